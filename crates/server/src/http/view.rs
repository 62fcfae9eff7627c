//! A device as JSON.

use crate::unit::Unit;
use serde::Serialize;
use sim::DeviceState;
use utoipa::ToSchema;

/// An entry of the list of devices.
#[derive(Serialize, ToSchema)]
pub(super) struct Summary<'a> {
    name: &'a str,
    model: &'a str,
    endpoints: &'a [String],
}

impl<'a> Summary<'a> {
    pub fn of(unit: &'a Unit, endpoints: &'a [String]) -> Self {
        Self { name: &unit.name, model: unit.model, endpoints }
    }
}

/// Everything about a device that can be seen from outside.
#[derive(Serialize, ToSchema)]
pub(super) struct View<'a> {
    #[serde(flatten)]
    summary: Summary<'a>,
    #[serde(flatten)]
    state: DeviceState,
}

impl<'a> View<'a> {
    /// The device now.
    pub fn of(unit: &'a Unit, endpoints: &'a [String]) -> Self {
        Self { summary: Summary::of(unit, endpoints), state: unit.state() }
    }
}
