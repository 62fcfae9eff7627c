//! Sockets: many clients at once, each with a thread of its own that blocks in `read`.

use super::{
    hid,
    line::Line,
    slcan,
    stream::{Stream, StreamSink},
    unix::UnixSocket,
};
use crate::stop::{Waited, Watch};
use std::{
    io,
    net::TcpListener,
    os::fd::{AsFd, BorrowedFd, OwnedFd},
    path::Path,
    sync::{Arc, Mutex, PoisonError, Weak},
    thread,
    time::Duration,
};

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

    /// Accepts clients until it is over, and then shuts their connections.
    pub fn serve(self, line: &Arc<Line>, stop: &Watch) {
        let clients = Clients::default();
        while let Waited::Other = stop.or_readable(Some(self.listener.as_fd()), None) {
            match self.listener.accept() {
                Ok(socket) => self.welcome(socket, line, &clients),
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => {}
                Err(_) => thread::sleep(ACCEPT_PAUSE),
            }
        }
        clients.shut();
    }

    fn welcome(&self, socket: OwnedFd, line: &Arc<Line>, clients: &Clients) {
        let Ok(stream) = Stream::new(socket) else { return };
        let stream = Arc::new(stream);
        if !clients.admit(&stream) {
            return;
        }
        let (line, framing) = (Arc::clone(line), self.framing);
        // Without a thread for it the connection is dropped, and so closed.
        let _ = thread::Builder::new().name("client".into()).spawn(move || match framing {
            Framing::Plain => talk(&stream, &line),
            Framing::Slcan => slcan::talk(&stream, &line),
            Framing::Hid => hid::talk(&stream, &line),
        });
    }
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

/// The connections of an endpoint that are open.
#[derive(Default)]
struct Clients(Mutex<Vec<Weak<Stream>>>);

impl Clients {
    /// Takes a client in unless there are too many.
    fn admit(&self, stream: &Arc<Stream>) -> bool {
        let mut streams = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        streams.retain(|stream| stream.strong_count() > 0);
        let room = streams.len() < MAX_CLIENTS;
        if room {
            streams.push(Arc::downgrade(stream));
        }
        room
    }

    fn shut(&self) {
        for stream in self.0.lock().unwrap_or_else(PoisonError::into_inner).drain(..) {
            if let Some(stream) = stream.upgrade() {
                stream.shut();
            }
        }
    }
}

/// One connection, to its end.
fn talk(stream: &Arc<Stream>, line: &Line) {
    let mut client = line.client(Arc::new(StreamSink(Arc::clone(stream))));
    stream.receive(|bytes| client.exchange(bytes, |reply| stream.send(reply)));
}
