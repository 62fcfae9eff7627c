//! Where bytes come in: one thread a client, which reads, asks the devices and writes what they say.
//!
//! A command is answered by the thread that read it, so a round trip never waits for another thread to
//! be woken.

mod hid;
mod line;
mod pty;
mod slcan;
mod socket;
mod stream;
mod unix;

pub(crate) use line::Line;
pub(crate) use pty::Pty;
pub(crate) use socket::{Framing, Sockets};

/// Where bytes go that a device sends by itself: to the client that spoke last.
pub(crate) trait Sink: Send + Sync {
    /// Writes the bytes without waiting; what there is no room for is lost.
    fn push(&self, bytes: &[u8]);
}
