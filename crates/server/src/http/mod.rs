//! The page and the HTTP interface: the state of the devices, their pins, and the faults that one can give them.

mod api;
mod calls;
mod connection;
mod debug;
mod guard;
mod lease;
mod limits;
mod lsp;
mod page;
mod request;
mod serve;
mod socket;
mod stream;
mod tls;
mod view;

pub use guard::Token;
pub(crate) use lease::{Lease, LeaseGrant, LeaseRequest, key as lease};
pub use limits::Patience;
pub(crate) use request::{Answer, Body, Place, Problem, Shared, at, json, unprocessable};
pub(crate) use serve::Http;
pub use serve::HttpSettings;
pub(crate) use socket::{SHORT_MESSAGE, Upgrade};
pub use tls::Tls;
pub(crate) use view::View;

use crate::desk::Desk;
use axum::{
    Json,
    http::{StatusCode, header},
    response::{IntoResponse, Response},
};
use lease::Control;
use limits::Limits;
use std::{net::SocketAddr, sync::Arc};

/// What the calls need.
pub(crate) struct Site {
    pub address: SocketAddr,
    pub token: Token,
    pub control: Control,
    pub limits: Arc<Limits>,
    /// The controllers.
    pub desk: Arc<Desk>,
}

/// A call that did not do what it should: a status and one sentence for people.
#[derive(Debug)]
pub(crate) struct Failure {
    status: StatusCode,
    message: String,
    /// Who has control, if that is why.
    holder: Option<String>,
}

impl Failure {
    pub fn new(status: StatusCode, message: impl Into<String>) -> Self {
        Self { status, message: message.into(), holder: None }
    }

    /// Whether what was asked for was refused, and not done.
    pub fn is_refusal(&self) -> bool {
        self.status.is_client_error()
    }

    /// There is no such thing; `known` are those that there are.
    pub fn unknown<'a>(kind: &str, name: &str, known: impl IntoIterator<Item = &'a str>) -> Self {
        let known: Vec<_> = known.into_iter().collect();
        Self::new(StatusCode::NOT_FOUND, format!("unknown {kind} `{name}`, known: {}", known.join(", ")))
    }
}

impl IntoResponse for Failure {
    fn into_response(self) -> Response {
        let body = Json(Problem { error: self.message, holder: self.holder });
        if self.status == StatusCode::UNAUTHORIZED {
            return (self.status, [(header::WWW_AUTHENTICATE, "Bearer")], body).into_response();
        }
        (self.status, body).into_response()
    }
}
