//! A connection over a socket of any kind.

use super::Sink;
use rustix::{
    io::Errno,
    net::{
        RecvFlags, SendFlags, Shutdown,
        sockopt::{Timeout, set_socket_timeout},
    },
};
use std::{
    io,
    os::fd::{AsFd, BorrowedFd, OwnedFd},
    sync::Arc,
    time::Duration,
};

/// Most bytes read at once.
const READ_BYTES: usize = 4096;

/// A client that takes no bytes for this long is dropped.
const WRITE_TIMEOUT: Duration = Duration::from_secs(5);

/// A connection whose reads and writes wait.
pub(super) struct Stream(OwnedFd);

impl Stream {
    /// Takes over a socket that has been accepted.
    pub fn new(socket: OwnedFd) -> io::Result<Self> {
        rustix::io::ioctl_fionbio(&socket, false)?;
        set_socket_timeout(&socket, Timeout::Send, Some(WRITE_TIMEOUT))?;
        Ok(Self(socket))
    }

    /// Gives what arrives to `take` until it says `false` or the connection ends.
    pub fn receive(&self, mut take: impl FnMut(&[u8]) -> bool) {
        let mut bytes = [0; READ_BYTES];
        loop {
            match rustix::net::recv(&self.0, &mut bytes, RecvFlags::empty()) {
                Ok((0, _)) => return,
                Ok((length, _)) if take(&bytes[..length]) => {}
                Err(Errno::INTR) => {}
                Ok(_) | Err(_) => return,
            }
        }
    }

    /// Sends all of it, and says whether that went well.
    #[must_use]
    pub fn send(&self, mut bytes: &[u8]) -> bool {
        while !bytes.is_empty() {
            match rustix::net::send(&self.0, bytes, SendFlags::NOSIGNAL) {
                Ok(sent) => bytes = &bytes[sent..],
                Err(Errno::INTR) => {}
                Err(_) => return false,
            }
        }
        true
    }

    /// Ends the connection; whoever reads from it wakes up.
    pub fn shut(&self) {
        let _ = rustix::net::shutdown(&self.0, Shutdown::Both);
    }
}

impl AsFd for Stream {
    fn as_fd(&self) -> BorrowedFd<'_> {
        self.0.as_fd()
    }
}

/// Sends without waiting.
pub(super) struct StreamSink(pub Arc<Stream>);

impl Sink for StreamSink {
    fn push(&self, bytes: &[u8]) {
        let sent = rustix::net::send(&*self.0, bytes, SendFlags::DONTWAIT | SendFlags::NOSIGNAL);
        // Half a frame would put every later one out of step.
        if sent.is_ok_and(|sent| sent < bytes.len()) {
            self.0.shut();
        }
    }
}
