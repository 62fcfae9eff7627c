//! What a controller answers.

use super::CARRIAGE_RETURN;
use core::fmt;

/// Most characters in a reply: an error's words and the command that it repeats.
pub const MAX_REPLY: usize = 96;

/// A reply that is being written; its end is not in it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Reply(heapless::String<MAX_REPLY>);

impl Reply {
    /// An empty one.
    pub const fn new() -> Self {
        Self(heapless::String::new())
    }

    /// What it says so far.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// The bytes for a serial line: the text and a carriage return.
    pub fn emit(&self) -> heapless::Vec<u8, { MAX_REPLY + 1 }> {
        let mut line = heapless::Vec::new();
        line.extend(self.0.bytes().chain([CARRIAGE_RETURN]));
        line
    }
}

impl fmt::Write for Reply {
    /// Fails beyond [`MAX_REPLY`] characters; what does not fit as a whole is left out.
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.push_str(text).map_err(|_| fmt::Error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::fmt::Write;

    #[test]
    fn lines() {
        let check = |text: &str, expected: &[u8]| {
            let mut reply = Reply::new();
            write!(reply, "{text}").unwrap();
            assert_eq!(reply.emit(), expected);
        };
        // Manual, 6.2.3.
        check("7", b"7\r");
        check("OK", b"OK\r");
        check("", b"\r");
        check(&"x".repeat(MAX_REPLY), &[[b'x'; MAX_REPLY].as_slice(), b"\r"].concat());
    }

    #[test]
    fn a_reply_has_a_bound() {
        let mut reply = Reply::new();
        write!(reply, "{}", "x".repeat(MAX_REPLY)).unwrap();
        assert!(write!(reply, "x").is_err());
        assert_eq!(reply.as_str().len(), MAX_REPLY);
    }
}
