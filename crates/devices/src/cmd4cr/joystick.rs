//! Joystick control of X and Y (manual, 2.5.1).

use super::refusal::Refusal;
use super::table::{AXIS_COUNT, Id, JOYSTICK_AXES};
use super::{Cmd4cr, HZ};
use crate::ascii::station::Task;
use crate::board::Board;
use crate::flash::Flash;
use ::motion::joystick::{Joystick, Settings, SoftLimits};
use ::motion::pps;

/// Soft limits of an axis among JLIM1 to JLIM8.
const LIMITS: usize = 4;

impl<F: Flash> Cmd4cr<F> {
    /// Whether an axis follows its joystick.
    pub fn joystick_on(&self, axis: usize) -> bool {
        self.memory.cells.get(Id::JoystickMask) >> axis & 1 != 0
    }

    /// `JENA`, `JOYENA`: the axes with a bit follow their joysticks, and StepNLoop is off there.
    pub fn set_joystick(&mut self, mask: i32) -> Result<(), Refusal> {
        let before = self.memory.cells.get(Id::JoystickMask);
        let begins = |axis: usize| (mask & !before) >> axis & 1 != 0;
        for axis in (0..AXIS_COUNT).filter(|&axis| begins(axis)) {
            if self.buffer.is_on() {
                return Err(Refusal::BufferEnabled);
            }
            if !self.is_done(axis) || self.pulser_on(axis) {
                return Err(Refusal::Moving);
            }
        }
        self.memory.cells.set(Id::JoystickMask, mask);
        for axis in 0..AXIS_COUNT {
            if begins(axis) {
                self.begin_to_follow(axis);
            } else if (before & !mask) >> axis & 1 != 0 {
                self.axes[axis].halt();
                self.stations[axis].joystick = Joystick::new();
                self.stations[axis].task = Task::Stop;
            }
        }
        Ok(())
    }

    /// Once a millisecond: the speed that the joystick asks for. A slowdown input leaves low speed at the most.
    pub fn follow_joystick(&mut self, axis: usize, board: &mut dyn Board) {
        if axis >= JOYSTICK_AXES || !self.joystick_on(axis) {
            return;
        }
        let value = |id| self.memory.cells.at(id, axis);
        let limit = |side| self.memory.cells.at(Id::JoystickLimits, axis * LIMITS + side);
        let most = if self.guards[axis].slow {
            let limits = self.limits(axis);
            pps::pps(limits.start, limits.scale, HZ)
        } else {
            u32::MAX
        };
        let settings = Settings {
            negative_mv: value(Id::JoystickMin),
            positive_mv: value(Id::JoystickMax),
            tolerance_mv: value(Id::JoystickTolerance),
            speed_pps: most.min(value(Id::JoystickSpeed) as u32),
            change_pps: value(Id::JoystickChange) as u32,
            limits: SoftLimits {
                negative_outer: limit(0),
                negative_inner: limit(1),
                positive_inner: limit(2),
                positive_outer: limit(3),
            },
        };
        let analog = self.analog(axis, board);
        let free = self.may_follow(axis);
        let allowed = self.limits_on(axis).map(|on| !on && free);
        self.stations[axis].follow_joystick(&mut self.axes[axis], &settings, analog, allowed, HZ);
    }

    /// Whether nothing but a limit keeps an axis from following a joystick or a manual pulse generator.
    pub fn may_follow(&self, axis: usize) -> bool {
        !self.is_barred(axis) && !self.alarm_on(axis) && !self.io.emergency()
    }
}
