//! What the page needs beside the state of devices: what each model can do, and one way to work with every controller,
//! be it virtual or real.

mod catalog;
mod models;

use crate::http::Site;
use axum::{Router, routing::get};
use std::sync::Arc;

/// The calls of the desk.
pub(crate) fn routes() -> Router<Arc<Site>> {
    Router::new().route("/api/models", get(models::list)).route("/api/models/{model}", get(models::one))
}
