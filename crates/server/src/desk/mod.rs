//! What the page needs beside the state of devices: what each model can do, and one way to work with every controller,
//! be it virtual or real.

mod catalog;
mod models;

use crate::http::Site;
use std::sync::Arc;
use utoipa_axum::{router::OpenApiRouter, routes};

/// The calls of the desk that nobody needs control for.
pub(crate) fn free() -> OpenApiRouter<Arc<Site>> {
    OpenApiRouter::new().routes(routes!(models::list)).routes(routes!(models::one))
}
