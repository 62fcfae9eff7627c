//! Breakpoints of a controller.

use super::{
    Failure,
    request::{Answer, Body, Place, Shared, at, json},
};
use crate::breaks::{DebugState, Go, MAX_BREAKPOINTS};
use axum::{Json, http::StatusCode};
use serde::Deserialize;
use std::collections::BTreeSet;

/// Where programs are to be held.
#[derive(Deserialize)]
struct Breakpoints {
    breakpoints: BTreeSet<u16>,
}

/// What is to happen next.
#[derive(Deserialize)]
struct Command {
    r#do: Go,
}

/// `GET /api/devices/NAME/debug`
pub async fn state(site: Shared, place: Place<String>) -> Answer<Json<DebugState>> {
    Ok(Json(site.unit(&at(place)?)?.debug_state()))
}

/// `PUT /api/devices/NAME/debug`: the addresses at which programs are held, all of them.
pub async fn set(site: Shared, place: Place<String>, body: Body) -> Answer<Json<DebugState>> {
    let unit = site.unit(&at(place)?)?;
    let Breakpoints { breakpoints } = json(body)?;
    if breakpoints.len() > MAX_BREAKPOINTS {
        let message = format!("there are {MAX_BREAKPOINTS} breakpoints at most");
        return Err(Failure::new(StatusCode::UNPROCESSABLE_ENTITY, message));
    }
    unit.set_breakpoints(breakpoints);
    Ok(Json(unit.debug_state()))
}

/// `POST /api/devices/NAME/debug`: a step, or on.
pub async fn go(site: Shared, place: Place<String>, body: Body) -> Answer<Json<DebugState>> {
    let unit = site.unit(&at(place)?)?;
    unit.debug(json::<Command>(body)?.r#do);
    Ok(Json(unit.debug_state()))
}
