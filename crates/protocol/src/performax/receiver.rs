//! Cuts what comes in at a port into commands.

use super::{ADDRESS_MARK, CARRIAGE_RETURN, LINE_FEED, MAX_COMMAND, NUL, as_text, is_text};

/// Bytes before the command when it has an address.
const ADDRESS_LENGTH: usize = 3;

/// Most bytes of a line.
const LINE_LENGTH: usize = ADDRESS_LENGTH + MAX_COMMAND;

/// A command with the number of the device that it is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Message<'a> {
    /// The two digits behind `@`, 0 to 99, if the line began so.
    pub address: Option<u8>,
    /// What follows, at least one and at most [`MAX_COMMAND`] printable ASCII characters.
    pub text: Result<&'a str, TextError>,
}

/// Why a line or a packet is no text. Nothing of it is to be executed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TextError {
    /// It has more characters than there is room for.
    TooLong,
    /// It has a byte that is no printable ASCII character.
    NotText,
}

/// Collects the commands of one port. A carriage return, a line feed or a NUL ends one; what has nothing
/// before its end, as the padding of a USB packet, is none.
#[derive(Clone, Debug)]
pub struct Receiver {
    bytes: [u8; LINE_LENGTH],
    /// Bytes so far; above [`LINE_LENGTH`], how many is not known.
    length: usize,
    is_text: bool,
}

impl Default for Receiver {
    fn default() -> Self {
        Self::new()
    }
}

impl Receiver {
    /// One that has received nothing.
    pub const fn new() -> Self {
        Self { bytes: [0; LINE_LENGTH], length: 0, is_text: true }
    }

    /// Takes a byte and gives the command that it ended, if any. A line that is too long or has strange
    /// bytes in it is one message too, so that its sender can be told.
    pub fn push(&mut self, byte: u8) -> Option<Message<'_>> {
        if matches!(byte, CARRIAGE_RETURN | LINE_FEED | NUL) {
            return self.finish();
        }
        self.is_text &= is_text(byte);
        if let Some(place) = self.bytes.get_mut(self.length) {
            *place = byte;
        }
        self.length = (self.length + 1).min(LINE_LENGTH + 1);
        None
    }

    /// Forgets a command that has begun.
    pub fn clear(&mut self) {
        *self = Self::new();
    }

    fn finish(&mut self) -> Option<Message<'_>> {
        let length = core::mem::take(&mut self.length);
        let is_text = core::mem::replace(&mut self.is_text, true);
        let line = &self.bytes[..length.min(LINE_LENGTH)];
        let (address, command) = split_address(line);
        if command.is_empty() {
            return None;
        }
        let text = if !is_text {
            Err(TextError::NotText)
        } else if command.len() > MAX_COMMAND || length > LINE_LENGTH {
            Err(TextError::TooLong)
        } else {
            Ok(as_text(command))
        };
        Some(Message { address, text })
    }
}

/// The address that a line begins with, and the rest. Where no two digits follow the mark it is none.
fn split_address(line: &[u8]) -> (Option<u8>, &[u8]) {
    match line {
        [ADDRESS_MARK, tens @ b'0'..=b'9', units @ b'0'..=b'9', rest @ ..] => {
            (Some((tens - b'0') * 10 + units - b'0'), rest)
        }
        _ => (None, line),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    type Owned = (Option<u8>, Result<String, TextError>);

    fn messages(bytes: &[u8]) -> Vec<Owned> {
        let mut receiver = Receiver::new();
        let mut messages = Vec::new();
        for &byte in bytes {
            messages.extend(receiver.push(byte).map(|it| (it.address, it.text.map(str::to_owned))));
        }
        messages
    }

    fn check(input: &[u8], expected: &[(Option<u8>, Result<&str, TextError>)]) {
        let expected: Vec<Owned> =
            expected.iter().map(|(address, text)| (*address, text.map(str::to_owned))).collect();
        assert_eq!(messages(input), expected, "{}", input.escape_ascii());
    }

    /// The lines of the manual, 6.2.3.
    #[test]
    fn addressed_lines() {
        check(b"@00POLX\r", &[(Some(0), Ok("POLX"))]);
        check(b"@00DI\r@00STORE\r", &[(Some(0), Ok("DI")), (Some(0), Ok("STORE"))]);
        check(b"@42X-1000\r", &[(Some(42), Ok("X-1000"))]);
        check(b"@99ID\n", &[(Some(99), Ok("ID"))]);
    }

    #[test]
    fn bare_lines() {
        check(b"ID\rX1000\nMST\0", &[(None, Ok("ID")), (None, Ok("X1000")), (None, Ok("MST"))]);
        check(b"I1000:-1000\r\n", &[(None, Ok("I1000:-1000"))]);
        check(b"DN=2ED02\0\0\0\0\0", &[(None, Ok("DN=2ED02"))]);
        check(b"no end", &[]);
    }

    #[test]
    fn empty_lines() {
        check(b"\r\n\0\r", &[]);
        check(b"@00\r", &[]);
        check(b" \r", &[(None, Ok(" "))]);
    }

    #[test]
    fn an_address_has_two_digits() {
        check(b"@0POLX\r", &[(None, Ok("@0POLX"))]);
        check(b"@\r", &[(None, Ok("@"))]);
        check(b"@7\r", &[(None, Ok("@7"))]);
        check(b"@X1MST\r", &[(None, Ok("@X1MST"))]);
        check(b"@012\r", &[(Some(1), Ok("2"))]);
        check(b" @00ID\r", &[(None, Ok(" @00ID"))]);
    }

    #[test]
    fn a_command_has_a_bound() {
        let most = "V".repeat(MAX_COMMAND);
        let line = |address: &str, end: &str| format!("{address}{most}{end}\rID\r").into_bytes();
        let next = (None, Ok("ID"));
        check(&line("", ""), &[(None, Ok(&most)), next]);
        check(&line("@07", ""), &[(Some(7), Ok(&most)), next]);
        check(&line("", "V"), &[(None, Err(TextError::TooLong)), next]);
        check(&line("@07", "V"), &[(Some(7), Err(TextError::TooLong)), next]);
        check(&line("@07", &most), &[(Some(7), Err(TextError::TooLong)), next]);
    }

    #[test]
    fn strange_bytes() {
        let next = (None, Ok("ID"));
        check(b"X\x80\rID\r", &[(None, Err(TextError::NotText)), next]);
        check(b"@03\tMST\rID\r", &[(Some(3), Err(TextError::NotText)), next]);
        check(b"STOP\x7F\rID\r", &[(None, Err(TextError::NotText)), next]);
        check(b"\x01\rID\r", &[(None, Err(TextError::NotText)), next]);
        // Beyond the bound too.
        let long = [[b'V'; 100].as_slice(), b"\xFF\rID\r"].concat();
        check(&long, &[(None, Err(TextError::NotText)), next]);
    }

    #[test]
    fn a_command_can_be_forgotten() {
        let mut receiver = Receiver::new();
        assert_eq!(receiver.push(0xFF), None);
        assert_eq!(receiver.push(b'X'), None);
        receiver.clear();
        assert_eq!(receiver.push(b'V'), None);
        assert_eq!(receiver.push(NUL), Some(Message { address: None, text: Ok("V") }));
    }

    proptest! {
        /// A stream says the same as its lines one by one, and each of them gives one message at most.
        #[test]
        fn lines_do_not_meet(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
            let bytes = [bytes, b"\r".to_vec()].concat();
            let lines = bytes.split_inclusive(|byte| matches!(byte, 0 | b'\r' | b'\n'));
            let one_by_one: Vec<Owned> = lines.flat_map(|line| {
                let messages = messages(line);
                assert!(messages.len() <= 1);
                messages
            }).collect();
            prop_assert_eq!(messages(&bytes), one_by_one);
        }
    }
}
