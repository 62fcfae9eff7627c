//! The 9-byte frame, and what a request and a reply say.

use core::fmt;

/// Bytes in a request or reply on a serial line.
pub const FRAME_LENGTH: usize = 9;

/// The sum of bytes that ends a frame: 8 bits, without carry.
pub const fn checksum(bytes: &[u8]) -> u8 {
    let mut sum = 0u8;
    let mut index = 0;
    while index < bytes.len() {
        sum = sum.wrapping_add(bytes[index]);
        index += 1;
    }
    sum
}

/// Nine bytes as they were received, checksum not yet believed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Frame(pub [u8; FRAME_LENGTH]);

/// The last byte of a frame is not the sum of the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ChecksumError {
    /// The byte that came.
    pub received: u8,
    /// The sum of the eight bytes before it.
    pub expected: u8,
}

impl fmt::Display for ChecksumError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "checksum {:02X}h, expected {:02X}h", self.received, self.expected)
    }
}

impl core::error::Error for ChecksumError {}

impl Frame {
    /// Completes eight bytes with their checksum.
    const fn sealed(body: [u8; 8]) -> Self {
        let [a, b, c, d, e, f, g, h] = body;
        Self([a, b, c, d, e, f, g, h, checksum(&body)])
    }

    /// The first byte: the address of the module in a request, of the host in a reply. It can be read
    /// before the checksum is checked.
    pub const fn address(&self) -> u8 {
        self.0[0]
    }

    /// Whether the last byte is right.
    pub const fn check(&self) -> Result<(), ChecksumError> {
        let [body @ .., received] = &self.0;
        let expected = checksum(body);
        if *received == expected { Ok(()) } else { Err(ChecksumError { received: *received, expected }) }
    }

    /// The four bytes of the value, MSB first.
    const fn value(&self) -> i32 {
        let [_, _, _, _, a, b, c, d, _] = self.0;
        i32::from_be_bytes([a, b, c, d])
    }
}

/// A request from a host to a module.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Request {
    /// Address of the module.
    pub address: u8,
    /// The command's number.
    pub opcode: u8,
    /// The type field.
    pub kind: u8,
    /// The motor or bank field.
    pub motor: u8,
    /// The value.
    pub value: i32,
}

impl Request {
    /// Reads a frame. Any opcode and type is a request; only the checksum can be wrong.
    pub const fn parse(frame: &Frame) -> Result<Self, ChecksumError> {
        if let Err(error) = frame.check() {
            return Err(error);
        }
        let [address, opcode, kind, motor, ..] = frame.0;
        Ok(Self { address, opcode, kind, motor, value: frame.value() })
    }

    /// The bytes of the request.
    pub const fn emit(&self) -> Frame {
        let [a, b, c, d] = self.value.to_be_bytes();
        Frame::sealed([self.address, self.opcode, self.kind, self.motor, a, b, c, d])
    }
}

/// A module's reply to a host.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Reply {
    /// Address of the host.
    pub host: u8,
    /// Address of the module.
    pub module: u8,
    /// How it went.
    pub status: Status,
    /// The number of the command it answers.
    pub opcode: u8,
    /// The value.
    pub value: i32,
}

impl Reply {
    /// Reads a frame. Only the checksum can be wrong.
    pub const fn parse(frame: &Frame) -> Result<Self, ChecksumError> {
        if let Err(error) = frame.check() {
            return Err(error);
        }
        let [host, module, status, opcode, ..] = frame.0;
        Ok(Self { host, module, status: Status(status), opcode, value: frame.value() })
    }

    /// The bytes of the reply.
    pub const fn emit(&self) -> Frame {
        let [a, b, c, d] = self.value.to_be_bytes();
        Frame::sealed([self.host, self.module, self.status.0, self.opcode, a, b, c, d])
    }
}

/// The status byte of a reply (manual 3.2.1). A module may send others than those named here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Status(pub u8);

impl Status {
    /// The checksum of the request was wrong; nothing was executed.
    pub const WRONG_CHECKSUM: Self = Self(1);
    /// There is no such command.
    pub const INVALID_COMMAND: Self = Self(2);
    /// The type field names nothing, or nothing that this command can act on.
    pub const WRONG_TYPE: Self = Self(3);
    /// The motor, bank or value is out of range.
    pub const INVALID_VALUE: Self = Self(4);
    /// The memory is protected against writing.
    pub const LOCKED: Self = Self(5);
    /// The command exists, but not here or not now.
    pub const NOT_AVAILABLE: Self = Self(6);
    /// Executed.
    pub const OK: Self = Self(100);
    /// Stored in the program memory.
    pub const LOADED: Self = Self(101);
    /// A motor has reached its target (the second reply to command 138).
    pub const POSITION_REACHED: Self = Self(128);

    /// Whether the command did what it says.
    pub const fn is_ok(self) -> bool {
        matches!(self, Self::OK | Self::LOADED | Self::POSITION_REACHED)
    }
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match *self {
            Self::WRONG_CHECKSUM => "wrong checksum",
            Self::INVALID_COMMAND => "invalid command",
            Self::WRONG_TYPE => "wrong type",
            Self::INVALID_VALUE => "invalid value",
            Self::LOCKED => "memory locked",
            Self::NOT_AVAILABLE => "command not available",
            Self::OK => "ok",
            Self::LOADED => "loaded into program memory",
            Self::POSITION_REACHED => "position reached",
            Self(other) => return write!(f, "status {other}"),
        };
        write!(f, "{text} ({})", self.0)
    }
}
