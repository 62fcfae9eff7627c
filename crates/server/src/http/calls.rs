//! The calls, one function each.

use super::{
    Failure, Site,
    request::{Answer, Body, Place, Shared, at, json, unprocessable},
    stream::stream as states,
    view::{Summary, View},
};
use crate::unit::Unit;
use axum::{
    Json,
    extract::{State, WebSocketUpgrade, ws::rejection::WebSocketUpgradeRejection},
    http::StatusCode,
    response::{IntoResponse, Response},
};
use serde_json::Value;
use sim::{
    FaultError, PinError, PinValue,
    device::AxisError,
    fault::{Entry, FaultView},
};

impl Site {
    fn find(&self, name: &str) -> Answer<usize> {
        self.units.iter().position(|(unit, _)| unit.name == name).ok_or_else(|| {
            Failure::unknown("device", name, self.units.iter().map(|(unit, _)| unit.name.as_str()))
        })
    }

    pub(super) fn unit(&self, name: &str) -> Answer<&Unit> {
        Ok(&self.units[self.find(name)?].0)
    }
}

/// `GET /api/devices`
pub async fn devices(State(site): Shared) -> Response {
    let list: Vec<_> = site.units.iter().map(|(unit, endpoints)| Summary::of(unit, endpoints)).collect();
    Json(list).into_response()
}

/// `GET /api/devices/NAME`
pub async fn device(State(site): Shared, place: Place<String>) -> Answer<Response> {
    let (unit, endpoints) = &site.units[site.find(&at(place)?)?];
    Ok(Json(View::of(unit, endpoints)).into_response())
}

/// `GET /api/devices/NAME/stream`
pub async fn stream(
    State(site): Shared,
    place: Place<String>,
    upgrade: Result<WebSocketUpgrade, WebSocketUpgradeRejection>,
) -> Answer<Response> {
    let number = site.find(&at(place)?)?;
    let upgrade = upgrade.map_err(|why| Failure::new(why.status(), "this is a WebSocket"))?;
    Ok(upgrade.on_upgrade(move |socket| states(socket, site, number)))
}

/// `GET /api/devices/NAME/pins/PIN`
pub async fn read_pin(State(site): Shared, place: Place<(String, String)>) -> Answer<Json<PinValue>> {
    let (name, pin) = at(place)?;
    Ok(Json(site.unit(&name)?.with(|device| device.read_pin(&pin))?))
}

/// `PUT /api/devices/NAME/pins/PIN`
pub async fn drive_pin(
    State(site): Shared,
    place: Place<(String, String)>,
    body: Body,
) -> Answer<StatusCode> {
    let (name, pin) = at(place)?;
    let unit = site.unit(&name)?;
    let value = match json(body)? {
        Value::Bool(on) => PinValue::Level(on),
        Value::Number(number) => PinValue::Number(number.as_f64().unwrap_or(f64::NAN)),
        other => return Err(unprocessable(format!("`{other}` is not true, false or a number"))),
    };
    unit.with(|device| device.drive_pin(&pin, value))?;
    Ok(StatusCode::NO_CONTENT)
}

/// `DELETE /api/devices/NAME/pins/PIN`
pub async fn release_pin(State(site): Shared, place: Place<(String, String)>) -> Answer<StatusCode> {
    let (name, pin) = at(place)?;
    site.unit(&name)?.with(|device| device.release_pin(&pin))?;
    Ok(StatusCode::NO_CONTENT)
}

/// `PUT /api/devices/NAME/axes/AXIS/load`
pub async fn set_load(State(site): Shared, place: Place<(String, String)>, body: Body) -> Answer<StatusCode> {
    let (name, axis) = at(place)?;
    let unit = site.unit(&name)?;
    let value: Value = json(body)?;
    let load = value.as_f64().ok_or_else(|| unprocessable(format!("`{value}` is not a number")))?;
    unit.with(|device| device.set_load(&axis, load))?;
    Ok(StatusCode::NO_CONTENT)
}

/// `POST /api/devices/NAME/axes/AXIS/push`
pub async fn push(State(site): Shared, place: Place<(String, String)>, body: Body) -> Answer<StatusCode> {
    let (name, axis) = at(place)?;
    let unit = site.unit(&name)?;
    let distance = whole(body, "pulses")?;
    unit.with(|device| device.push(&axis, distance))?;
    Ok(StatusCode::NO_CONTENT)
}

/// `POST /api/devices/NAME/axes/AXIS/lose`
pub async fn lose(State(site): Shared, place: Place<(String, String)>, body: Body) -> Answer<StatusCode> {
    let (name, axis) = at(place)?;
    let unit = site.unit(&name)?;
    // Fewer than none are too many.
    let pulses = u64::try_from(whole(body, "pulses")?).unwrap_or(u64::MAX);
    unit.with(|device| device.lose(&axis, pulses))?;
    Ok(StatusCode::NO_CONTENT)
}

/// `GET /api/devices/NAME/faults`
pub async fn faults(State(site): Shared, place: Place<String>) -> Answer<Json<Vec<FaultView>>> {
    Ok(Json(site.unit(&at(place)?)?.with(|device| device.faults())))
}

/// `POST /api/devices/NAME/faults`
pub async fn add_fault(State(site): Shared, place: Place<String>, body: Body) -> Answer<Response> {
    let unit = site.unit(&at(place)?)?;
    let entry: Entry = serde_json::from_value(json(body)?)
        .map_err(|why| unprocessable(format!("this is no fault: {why}")))?;
    if entry.device.is_some() {
        return Err(unprocessable("device: the path says which device it is"));
    }
    let id = unit.with(|device| device.plan_entry(&entry))?;
    Ok((StatusCode::CREATED, Json(serde_json::json!({ "id": id }))).into_response())
}

/// `DELETE /api/devices/NAME/faults`
pub async fn clear_faults(State(site): Shared, place: Place<String>) -> Answer<StatusCode> {
    site.unit(&at(place)?)?.with(|device| device.clear_faults());
    Ok(StatusCode::NO_CONTENT)
}

/// `DELETE /api/devices/NAME/faults/ID`
pub async fn clear_fault(State(site): Shared, place: Place<(String, u64)>) -> Answer<StatusCode> {
    let (name, id) = at(place)?;
    site.unit(&name)?.with(|device| device.clear_fault(id))?;
    Ok(StatusCode::NO_CONTENT)
}

/// `POST /api/devices/NAME/mpg/AXIS`
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

/// `POST /api/devices/NAME/power-cycle`
pub async fn power_cycle(State(site): Shared, place: Place<String>) -> Answer<StatusCode> {
    site.unit(&at(place)?)?.with(|device| device.power_cycle());
    Ok(StatusCode::NO_CONTENT)
}

/// `POST /api/devices/NAME/power-cut`
pub async fn power_cut(State(site): Shared, place: Place<String>) -> Answer<StatusCode> {
    site.unit(&at(place)?)?.with(|device| device.power_cut());
    Ok(StatusCode::NO_CONTENT)
}

impl From<PinError> for Failure {
    fn from(error: PinError) -> Self {
        let status = match error {
            PinError::Unknown { .. } => StatusCode::NOT_FOUND,
            _ => StatusCode::UNPROCESSABLE_ENTITY,
        };
        Self::new(status, error.to_string())
    }
}

impl From<AxisError> for Failure {
    fn from(error: AxisError) -> Self {
        let status = match error {
            AxisError::Unknown { .. } | AxisError::NoPulser(_) => StatusCode::NOT_FOUND,
            AxisError::Range => StatusCode::UNPROCESSABLE_ENTITY,
        };
        Self::new(status, error.to_string())
    }
}

impl From<FaultError> for Failure {
    fn from(error: FaultError) -> Self {
        let status = match error {
            FaultError::Unknown(_) => StatusCode::NOT_FOUND,
            FaultError::Wrong(_) | FaultError::TooMany => StatusCode::UNPROCESSABLE_ENTITY,
        };
        Self::new(status, error.to_string())
    }
}

/// A whole number of something; beyond the range it is the last one in it.
fn whole(body: Body, what: &str) -> Answer<i64> {
    let value: Value = json(body)?;
    let number = value.as_f64().filter(|number| number.fract() == 0.0);
    Ok(number.ok_or_else(|| unprocessable(format!("`{value}` is not a number of {what}")))? as i64)
}
