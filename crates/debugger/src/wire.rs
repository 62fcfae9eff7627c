//! Messages between an editor and a program that it started, over standard input and output: a header with a length,
//! then JSON. The Debug Adapter Protocol and the Language Server Protocol both have them.

use serde::{Serialize, de::DeserializeOwned};
use std::io::{self, BufRead, Read, Write};

/// Longest message that is read.
pub const MAX_MESSAGE_BYTES: u64 = 4 << 20;

/// Longest line of a header.
const MAX_HEADER_BYTES: u64 = 256;

/// Most lines of a header.
const MAX_HEADER_LINES: usize = 16;

/// Why the conversation ends.
#[derive(Debug, thiserror::Error)]
pub enum WireError {
    /// The other side cannot be read or written to.
    #[error("the editor cannot be reached: {0}")]
    Io(#[from] io::Error),
    /// This is no header.
    #[error("a message begins with `Content-Length: NUMBER`, of at most {MAX_MESSAGE_BYTES}")]
    Header,
    /// This is no message.
    #[error("a message that is none: {0}")]
    Message(#[from] serde_json::Error),
}

/// Reads a message; `None` at the end.
///
/// # Errors
/// All of [`WireError`].
pub fn read<T: DeserializeOwned>(input: &mut impl BufRead) -> Result<Option<T>, WireError> {
    let Some(text) = read_text(input)? else { return Ok(None) };
    Ok(Some(serde_json::from_slice(&text)?))
}

/// Reads the text of a message, whatever it is; `None` at the end.
///
/// # Errors
/// [`WireError::Io`] and [`WireError::Header`].
pub fn read_text(input: &mut impl BufRead) -> Result<Option<Vec<u8>>, WireError> {
    let mut length = None;
    for number in 0..MAX_HEADER_LINES {
        let mut line = Vec::new();
        if input.by_ref().take(MAX_HEADER_BYTES).read_until(b'\n', &mut line)? == 0 && number == 0 {
            return Ok(None);
        }
        let line = str::from_utf8(&line).map_err(|_| WireError::Header)?;
        if line.trim().is_empty() {
            break;
        }
        let (name, value) = line.split_once(':').ok_or(WireError::Header)?;
        if name.eq_ignore_ascii_case("Content-Length") {
            length = value.trim().parse::<u64>().ok();
        }
    }
    let length = length.filter(|length| *length <= MAX_MESSAGE_BYTES).ok_or(WireError::Header)?;
    let mut message = vec![0; length as usize];
    input.read_exact(&mut message)?;
    Ok(Some(message))
}

/// Writes a message.
///
/// # Errors
/// [`WireError::Io`] and [`WireError::Message`].
pub fn write(output: &mut impl Write, message: &impl Serialize) -> Result<(), WireError> {
    Ok(write_text(output, &serde_json::to_vec(message)?)?)
}

/// Writes the text of a message.
///
/// # Errors
/// Those of the output.
pub fn write_text(output: &mut impl Write, text: &[u8]) -> io::Result<()> {
    write!(output, "Content-Length: {}\r\n\r\n", text.len())?;
    output.write_all(text)?;
    output.flush()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    #[test]
    fn messages_come_back() {
        let mut bytes = Vec::new();
        write(&mut bytes, &json!({"seq": 1})).expect("a buffer takes everything");
        write(&mut bytes, &json!("ä")).expect("a buffer takes everything");
        assert!(bytes.starts_with(b"Content-Length: 9\r\n\r\n{"));
        let mut input = &bytes[..];
        assert_eq!(read::<Value>(&mut input).expect("a message"), Some(json!({"seq": 1})));
        assert_eq!(read::<Value>(&mut input).expect("a message"), Some(json!("ä")));
        assert!(read::<Value>(&mut input).expect("the end").is_none());
    }

    #[test]
    fn what_is_no_message() {
        let check = |text: &str, expected: &str| {
            let error = read::<Value>(&mut text.as_bytes()).expect_err(text).to_string();
            assert!(error.contains(expected), "{text}: {error}");
        };
        check("hello\r\n\r\n", "begins with");
        check("Content-Length: x\r\n\r\n", "begins with");
        check("Content-Length: 99999999999\r\n\r\n", "begins with");
        check("Content-Type: x\r\n\r\n{}", "begins with");
        check("Content-Length: 5\r\n\r\n{}", "cannot be reached");
        check("Content-Length: 2\r\n\r\n{]", "none");
        check(&"A: b\r\n".repeat(100), "begins with");
    }
}
