//! Which controllers there are, and new ones.

use super::{link, seat::Summary};
use crate::http::{Answer, Body, Failure, Place, Shared, View, at, json, unprocessable};
use axum::{Json, extract::State, http::StatusCode};
use devices::MODELS;
use host::{Found, WireError};
use serde::Deserialize;
use sim::{Bench, config::is_name};
use ts_rs::TS;
use utoipa::ToSchema;

/// What a bench file is called in messages.
const BENCH: &str = "bench";

/// What is to come.
#[derive(Deserialize, TS, ToSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum NewDevices {
    /// The virtual controllers of a bench file. They listen on TCP at this machine, or nowhere: no files of the server
    /// are named, and none are made.
    Bench(String),
    /// A real controller.
    Real(RealDevice),
}

/// A real controller.
#[derive(Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RealDevice {
    /// What it is to be called: letters, digits and `.`, `_`, `-`.
    name: String,
    /// The name of its model.
    model: String,
    /// Where it is: `serial:PATH:BAUD` or `tcp:HOST:PORT`.
    link: String,
    /// Its address, if it is not alone there.
    #[ts(optional)]
    address: Option<u8>,
}

/// Where to look.
#[derive(Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WhereToLook {
    /// `serial:PATH:BAUD` or `tcp:HOST:PORT`.
    link: String,
}

/// The controllers
#[utoipa::path(get, path = "/api/devices", tag = "devices", responses((status = 200, body = [Summary])))]
pub(crate) async fn list(State(site): Shared) -> Json<Vec<Summary>> {
    Json(site.desk.summaries())
}

/// Add virtual controllers from a bench file, or connect a real one
///
/// Gives those that came.
#[utoipa::path(
    post, path = "/api/devices", tag = "devices",
    request_body = NewDevices, responses((status = 201, body = [Summary]))
)]
pub(crate) async fn add(State(site): Shared, body: Body) -> Answer<(StatusCode, Json<Vec<Summary>>)> {
    let added = match json(body)? {
        NewDevices::Bench(text) => {
            let bench = Bench::parse_local(&text, BENCH).map_err(|why| unprocessable(why.to_string()))?;
            site.desk.add_devices(&bench.devices)?
        }
        NewDevices::Real(RealDevice { name, model, link, address }) => {
            if !is_name(&name) {
                let message = format!("`{name}` is not a name: letters, digits and `.`, `_`, `-`");
                return Err(unprocessable(message));
            }
            let known = MODELS.iter().map(|model| model.name);
            let model = devices::model(&model).ok_or_else(|| Failure::unknown("model", &model, known))?;
            vec![site.desk.add_real(name, model, place(&link)?, address)?]
        }
    };
    Ok((StatusCode::CREATED, Json(added)))
}

/// A controller
///
/// A virtual one with its state.
#[utoipa::path(get, path = "/api/devices/{device}", tag = "devices", responses((status = 200, body = View)))]
pub(crate) async fn show(State(site): Shared, place: Place<String>) -> Answer<Json<View>> {
    let seat = site.desk.find(&at(place)?)?;
    Ok(Json(View::of(&seat)))
}

/// Take a controller from the list
///
/// Those that were there from the start stay.
#[utoipa::path(delete, path = "/api/devices/{device}", tag = "devices", responses((status = 204)))]
pub(crate) async fn remove(State(site): Shared, place: Place<String>) -> Answer<StatusCode> {
    site.desk.remove(&at(place)?)?;
    Ok(StatusCode::NO_CONTENT)
}

/// The serial ports of the server's computer
#[utoipa::path(get, path = "/api/serial-ports", tag = "devices", responses((status = 200, body = [String])))]
pub(crate) async fn serial_ports() -> Answer<Json<Vec<String>>> {
    let ports = host::serial_ports().map_err(|why| {
        Failure::new(StatusCode::INTERNAL_SERVER_ERROR, format!("the serial ports cannot be listed: {why}"))
    })?;
    Ok(Json(ports.iter().map(|port| port.display().to_string()).collect()))
}

/// Look for controllers at a serial port or TCP port
///
/// It takes half a minute where nobody answers.
#[utoipa::path(
    post, path = "/api/find", tag = "devices",
    request_body = WhereToLook, responses((status = 200, body = [Found]))
)]
pub(crate) async fn find(body: Body) -> Answer<Json<Vec<Found>>> {
    let WhereToLook { link } = json(body)?;
    let bus =
        place(&link)?.open().await.map_err(|why| Failure::from(host::Error::Wire(WireError::System(why))))?;
    Ok(Json(host::find(&bus).await?))
}

fn place(link: &str) -> Answer<link::Place> {
    link.parse().map_err(|why: link::PlaceError| unprocessable(why.to_string()))
}
