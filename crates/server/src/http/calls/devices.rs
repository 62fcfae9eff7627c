//! The state of virtual devices.

use super::{
    super::{
        socket::{SHORT_MESSAGE, Upgrade},
        stream::stream as states,
    },
    Answer, Place, Shared, at,
};
use axum::{extract::State, response::Response};

/// A WebSocket with the state of a virtual device, thirty times a second
#[utoipa::path(get, path = "/api/devices/{device}/stream", tag = "devices", responses((status = 101)))]
pub async fn stream(State(site): Shared, place: Place<String>, upgrade: Upgrade) -> Answer<Response> {
    let seat = site.desk.find(&at(place)?)?;
    // A real controller has no state but what it says, which is not said thirty times a second.
    seat.unit()?;
    Ok(upgrade.run(SHORT_MESSAGE, move |socket| states(socket, seat)))
}
