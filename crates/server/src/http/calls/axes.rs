//! What the world does to the shafts of virtual devices.

use super::{Answer, Body, Place, Shared, at, json, unprocessable, whole};
use axum::{extract::State, http::StatusCode};
use serde_json::Value;

/// Load an axis
///
/// In parts of the pull-out torque at full current.
#[utoipa::path(
    put, path = "/api/devices/{device}/axes/{axis}/load", tag = "machine",
    request_body(content = f64, content_type = "application/json"), responses((status = 204))
)]
pub async fn set_load(State(site): Shared, place: Place<(String, String)>, body: Body) -> Answer<StatusCode> {
    let (name, axis) = at(place)?;
    let unit = site.unit(&name)?;
    let value: Value = json(body)?;
    let load = value.as_f64().ok_or_else(|| unprocessable(format!("`{value}` is not a number")))?;
    unit.with(|device| device.set_load(&axis, load))?;
    Ok(StatusCode::NO_CONTENT)
}

/// Push the shaft by a number of pulses
#[utoipa::path(
    post, path = "/api/devices/{device}/axes/{axis}/push", tag = "machine",
    request_body(content = i64, content_type = "application/json"), responses((status = 204))
)]
pub async fn push(State(site): Shared, place: Place<(String, String)>, body: Body) -> Answer<StatusCode> {
    let (name, axis) = at(place)?;
    let unit = site.unit(&name)?;
    let distance = whole(body, "pulses")?;
    unit.with(|device| device.push(&axis, distance))?;
    Ok(StatusCode::NO_CONTENT)
}

/// Have the motor lose a number of pulses
#[utoipa::path(
    post, path = "/api/devices/{device}/axes/{axis}/lose", tag = "machine",
    request_body(content = u64, content_type = "application/json"), responses((status = 204))
)]
pub async fn lose(State(site): Shared, place: Place<(String, String)>, body: Body) -> Answer<StatusCode> {
    let (name, axis) = at(place)?;
    let unit = site.unit(&name)?;
    // Fewer than none are too many.
    let pulses = u64::try_from(whole(body, "pulses")?).unwrap_or(u64::MAX);
    unit.with(|device| device.lose(&axis, pulses))?;
    Ok(StatusCode::NO_CONTENT)
}

/// Turn the hand wheel of an axis by a number of counts
#[utoipa::path(
    post, path = "/api/devices/{device}/mpg/{axis}", tag = "machine",
    request_body(content = i64, content_type = "application/json"), responses((status = 204))
)]
pub async fn turn_pulser(
    State(site): Shared,
    place: Place<(String, String)>,
    body: Body,
) -> Answer<StatusCode> {
    let (name, axis) = at(place)?;
    let unit = site.unit(&name)?;
    let counts = whole(body, "counts")?;
    unit.with(|device| device.pulser(&axis, counts))?;
    Ok(StatusCode::NO_CONTENT)
}
