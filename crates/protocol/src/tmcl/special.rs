//! The two replies that are not built like the others (manual 3.7.53). On CAN they lose the host
//! address, as other replies do, and end where the request ended.

use super::frame::{FRAME_LENGTH, Frame, checksum};
use crate::can;

/// The command whose type 0 is answered by a [`VersionReply`].
pub const VERSION_OPCODE: u8 = 136;

/// The command that is answered by a [`MemoryReply`].
pub const MEMORY_OPCODE: u8 = 134;

/// The firmware version as text: host address and eight characters, without a checksum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct VersionReply {
    /// Address of the host.
    pub host: u8,
    /// Four characters of the module's number, `V`, three of the version.
    pub text: [u8; 8],
}

impl VersionReply {
    /// Reads a frame. Nothing in it tells this reply from another; the request does.
    pub const fn parse(frame: &Frame) -> Self {
        let [host, text @ ..] = frame.0;
        Self { host, text }
    }

    /// The bytes of the reply.
    pub const fn emit(&self) -> Frame {
        let [a, b, c, d, e, f, g, h] = self.text;
        Frame([self.host, a, b, c, d, e, f, g, h])
    }

    /// The reply as a CAN frame; `None` if the identifier has more than 11 bits. The last character only
    /// fits a `long` one.
    pub fn emit_can(&self, id: u16, long: bool) -> Option<can::Frame> {
        can::Frame::new(id, if long { &self.text } else { &self.text[..7] }).ok()
    }
}

/// One command of the program memory. Its checksum leaves out the host address.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MemoryReply {
    /// Address of the host.
    pub host: u8,
    /// Number of the stored command.
    pub opcode: u8,
    /// Its type field.
    pub kind: u8,
    /// Its motor or bank field.
    pub motor: u8,
    /// Its value.
    pub value: i32,
}

impl MemoryReply {
    /// Reads a frame; `None` if the checksum is wrong, as it is when the module answers with an
    /// ordinary error reply. (One in 256 of those would pass: look at the status there first.)
    pub const fn parse(frame: &Frame) -> Option<Self> {
        let [host, opcode, kind, motor, a, b, c, d, sum] = frame.0;
        if checksum(&[opcode, kind, motor, a, b, c, d]) != sum {
            return None;
        }
        Some(Self { host, opcode, kind, motor, value: i32::from_be_bytes([a, b, c, d]) })
    }

    /// The bytes of the reply.
    pub const fn emit(&self) -> Frame {
        let [a, b, c, d] = self.value.to_be_bytes();
        let sum = checksum(&[self.opcode, self.kind, self.motor, a, b, c, d]);
        let bytes: [u8; FRAME_LENGTH] = [self.host, self.opcode, self.kind, self.motor, a, b, c, d, sum];
        Frame(bytes)
    }

    /// The reply as a CAN frame, checksum in the eighth byte if it is `long`; `None` if the identifier
    /// has more than 11 bits.
    pub fn emit_can(&self, id: u16, long: bool) -> Option<can::Frame> {
        let Frame([_, bytes @ ..]) = self.emit();
        can::Frame::new(id, if long { &bytes } else { &bytes[..7] }).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_version_reply_has_no_checksum() {
        let reply = VersionReply { host: 2, text: *b"1140V147" };
        assert_eq!(reply.emit().0, [2, b'1', b'1', b'4', b'0', b'V', b'1', b'4', b'7']);
        assert_eq!(VersionReply::parse(&reply.emit()), reply);
    }

    #[test]
    fn the_memory_reply_sums_the_command_only() {
        let reply = MemoryReply { host: 2, opcode: 4, kind: 0, motor: 0, value: 90000 };
        assert_eq!(reply.emit().0, [2, 4, 0, 0, 0x00, 0x01, 0x5F, 0x90, 0xF4]);
        assert_eq!(MemoryReply::parse(&reply.emit()), Some(reply));
        let mut wrong = reply.emit();
        wrong.0[8] ^= 1;
        assert_eq!(MemoryReply::parse(&wrong), None);
    }

    #[test]
    fn on_can() {
        let data = |frame: Option<can::Frame>| frame.map(|frame| frame.data().to_vec());
        let version = VersionReply { host: 2, text: *b"1140V147" };
        assert_eq!(data(version.emit_can(2, true)), Some(b"1140V147".to_vec()));
        assert_eq!(data(version.emit_can(2, false)), Some(b"1140V14".to_vec()));
        let memory = MemoryReply { host: 2, opcode: 4, kind: 0, motor: 0, value: 90000 };
        assert_eq!(data(memory.emit_can(2, true)), Some(vec![4, 0, 0, 0x00, 0x01, 0x5F, 0x90, 0xF4]));
        assert_eq!(data(memory.emit_can(2, false)), Some(vec![4, 0, 0, 0x00, 0x01, 0x5F, 0x90]));
    }
}
