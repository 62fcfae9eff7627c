//! What a device is doing, for people and their tools.

use devices::{AxisState, ProgramRun, ProgramState};
use serde::Serialize;
use std::collections::BTreeMap;

/// A device at one moment.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
pub struct DeviceState {
    /// The axes by name.
    pub axes: BTreeMap<&'static str, AxisView>,
    /// The standalone programs in their order.
    pub programs: Vec<ProgramView>,
    /// Device time in seconds since the device was made; it goes on when the power is cycled.
    pub device_seconds: f64,
}

/// One axis at one moment.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
pub struct AxisView {
    /// Position counter in pulses.
    pub position: i32,
    /// Position as the encoder says, in the unit of its register.
    pub encoder: i32,
    /// Speed in pulses a second.
    pub speed: f64,
    /// Where it is going, in pulses.
    pub target: i32,
    /// The status word of the axis as the device defines it.
    pub status: u32,
    /// All pulses since power-up, in both directions.
    pub steps: u64,
}

impl From<AxisState> for AxisView {
    fn from(state: AxisState) -> Self {
        Self {
            position: state.position,
            encoder: state.encoder,
            speed: state.speed_mpps as f64 / 1000.0,
            target: state.target,
            status: state.status,
            steps: state.steps,
        }
    }
}

/// One program at one moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
pub struct ProgramView {
    /// `idle`, `running`, `paused` or `error`.
    pub state: &'static str,
    /// Line or address.
    pub counter: u32,
    /// Instructions executed since power-up.
    pub instructions: u64,
}

impl From<ProgramState> for ProgramView {
    fn from(program: ProgramState) -> Self {
        let state = match program.run {
            ProgramRun::Idle => "idle",
            ProgramRun::Running => "running",
            ProgramRun::Paused => "paused",
            ProgramRun::Error => "error",
        };
        Self { state, counter: program.counter, instructions: program.instructions }
    }
}
