//! The lines `t`, `T`, `r` and `R`: a frame on the bus.

use super::{CARRIAGE_RETURN, Text};
use crate::can;

/// The largest 29-bit identifier.
pub const MAX_EXTENDED_ID: u32 = 0x1FFF_FFFF;

/// The identifier of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Identifier {
    /// 11 bits.
    Standard(u16),
    /// 29 bits.
    Extended(u32),
}

/// What a frame carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Payload {
    /// Data: the first `length` (at most 8) of the bytes.
    Data {
        /// How many bytes count.
        length: u8,
        /// The bytes; 0 behind the end.
        bytes: [u8; can::MAX_DATA],
    },
    /// A request for a frame of this length (at most 8).
    Remote {
        /// The length field.
        length: u8,
    },
}

/// A frame as an adapter's line gives it. Only 11-bit data frames can be TMCL: see
/// [`frame`](Self::frame).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Message {
    /// Its identifier.
    pub identifier: Identifier,
    /// Its data, or the request for it.
    pub payload: Payload,
}

impl From<&can::Frame> for Message {
    fn from(frame: &can::Frame) -> Self {
        let mut bytes = [0; can::MAX_DATA];
        bytes[..frame.data().len()].copy_from_slice(frame.data());
        let payload = Payload::Data { length: frame.data().len() as u8, bytes };
        Self { identifier: Identifier::Standard(frame.id()), payload }
    }
}

impl Message {
    /// The message as a data frame with an 11-bit identifier, if it is one.
    pub fn frame(&self) -> Option<can::Frame> {
        match (self.identifier, &self.payload) {
            (Identifier::Standard(id), Payload::Data { length, bytes }) => {
                can::Frame::new(id, bytes.get(..usize::from(*length))?).ok()
            }
            _ => None,
        }
    }

    /// Reads a line without its end, and gives what is left behind the message (a time stamp). `None` if
    /// it is no message, or one with a wrong digit, length or identifier.
    pub fn parse(line: &[u8]) -> Option<(Self, &[u8])> {
        let (&kind, rest) = line.split_first()?;
        let (identifier, rest) = match kind {
            b't' | b'r' => {
                let (id, rest) = number(rest, 3)?;
                let id = u16::try_from(id).ok().filter(|&id| id <= can::MAX_ID)?;
                (Identifier::Standard(id), rest)
            }
            b'T' | b'R' => {
                let (id, rest) = number(rest, 8)?;
                (Identifier::Extended(Some(id).filter(|&id| id <= MAX_EXTENDED_ID)?), rest)
            }
            _ => return None,
        };
        let (&digit, mut rest) = rest.split_first()?;
        let length = Some(digit.wrapping_sub(b'0')).filter(|&length| usize::from(length) <= can::MAX_DATA)?;
        if matches!(kind, b'r' | b'R') {
            return Some((Self { identifier, payload: Payload::Remote { length } }, rest));
        }
        let mut bytes = [0; can::MAX_DATA];
        for byte in &mut bytes[..usize::from(length)] {
            let (value, after) = number(rest, 2)?;
            *byte = value as u8;
            rest = after;
        }
        Some((Self { identifier, payload: Payload::Data { length, bytes } }, rest))
    }

    /// The line, with its end. `time_ms` is the adapter's time stamp, if it sends them.
    pub fn emit(&self, time_ms: Option<u16>) -> Text {
        let mut text = Text::new();
        let remote = matches!(self.payload, Payload::Remote { .. });
        match self.identifier {
            Identifier::Standard(id) => {
                put(&mut text, if remote { b'r' } else { b't' });
                hex(&mut text, u32::from(id & can::MAX_ID), 3);
            }
            Identifier::Extended(id) => {
                put(&mut text, if remote { b'R' } else { b'T' });
                hex(&mut text, id & MAX_EXTENDED_ID, 8);
            }
        }
        match self.payload {
            Payload::Remote { length } => put(&mut text, b'0' + length.min(can::MAX_DATA as u8)),
            Payload::Data { length, bytes } => {
                let data = &bytes[..usize::from(length).min(can::MAX_DATA)];
                put(&mut text, b'0' + data.len() as u8);
                data.iter().for_each(|&byte| hex(&mut text, u32::from(byte), 2));
            }
        }
        if let Some(time) = time_ms {
            hex(&mut text, u32::from(time), 4);
        }
        put(&mut text, CARRIAGE_RETURN);
        text
    }
}

/// The number in the first `digits` (at most 8) hexadecimal digits, and what follows them.
pub(super) fn number(text: &[u8], digits: usize) -> Option<(u32, &[u8])> {
    let (head, rest) = text.split_at_checked(digits)?;
    let value =
        head.iter().try_fold(0, |value, &digit| Some(value << 4 | char::from(digit).to_digit(16)?))?;
    Some((value, rest))
}

/// Appends upper-case hexadecimal digits.
pub(super) fn hex(text: &mut Text, value: u32, digits: u32) {
    for digit in (0..digits).rev() {
        put(text, b"0123456789ABCDEF"[(value >> (4 * digit) & 0xF) as usize]);
    }
}

/// Appends a character. Every line of ours fits its bound.
pub(super) fn put(text: &mut Text, byte: u8) {
    assert!(text.push(byte).is_ok(), "an SLCAN line has a bound of LINE_LENGTH");
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn lines() {
        let check = |line: &[u8], message: Message, rest: &[u8]| {
            assert_eq!(Message::parse(line), Some((message, rest)), "{line:?}");
        };
        let data = |data: &[u8]| {
            let mut bytes = [0; 8];
            bytes[..data.len()].copy_from_slice(data);
            Payload::Data { length: data.len() as u8, bytes }
        };
        let standard = Identifier::Standard;
        check(
            b"t0017060100FFFFFFFE",
            Message { identifier: standard(1), payload: data(&[6, 1, 0, 255, 255, 255, 254]) },
            b"",
        );
        check(
            b"t7FF2abCD1234",
            Message { identifier: standard(0x7FF), payload: data(&[0xAB, 0xCD]) },
            b"1234",
        );
        check(b"r1235", Message { identifier: standard(0x123), payload: Payload::Remote { length: 5 } }, b"");
        let extended = Identifier::Extended(0x1FFF_FFFF);
        check(b"T1FFFFFFF0", Message { identifier: extended, payload: data(&[]) }, b"");
        check(b"R1FFFFFFF8", Message { identifier: extended, payload: Payload::Remote { length: 8 } }, b"");
    }

    #[test]
    fn wrong_lines() {
        for line in [
            &b"t8000"[..],
            b"t",
            b"t1",
            b"t0019",
            b"t001:",
            b"t00110",
            b"t0011g0",
            b"T200000000",
            b"T0000",
            b"x0010",
            b"",
        ] {
            assert_eq!(Message::parse(line), None, "{line:?}");
        }
    }

    #[test]
    fn the_longest_line_fits() {
        let payload = Payload::Data { length: 8, bytes: [0xFF; 8] };
        let message = Message { identifier: Identifier::Extended(MAX_EXTENDED_ID), payload };
        assert_eq!(message.emit(Some(59_999)), b"T1FFFFFFF8FFFFFFFFFFFFFFFFEA5F\r");
    }

    proptest! {
        #[test]
        fn parse_and_emit_agree(line in "[tTrR][0-9A-F]{0,27}") {
            if let Some((message, rest)) = Message::parse(line.as_bytes()) {
                let text = message.emit(None);
                prop_assert_eq!(&text[..text.len() - 1], &line.as_bytes()[..line.len() - rest.len()]);
            }
        }

        #[test]
        fn any_bytes(line in prop::collection::vec(any::<u8>(), 0..40)) {
            let _ = Message::parse(&line);
        }
    }
}
