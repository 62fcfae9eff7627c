//! Cuts a stream of bytes into lines.

use super::{BELL, CARRIAGE_RETURN, LINE_LENGTH};

/// What a byte ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Line<'a> {
    /// A line, without its carriage return; it may be empty.
    Text(&'a [u8]),
    /// The other side said no. A line that was begun is dropped.
    Bell,
    /// More than [`LINE_LENGTH`] characters came without an end; all of them are dropped.
    TooLong,
}

/// Collects one side's characters.
#[derive(Clone, Debug, Default)]
pub struct Lines {
    bytes: [u8; LINE_LENGTH],
    /// Characters so far; above the bound, how many is not known.
    length: usize,
}

impl Lines {
    /// An empty line.
    pub const fn new() -> Self {
        Self { bytes: [0; LINE_LENGTH], length: 0 }
    }

    /// Takes a byte. Line feeds are ignored.
    pub fn push(&mut self, byte: u8) -> Option<Line<'_>> {
        match byte {
            CARRIAGE_RETURN => {
                let length = core::mem::take(&mut self.length);
                Some(self.bytes.get(..length).map_or(Line::TooLong, Line::Text))
            }
            BELL => {
                self.length = 0;
                Some(Line::Bell)
            }
            b'\n' => None,
            _ => {
                if let Some(place) = self.bytes.get_mut(self.length) {
                    *place = byte;
                }
                self.length = (self.length + 1).min(LINE_LENGTH + 1);
                None
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends() {
        let check = |input: &[u8], expected: &[Line<'_>]| {
            let mut lines = Lines::new();
            let mut count = 0;
            for &byte in input {
                if let Some(line) = lines.push(byte) {
                    assert_eq!(line, expected[count]);
                    count += 1;
                }
            }
            assert_eq!(count, expected.len());
        };
        check(b"S8\rO\r\n\r", &[Line::Text(b"S8"), Line::Text(b"O"), Line::Text(b"")]);
        check(b"t12\x07O\r", &[Line::Bell, Line::Text(b"O")]);
        check(&[b"x".repeat(30), b"\r".to_vec()].concat(), &[Line::Text(&[b'x'; 30])]);
        check(&[b"x".repeat(31), b"\rC\r".to_vec()].concat(), &[Line::TooLong, Line::Text(b"C")]);
    }
}
