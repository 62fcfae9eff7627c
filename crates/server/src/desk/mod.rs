//! What the page needs beside the state of devices: what each model can do, and one way to work with every controller,
//! be it virtual or real.
//!
//! - [`catalog`]: what a model can do, from its tables.
//! - [`list`]: which controllers there are; [`seat`]: one of them; [`link`] and [`wire`]: the way to it, which is the
//!   same for virtual and real ones.
//! - [`hub`] asks a controller for its status while somebody looks, [`live`] tells them; [`hold`] stops jogs when nobody
//!   holds them any more.
//! - [`control`], [`parameters`], [`program`], [`machine`], [`devices`]: the calls.

mod catalog;
mod control;
mod devices;
mod hold;
mod hub;
mod link;
mod list;
mod live;
mod machine;
mod models;
mod parameters;
mod program;
mod role;
mod seat;
mod typescript;
mod wire;

pub(crate) use list::Desk;
pub(crate) use seat::{Seat, Summary};
pub use typescript::typescript;

use crate::http::Site;
use axum::extract::DefaultBodyLimit;
use std::sync::Arc;
use utoipa_axum::{router::OpenApiRouter, routes};

/// Most bytes of a bench file or program as JSON, in which a character may need six bytes.
const MAX_TEXT_BYTES: usize = 6 << 20;

/// The calls of the desk that nobody needs control for: looking, and stopping.
pub(crate) fn free() -> OpenApiRouter<Arc<Site>> {
    OpenApiRouter::new()
        .routes(routes!(models::list))
        .routes(routes!(models::one))
        .routes(routes!(models::fault_kinds))
        .routes(routes!(devices::serial_ports))
        .routes(routes!(devices::find))
        .routes(routes!(live::live))
        .routes(routes!(control::status))
        .routes(routes!(control::stop))
        .merge(long(OpenApiRouter::new().routes(routes!(program::compile))))
}

/// The calls that say themselves whether they need control.
pub(crate) fn judging() -> OpenApiRouter<Arc<Site>> {
    OpenApiRouter::new().routes(routes!(control::act))
}

/// The calls that change something.
pub(crate) fn led() -> OpenApiRouter<Arc<Site>> {
    let texts = OpenApiRouter::new()
        .routes(routes!(devices::list, devices::add))
        .routes(routes!(program::upload, program::download));
    OpenApiRouter::new()
        .routes(routes!(devices::show, devices::remove))
        .routes(routes!(control::terminal))
        .routes(routes!(parameters::read_all))
        .routes(routes!(parameters::read, parameters::write))
        .routes(routes!(parameters::store))
        .routes(routes!(parameters::restore))
        .routes(routes!(machine::show, machine::change))
        .routes(routes!(program::control))
        .routes(routes!(program::variables))
        .merge(long(texts))
}

/// Calls that take texts of users.
fn long(router: OpenApiRouter<Arc<Site>>) -> OpenApiRouter<Arc<Site>> {
    router.layer(DefaultBodyLimit::max(MAX_TEXT_BYTES))
}
