//! What a controller is told to do.

use super::hold;
use crate::http::{Answer, Body, Place, Shared, at, json, lease};
use axum::{
    Json,
    extract::State,
    http::{HeaderMap, StatusCode},
};
use host::{Action, Status};
use serde::Deserialize;
use ts_rs::TS;
use utoipa::ToSchema;

/// A line that somebody typed.
#[derive(Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TypedLine {
    /// It, without its end.
    line: String,
}

/// What a controller is doing, as it says over its wire
#[utoipa::path(get, path = "/api/devices/{device}/status", tag = "control", responses((status = 200, body = Status)))]
pub(crate) async fn status(State(site): Shared, place: Place<String>) -> Answer<Json<Status>> {
    let seat = site.desk.find(&at(place)?)?;
    Ok(Json(seat.ask(async |it| it.status().await).await?))
}

/// Have a controller do something
///
/// To stop or abort nobody needs control. A jog with `held` stops unless the WebSocket `live` says again and again that it goes on.
#[utoipa::path(
    post, path = "/api/devices/{device}/act", tag = "control",
    request_body = Action, responses((status = 204))
)]
pub(crate) async fn act(
    State(site): Shared,
    place: Place<String>,
    headers: HeaderMap,
    body: Body,
) -> Answer<StatusCode> {
    let action: Answer<Action> = json(body);
    if !matches!(action, Ok(Action::Stop { .. } | Action::Abort { .. })) {
        site.control.admit(lease(&headers))?;
    }
    let seat = site.desk.find(&at(place)?)?;
    let action = action?;
    let begun = hold::begin(&seat, &action);
    let done = seat.ask(async |it| it.act(&action).await).await;
    match (&done, begun) {
        (Ok(()), None) => seat.holds.superseded(&action),
        (Err(why), Some(begun)) if why.is_refusal() => begun.refused(&seat.holds),
        _ => {}
    }
    done.map(|()| StatusCode::NO_CONTENT)
}

/// Stop all axes and programs
///
/// Whoever has control: everybody may.
#[utoipa::path(post, path = "/api/devices/{device}/stop", tag = "control", responses((status = 204)))]
pub(crate) async fn stop(State(site): Shared, place: Place<String>) -> Answer<StatusCode> {
    let seat = site.desk.find(&at(place)?)?;
    seat.ask(async |it| it.stop_all().await).await?;
    seat.holds.superseded(&Action::Stop { axis: None });
    Ok(StatusCode::NO_CONTENT)
}

/// Send a line to a controller
///
/// In the language of its wire. A refusal is an answer too.
#[utoipa::path(
    post, path = "/api/devices/{device}/terminal", tag = "control",
    request_body = TypedLine, responses((status = 200, body = host::Answer))
)]
pub(crate) async fn terminal(
    State(site): Shared,
    place: Place<String>,
    body: Body,
) -> Answer<Json<host::Answer>> {
    let seat = site.desk.find(&at(place)?)?;
    let TypedLine { line } = json(body)?;
    Ok(Json(seat.ask(async |it| it.terminal(&line).await).await?))
}
