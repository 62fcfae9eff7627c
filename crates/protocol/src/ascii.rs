//! The ASCII line interface of TMCL modules (manual 3.4): the module's side of a terminal.
//!
//! A line is an address character, a command and a carriage return. The editor decides what is echoed
//! and when a line is complete; what the line says is somebody else's business.

use crate::tmcl::Status;
use core::fmt::Write;

/// Most characters in a line, address character included, carriage return not.
pub const LINE_LENGTH: usize = 80;

/// Most bytes in a reply: two addresses, status, value, separators and carriage return.
pub const REPLY_LENGTH: usize = 20;

const CARRIAGE_RETURN: u8 = b'\r';
const BACKSPACE: u8 = 0x08;
const DELETE: u8 = 0x7F;

/// What rubs out a character on a terminal.
const RUB_OUT: &[u8] = b"\x08 \x08";

/// The character of an address: `A` for 1, `B` for 2, and so on through the 8-bit codes.
pub const fn address_character(address: u8) -> u8 {
    b'@'.wrapping_add(address)
}

/// What is sent back of the characters that come in (global parameter 67).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Echo {
    /// Each character at once.
    #[default]
    Character,
    /// The whole line after its carriage return.
    Line,
    /// Nothing; only the reply is sent.
    Off,
}

impl Echo {
    /// The setting in bits 4 and 5 of global parameter 67. With both set there is no echo.
    pub const fn from_parameter(value: i32) -> Self {
        match (value & 1 << 4 != 0, value & 1 << 5 != 0) {
            (false, false) => Self::Character,
            (true, false) => Self::Line,
            (_, true) => Self::Off,
        }
    }
}

/// A finished line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Line<'a> {
    /// The printable ASCII characters behind the address character.
    Command(&'a str),
    /// There were more than [`LINE_LENGTH`]. Nothing of it is to be executed.
    TooLong,
}

/// What comes of a character.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Step<'a> {
    /// Bytes to send back, before any reply.
    pub echo: &'a [u8],
    /// The line, if this character ended one for this module.
    pub line: Option<Line<'a>>,
}

/// Collects a line. Lines for other modules are let pass without a sound.
#[derive(Clone, Debug)]
pub struct Editor {
    /// The line with its address character, then room for the carriage return.
    bytes: [u8; LINE_LENGTH + 1],
    length: usize,
    state: State,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// Nothing yet of this line.
    Empty,
    /// The line is for this module.
    Addressed,
    /// It is, and has grown too long.
    Overlong,
    /// It is for another one.
    Foreign,
}

impl Default for Editor {
    fn default() -> Self {
        Self::new()
    }
}

impl Editor {
    /// An empty line.
    pub const fn new() -> Self {
        Self { bytes: [0; LINE_LENGTH + 1], length: 0, state: State::Empty }
    }

    /// Forgets the line.
    pub fn clear(&mut self) {
        self.length = 0;
        self.state = State::Empty;
    }

    /// Takes a character; `address` is the module's. Line feeds, other control characters and bytes
    /// above 7Eh are ignored inside a line.
    pub fn push(&mut self, byte: u8, address: u8, echo: Echo) -> Step<'_> {
        let nothing = Step { echo: &[], line: None };
        match (self.state, byte) {
            (State::Empty, CARRIAGE_RETURN | b'\n') => nothing,
            (State::Empty, _) if byte == address_character(address) => {
                self.state = State::Addressed;
                self.append(byte, echo)
            }
            (State::Empty, _) => {
                self.state = State::Foreign;
                nothing
            }
            (State::Foreign, CARRIAGE_RETURN) => {
                self.clear();
                nothing
            }
            (State::Foreign, _) => nothing,
            (_, CARRIAGE_RETURN) => self.finish(echo),
            (_, BACKSPACE | DELETE) => self.erase(echo),
            (State::Overlong, _) => nothing,
            (State::Addressed, b' '..=b'~') if self.length == LINE_LENGTH => {
                self.state = State::Overlong;
                nothing
            }
            (State::Addressed, b' '..=b'~') => self.append(byte, echo),
            (State::Addressed, _) => nothing,
        }
    }

    fn append(&mut self, byte: u8, echo: Echo) -> Step<'_> {
        self.bytes[self.length] = byte;
        self.length += 1;
        let tail = &self.bytes[self.length - 1..self.length];
        Step { echo: if echo == Echo::Character { tail } else { &[] }, line: None }
    }

    /// Takes back a character; the address character too, and then the line is nobody's again.
    fn erase(&mut self, echo: Echo) -> Step<'_> {
        // What did not fit was not echoed either, so there is nothing on the screen to rub out.
        if self.state == State::Overlong {
            return Step { echo: &[], line: None };
        }
        self.length -= 1;
        if self.length == 0 {
            self.state = State::Empty;
        }
        Step { echo: if echo == Echo::Character { RUB_OUT } else { &[] }, line: None }
    }

    fn finish(&mut self, echo: Echo) -> Step<'_> {
        let (length, overlong) = (self.length, self.state == State::Overlong);
        self.clear();
        self.bytes[length] = CARRIAGE_RETURN;
        let echo = match echo {
            Echo::Character => &self.bytes[length..=length],
            Echo::Line => &self.bytes[..=length],
            Echo::Off => &[],
        };
        let text = core::str::from_utf8(&self.bytes[1..length]).unwrap_or_default();
        Step { echo, line: Some(if overlong { Line::TooLong } else { Line::Command(text) }) }
    }
}

/// The bytes of a reply: `BA 100 -5000` and a carriage return.
pub fn reply(host: u8, module: u8, status: Status, value: i32) -> heapless::Vec<u8, REPLY_LENGTH> {
    let mut text = heapless::Vec::<u8, REPLY_LENGTH>::new();
    let addresses = [address_character(host), address_character(module)];
    let written = text
        .extend_from_slice(&addresses)
        .and_then(|()| write!(text, " {} {value}\r", status.0).map_err(|_| Default::default()));
    assert!(written.is_ok(), "REPLY_LENGTH holds the longest reply");
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// What is echoed, and the lines, for module 1.
    fn type_in(input: &[u8], echo: Echo) -> (Vec<u8>, Vec<String>) {
        let mut editor = Editor::new();
        let (mut echoed, mut lines) = (Vec::new(), Vec::new());
        for &byte in input {
            let step = editor.push(byte, 1, echo);
            echoed.extend_from_slice(step.echo);
            lines.extend(step.line.map(|line| match line {
                Line::Command(text) => text.to_owned(),
                Line::TooLong => "too long".to_owned(),
            }));
        }
        (echoed, lines)
    }

    #[test]
    fn echo_settings() {
        let check = |parameter: i32, echoed: &str| {
            let (bytes, lines) = type_in(b"AMST 1\x080\r", Echo::from_parameter(parameter));
            assert_eq!(String::from_utf8(bytes).expect("ASCII"), echoed, "{parameter}");
            assert_eq!(lines, ["MST 0"]);
        };
        check(0, "AMST 1\x08 \x080\r");
        check(1, "AMST 1\x08 \x080\r");
        check(1 << 4, "AMST 0\r");
        check(1 << 5, "");
        check(3 << 4, "");
    }

    #[test]
    fn lines() {
        let check = |input: &[u8], expected: &[&str]| assert_eq!(type_in(input, Echo::Off).1, expected);
        check(b"AMVP ABS, 1, 50000\r", &["MVP ABS, 1, 50000"]);
        check(b"A MVP ABS, 1, 50000\r", &[" MVP ABS, 1, 50000"]);
        check(b"AROL 2, 500\rA MST 1\rABIN\r", &["ROL 2, 500", " MST 1", "BIN"]);
        check(b"A\r\n\r\nA\r\n", &["", ""]);
        check(b"A\x08B\r", &[]);
        check(b"B\x7F\x08AMST 0\rAMST 0\r", &["MST 0"]);
        check(b"AM\xFFS\x00T\t 0\r", &["MST 0"]);
        check(b"A\x08\x08\x08\rAMST 0\r", &["MST 0"]);
    }

    #[test]
    fn a_line_for_another_module_is_not_echoed() {
        for echo in [Echo::Character, Echo::Line, Echo::Off] {
            assert_eq!(type_in(b"BMST 0\ra MST 0\r", echo), (Vec::new(), Vec::new()));
        }
    }

    #[test]
    fn a_line_has_a_bound() {
        let exact = [b"A".as_slice(), &[b'x'; LINE_LENGTH - 1], b"\r"].concat();
        let more = [b"A".as_slice(), &[b'x'; LINE_LENGTH], b"\x08\r"].concat();
        let expected = core::str::from_utf8(&exact[1..LINE_LENGTH]).expect("ASCII");
        assert_eq!(type_in(&exact, Echo::Off).1, [expected]);
        assert_eq!(type_in(&more, Echo::Off).1, ["too long"]);
    }

    #[test]
    fn replies() {
        let check = |host, module, status, value, expected: &[u8]| {
            assert_eq!(reply(host, module, status, value), expected);
        };
        check(2, 1, Status::OK, -5000, b"BA 100 -5000\r");
        check(2, 1, Status::INVALID_VALUE, 0, b"BA 4 0\r");
        check(0, 255, Status(255), i32::MIN, b"@? 255 -2147483648\r");
    }

    proptest! {
        /// Nothing panics, and with echo off nothing is sent.
        #[test]
        fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
            let (echoed, lines) = type_in(&bytes, Echo::Off);
            prop_assert!(echoed.is_empty());
            prop_assert!(lines.len() <= bytes.iter().filter(|&&byte| byte == b'\r').count());
            type_in(&bytes, Echo::Character);
            type_in(&bytes, Echo::Line);
        }
    }
}
