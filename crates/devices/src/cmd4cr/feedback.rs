//! Position and encoder counters, and StepNLoop (manual, 2.5.3 and 2.6.1).

use super::Cmd4cr;
use super::refusal::Refusal;
use super::table::{AXIS_COUNT, Id, POSITIONS};
use crate::ascii::station::{Halt, Task};
use crate::board::Board;
use crate::flash::Flash;
use ::motion::closed_loop::Settings;

impl<F: Flash> Cmd4cr<F> {
    /// The pulse counter, or the target position now with StepNLoop.
    pub fn position(&self, axis: usize) -> i32 {
        self.stations[axis].closed.position(&self.axes[axis], self.ratio(axis))
    }

    /// Sets the pulse counter.
    pub fn set_position(&mut self, axis: usize, position: i32, board: &mut dyn Board) -> Result<(), Refusal> {
        if !self.is_idle(axis) || self.is_moving(axis) || self.stations[axis].closed.is_on() {
            return Err(Refusal::Moving);
        }
        self.axes[axis].halt();
        self.axes[axis].set_position(position);
        self.recount(axis, board);
        Ok(())
    }

    /// The encoder counter.
    pub fn encoder(&self, axis: usize, board: &mut dyn Board) -> i32 {
        self.stations[axis].encoder.position(board.encoder(axis))
    }

    /// Sets the encoder counter; the target of StepNLoop goes along.
    pub fn set_encoder(&mut self, axis: usize, position: i32, board: &mut dyn Board) {
        self.stations[axis].set_encoder(position, board.encoder(axis));
        self.recount(axis, board);
    }

    /// Target position now minus encoder; 0 without StepNLoop (manual, 2.6.1.3).
    pub fn delta(&self, axis: usize, board: &mut dyn Board) -> i32 {
        let encoder = self.encoder(axis, board);
        let closed = &self.stations[axis].closed;
        if closed.is_on() { closed.delta(&self.axes[axis], encoder, self.ratio(axis)) } else { 0 }
    }

    /// The pulse that a target means.
    pub fn goal(&self, axis: usize, target: i32) -> Result<i32, Refusal> {
        let pulses = self.stations[axis].goal(&self.axes[axis], target, self.ratio(axis));
        pulses.filter(|pulses| POSITIONS.contains(pulses)).ok_or(Refusal::Index)
    }

    /// `SL`: StepNLoop on or off. It does not go together with the joystick, a manual pulse generator or, for
    /// the axes that it moves, the buffer.
    pub fn switch_loop(&mut self, axis: usize, on: bool, board: &mut dyn Board) -> Result<(), Refusal> {
        if !self.is_done(axis) || on && matches!(self.stations[axis].task, Task::Follow) {
            return Err(Refusal::Moving);
        }
        if on && self.buffer.is_on() {
            return Err(Refusal::BufferEnabled);
        }
        self.memory.cells.set_at(Id::Loop, axis, on.into());
        self.stations[axis].switch_loop(on, &self.axes[axis], board.encoder(axis));
        Ok(())
    }

    /// Switches the loops on that are on at power-up.
    pub fn boot_loops(&mut self, board: &mut dyn Board) {
        for axis in 0..AXIS_COUNT {
            if self.joystick_on(axis) || self.pulser_on(axis) {
                self.begin_to_follow(axis);
            } else if self.memory.cells.at(Id::Loop, axis) != 0 {
                self.stations[axis].switch_loop(true, &self.axes[axis], board.encoder(axis));
            }
        }
    }

    /// An axis follows a joystick or a manual pulse generator, without StepNLoop.
    pub fn begin_to_follow(&mut self, axis: usize) {
        self.memory.cells.set_at(Id::Loop, axis, 0);
        self.stations[axis].closed.disable();
        self.stations[axis].task = Task::Follow;
    }

    /// The errors of StepNLoop are forgotten.
    pub fn clear_loop(&mut self, axis: usize, board: &mut dyn Board) {
        let encoder = self.encoder(axis, board);
        self.stations[axis].closed.clear(&self.axes[axis], encoder);
    }

    /// Lets StepNLoop watch an axis: once a millisecond, and when it has come to rest.
    pub fn poll_loop(&mut self, axis: usize, board: &mut dyn Board) {
        if !self.stations[axis].closed.is_on() {
            return;
        }
        let get = |id| self.memory.cells.at(id, axis) as u32;
        let settings = Settings {
            ratio: self.ratio(axis),
            tolerance: get(Id::LoopTolerance),
            range: get(Id::LoopRange),
            attempts: get(Id::LoopAttempts),
        };
        let carried = self.ride_of(axis).is_some();
        if matches!(self.stations[axis].task, Task::Rest) && !self.axes[axis].is_moving() && !carried {
            // A correction goes with the speeds of the axis.
            self.set_limits(axis, self.limits(axis));
        }
        let decoder = board.encoder(axis);
        if self.stations[axis].poll_loop(&mut self.axes[axis], decoder, &settings, carried) {
            self.stop_ride(axis, Halt::AtOnce);
            self.settle();
            self.program_error(axis);
        }
    }
}
