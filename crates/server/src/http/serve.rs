//! The listener of the HTTP interface, with its limits.

use super::{Site, Token, api, guard, page};
use crate::{Error, desk::Desk};
use axum::{Router, extract::DefaultBodyLimit, middleware};
use std::{
    io,
    net::SocketAddr,
    pin::Pin,
    sync::Arc,
    task::{Context, Poll},
    time::Duration,
};
use tokio::{
    io::{AsyncRead, AsyncWrite, ReadBuf},
    net::{TcpListener, TcpStream},
    sync::{OwnedSemaphorePermit, Semaphore},
};

/// Most connections at a time; more wait until one is closed.
pub const MAX_CONNECTIONS: usize = 128;

/// Most bytes of a request's body: no call needs more than a number.
pub const MAX_BODY_BYTES: usize = 4096;

/// How long to wait when no connection can be accepted, as when file descriptors have run out.
const ACCEPT_PAUSE: Duration = Duration::from_millis(100);

/// The HTTP interface, bound but not serving yet.
pub(crate) struct Http {
    listener: std::net::TcpListener,
    address: SocketAddr,
}

impl Http {
    /// Listens on `address`; port 0 lets the system choose.
    pub fn bind(address: &str) -> Result<Self, Error> {
        let failed = |source| Error::Listen { endpoint: format!("http {address}"), source };
        let listener = std::net::TcpListener::bind(address).map_err(failed)?;
        listener.set_nonblocking(true).map_err(failed)?;
        let address = listener.local_addr().map_err(failed)?;
        Ok(Self { listener, address })
    }

    /// The page's address, with the token.
    pub fn url(&self, token: &Token) -> String {
        format!("http://{}/?token={}", self.address, token.as_str())
    }

    /// Serves until the future is dropped.
    pub async fn serve(self, token: Token, desk: Arc<Desk>) -> io::Result<()> {
        let listener = Limited {
            listener: TcpListener::from_std(self.listener)?,
            permits: Arc::new(Semaphore::new(MAX_CONNECTIONS)),
        };
        let site = Arc::new(Site { address: self.address, token, control: Default::default(), desk });
        axum::serve(listener, routes(site)).await
    }
}

/// What is served, behind all that a request has to pass, from the bottom up.
fn routes(site: Arc<Site>) -> Router {
    api::routes(&site)
        .fallback(api::nowhere)
        .method_not_allowed_fallback(api::no_method)
        .layer(DefaultBodyLimit::max(MAX_BODY_BYTES))
        .layer(middleware::from_fn_with_state(Arc::clone(&site), guard::token))
        .layer(middleware::from_fn(page::serve))
        .layer(middleware::from_fn_with_state(Arc::clone(&site), guard::place))
        .layer(middleware::from_fn(page::secure))
        .with_state(site)
}

/// Accepts no more than [`MAX_CONNECTIONS`] at a time.
struct Limited {
    listener: TcpListener,
    permits: Arc<Semaphore>,
}

impl axum::serve::Listener for Limited {
    type Io = Connection;
    type Addr = SocketAddr;

    async fn accept(&mut self) -> (Connection, SocketAddr) {
        let permit = Arc::clone(&self.permits).acquire_owned().await.expect("the semaphore is never closed");
        loop {
            match self.listener.accept().await {
                Ok((stream, address)) => {
                    let _ = stream.set_nodelay(true);
                    return (Connection { stream, _permit: permit }, address);
                }
                Err(_) => tokio::time::sleep(ACCEPT_PAUSE).await,
            }
        }
    }

    fn local_addr(&self) -> io::Result<SocketAddr> {
        self.listener.local_addr()
    }
}

/// A connection that counts.
struct Connection {
    stream: TcpStream,
    _permit: OwnedSemaphorePermit,
}

impl AsyncRead for Connection {
    fn poll_read(
        mut self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        into: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_read(cx, into)
    }
}

impl AsyncWrite for Connection {
    fn poll_write(mut self: Pin<&mut Self>, cx: &mut Context<'_>, from: &[u8]) -> Poll<io::Result<usize>> {
        Pin::new(&mut self.stream).poll_write(cx, from)
    }

    fn poll_flush(mut self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_flush(cx)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(cx)
    }
}
