//! The state of virtual devices.

use super::{
    super::{Failure, stream::stream as states},
    Answer, Place, Shared, at,
};
use axum::{
    extract::{State, WebSocketUpgrade, ws::rejection::WebSocketUpgradeRejection},
    response::Response,
};

/// A WebSocket with the state of a virtual device, thirty times a second
#[utoipa::path(get, path = "/api/devices/{device}/stream", tag = "devices", responses((status = 101)))]
pub async fn stream(
    State(site): Shared,
    place: Place<String>,
    upgrade: Result<WebSocketUpgrade, WebSocketUpgradeRejection>,
) -> Answer<Response> {
    let seat = site.desk.find(&at(place)?)?;
    // A real controller has no state but what it says, which is not said thirty times a second.
    seat.unit()?;
    let upgrade = upgrade.map_err(|why| Failure::new(why.status(), "this is a WebSocket"))?;
    Ok(upgrade.on_upgrade(move |socket| states(socket, seat)))
}
