//! Parameters of a controller: reading, writing, storing.

use super::seat::Seat;
use crate::http::{Answer, Body, Failure, Place, Shared, at, json, unprocessable};
use axum::{Json, extract::State, http::StatusCode};
use devices::guide::Setting;
use host::{Controller, Error, Key, Value};
use std::collections::BTreeMap;

/// All parameters that can be read
///
/// Those that are changed by being looked at are left out.
#[utoipa::path(
    get, path = "/api/devices/{device}/parameters", tag = "parameters",
    responses((status = 200, body = BTreeMap<String, Value>))
)]
pub(crate) async fn read_all(
    State(site): Shared,
    place: Place<String>,
) -> Answer<Json<BTreeMap<String, Value>>> {
    let seat = site.desk.find(&at(place)?)?;
    let settings = (seat.model.guide.settings)();
    let readable = settings.iter().filter(|it| it.readable && !it.is_touchy);
    let values = seat.ask(async |it| values(it, readable).await).await?;
    Ok(Json(values))
}

/// One parameter
#[utoipa::path(
    get, path = "/api/devices/{device}/parameters/{parameter}", tag = "parameters",
    responses((status = 200, body = Value))
)]
pub(crate) async fn read(State(site): Shared, place: Place<(String, String)>) -> Answer<Json<Value>> {
    let (name, id) = at(place)?;
    let seat = site.desk.find(&name)?;
    let setting = find(&seat, &id)?;
    if !setting.readable {
        return Err(unprocessable(format!("`{id}` cannot be read")));
    }
    let value = seat.ask(async |it| it.read(&key(&setting)).await).await?;
    Ok(Json(as_shown(&setting, value)))
}

/// Set a parameter
#[utoipa::path(
    put, path = "/api/devices/{device}/parameters/{parameter}", tag = "parameters",
    request_body = Value, responses((status = 204))
)]
pub(crate) async fn write(
    State(site): Shared,
    place: Place<(String, String)>,
    body: Body,
) -> Answer<StatusCode> {
    let (name, id) = at(place)?;
    let seat = site.desk.find(&name)?;
    let setting = find(&seat, &id)?;
    let value: Value = json(body)?;
    if !setting.writable {
        return Err(unprocessable(format!("`{id}` cannot be set")));
    }
    if setting.is_text != matches!(value, Value::Text(_)) {
        let kind = if setting.is_text { "text" } else { "a number" };
        return Err(unprocessable(format!("`{id}` is {kind}")));
    }
    seat.ask(async |it| it.write(&key(&setting), &value).await).await?;
    Ok(StatusCode::NO_CONTENT)
}

/// Store all parameters that can be stored, so that they outlive the power
#[utoipa::path(post, path = "/api/devices/{device}/parameters/store", tag = "parameters", responses((status = 204)))]
pub(crate) async fn store(State(site): Shared, place: Place<String>) -> Answer<StatusCode> {
    let seat = site.desk.find(&at(place)?)?;
    let settings = (seat.model.guide.settings)();
    let keys: Vec<_> = settings.iter().filter(|it| it.stored && !it.stores_itself).map(key).collect();
    seat.ask(async |it| it.store(&keys).await).await?;
    Ok(StatusCode::NO_CONTENT)
}

/// Give all settings the values that they had from the factory
#[utoipa::path(post, path = "/api/devices/{device}/parameters/restore", tag = "parameters", responses((status = 204)))]
pub(crate) async fn restore(State(site): Shared, place: Place<String>) -> Answer<StatusCode> {
    let seat = site.desk.find(&at(place)?)?;
    let settings = (seat.model.guide.settings)();
    let stored = settings.iter().filter(|it| it.stored && it.writable);
    let defaults: Vec<_> =
        stored.filter_map(|it| Some((key(it), with_point(it.default?, it.decimals)))).collect();
    seat.ask(async |it| it.restore_factory(&defaults).await).await?;
    Ok(StatusCode::NO_CONTENT)
}

/// What these parameters are. What a controller refuses to say now is left out.
pub(super) async fn values(
    controller: &Controller,
    settings: impl Iterator<Item = &Setting>,
) -> host::Result<BTreeMap<String, Value>> {
    let mut values = BTreeMap::new();
    for setting in settings {
        match controller.read(&key(setting)).await {
            Ok(value) => drop(values.insert(setting.id.clone(), as_shown(setting, value))),
            Err(Error::Refused { .. }) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(values)
}

/// The parameter with an id.
fn find(seat: &Seat, id: &str) -> Answer<Setting> {
    let settings = (seat.model.guide.settings)();
    settings.into_iter().find(|it| it.id == id).ok_or_else(|| {
        Failure::new(StatusCode::NOT_FOUND, format!("a {} has no parameter `{id}`", seat.model.name))
    })
}

fn key(setting: &Setting) -> Key {
    setting.id.parse().expect("the id of a parameter names one")
}

/// A value as its table means it: text, or 32 bits without a sign.
fn as_shown(setting: &Setting, value: Value) -> Value {
    match value {
        Value::Text(_) => value,
        value if setting.is_text => Value::Text(value.to_string()),
        Value::Number(number @ i32::MIN..0) if setting.range.is_some_and(|(low, _)| low == 0) => {
            Value::Decimal((number as u32).into())
        }
        value => value,
    }
}

/// A number of a table, which counts without the point.
fn with_point(number: i64, decimals: u8) -> Value {
    match i32::try_from(number) {
        Ok(number) if decimals == 0 => Value::Number(number),
        _ => Value::Decimal(number as f64 / 10_f64.powi(decimals.into())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use devices::MODELS;

    #[test]
    fn every_id_names_a_parameter() {
        for model in MODELS {
            for setting in (model.guide.settings)() {
                assert_eq!(key(&setting).to_string(), setting.id);
            }
        }
    }

    #[test]
    fn numbers_with_a_point() {
        assert_eq!(with_point(5, 0), Value::Number(5));
        assert_eq!(with_point(2500, 3), Value::Decimal(2.5));
    }
}
