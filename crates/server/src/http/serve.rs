//! The listener: who may connect, and what is done for a connection.

use super::{
    Site, Tls, Token, api,
    connection::Connection,
    guard,
    limits::{self, Client, MAX_BODY_BYTES, MAX_CONNECTIONS, MAX_HEAD_BYTES, MAX_HEADERS, Patience},
    page,
};
use crate::{Error, desk::Desk};
use axum::{Router, extract::DefaultBodyLimit, http::Request, middleware};
use hyper::{body::Incoming, server::conn::http1, service::Service, service::service_fn};
use hyper_util::{
    rt::{TokioIo, TokioTimer},
    service::TowerToHyperService,
};
use std::{
    convert::Infallible,
    io,
    net::{SocketAddr, ToSocketAddrs},
    sync::Arc,
    time::Duration,
};
use tokio::{
    io::{AsyncRead, AsyncWrite},
    net::TcpListener,
    sync::Semaphore,
    time::timeout,
};
use tokio_rustls::TlsAcceptor;

/// How long to wait when no connection can be accepted, as when file descriptors have run out.
const ACCEPT_PAUSE: Duration = Duration::from_millis(100);

/// The HTTP interface, and who may come.
pub struct HttpSettings {
    /// Where it listens, as `ADDR:PORT`; port 0 lets the system choose.
    pub address: String,
    /// What every request must show.
    pub token: Token,
    /// A certificate, for HTTPS.
    pub tls: Option<Tls>,
    /// Whether other machines may connect without TLS.
    pub is_insecure: bool,
    /// How long clients may take.
    pub patience: Patience,
}

impl HttpSettings {
    /// Without TLS, for this machine only.
    pub fn new(address: impl Into<String>, token: Token) -> Self {
        let patience = Patience::default();
        Self { address: address.into(), token, tls: None, is_insecure: false, patience }
    }
}

/// The HTTP interface, bound but not serving yet.
pub(crate) struct Http {
    listener: std::net::TcpListener,
    address: SocketAddr,
    token: Token,
    tls: Option<TlsAcceptor>,
    patience: Patience,
}

impl Http {
    /// Listens. Others than this machine can only connect if TLS protects the token, or the user wants it so.
    pub fn bind(settings: HttpSettings) -> Result<Self, Error> {
        let HttpSettings { address, token, tls, is_insecure, patience } = settings;
        let failed = |source| Error::Listen { endpoint: format!("http {address}"), source };
        let tls = tls.map(|tls| tls.acceptor()).transpose()?;
        let places: Vec<SocketAddr> = address.to_socket_addrs().map_err(failed)?.collect();
        // Before anybody can connect.
        if tls.is_none() && !is_insecure && !places.iter().all(|place| place.ip().is_loopback()) {
            return Err(Error::Exposed(address));
        }
        let listener = std::net::TcpListener::bind(&places[..]).map_err(failed)?;
        listener.set_nonblocking(true).map_err(failed)?;
        let bound = listener.local_addr().map_err(failed)?;
        Ok(Self { listener, address: bound, token, tls, patience })
    }

    /// The page's address, with the token.
    pub fn url(&self) -> String {
        let scheme = if self.tls.is_some() { "https" } else { "http" };
        format!("{scheme}://{}/?token={}", self.address, self.token.as_str())
    }

    /// Serves until the future is dropped.
    pub async fn serve(self, desk: Arc<Desk>) -> io::Result<Infallible> {
        let Self { listener, address, token, tls, patience } = self;
        let listener = TcpListener::from_std(listener)?;
        let permits = Arc::new(Semaphore::new(MAX_CONNECTIONS));
        let site = Site { address, token, control: Default::default(), limits: Default::default(), desk };
        let routes = routes(Arc::new(site), patience);
        loop {
            let permit = Arc::clone(&permits).acquire_owned().await.expect("the semaphore is never closed");
            let (stream, peer) = loop {
                match listener.accept().await {
                    Ok(accepted) => break accepted,
                    Err(_) => tokio::time::sleep(ACCEPT_PAUSE).await,
                }
            };
            let _ = stream.set_nodelay(true);
            let (client, connection) = (Client(peer.ip()), Connection::new(stream, patience.send, permit));
            let (tls, routes) = (tls.clone(), routes.clone());
            tokio::spawn(async move {
                match tls {
                    None => answer(connection, client, routes, patience.head).await,
                    Some(tls) => {
                        if let Ok(Ok(stream)) = timeout(patience.handshake, tls.accept(connection)).await {
                            answer(stream, client, routes, patience.head).await;
                        }
                    }
                }
            });
        }
    }
}

/// Answers the requests of a connection.
async fn answer(
    stream: impl AsyncRead + AsyncWrite + Unpin + Send + 'static,
    client: Client,
    routes: Router,
    patience: Duration,
) {
    let routes = TowerToHyperService::new(routes);
    let service = service_fn(move |mut request: Request<Incoming>| {
        request.extensions_mut().insert(client);
        routes.call(request)
    });
    let connection = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(patience)
        .max_buf_size(MAX_HEAD_BYTES)
        .max_headers(MAX_HEADERS)
        .serve_connection(TokioIo::new(stream), service)
        .with_upgrades();
    // What goes wrong on a connection ends it, which the client sees.
    let _ = connection.await;
}

/// What is served, behind all that a request has to pass, from the bottom up.
fn routes(site: Arc<Site>, patience: Patience) -> Router {
    api::routes(&site)
        .fallback(api::nowhere)
        .method_not_allowed_fallback(api::no_method)
        .layer(DefaultBodyLimit::max(MAX_BODY_BYTES))
        .layer(middleware::from_fn_with_state(patience.body, limits::body))
        .layer(middleware::from_fn_with_state(Arc::clone(&site.limits), limits::changes))
        .layer(middleware::from_fn_with_state(Arc::clone(&site), guard::token))
        .layer(middleware::from_fn(page::serve))
        .layer(middleware::from_fn_with_state(Arc::clone(&site), guard::place))
        .layer(middleware::from_fn(page::secure))
        .with_state(site)
}
