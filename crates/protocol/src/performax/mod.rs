//! The ASCII protocol of the Performax and Commander controllers (PMX-2ED-SA manual, 6.1 to 6.3; CMD-4CR
//! manual, 3).
//!
//! A command is a line of text, and so is its reply. On RS-485 an `@` and the two digits of the device's
//! number stand before the command and both lines end with a carriage return. On USB both are packets of
//! [`PACKET_LENGTH`] bytes, ended by a NUL, without a number; [`hid`](crate::hid) has the rest of USB.

mod packet;
mod receiver;
mod reply;

pub use packet::{PACKET_LENGTH, Packet};
pub use receiver::{Message, Receiver, TextError};
pub use reply::{MAX_REPLY, Reply};

/// Most characters in a command, without the device's number and the end of the line.
pub const MAX_COMMAND: usize = 64;

/// What a line on RS-485 begins with; two digits follow.
const ADDRESS_MARK: u8 = b'@';

const CARRIAGE_RETURN: u8 = b'\r';
const LINE_FEED: u8 = b'\n';
const NUL: u8 = 0;

/// Whether a character may stand in a command.
const fn is_text(byte: u8) -> bool {
    matches!(byte, b' '..=b'~')
}

/// Bytes as text.
///
/// # Panics
/// If one of them [is none](is_text).
fn as_text(bytes: &[u8]) -> &str {
    core::str::from_utf8(bytes).expect("printable ASCII characters are UTF-8")
}
