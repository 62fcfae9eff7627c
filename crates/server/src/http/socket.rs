//! WebSockets: they are counted, their messages are limited, and control lasts while one is open that shows it.

use super::{
    Failure, Site, guard,
    limits::{Client, SocketPermit},
};
use axum::{
    extract::{FromRequestParts, WebSocketUpgrade, ws::WebSocket},
    http::request::Parts,
    response::Response,
};
use std::{future::pending, sync::Arc, time::Duration};
use tokio::time::interval;

/// Most bytes of a message of a client that has little to say.
pub const SHORT_MESSAGE: usize = 4096;

/// How often control is renewed.
const RENEWAL: Duration = Duration::from_secs(3);

/// A request that wants to become a WebSocket, and may.
pub struct Upgrade {
    upgrade: WebSocketUpgrade,
    permit: SocketPermit,
    /// `lease` of the query.
    lease: Option<String>,
    site: Arc<Site>,
}

impl FromRequestParts<Arc<Site>> for Upgrade {
    type Rejection = Failure;

    async fn from_request_parts(parts: &mut Parts, site: &Arc<Site>) -> Result<Self, Failure> {
        let upgrade = WebSocketUpgrade::from_request_parts(parts, site).await;
        let upgrade = upgrade.map_err(|why| Failure::new(why.status(), "this is a WebSocket"))?;
        let permit = SocketPermit::of(&site.limits, Client::of(parts))?;
        let lease = guard::query(&parts.uri, "lease").map(str::to_owned);
        Ok(Self { upgrade, permit, lease, site: Arc::clone(site) })
    }
}

impl Upgrade {
    /// The lease that the client shows.
    pub fn lease(&self) -> Option<&str> {
        self.lease.as_deref()
    }

    /// Answers, and then talks until `talk` has ended. Messages of the client have at most so many bytes.
    pub fn run<F>(self, max_message: usize, talk: impl FnOnce(WebSocket) -> F + Send + 'static) -> Response
    where
        F: Future<Output = ()> + Send,
    {
        let Self { upgrade, permit, lease, site } = self;
        let upgrade = upgrade.max_message_size(max_message).max_frame_size(max_message);
        upgrade.on_upgrade(async move |socket| {
            let _permit = permit;
            tokio::select! {
                () = talk(socket) => {}
                () = keep(&site, lease) => {}
            }
        })
    }
}

/// Keeps control for the client that shows this lease, as long as it is the one that has it. Never ends.
async fn keep(site: &Site, lease: Option<String>) {
    if let Some(lease) = lease {
        let mut ticks = interval(RENEWAL);
        while site.control.renew(&lease) {
            ticks.tick().await;
        }
    }
    pending().await
}
