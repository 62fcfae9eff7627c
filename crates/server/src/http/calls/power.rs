//! The power of virtual devices.

use super::{Answer, Place, Shared, at};
use axum::{extract::State, http::StatusCode};

/// Switch the device off and on
#[utoipa::path(
    post, path = "/api/devices/{device}/power-cycle", tag = "machine",
    responses((status = 204))
)]
pub async fn cycle(State(site): Shared, place: Place<String>) -> Answer<StatusCode> {
    site.unit(&at(place)?)?.with(|device| device.power_cycle());
    Ok(StatusCode::NO_CONTENT)
}

/// The same in the midst of whatever it does
///
/// What its flash memory has not finished is lost.
#[utoipa::path(
    post, path = "/api/devices/{device}/power-cut", tag = "machine",
    responses((status = 204))
)]
pub async fn cut(State(site): Shared, place: Place<String>) -> Answer<StatusCode> {
    site.unit(&at(place)?)?.with(|device| device.power_cut());
    Ok(StatusCode::NO_CONTENT)
}
