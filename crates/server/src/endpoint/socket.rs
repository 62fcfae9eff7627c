//! Sockets: many clients at once.

use super::{
    hid,
    line::Line,
    slcan,
    stream::{Stream, StreamSink},
    unix::UnixSocket,
};
use crate::ready;
use std::{
    io,
    net::TcpListener,
    os::fd::{AsFd, AsRawFd, BorrowedFd, OwnedFd, RawFd},
    path::Path,
    sync::Arc,
    time::Duration,
};
use tokio::{io::Interest, time::sleep};

/// Most clients of one endpoint at a time; one more is turned away.
pub const MAX_CLIENTS: usize = 64;

/// How long to wait when no connection can be accepted, as when file descriptors have run out.
const ACCEPT_PAUSE: Duration = Duration::from_millis(100);

/// What the bytes of a connection are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Framing {
    /// The bytes of the device's port.
    Plain,
    /// CAN frames as lines of text.
    Slcan,
    /// Reports of USB HID.
    Hid,
}

/// A listening endpoint.
pub(crate) struct Sockets {
    listener: Listener,
    /// The real port of TCP.
    port: Option<u16>,
    framing: Framing,
}

enum Listener {
    Tcp(TcpListener),
    Unix(UnixSocket),
}

impl Sockets {
    /// Listens on a port of a host; port 0 lets the system choose.
    pub fn tcp((host, port): (&str, u16), framing: Framing) -> io::Result<Self> {
        let listener = TcpListener::bind((host, port))?;
        listener.set_nonblocking(true)?;
        let port = listener.local_addr()?.port();
        Ok(Self { listener: Listener::Tcp(listener), port: Some(port), framing })
    }

    /// Listens at a path.
    pub fn unix(path: &Path, framing: Framing) -> io::Result<Self> {
        Ok(Self { listener: Listener::Unix(UnixSocket::bind(path)?), port: None, framing })
    }

    /// The real port of TCP.
    pub fn port(&self) -> Option<u16> {
        self.port
    }

    /// Accepts clients for ever. Each has a task of its own.
    pub async fn serve(self, line: Arc<Line>) {
        let listener = match ready::watch(self.listener, Interest::READABLE) {
            Ok(listener) => listener,
            Err(error) => return eprintln!("warning: an endpoint ends: {error}"),
        };
        // Every client holds it as long as it is there.
        let present = Arc::new(());
        loop {
            let Ok(mut ready) = listener.readable().await else { return };
            match listener.get_ref().accept() {
                Ok(_) if Arc::strong_count(&present) > MAX_CLIENTS => {}
                Ok(socket) => welcome(socket, self.framing, &line, &present),
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => ready.clear_ready(),
                Err(_) => sleep(ACCEPT_PAUSE).await,
            }
        }
    }
}

fn welcome(socket: OwnedFd, framing: Framing, line: &Arc<Line>, present: &Arc<()>) {
    let Ok(stream) = Stream::new(socket) else { return };
    let (stream, line, present) = (Arc::new(stream), Arc::clone(line), Arc::clone(present));
    tokio::spawn(async move {
        match framing {
            Framing::Plain => talk(stream, line).await,
            Framing::Slcan => slcan::talk(stream, line).await,
            Framing::Hid => hid::talk(stream, line).await,
        }
        drop(present);
    });
}

impl Listener {
    fn accept(&self) -> io::Result<OwnedFd> {
        match self {
            Self::Tcp(listener) => {
                let (stream, _) = listener.accept()?;
                // A client that has gone already is found out when it is read from.
                let _ = stream.set_nodelay(true);
                Ok(stream.into())
            }
            Self::Unix(socket) => socket.accept(),
        }
    }
}

impl AsFd for Listener {
    fn as_fd(&self) -> BorrowedFd<'_> {
        match self {
            Self::Tcp(listener) => listener.as_fd(),
            Self::Unix(socket) => socket.as_fd(),
        }
    }
}

impl AsRawFd for Listener {
    fn as_raw_fd(&self) -> RawFd {
        self.as_fd().as_raw_fd()
    }
}

/// One connection, to its end.
async fn talk(stream: Arc<Stream>, line: Arc<Line>) {
    let mut client = line.client(Arc::new(StreamSink(Arc::clone(&stream))));
    while let Some(()) = stream.receive(|bytes| client.exchange(bytes)).await {
        for reply in client.replies() {
            reply.pause().await;
            if !stream.send(&reply.bytes).await {
                return;
            }
        }
    }
}
