//! The packets of USB.

use super::{CARRIAGE_RETURN, NUL, TextError, as_text, is_text};

/// Bytes of a packet, in both directions (PMX-2ED-SA manual, 6.1.2; CMD-4CR manual, 3.1.2.6).
pub const PACKET_LENGTH: usize = 64;

/// What a controller hears of a packet without text in it: a line that is none.
const NO_TEXT: &[u8] = &[0x7F, NUL];

/// A command or a reply on its way over USB: text, a NUL, and padding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Packet(pub [u8; PACKET_LENGTH]);

impl Packet {
    /// The packet of a text, padded with NUL.
    ///
    /// # Errors
    /// [`TextError::NotText`], or [`TextError::TooLong`] for 64 characters and more.
    pub fn encode(text: &str) -> Result<Self, TextError> {
        if !text.bytes().all(is_text) {
            return Err(TextError::NotText);
        }
        // One byte stays for the NUL.
        if text.len() >= PACKET_LENGTH {
            return Err(TextError::TooLong);
        }
        let mut bytes = [NUL; PACKET_LENGTH];
        bytes[..text.len()].copy_from_slice(text.as_bytes());
        Ok(Self(bytes))
    }

    /// The text before the NUL. What stands behind it is whatever was left in the sender's buffer.
    ///
    /// # Errors
    /// [`TextError::NotText`], or [`TextError::TooLong`] if there is no NUL.
    pub fn decode(&self) -> Result<&str, TextError> {
        let end = self.0.iter().position(|byte| *byte == NUL).ok_or(TextError::TooLong)?;
        let text = &self.0[..end];
        if text.iter().copied().all(is_text) { Ok(as_text(text)) } else { Err(TextError::NotText) }
    }

    /// What the controller is to hear of a packet: its text with the NUL, and nothing of what stands behind
    /// it. Instead of a packet that is no text it hears a line that is none, which it refuses as such.
    pub fn heard(&self) -> &[u8] {
        self.decode().map_or(NO_TEXT, |text| &self.0[..=text.len()])
    }

    /// The packet of a controller's reply, as it sends it over a serial line. There is room for 63 characters;
    /// of a longer one, which only repeats the words that it refuses, the end is cut off.
    pub fn of_reply(line: &[u8]) -> Self {
        let text = line.strip_suffix(&[CARRIAGE_RETURN]).unwrap_or(line);
        let text = &text[..text.len().min(PACKET_LENGTH - 1)];
        let mut bytes = [NUL; PACKET_LENGTH];
        bytes[..text.len()].copy_from_slice(text);
        Self(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::performax::Receiver;
    use proptest::prelude::*;

    #[test]
    fn encode() {
        let check =
            |text: &str, expected| assert_eq!(Packet::encode(text).map(|it| it.0[text.len()]), expected);
        check("", Ok(0));
        check("DN=2ED02", Ok(0));
        check(&"V".repeat(63), Ok(0));
        check(&"V".repeat(64), Err(TextError::TooLong));
        check("X1000\r", Err(TextError::NotText));
        check("µ", Err(TextError::NotText));
    }

    #[test]
    fn decode() {
        let check = |bytes: &[u8], expected| {
            let mut packet = Packet([0xAA; PACKET_LENGTH]);
            packet.0[..bytes.len()].copy_from_slice(bytes);
            assert_eq!(packet.decode(), expected);
        };
        check(b"OK\0", Ok("OK"));
        check(b"\0", Ok(""));
        check(b"OK\0behind", Ok("OK"));
        check(b"OK\r\0", Err(TextError::NotText));
        check(&[b'V'; 64], Err(TextError::TooLong));
    }

    #[test]
    fn heard() {
        let check = |bytes: &[u8], expected: &[u8]| {
            let mut packet = Packet([0xAA; PACKET_LENGTH]);
            packet.0[..bytes.len()].copy_from_slice(bytes);
            assert_eq!(packet.heard(), expected, "{}", bytes.escape_ascii());
        };
        check(b"PX\0", b"PX\0");
        check(b"PX\0ABORT\0", b"PX\0");
        check(b"\0PX\0", b"\0");
        check(b"PX\r\0", NO_TEXT);
        // Cut off somewhere, it is not to be executed.
        check(&[b'7'; 64], NO_TEXT);
        check(b"@01X100000", NO_TEXT);
        let refused: Vec<_> = {
            let mut receiver = Receiver::new();
            NO_TEXT.iter().filter_map(|byte| receiver.push(*byte).map(|it| it.text.is_err())).collect()
        };
        assert_eq!(refused, [true]);
    }

    #[test]
    fn of_reply() {
        let check = |line: &[u8], expected: &str| {
            assert_eq!(Packet::of_reply(line), Packet::encode(expected).unwrap());
        };
        check(b"OK\r", "OK");
        check(b"\r", "");
        check(b"-1000", "-1000");
        check(&[[b'?'; 63].as_slice(), b"\r"].concat(), &"?".repeat(63));
        check(&[[b'?'; 96].as_slice(), b"\r"].concat(), &"?".repeat(63));
    }

    proptest! {
        /// A packet says the same to the controller as its text alone.
        #[test]
        fn there_and_back(text in "[ -~]{0,63}") {
            let packet = Packet::encode(&text).unwrap();
            prop_assert_eq!(packet.decode(), Ok(text.as_str()));
            let mut receiver = Receiver::new();
            let mut received = Vec::new();
            for byte in packet.0 {
                received.extend(receiver.push(byte).map(|it| (it.address, it.text.map(str::to_owned))));
            }
            let mut receiver = Receiver::new();
            let mut expected = Vec::new();
            for byte in text.bytes().chain([0]) {
                expected.extend(receiver.push(byte).map(|it| (it.address, it.text.map(str::to_owned))));
            }
            prop_assert_eq!(received, expected);
        }

        #[test]
        fn any_bytes(bytes: [u8; 32]) {
            let mut packet = Packet([0; PACKET_LENGTH]);
            packet.0[..32].copy_from_slice(&bytes);
            if let Ok(text) = packet.decode() {
                prop_assert!(Packet::encode(text).is_ok());
            }
        }
    }
}
