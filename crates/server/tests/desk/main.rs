//! What the page asks of the server, over HTTP and WebSocket, with all three controllers.

mod catalog;
#[path = "../common/mod.rs"]
mod common;
