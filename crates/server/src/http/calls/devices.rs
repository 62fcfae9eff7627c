//! Which devices there are, and their state.

use super::{
    super::{
        socket::{SHORT_MESSAGE, Upgrade},
        stream::stream as states,
        view::{Summary, View},
    },
    Answer, Place, Shared, at,
};
use axum::{
    Json,
    extract::State,
    response::{IntoResponse, Response},
};

/// The devices
#[utoipa::path(get, path = "/api/devices", tag = "devices", responses((status = 200, body = [Summary])))]
pub async fn list(State(site): Shared) -> Response {
    let list: Vec<_> = site.units.iter().map(|(unit, endpoints)| Summary::of(unit, endpoints)).collect();
    Json(list).into_response()
}

/// The state of a virtual device
#[utoipa::path(get, path = "/api/devices/{device}", tag = "devices", responses((status = 200, body = View)))]
pub async fn show(State(site): Shared, place: Place<String>) -> Answer<Response> {
    let (unit, endpoints) = &site.units[site.find(&at(place)?)?];
    Ok(Json(View::of(unit, endpoints)).into_response())
}

/// A WebSocket with the state of a virtual device, thirty times a second
#[utoipa::path(get, path = "/api/devices/{device}/stream", tag = "devices", responses((status = 101)))]
pub async fn stream(State(site): Shared, place: Place<String>, upgrade: Upgrade) -> Answer<Response> {
    let number = site.find(&at(place)?)?;
    Ok(upgrade.run(SHORT_MESSAGE, move |socket| states(socket, site, number)))
}
