//! The external start input: motions that wait for it (manual, 2.1.1.2 and 2.1.3.1.3).

use super::Cmd4cr;
use super::motion::{Motion, axes_in};
use super::refusal::Refusal;
use crate::board::Board;
use crate::flash::Flash;
use heapless::Deque;

/// Motions that can wait.
pub const MAX_WAITING: usize = 3;

/// Motions in the order of their commands, each with the program that gave it.
pub type Waiting = Deque<(Motion, Option<usize>), MAX_WAITING>;

impl<F: Flash> Cmd4cr<F> {
    /// Whether a motion of an axis waits for the input.
    pub fn is_waiting(&self, axis: usize) -> bool {
        self.waiting.iter().any(|(motion, _)| motion.axes() >> axis & 1 != 0)
    }

    /// A motion waits, unless an error would forbid it anyway.
    pub fn wait_for_start(&mut self, motion: Motion, program: Option<usize>) -> Result<(), Refusal> {
        for axis in axes_in(motion.axes()) {
            if self.joystick_on(axis) || self.pulser_on(axis) {
                return Err(Refusal::Moving);
            }
            self.may_set_out(axis, [false; 2])?;
        }
        self.waiting.push_back((motion, program)).map_err(|_| Refusal::BufferFull)
    }

    /// The input has come on: the first motion begins. One whose axes still move goes on waiting, one that
    /// an error forbids is dropped.
    pub fn external_start(&mut self, board: &mut dyn Board) {
        let Some(&(motion, program)) = self.waiting.front() else { return };
        if axes_in(motion.axes()).all(|axis| self.is_idle(axis)) {
            self.waiting.pop_front();
            if self.begin(&motion, program, board).is_err()
                && let Some(axis) = axes_in(motion.axes()).next()
            {
                self.stations[axis].program = program;
                self.program_error(axis);
            }
        }
    }

    /// Forgets the motions of an axis that wait.
    pub fn drop_waiting(&mut self, axis: usize) {
        for _ in 0..self.waiting.len() {
            let entry = self.waiting.pop_front().filter(|(motion, _)| motion.axes() >> axis & 1 == 0);
            if let Some(entry) = entry {
                assert!(self.waiting.push_back(entry).is_ok(), "it was there before");
            }
        }
    }

    /// Forgets all of them.
    pub fn drop_all_waiting(&mut self) {
        self.waiting.clear();
    }
}
