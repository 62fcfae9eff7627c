//! Switches that are moved along their axis while the machine runs.

use super::{AxisError, VirtualDevice, world::Stirred};
use crate::{
    config::{AxisConfig, MAX_PULSES},
    tape::Act,
};
use serde::{Deserialize, Serialize};

/// New places of switches, in the unit of [`AxisConfig`]; those without one stay where they are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
#[serde(default, deny_unknown_fields)]
pub struct Switches {
    /// The switch at the negative end is on here and below.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub negative_limit: Option<i64>,
    /// The switch at the positive end is on here and above.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub positive_limit: Option<i64>,
    /// The home switch is on from the first to the second position.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub home: Option<[i64; 2]>,
}

/// Why switches stay where they are.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SwitchError {
    /// There is no such axis.
    #[error(transparent)]
    Axis(#[from] AxisError),
    /// There is nowhere to move any.
    #[error("`negative_limit`, `positive_limit` or `home` says where a switch goes")]
    Nothing,
    /// A circle has no ends.
    #[error("an axis that goes round has no ends")]
    Round,
    /// Nobody could get there.
    #[error("{0} is not between {low} and {MAX_PULSES}", low = -MAX_PULSES)]
    Far(i64),
    /// The limits are not apart.
    #[error("the negative limit {0} must lie below the positive limit {1}")]
    Limits(i64, i64),
    /// The home switch would end before it begins.
    #[error("home: {0} must not lie above {1}")]
    Home(i64, i64),
}

impl Switches {
    /// The machine with the switches there.
    fn put(&self, mut machine: AxisConfig) -> Result<AxisConfig, SwitchError> {
        let Self { negative_limit, positive_limit, home } = *self;
        let limits = [negative_limit, positive_limit];
        let mut places = limits.into_iter().flatten().chain(home.into_iter().flatten()).peekable();
        if places.peek().is_none() {
            return Err(SwitchError::Nothing);
        }
        if let Some(far) = places.find(|place| !(-MAX_PULSES..=MAX_PULSES).contains(place)) {
            return Err(SwitchError::Far(far));
        }
        if limits != [None, None] {
            if machine.circumference.is_some() {
                return Err(SwitchError::Round);
            }
            machine.negative_limit = negative_limit.unwrap_or(machine.negative_limit);
            machine.positive_limit = positive_limit.unwrap_or(machine.positive_limit);
            if machine.negative_limit >= machine.positive_limit {
                return Err(SwitchError::Limits(machine.negative_limit, machine.positive_limit));
            }
        }
        if let Some([first, last]) = home {
            if first > last {
                return Err(SwitchError::Home(first, last));
            }
            machine.home = [first, last];
        }
        Ok(machine)
    }
}

impl VirtualDevice {
    /// Moves switches of an axis. One that comes to where the axis is, or goes from there, changes its input now. A pin
    /// that has a cam instead of its usual switch keeps the cam.
    ///
    /// # Errors
    /// [`SwitchError`]; then all stay where they are.
    pub fn move_switches(&mut self, axis: &str, switches: &Switches) -> Result<(), SwitchError> {
        let number = self.axis_index(axis)?;
        let machine = switches.put(self.config.axis(axis))?;
        self.tell_tape(|| Act::Switches(axis.into(), *switches));
        self.config.axes.insert(axis.into(), machine);
        self.world.machine.move_switches(number, &self.config, self.controller.axes());
        self.world.windows[number] = None;
        self.world.stir(Stirred::Contacts);
        self.settle();
        self.tend_faults();
        Ok(())
    }
}
