//! A connection over a socket of any kind.

use super::Sink;
use crate::ready;
use rustix::{
    io::Errno,
    net::{RecvFlags, SendFlags, Shutdown},
};
use std::{io, os::fd::OwnedFd, sync::Arc, time::Duration};
use tokio::{
    io::{Interest, unix::AsyncFd},
    time::timeout,
};

/// Most bytes read at once.
const READ_BYTES: usize = 4096;

/// A client that takes no bytes for this long is dropped.
const WRITE_TIMEOUT: Duration = Duration::from_secs(5);

/// A connection.
pub(super) struct Stream(AsyncFd<OwnedFd>);

impl Stream {
    /// Takes over a socket that has been accepted.
    pub fn new(socket: OwnedFd) -> io::Result<Self> {
        rustix::io::ioctl_fionbio(&socket, true)?;
        Ok(Self(ready::watch(socket, Interest::READABLE | Interest::WRITABLE)?))
    }

    /// Waits for bytes and gives what `take` makes of them; `None` when the connection has ended.
    pub async fn receive<T>(&self, take: impl FnOnce(&[u8]) -> T) -> Option<T> {
        loop {
            let mut ready = self.0.readable().await.ok()?;
            let mut bytes = [0; READ_BYTES];
            match rustix::net::recv(&self.0, &mut bytes, RecvFlags::empty()) {
                Ok((0, _)) => return None,
                Ok((length, _)) => {
                    // There was no more: asking again would say so at the price of a call.
                    if length < READ_BYTES {
                        ready.clear_ready();
                    }
                    return Some(take(&bytes[..length]));
                }
                Err(Errno::AGAIN) => ready.clear_ready(),
                Err(Errno::INTR) => {}
                Err(_) => return None,
            }
        }
    }

    /// Sends all of it, and says whether that went well.
    #[must_use]
    pub async fn send(&self, mut bytes: &[u8]) -> bool {
        while !bytes.is_empty() {
            match rustix::net::send(&self.0, bytes, SendFlags::NOSIGNAL) {
                Ok(sent) => bytes = &bytes[sent..],
                Err(Errno::INTR) => {}
                Err(Errno::AGAIN) if self.takes_more().await => {}
                Err(_) => return false,
            }
        }
        true
    }

    /// Waits until there may be room for bytes again, and says whether there was in time.
    async fn takes_more(&self) -> bool {
        let room = async {
            // What is known of it was true before there was none.
            self.0.writable().await?.clear_ready();
            self.0.writable().await.map(drop)
        };
        matches!(timeout(WRITE_TIMEOUT, room).await, Ok(Ok(())))
    }

    /// Ends the connection; whoever reads from it wakes up.
    fn shut(&self) {
        let _ = rustix::net::shutdown(&self.0, Shutdown::Both);
    }
}

/// Sends without waiting.
pub(super) struct StreamSink(pub Arc<Stream>);

impl Sink for StreamSink {
    fn push(&self, bytes: &[u8]) {
        let sent = rustix::net::send(&self.0.0, bytes, SendFlags::NOSIGNAL);
        // Half a frame would put every later one out of step.
        if sent.is_ok_and(|sent| sent < bytes.len()) {
            self.0.shut();
        }
    }
}
