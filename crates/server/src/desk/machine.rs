//! The machine behind a virtual controller, for a drawing of it.

use crate::http::{Answer, Body, Failure, Place, Shared, at, json, unprocessable};
use axum::{Json, extract::State, http::StatusCode};
use serde::{Deserialize, Serialize};
use sim::{
    VirtualDevice,
    device::{SwitchError, Switches},
};
use std::collections::BTreeMap;
use ts_rs::TS;
use utoipa::ToSchema;

/// A machine.
#[derive(Debug, Serialize, TS, ToSchema)]
pub(crate) struct Machine {
    /// What is at each axis.
    axes: BTreeMap<&'static str, MachineAxis>,
}

/// What is at an axis. Positions are pulses at full resolution from where it first stood.
#[derive(Debug, Serialize, TS, ToSchema)]
pub(crate) struct MachineAxis {
    /// Where the driven side is.
    #[ts(type = "number")]
    shaft: i64,
    /// The switch at the negative end is on here and below; there is none on an axis that goes round.
    #[ts(type = "number | null")]
    negative_limit: Option<i64>,
    /// The switch at the positive end is on here and above.
    #[ts(type = "number | null")]
    positive_limit: Option<i64>,
    /// The home switch is on from the first to the second position.
    #[ts(type = "[number, number] | null")]
    home: Option<[i64; 2]>,
    /// From one index mark to the next.
    #[ts(type = "number | null")]
    index_every: Option<i64>,
    /// After so many pulses an axis that goes round is where it was.
    #[ts(type = "number | null")]
    circumference: Option<i64>,
    /// Its load, in parts of the motor's pull-out torque.
    load: f64,
    /// Play between the motor and what it drives.
    #[ts(type = "number")]
    backlash: i64,
}

/// The machine behind a virtual device
#[utoipa::path(get, path = "/api/devices/{device}/machine", tag = "machine", responses((status = 200, body = Machine)))]
pub(crate) async fn show(State(site): Shared, place: Place<String>) -> Answer<Json<Machine>> {
    let unit = site.unit(&at(place)?)?;
    let axes =
        unit.with(|device| device.axes().iter().map(|axis| (*axis, MachineAxis::of(device, axis))).collect());
    Ok(Json(Machine { axes }))
}

/// Switches of an axis that are moved.
#[derive(Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MovedSwitches {
    /// The axis.
    axis: String,
    /// The switch at the negative end is on here and below.
    #[serde(default)]
    #[ts(optional)]
    negative_limit: Option<i64>,
    /// The switch at the positive end is on here and above.
    #[serde(default)]
    #[ts(optional)]
    positive_limit: Option<i64>,
    /// The home switch is on from the first to the second position.
    #[serde(default)]
    #[ts(type = "[number, number]", optional)]
    home: Option<[i64; 2]>,
}

/// Move limit and home switches of a virtual device while it runs
///
/// Those that are not named stay where they are.
#[utoipa::path(
    patch, path = "/api/devices/{device}/machine", tag = "machine",
    request_body = MovedSwitches, responses((status = 204))
)]
pub(crate) async fn change(State(site): Shared, place: Place<String>, body: Body) -> Answer<StatusCode> {
    let unit = site.unit(&at(place)?)?;
    let MovedSwitches { axis, negative_limit, positive_limit, home } = json(body)?;
    let switches = Switches { negative_limit, positive_limit, home };
    unit.with(|device| device.move_switches(&axis, &switches))?;
    Ok(StatusCode::NO_CONTENT)
}

impl From<SwitchError> for Failure {
    fn from(error: SwitchError) -> Self {
        match error {
            SwitchError::Axis(error) => error.into(),
            error => unprocessable(error.to_string()),
        }
    }
}

impl MachineAxis {
    fn of(device: &VirtualDevice, axis: &str) -> Self {
        let known = "the device has this axis";
        let (machine, circular) = (device.config().axis(axis), device.config().axis(axis).circumference);
        Self {
            shaft: device.shaft(axis).expect(known),
            negative_limit: circular.is_none().then_some(machine.negative_limit),
            positive_limit: circular.is_none().then_some(machine.positive_limit),
            home: (machine.home[0] <= machine.home[1]).then_some(machine.home),
            index_every: (machine.index_every != 0).then_some(machine.index_every),
            circumference: circular,
            load: device.load(axis).expect(known),
            backlash: machine.backlash,
        }
    }
}
