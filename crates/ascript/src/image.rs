//! Program files: a head of eight bytes, the compiled lines, and a check of both.
//!
//! The head is the magic number, the format's version, the family and the number of lines (LSB first); the
//! check is the CRC-32 of everything before it (LSB first).

use crate::dialect::Dialect;
use crate::line::{BYTES, Line};
use thiserror::Error;

const MAGIC: [u8; 4] = *b"ASCR";
const VERSION: u8 = 1;
const HEAD: usize = 8;
const CHECK: usize = 4;

/// Why bytes are no program file.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum ImageError {
    /// It does not begin like one, or is of another version.
    #[error("this is no A-SCRIPT program file")]
    Magic,
    /// It is for another family of controllers.
    #[error("the program is for another family of controllers")]
    Family,
    /// Its length is not what its head says.
    #[error("a program file of {lines} lines has {expected} bytes, this one has {received}")]
    Length {
        /// Lines, as the head says.
        lines: usize,
        /// Bytes it should have.
        expected: usize,
        /// Bytes it has.
        received: usize,
    },
    /// There are more lines than the memory has.
    #[error("there is room for {most} lines, this file has {lines}")]
    TooLong {
        /// Lines in the file.
        lines: usize,
        /// Lines of the memory.
        most: u16,
    },
    /// The check is wrong.
    #[error("the program file is damaged")]
    Check,
    /// Bytes that are no line of the dialect.
    #[error("line {0} is none")]
    Line(usize),
}

/// The program file of these lines.
///
/// # Panics
/// If there are more than 65535 of them, which no memory has.
pub fn to_file(lines: &[Line], dialect: &Dialect) -> Vec<u8> {
    let [low, high] = u16::try_from(lines.len()).expect("no memory has so many lines").to_le_bytes();
    let mut bytes = Vec::with_capacity(HEAD + lines.len() * BYTES + CHECK);
    bytes.extend_from_slice(&MAGIC);
    bytes.extend_from_slice(&[VERSION, dialect.family as u8, low, high]);
    lines.iter().for_each(|line| bytes.extend_from_slice(&line.to_bytes()));
    bytes.extend_from_slice(&crc(&bytes).to_le_bytes());
    bytes
}

/// The lines of a program file.
///
/// # Errors
/// Anything that [`to_file`] would not have written of lines that fit the dialect is refused.
pub fn from_file(bytes: &[u8], dialect: &Dialect) -> Result<Vec<Line>, ImageError> {
    let Some((head, rest)) = bytes.split_first_chunk::<HEAD>() else { return Err(ImageError::Magic) };
    let &[m0, m1, m2, m3, version, family, low, high] = head;
    if [m0, m1, m2, m3] != MAGIC || version != VERSION {
        return Err(ImageError::Magic);
    }
    let lines = usize::from(u16::from_le_bytes([low, high]));
    let expected = HEAD + lines * BYTES + CHECK;
    if bytes.len() != expected {
        return Err(ImageError::Length { lines, expected, received: bytes.len() });
    }
    let (body, check) = rest.split_at(rest.len() - CHECK);
    if crc(&bytes[..bytes.len() - CHECK]).to_le_bytes() != *check {
        return Err(ImageError::Check);
    }
    if family != dialect.family as u8 {
        return Err(ImageError::Family);
    }
    if lines > usize::from(dialect.lines) {
        return Err(ImageError::TooLong { lines, most: dialect.lines });
    }
    let (records, _) = body.as_chunks::<BYTES>();
    let line = |(number, record)| Line::from_bytes(record, dialect).ok_or(ImageError::Line(number));
    records.iter().enumerate().map(line).collect()
}

/// CRC-32 as in IEEE 802.3.
fn crc(bytes: &[u8]) -> u32 {
    const POLYNOMIAL: u32 = 0xEDB8_8320;
    let crc = bytes.iter().fold(u32::MAX, |crc, &byte| {
        let step = |crc: u32, _| if crc & 1 == 1 { crc >> 1 ^ POLYNOMIAL } else { crc >> 1 };
        (0..u8::BITS).fold(crc ^ u32::from(byte), step)
    });
    !crc
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dialect::{COMMANDER, PERFORMAX_2};

    #[test]
    fn check_value() {
        assert_eq!(crc(b"123456789"), 0xCBF4_3926);
    }

    #[test]
    fn there_and_back() {
        for lines in [vec![], vec![Line::Program(0), Line::EndWhile { target: 700 }, Line::End]] {
            let file = to_file(&lines, &PERFORMAX_2);
            assert_eq!(from_file(&file, &PERFORMAX_2), Ok(lines));
        }
    }

    #[test]
    fn damaged_files() {
        let file = to_file(&[Line::Program(0), Line::End], &PERFORMAX_2);
        for position in 0..file.len() {
            let mut damaged = file.clone();
            damaged[position] ^= 0x40;
            assert!(from_file(&damaged, &PERFORMAX_2).is_err(), "byte {position}");
            assert!(from_file(&file[..position], &PERFORMAX_2).is_err(), "{position} bytes");
        }
        let check = |file: &[u8], expected| assert_eq!(from_file(file, &PERFORMAX_2), Err(expected));
        check(b"", ImageError::Magic);
        check(&file[..20], ImageError::Length { lines: 2, expected: 36, received: 20 });
        check(&to_file(&[], &COMMANDER), ImageError::Family);
        check(&to_file(&[Line::End; 1276], &PERFORMAX_2), ImageError::TooLong { lines: 1276, most: 1275 });
        check(&to_file(&[Line::End, Line::Program(2)], &PERFORMAX_2), ImageError::Line(1));
    }
}
