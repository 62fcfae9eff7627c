//! The pins of virtual devices.

use super::{Answer, Body, Place, Shared, at, json, unprocessable};
use axum::{Json, extract::State, http::StatusCode};
use serde_json::Value;
use sim::PinValue;

/// What is on a pin
#[utoipa::path(
    get, path = "/api/devices/{device}/pins/{pin}", tag = "machine",
    responses((status = 200, body = PinValue))
)]
pub async fn read(State(site): Shared, place: Place<(String, String)>) -> Answer<Json<PinValue>> {
    let (name, pin) = at(place)?;
    Ok(Json(site.unit(&name)?.with(|device| device.read_pin(&pin))?))
}

/// Drive a pin
///
/// It keeps what it is given, whatever the simulated machine does.
#[utoipa::path(
    put, path = "/api/devices/{device}/pins/{pin}", tag = "machine",
    request_body = PinValue, responses((status = 204))
)]
pub async fn drive(State(site): Shared, place: Place<(String, String)>, body: Body) -> Answer<StatusCode> {
    let (name, pin) = at(place)?;
    let unit = site.unit(&name)?;
    let value = match json::<Value>(body)? {
        Value::Bool(on) => PinValue::Level(on),
        Value::Number(number) => PinValue::Number(number.as_f64().unwrap_or(f64::NAN)),
        other => return Err(unprocessable(format!("`{other}` is not true, false or a number"))),
    };
    unit.with(|device| device.drive_pin(&pin, value))?;
    Ok(StatusCode::NO_CONTENT)
}

/// Give a pin back to the simulated machine
#[utoipa::path(
    delete, path = "/api/devices/{device}/pins/{pin}", tag = "machine",
    responses((status = 204))
)]
pub async fn release(State(site): Shared, place: Place<(String, String)>) -> Answer<StatusCode> {
    let (name, pin) = at(place)?;
    site.unit(&name)?.with(|device| device.release_pin(&pin))?;
    Ok(StatusCode::NO_CONTENT)
}
