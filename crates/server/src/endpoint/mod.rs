//! Where bytes come in: one task a client, which reads, asks the devices and writes what they say.
//!
//! A command is answered by the task that read it, so a round trip never waits for another one.

mod hid;
mod line;
mod pty;
mod slcan;
mod socket;
mod stream;
mod unix;

pub(crate) use line::Line;

use pty::Pty;
use sim::Endpoint;
use socket::{Framing, Sockets};
use std::{io, sync::Arc};

/// Where bytes go that a device sends by itself: to the client that spoke last.
pub(crate) trait Sink: Send + Sync {
    /// Writes the bytes without waiting; what there is no room for is lost.
    fn push(&self, bytes: &[u8]);
}

/// An endpoint that is open but not served yet.
pub(crate) enum Door {
    Sockets(Sockets),
    Pty(Pty),
}

impl Door {
    /// Opens an endpoint.
    pub fn open(endpoint: &Endpoint) -> io::Result<Self> {
        let tcp = |host, port, framing| Sockets::tcp((host, port), framing).map(Self::Sockets);
        match endpoint {
            Endpoint::Tcp { host, port } => tcp(host, *port, Framing::Plain),
            Endpoint::SlcanTcp { host, port } => tcp(host, *port, Framing::Slcan),
            Endpoint::HidTcp { host, port } => tcp(host, *port, Framing::Hid),
            Endpoint::HidUnix { path } => Sockets::unix(path, Framing::Hid).map(Self::Sockets),
            Endpoint::Pty { path } => Pty::open(path).map(Self::Pty),
        }
    }

    /// The endpoint with the real port.
    pub fn name(&self, asked: &Endpoint) -> String {
        let mut endpoint = asked.clone();
        if let (
            Self::Sockets(sockets),
            Endpoint::Tcp { port, .. } | Endpoint::SlcanTcp { port, .. } | Endpoint::HidTcp { port, .. },
        ) = (self, &mut endpoint)
        {
            *port = sockets.port().unwrap_or(*port);
        }
        endpoint.to_string()
    }

    /// Serves whoever comes, for ever.
    pub async fn serve(self, line: Arc<Line>) {
        match self {
            Self::Sockets(sockets) => sockets.serve(line).await,
            Self::Pty(pty) => pty.serve(line).await,
        }
    }
}
