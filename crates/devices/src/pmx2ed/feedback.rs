//! Encoders and StepNLoop (manual, sections 7.4 and 7.17).

use super::Pmx2ed;
use super::refusal::Refusal;
use super::table::{AXIS_COUNT, Id};
use crate::ascii::station::{Halt, Task};
use crate::board::Board;
use crate::flash::Flash;
use ::motion::closed_loop::Settings;

impl<F: Flash> Pmx2ed<F> {
    /// The pulse counter, or the target position now with StepNLoop.
    pub fn position(&self, axis: usize) -> i32 {
        self.stations[axis].closed.position(&self.axes[axis], self.ratio(axis))
    }

    /// Sets the pulse counter.
    pub fn set_position(&mut self, axis: usize, position: i32) -> Result<(), Refusal> {
        if !self.is_done(axis) {
            return Err(Refusal::Moving);
        }
        if self.stations[axis].closed.is_on() {
            // The target position follows from the encoder (manual, 8.1.2: not while StepNLoop is on).
            return Err(Refusal::State);
        }
        self.axes[axis].halt();
        self.axes[axis].set_position(position);
        Ok(())
    }

    /// The encoder counter.
    pub fn encoder(&self, axis: usize, board: &mut dyn Board) -> i32 {
        self.stations[axis].encoder.position(board.encoder(axis))
    }

    /// Sets the encoder counter; the target of StepNLoop goes along.
    pub fn set_encoder(&mut self, axis: usize, position: i32, board: &mut dyn Board) {
        self.stations[axis].set_encoder(position, board.encoder(axis));
    }

    /// Target position now minus encoder.
    pub fn delta(&self, axis: usize, board: &mut dyn Board) -> i32 {
        let encoder = self.encoder(axis, board);
        self.stations[axis].closed.delta(&self.axes[axis], encoder, self.ratio(axis))
    }

    /// The pulse that a target means.
    pub fn goal(&self, axis: usize, target: i32) -> Result<i32, Refusal> {
        self.stations[axis].goal(&self.axes[axis], target, self.ratio(axis)).ok_or(Refusal::Value)
    }

    /// `SL`: StepNLoop on or off.
    pub fn switch_loop(&mut self, axis: usize, on: bool, board: &mut dyn Board) -> Result<(), Refusal> {
        if self.joystick_on(axis) && on {
            return Err(Refusal::State);
        }
        if !self.is_done(axis) {
            return Err(Refusal::Moving);
        }
        self.memory.cells.set_at(Id::Loop, axis, on.into());
        self.stations[axis].switch_loop(on, &self.axes[axis], board.encoder(axis));
        Ok(())
    }

    /// Switches the loops on that are on at power-up; a joystick is stronger.
    pub fn boot_loops(&mut self, board: &mut dyn Board) {
        for axis in 0..AXIS_COUNT {
            if self.joystick_on(axis) {
                self.memory.cells.set_at(Id::Loop, axis, 0);
                self.stations[axis].task = Task::Follow;
            }
            if self.memory.cells.at(Id::Loop, axis) != 0 {
                self.stations[axis].switch_loop(true, &self.axes[axis], board.encoder(axis));
            }
        }
    }

    /// `CLRS`: the errors of StepNLoop are forgotten.
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
        let carried = self.line_of(axis).is_some();
        if matches!(self.stations[axis].task, Task::Rest) && !self.axes[axis].is_moving() && !carried {
            // A correction goes with the speeds of the axis.
            let limits = self.limits(axis);
            self.axes[axis].set_limits(limits);
        }
        let decoder = board.encoder(axis);
        if !self.stations[axis].poll_loop(&mut self.axes[axis], decoder, &settings, carried) {
            return;
        }
        self.stop_line(axis, Halt::AtOnce);
        self.settle();
        self.program_error(axis);
    }
}
