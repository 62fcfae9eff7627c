//! Faults of virtual devices.

use super::{Answer, Body, Place, Shared, at, json, unprocessable};
use axum::{Json, extract::State, http::StatusCode};
use serde::Serialize;
use sim::fault::{Entry, FaultView};
use utoipa::ToSchema;

/// The number of a fault, which no other fault of the device has.
#[derive(Serialize, ToSchema)]
pub struct Numbered {
    id: u64,
}

/// The faults that wait or are active
#[utoipa::path(
    get, path = "/api/devices/{device}/faults", tag = "faults",
    responses((status = 200, body = [FaultView]))
)]
pub async fn list(State(site): Shared, place: Place<String>) -> Answer<Json<Vec<FaultView>>> {
    Ok(Json(site.unit(&at(place)?)?.with(|device| device.faults())))
}

/// Give the device a fault
#[utoipa::path(
    post, path = "/api/devices/{device}/faults", tag = "faults",
    request_body = Entry, responses((status = 201, body = Numbered))
)]
pub async fn add(
    State(site): Shared,
    place: Place<String>,
    body: Body,
) -> Answer<(StatusCode, Json<Numbered>)> {
    let unit = site.unit(&at(place)?)?;
    let entry: Entry = serde_json::from_value(json(body)?)
        .map_err(|why| unprocessable(format!("this is no fault: {why}")))?;
    if entry.device.is_some() {
        return Err(unprocessable("device: the path says which device it is"));
    }
    let id = unit.with(|device| device.plan_entry(&entry))?;
    Ok((StatusCode::CREATED, Json(Numbered { id })))
}

/// End all faults
#[utoipa::path(
    delete, path = "/api/devices/{device}/faults", tag = "faults",
    responses((status = 204))
)]
pub async fn clear_all(State(site): Shared, place: Place<String>) -> Answer<StatusCode> {
    site.unit(&at(place)?)?.with(|device| device.clear_faults());
    Ok(StatusCode::NO_CONTENT)
}

/// End a fault
#[utoipa::path(
    delete, path = "/api/devices/{device}/faults/{id}", tag = "faults",
    responses((status = 204))
)]
pub async fn clear(State(site): Shared, place: Place<(String, u64)>) -> Answer<StatusCode> {
    let (name, id) = at(place)?;
    site.unit(&name)?.with(|device| device.clear_fault(id))?;
    Ok(StatusCode::NO_CONTENT)
}
