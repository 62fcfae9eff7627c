//! Breakpoints of a controller.

use super::{
    Failure,
    request::{Answer, Body, Place, Shared, at, json},
};
use crate::breaks::{DebugState, Go, MAX_BREAKPOINTS};
use axum::{Json, http::StatusCode};
use serde::Deserialize;
use std::collections::BTreeSet;
use utoipa::ToSchema;

/// Where programs are to be held.
#[derive(Deserialize, ToSchema)]
pub struct Breakpoints {
    breakpoints: BTreeSet<u16>,
}

/// What is to happen next.
#[derive(Deserialize, ToSchema)]
pub struct DebugCommand {
    r#do: Go,
}

/// Where programs are held
#[utoipa::path(get, path = "/api/devices/{device}/debug", tag = "programs", responses((status = 200, body = DebugState)))]
pub async fn state(site: Shared, place: Place<String>) -> Answer<Json<DebugState>> {
    Ok(Json(site.unit(&at(place)?)?.debug_state()))
}

/// Set the addresses at which programs are held
///
/// All of them: others no longer count.
#[utoipa::path(
    put, path = "/api/devices/{device}/debug", tag = "programs",
    request_body = Breakpoints, responses((status = 200, body = DebugState))
)]
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

/// Go on after a breakpoint, or by a step
#[utoipa::path(
    post, path = "/api/devices/{device}/debug", tag = "programs",
    request_body = DebugCommand, responses((status = 200, body = DebugState))
)]
pub async fn go(site: Shared, place: Place<String>, body: Body) -> Answer<Json<DebugState>> {
    let unit = site.unit(&at(place)?)?;
    unit.debug(json::<DebugCommand>(body)?.r#do);
    Ok(Json(unit.debug_state()))
}
