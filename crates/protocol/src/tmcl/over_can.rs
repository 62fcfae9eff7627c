//! TMCL in CAN frames (manual 3.1, 3.2): the identifier takes the place of the address, and CAN's own
//! check that of the checksum.

use super::frame::Status;
use crate::can;
use core::fmt;

/// Data bytes of a request or reply, if there is no eighth that nobody uses.
const SHORT: usize = 7;

/// A CAN frame has fewer than seven data bytes and so is no TMCL.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CanLengthError;

impl fmt::Display for CanLengthError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("TMCL over CAN has 7 or 8 data bytes")
    }
}

impl core::error::Error for CanLengthError {}

/// A request in a CAN frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CanRequest {
    /// The frame's identifier: the module.
    pub id: u16,
    /// The command's number.
    pub opcode: u8,
    /// The type field.
    pub kind: u8,
    /// The motor or bank field.
    pub motor: u8,
    /// The value.
    pub value: i32,
    /// Whether there was an eighth data byte: its content means nothing, but the reply must have one too.
    pub long: bool,
}

impl CanRequest {
    /// Reads a frame.
    pub fn parse(frame: &can::Frame) -> Result<Self, CanLengthError> {
        let &[opcode, kind, motor, a, b, c, d, ref rest @ ..] = frame.data() else {
            return Err(CanLengthError);
        };
        let value = i32::from_be_bytes([a, b, c, d]);
        Ok(Self { id: frame.id(), opcode, kind, motor, value, long: !rest.is_empty() })
    }

    /// The frame of the request; `None` if the identifier has more than 11 bits.
    pub fn emit(&self) -> Option<can::Frame> {
        let [a, b, c, d] = self.value.to_be_bytes();
        frame(self.id, [self.opcode, self.kind, self.motor, a, b, c, d], self.long)
    }
}

/// A reply in a CAN frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CanReply {
    /// The frame's identifier: the host.
    pub id: u16,
    /// The low byte of the module's own identifier.
    pub module: u8,
    /// How it went.
    pub status: Status,
    /// The number of the command it answers.
    pub opcode: u8,
    /// The value.
    pub value: i32,
    /// Whether there is an eighth data byte, as there was in the request.
    pub long: bool,
}

impl CanReply {
    /// Reads a frame.
    pub fn parse(frame: &can::Frame) -> Result<Self, CanLengthError> {
        let &[module, status, opcode, a, b, c, d, ref rest @ ..] = frame.data() else {
            return Err(CanLengthError);
        };
        let value = i32::from_be_bytes([a, b, c, d]);
        Ok(Self { id: frame.id(), module, status: Status(status), opcode, value, long: !rest.is_empty() })
    }

    /// The frame of the reply; `None` if the identifier has more than 11 bits.
    pub fn emit(&self) -> Option<can::Frame> {
        let [a, b, c, d] = self.value.to_be_bytes();
        frame(self.id, [self.module, self.status.0, self.opcode, a, b, c, d], self.long)
    }
}

/// Seven bytes, and an eighth of 0 if it is to be long.
fn frame(id: u16, [a, b, c, d, e, f, g]: [u8; SHORT], long: bool) -> Option<can::Frame> {
    let data = [a, b, c, d, e, f, g, 0];
    can::Frame::new(id, if long { &data } else { &data[..SHORT] }).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reply_is_as_long_as_the_request() {
        let check = |data: &[u8], expected: &[u8]| {
            let request = CanRequest::parse(&can::Frame::new(1, data).expect("valid")).expect("long enough");
            assert_eq!((request.opcode, request.kind, request.motor, request.value), (6, 1, 0, -2));
            let reply = CanReply {
                id: 2,
                module: 1,
                status: Status::OK,
                opcode: request.opcode,
                value: -5000,
                long: request.long,
            };
            let frame = reply.emit().expect("valid identifier");
            assert_eq!((frame.id(), frame.data()), (2, expected));
            assert_eq!(CanReply::parse(&frame), Ok(reply));
        };
        check(&[6, 1, 0, 0xFF, 0xFF, 0xFF, 0xFE], &[1, 100, 6, 0xFF, 0xFF, 0xEC, 0x78]);
        check(&[6, 1, 0, 0xFF, 0xFF, 0xFF, 0xFE, 0x55], &[1, 100, 6, 0xFF, 0xFF, 0xEC, 0x78, 0]);
    }

    #[test]
    fn shorter_frames_are_not_tmcl() {
        let frame = can::Frame::new(1, &[6, 1, 0, 0, 0, 0]).expect("valid");
        assert_eq!(CanRequest::parse(&frame), Err(CanLengthError));
        assert_eq!(CanReply::parse(&frame), Err(CanLengthError));
    }

    #[test]
    fn an_identifier_has_11_bits() {
        let request = CanRequest { id: 0x800, opcode: 1, kind: 0, motor: 0, value: 0, long: false };
        assert_eq!(request.emit(), None);
    }
}
