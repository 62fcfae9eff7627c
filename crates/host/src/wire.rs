//! What carries requests there and replies back.

use std::{future::Future, io, pin::Pin, time::Duration};
use thiserror::Error;

/// Most bytes of a reply that are waited for.
pub const MAX_REPLY_BYTES: usize = 256;

/// How a reply ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// After so many bytes.
    Length(usize),
    /// With a carriage return, which belongs to it.
    Line,
    /// There is none.
    Silence,
}

impl End {
    /// How many of the bytes that came are the reply, once it is whole.
    pub fn find(self, bytes: &[u8]) -> Option<usize> {
        match self {
            Self::Length(length) => (bytes.len() >= length).then_some(length),
            Self::Line => bytes.iter().position(|byte| *byte == b'\r').map(|place| place + 1),
            Self::Silence => Some(0),
        }
    }
}

/// Why there is no reply.
#[derive(Debug, Error)]
pub enum WireError {
    /// Nothing came, or not all of it, in the time it was given.
    #[error("no reply within {} ms", .0.as_millis())]
    Timeout(Duration),
    /// The other side has gone.
    #[error("the connection is closed")]
    Closed,
    /// What came has no end.
    #[error("{MAX_REPLY_BYTES} bytes came and no end of a reply")]
    Endless,
    /// The system says no.
    #[error(transparent)]
    System(#[from] io::Error),
}

/// What a [`Wire`] is doing.
pub type Pending<'a, T> = Pin<Box<dyn Future<Output = Result<T, WireError>> + Send + 'a>>;

/// A link to one controller, or to a bus with several of them. The host speaks first, always; then it waits for the
/// reply (TMCL manual, 3; PMX-2ED-SA manual, 6.2.3).
pub trait Wire: Send {
    /// Sends a request and gives the reply, its end included. What came without being asked for is forgotten before.
    ///
    /// # Errors
    /// [`WireError`]. After one, what still comes belongs to nothing: [`settle`](Self::settle) first.
    fn exchange<'a>(&'a mut self, request: &'a [u8], end: End, patience: Duration) -> Pending<'a, Vec<u8>>;

    /// Waits until nothing comes any more, so that the next request is understood as one and the next reply is its own.
    ///
    /// # Errors
    /// [`WireError`], if the other side has gone.
    fn settle(&mut self) -> Pending<'_, ()> {
        Box::pin(async { Ok(()) })
    }
}
