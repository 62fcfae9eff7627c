//! Manual pulse generators, cam following and electronic gearing (manual, 2.1.3.1.4 and 2.5.2).

use super::refusal::Refusal;
use super::table::Id;
use super::{Cmd4cr, polarity};
use crate::ascii::speeds;
use crate::ascii::station::{Task, side};
use crate::flash::Flash;
use ::motion::pulser::{self, Gear};
use ::motion::{Direction, Goal};

/// The generator of an axis.
#[derive(Debug)]
pub struct Pulser {
    gear: pulser::Pulser,
    /// What has come out of the gear.
    position: i32,
}

impl Pulser {
    pub const fn new() -> Self {
        Self { gear: pulser::Pulser::new(), position: 0 }
    }
}

impl<F: Flash> Cmd4cr<F> {
    /// Whether an axis follows its manual pulse generator.
    pub fn pulser_on(&self, axis: usize) -> bool {
        self.memory.cells.at(Id::PulserEnable, axis) != 0
    }

    /// `MPE`, `MPGE`: an axis follows its generator or no longer; StepNLoop is off meanwhile.
    pub fn set_pulser(&mut self, axis: usize, on: bool) -> Result<(), Refusal> {
        if on == self.pulser_on(axis) {
            return Ok(());
        }
        if on {
            if self.buffer.is_on() {
                return Err(Refusal::BufferEnabled);
            }
            if !self.is_done(axis) || self.joystick_on(axis) {
                return Err(Refusal::Moving);
            }
            self.begin_to_follow(axis);
        } else {
            self.axes[axis].halt();
            self.stations[axis].task = Task::Stop;
        }
        self.memory.cells.set_at(Id::PulserEnable, axis, on.into());
        Ok(())
    }

    /// `MP`: pulses that have come out of the gear.
    pub fn pulser_position(&self, axis: usize) -> i32 {
        self.pulsers[axis].position
    }

    /// Sets that counter.
    pub fn set_pulser_position(&mut self, axis: usize, position: i32) {
        self.pulsers[axis].position = position;
    }

    /// Counts arrive: their pulses go out at once, no faster than high speed. Where an error or a limit is
    /// in the way they are lost.
    pub fn take_pulses(&mut self, axis: usize, counts: i32) {
        if !self.pulser_on(axis) {
            return;
        }
        let (shift, reversed) = polarity::pulser(self.polarity(axis));
        let get = |id| self.memory.cells.at(id, axis) as u32;
        let gear =
            Gear { shift, reversed, multiplier: get(Id::PulserMultiplier), divider: get(Id::PulserDivider) };
        let pulses = self.pulsers[axis].gear.take(counts, gear);
        let position = &mut self.pulsers[axis].position;
        *position = position.wrapping_add(pulses as i32);
        let way = Direction::of(pulses);
        if pulses == 0 || !self.may_follow(axis) {
            return;
        }
        if self.limits_on(axis)[side(way)] {
            return self.limit_hit(axis, way);
        }
        let limits = self.limits(axis);
        let speed = if self.guards[axis].slow { limits.start } else { limits.top };
        let unit = &mut self.axes[axis];
        unit.set_limits(speeds::constant(speed, limits.scale));
        let from = match unit.goal() {
            Goal::Position(target) if unit.is_moving() => target,
            _ => unit.position(),
        };
        unit.set_goal(Goal::Position(from.wrapping_add(pulses as i32)));
    }
}
