//! TMCL frames: the binary protocol of serial ports, USB and CAN (manual 3.1, 3.2).

mod frame;
mod over_can;
mod receiver;
mod special;

#[cfg(test)]
mod examples;

pub use frame::{ChecksumError, FRAME_LENGTH, Frame, Reply, Request, Status, checksum};
pub use over_can::{CanLengthError, CanReply, CanRequest};
pub use receiver::{PARTIAL_FRAME_TIMEOUT_MS, Receiver};
pub use special::{MEMORY_OPCODE, MemoryReply, VERSION_OPCODE, VersionReply};
