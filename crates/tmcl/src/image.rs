//! Program files: a record of eight bytes a command.

use crate::isa::{Command, PROGRAM_LENGTH};
use protocol::tmcl::checksum;
use thiserror::Error;

/// Bytes of a record: opcode, type, motor, value (MSB first) and the 8-bit sum of those seven.
pub const RECORD_LENGTH: usize = 8;

/// Why bytes are no program file.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum ImageError {
    /// The last record is incomplete.
    #[error("a program file has {RECORD_LENGTH} bytes a command, this one has {0} bytes")]
    Length(usize),
    /// There are more records than the program memory has cells.
    #[error("the program memory has {PROGRAM_LENGTH} commands, this file {0}")]
    TooLong(usize),
    /// The sum of a record is wrong.
    #[error("record {record} has checksum {received:02X}h, expected {expected:02X}h")]
    Checksum {
        /// Which one, from 0: the address of its command.
        record: usize,
        /// The byte in the file.
        received: u8,
        /// The sum of the seven bytes before it.
        expected: u8,
    },
}

/// The program file of these commands.
pub fn to_bytes(commands: &[Command]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(commands.len() * RECORD_LENGTH);
    for &Command { opcode, kind, motor, value } in commands {
        let [a, b, c, d] = value.to_be_bytes();
        let record = [opcode, kind, motor, a, b, c, d];
        bytes.extend_from_slice(&record);
        bytes.push(checksum(&record));
    }
    bytes
}

/// The commands of a program file.
///
/// # Errors
/// Anything that [`to_bytes`] would not have written is refused, with the number of the record.
pub fn from_bytes(bytes: &[u8]) -> Result<Vec<Command>, ImageError> {
    let (records, rest) = bytes.as_chunks::<RECORD_LENGTH>();
    if !rest.is_empty() {
        return Err(ImageError::Length(bytes.len()));
    }
    if records.len() > PROGRAM_LENGTH {
        return Err(ImageError::TooLong(records.len()));
    }
    let command = |(record, &[opcode, kind, motor, a, b, c, d, received]): (usize, &[u8; RECORD_LENGTH])| {
        let expected = checksum(&[opcode, kind, motor, a, b, c, d]);
        if received != expected {
            return Err(ImageError::Checksum { record, received, expected });
        }
        Ok(Command::new(opcode, kind, motor, i32::from_be_bytes([a, b, c, d])))
    };
    records.iter().enumerate().map(command).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records() {
        let program = [Command::new(4, 1, 0, -10000), Command::STOP];
        let bytes = to_bytes(&program);
        assert_eq!(bytes, [4, 1, 0, 0xFF, 0xFF, 0xD8, 0xF0, 0xCB, 28, 0, 0, 0, 0, 0, 0, 28]);
        assert_eq!(from_bytes(&bytes), Ok(program.to_vec()));
        assert_eq!(from_bytes(&[]), Ok(vec![]));
    }

    #[test]
    fn damaged_files() {
        let bytes = to_bytes(&[Command::STOP; 2]);
        assert_eq!(from_bytes(&bytes[..15]), Err(ImageError::Length(15)));
        for position in 0..16 {
            let mut damaged = bytes.clone();
            damaged[position] ^= 0x40;
            let error = from_bytes(&damaged).expect_err("damaged");
            assert!(matches!(error, ImageError::Checksum { record, .. } if record == position / 8));
        }
        let long = to_bytes(&[Command::STOP; PROGRAM_LENGTH + 1]);
        assert_eq!(from_bytes(&long), Err(ImageError::TooLong(2049)));
        let error = ImageError::Checksum { record: 7, received: 0x1C, expected: 0x1D };
        assert_eq!(error.to_string(), "record 7 has checksum 1Ch, expected 1Dh");
    }
}
