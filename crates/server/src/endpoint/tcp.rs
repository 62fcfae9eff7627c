//! TCP: many clients at once, each with a thread of its own that blocks in `read`.

use super::{Sink, line::Line, slcan};
use crate::stop::{Waited, Watch};
use rustix::net::SendFlags;
use std::{
    io::{self, Read, Write},
    net::{Shutdown, TcpListener, TcpStream},
    os::fd::AsFd,
    sync::{Arc, Mutex, PoisonError, Weak},
    thread,
    time::Duration,
};

/// Most clients of one endpoint at a time; one more is turned away.
pub const MAX_CLIENTS: usize = 64;

/// Most bytes read at once.
const READ_BYTES: usize = 4096;

/// A client that takes no bytes for this long is dropped.
const WRITE_TIMEOUT: Duration = Duration::from_secs(5);

/// How long to wait when no connection can be accepted, as when file descriptors have run out.
const ACCEPT_PAUSE: Duration = Duration::from_millis(100);

/// What the bytes of a connection are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Framing {
    /// The bytes of the device's port.
    Plain,
    /// CAN frames as lines of text.
    Slcan,
}

/// A listening endpoint.
pub(crate) struct Tcp {
    listener: TcpListener,
    port: u16,
    framing: Framing,
}

impl Tcp {
    /// Listens on a port of a host; port 0 lets the system choose.
    pub fn bind((host, port): (&str, u16), framing: Framing) -> io::Result<Self> {
        let listener = TcpListener::bind((host, port))?;
        listener.set_nonblocking(true)?;
        let port = listener.local_addr()?.port();
        Ok(Self { listener, port, framing })
    }

    /// The real port.
    pub fn port(&self) -> u16 {
        self.port
    }

    /// Accepts clients until it is over, and then shuts their connections.
    pub fn serve(self, line: &Arc<Line>, stop: &Watch) {
        let clients = Clients::default();
        while let Waited::Other = stop.or_readable(Some(self.listener.as_fd()), None) {
            match self.listener.accept() {
                Ok((stream, _)) => self.welcome(stream, line, &clients),
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => {}
                Err(_) => thread::sleep(ACCEPT_PAUSE),
            }
        }
        clients.shut();
    }

    fn welcome(&self, stream: TcpStream, line: &Arc<Line>, clients: &Clients) {
        let ready = stream
            .set_nonblocking(false)
            .and_then(|()| stream.set_nodelay(true))
            .and_then(|()| stream.set_write_timeout(Some(WRITE_TIMEOUT)));
        let stream = Arc::new(stream);
        if ready.is_err() || !clients.admit(&stream) {
            return;
        }
        let (line, framing) = (Arc::clone(line), self.framing);
        // Without a thread for it the connection is dropped, and so closed.
        let _ = thread::Builder::new().name("client".into()).spawn(move || match framing {
            Framing::Plain => talk(&stream, &line),
            Framing::Slcan => slcan::talk(&stream, &line),
        });
    }
}

/// The connections of an endpoint that are open.
#[derive(Default)]
struct Clients(Mutex<Vec<Weak<TcpStream>>>);

impl Clients {
    /// Takes a client in unless there are too many.
    fn admit(&self, stream: &Arc<TcpStream>) -> bool {
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
                let _ = stream.shutdown(Shutdown::Both);
            }
        }
    }
}

/// One connection, to its end.
fn talk(stream: &Arc<TcpStream>, line: &Line) {
    let mut client = line.client(Arc::new(StreamSink(Arc::clone(stream))));
    receive(stream, |bytes| client.exchange(bytes, |reply| (&**stream).write_all(reply).is_ok()));
}

/// Gives what arrives to `take` until it says `false` or the connection ends.
pub(super) fn receive(stream: &TcpStream, mut take: impl FnMut(&[u8]) -> bool) {
    let mut bytes = [0; READ_BYTES];
    loop {
        match (&*stream).read(&mut bytes) {
            Ok(0) => return,
            Ok(length) if take(&bytes[..length]) => {}
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Ok(_) | Err(_) => return,
        }
    }
}

/// Sends without waiting.
pub(super) struct StreamSink(pub Arc<TcpStream>);

impl Sink for StreamSink {
    fn push(&self, bytes: &[u8]) {
        let sent = rustix::net::send(&*self.0, bytes, SendFlags::DONTWAIT | SendFlags::NOSIGNAL);
        // Half a frame would put every later one out of step.
        if sent.is_ok_and(|sent| sent < bytes.len()) {
            let _ = self.0.shutdown(Shutdown::Both);
        }
    }
}
