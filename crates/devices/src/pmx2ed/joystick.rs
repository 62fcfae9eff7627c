//! Joystick control (manual, section 7.15).

use super::refusal::Refusal;
use super::table::{AXIS_COUNT, Id};
use super::{Pmx2ed, pins};
use crate::ascii::station::Task;
use crate::board::Board;
use crate::flash::Flash;
use ::motion::joystick::{Joystick, Settings, SoftLimits};
use ::motion::pps;

// Places of the two axes' values among JV1 to JV6.
pub const SPEEDS: usize = 0;
pub const CHANGES: usize = 2;
/// The first zero tolerance.
pub const TOLERANCES: usize = 4;

/// Soft limits of an axis among JL1 to JL8.
const LIMITS: usize = 4;

impl<F: Flash> Pmx2ed<F> {
    /// Whether an axis follows its joystick.
    pub fn joystick_on(&self, axis: usize) -> bool {
        self.memory.cells.get(Id::JoystickMask) >> axis & 1 != 0
    }

    /// `JO`, `JF`, `JOYENA`: the axes with a bit follow their joysticks, and StepNLoop is off there.
    pub fn set_joystick(&mut self, mask: i32) -> Result<(), Refusal> {
        let before = self.memory.cells.get(Id::JoystickMask);
        let begins = |axis: usize| (mask & !before) >> axis & 1 != 0;
        if (0..AXIS_COUNT).any(|axis| begins(axis) && !self.is_done(axis)) {
            return Err(Refusal::Moving);
        }
        self.memory.cells.set(Id::JoystickMask, mask);
        for axis in 0..AXIS_COUNT {
            if begins(axis) {
                self.memory.cells.set_at(Id::Loop, axis, 0);
                self.stations[axis].closed.disable();
                self.stations[axis].task = Task::Follow;
            } else if before >> axis & 1 != 0 && mask >> axis & 1 == 0 {
                self.axes[axis].halt();
                self.stations[axis].joystick = Joystick::new();
                self.stations[axis].task = Task::Stop;
            }
        }
        Ok(())
    }

    /// Once a millisecond: the speed that the joystick asks for.
    pub fn follow_joystick(&mut self, axis: usize, board: &mut dyn Board) {
        if !self.joystick_on(axis) {
            return;
        }
        let value = |first: usize| self.memory.cells.at(Id::JoystickValues, first + axis);
        let limit = |side| self.memory.cells.at(Id::JoystickLimits, limit_place(axis, side));
        let settings = Settings {
            negative_mv: 0,
            positive_mv: pins::MAX_MV,
            tolerance_mv: value(TOLERANCES),
            speed_pps: value(SPEEDS) as u32,
            change_pps: value(CHANGES) as u32,
            limits: SoftLimits {
                negative_outer: limit(0),
                negative_inner: limit(1),
                positive_inner: limit(2),
                positive_outer: limit(3),
            },
        };
        let analog = self.analog(axis, board);
        // A limit that is on, or an error that was not cleared, is stronger.
        let barred = self.stations[axis].errors.contains(&true);
        let allowed = self.limits_on(axis).map(|on| !on && !barred);
        let unit = &mut self.axes[axis];
        self.stations[axis].follow_joystick(unit, &settings, analog, allowed, pps::CLOCK_HZ);
    }
}

/// Where a soft limit of an axis stands among JL1 to JL8: negative outer and inner, positive inner and
/// outer.
pub const fn limit_place(axis: usize, side: usize) -> usize {
    axis * LIMITS + side
}
