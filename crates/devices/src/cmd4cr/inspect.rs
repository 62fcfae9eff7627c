//! What a debugger sees.

extern crate alloc;

use super::Cmd4cr;
use super::table::{AXES, COMMANDS};
use crate::ascii::inspect::{quantities, reader};
use crate::board::Board;
use crate::flash::Flash;
use crate::gate::Gate;
use crate::inspect::{Inspect, Quantity};
use ::motion::Ticks;
use alloc::vec::Vec;
use protocol::performax::Reply;

impl<F: Flash> Inspect for Cmd4cr<F> {
    fn gate(&mut self) -> &mut Gate {
        &mut self.programs.gate
    }

    fn next_program(&self) -> Option<(Ticks, usize)> {
        self.programs.next(self.now)
    }

    fn address(&self, program: usize) -> Option<u16> {
        self.programs.frames(program)?.next()
    }

    fn frames(&self, program: usize) -> Vec<u16> {
        self.programs.frames(program).into_iter().flatten().collect()
    }

    fn value(&self, name: &str, board: &mut dyn Board) -> Option<f64> {
        let line = reader(COMMANDS, AXES, name)?;
        let mut reply = Reply::new();
        self.ask(&line, &mut reply, board);
        reply.as_str().parse().ok()
    }

    fn quantities(&self) -> Vec<Quantity> {
        quantities(COMMANDS, AXES)
    }
}
