//! Wires that are streams of bytes: TCP and serial ports.

use crate::wire::{End, MAX_REPLY_BYTES, Pending, Wire, WireError};
use protocol::tmcl::PARTIAL_FRAME_TIMEOUT_MS;
use serial2_tokio::SerialPort;
use std::{io, path::Path, time::Duration};
use tokio::{
    io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt},
    net::{TcpStream, ToSocketAddrs},
    time::{Instant, timeout, timeout_at},
};

/// How long a stream has to be silent to count as settled: longer than a module waits for the rest of a frame, so that
/// it has forgotten what it had of one.
const SILENCE: Duration = Duration::from_millis(PARTIAL_FRAME_TIMEOUT_MS as u64 + 10);

/// Bytes that are thrown away at most before somebody who talks without end is given up.
const MAX_NOISE_BYTES: usize = 64 * 1024;

/// How long to wait for a connection.
const CONNECT: Duration = Duration::from_secs(3);

/// A stream as a [`Wire`].
#[derive(Debug)]
pub struct StreamWire<S>(S);

impl<S: AsyncRead + AsyncWrite + Unpin + Send> StreamWire<S> {
    /// A wire over a stream that is open.
    pub const fn new(stream: S) -> Self {
        Self(stream)
    }

    /// Reads what has come; `Closed` at the end of the stream.
    async fn read(&mut self, room: &mut [u8]) -> Result<usize, WireError> {
        match self.0.read(room).await? {
            0 => Err(WireError::Closed),
            count => Ok(count),
        }
    }

    /// Throws away what comes until nothing has for so long.
    async fn drain(&mut self, silence: Duration) -> Result<(), WireError> {
        let mut noise = [0; MAX_REPLY_BYTES];
        let mut seen = 0;
        while seen < MAX_NOISE_BYTES {
            match timeout(silence, self.read(&mut noise)).await {
                Err(_) => return Ok(()),
                Ok(read) => seen += read?,
            }
        }
        Err(WireError::Endless)
    }

    async fn ask(&mut self, request: &[u8], end: End) -> Result<Vec<u8>, WireError> {
        self.drain(Duration::ZERO).await?;
        self.0.write_all(request).await?;
        self.0.flush().await?;
        let mut reply = Vec::new();
        let mut part = [0; MAX_REPLY_BYTES];
        loop {
            if let Some(length) = end.find(&reply) {
                reply.truncate(length);
                return Ok(reply);
            }
            let room = MAX_REPLY_BYTES - reply.len();
            if room == 0 {
                return Err(WireError::Endless);
            }
            let count = self.read(&mut part[..room]).await?;
            reply.extend_from_slice(&part[..count]);
        }
    }
}

impl<S: AsyncRead + AsyncWrite + Unpin + Send> Wire for StreamWire<S> {
    fn exchange<'a>(&'a mut self, request: &'a [u8], end: End, patience: Duration) -> Pending<'a, Vec<u8>> {
        Box::pin(async move {
            let deadline = Instant::now() + patience;
            let reply = timeout_at(deadline, self.ask(request, end)).await;
            reply.unwrap_or(Err(WireError::Timeout(patience)))
        })
    }

    fn settle(&mut self) -> Pending<'_, ()> {
        Box::pin(self.drain(SILENCE))
    }
}

/// Connects to a controller that is reached by TCP, such as one behind a serial device server.
///
/// # Errors
/// Nobody listens there, or not in time.
pub async fn tcp(address: impl ToSocketAddrs) -> io::Result<StreamWire<TcpStream>> {
    let stream = timeout(CONNECT, TcpStream::connect(address)).await??;
    // A request is a few bytes, and the next one waits for the reply.
    stream.set_nodelay(true)?;
    Ok(StreamWire::new(stream))
}

/// Opens a serial port with 8 data bits, no parity, one stop bit and no flow control, which all three controllers have
/// (TMCL manual, 1; PMX-2ED-SA manual, 6.2.2; CMD-4CR manual, 3.2.1). The baud rate is in bits a second; the system
/// does not care on ports of USB.
///
/// # Errors
/// There is no such port, or it does not have the baud rate.
pub fn serial(path: impl AsRef<Path>, baud_rate: u32) -> io::Result<StreamWire<SerialPort>> {
    let port = SerialPort::open(path, baud_rate)?;
    port.discard_buffers()?;
    Ok(StreamWire::new(port))
}

/// The serial ports that there are.
///
/// # Errors
/// The system does not say.
pub fn serial_ports() -> io::Result<Vec<std::path::PathBuf>> {
    SerialPort::available_ports()
}
