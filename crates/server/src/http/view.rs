//! A device as JSON.

use crate::desk::{Seat, Summary};
use serde::Serialize;
use sim::DeviceState;
use utoipa::ToSchema;

/// Everything about a controller that can be seen from outside.
#[derive(Serialize, ToSchema)]
pub(crate) struct View {
    #[serde(flatten)]
    summary: Summary,
    /// Of a virtual one.
    #[serde(flatten)]
    state: Option<DeviceState>,
}

impl View {
    /// The controller now.
    pub fn of(seat: &Seat) -> Self {
        Self { summary: seat.summary(), state: seat.device().map(|unit| unit.state()) }
    }
}
