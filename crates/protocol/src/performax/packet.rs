//! The packets of USB.

use super::{NUL, TextError, as_text, is_text};

/// Bytes of a packet, in both directions (manual, 6.1.2).
pub const PACKET_LENGTH: usize = 64;

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
