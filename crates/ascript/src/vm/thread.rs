//! A thread: where it is, and how it is started, stopped and sent to the error subroutine.

use super::{CALL_DEPTH, Exit, Memory, State};
use crate::isa::ERROR_SUBROUTINE;
use crate::line::TEMPORARIES;

/// Return addresses of a program, and those of its error subroutine.
const STACK: usize = 2 * CALL_DEPTH;

/// A program, or a subroutine by itself, that is executed.
#[derive(Clone, Debug, Default)]
pub struct Thread {
    pub(super) state: State,
    pub(super) counter: u16,
    /// Where it was started.
    pub(super) start: u16,
    pub(super) stack: heapless::Vec<u16, STACK>,
    pub(super) temporaries: [i32; TEMPORARIES],
    pub(super) handler: Option<Handler>,
    /// What the device has been asked for.
    pub(super) pending: Option<Exit>,
    /// What it has read for the line at the counter.
    pub(super) fetched: Option<i32>,
    pub(super) instructions: u64,
}

/// An error subroutine that runs: what to go back to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Handler {
    /// The line to go on with; none if the program ends then.
    counter: Option<u16>,
    /// How many return addresses are those of the program.
    depth: usize,
    temporaries: [i32; TEMPORARIES],
}

impl Thread {
    /// One that is idle.
    pub const fn new() -> Self {
        Self {
            state: State::Idle,
            counter: 0,
            start: 0,
            stack: heapless::Vec::new(),
            temporaries: [0; TEMPORARIES],
            handler: None,
            pending: None,
            fetched: None,
            instructions: 0,
        }
    }

    /// Starts over at a line, which [`Memory::program`] or [`Memory::subroutine`] has found.
    pub fn start(&mut self, line: u16) {
        let instructions = self.instructions;
        *self = Self { state: State::Running, counter: line, start: line, instructions, ..Self::new() };
    }

    /// Starts a subroutine by itself. Returns whether there is such a subroutine; if not, nothing changes.
    pub fn start_sub<const LINES: usize, const VARIABLES: usize>(
        &mut self,
        memory: &Memory<LINES, VARIABLES>,
        number: u8,
    ) -> bool {
        memory.subroutine(number).map(|line| self.start(line)).is_some()
    }

    /// Stops the program for good. The counter stays where it is.
    pub fn stop(&mut self) {
        self.end(State::Idle);
    }

    /// Stops the program for good, if its error subroutine runs where that ends.
    pub fn stop_itself(&mut self) {
        match &mut self.handler {
            Some(handler) => handler.counter = None,
            None => self.stop(),
        }
    }

    fn end(&mut self, state: State) {
        self.state = state;
        self.stack.clear();
        self.handler = None;
        self.pending = None;
        self.fetched = None;
    }

    /// Holds the program until [`resume`](Self::resume), if it runs. What the device is doing for it goes on.
    pub fn pause(&mut self) {
        if self.state == State::Running {
            self.state = State::Paused;
        }
    }

    /// Goes on with a paused program.
    pub fn resume(&mut self) {
        if self.state == State::Paused {
            self.state = State::Running;
        }
    }

    /// What it is doing.
    pub const fn state(&self) -> State {
        self.state
    }

    /// The line that is executed next, or now.
    pub const fn counter(&self) -> u16 {
        self.counter
    }

    /// Lines executed since power-up.
    pub const fn instructions(&self) -> u64 {
        self.instructions
    }

    /// Lines were executed that nobody has seen: rounds that change nothing.
    pub const fn count(&mut self, instructions: u64) {
        self.instructions += instructions;
    }

    /// How many subroutines it is in, the error subroutine not counted.
    pub fn depth(&self) -> usize {
        self.stack.len()
    }

    /// Where it is: the line that is executed next or now, and the one from which each subroutine that it is in
    /// was called, innermost first. The error subroutine was called from where it goes back to.
    pub fn frames(&self) -> impl Iterator<Item = u16> {
        let depth = self.handler.map_or(0, |handler| handler.depth).min(self.stack.len());
        let (outer, inner) = self.stack.split_at(depth);
        let interrupted = self.handler.and_then(|handler| handler.counter);
        [self.counter]
            .into_iter()
            .chain(inner.iter().rev().map(|line| line - 1))
            .chain(interrupted)
            .chain(outer.iter().rev().map(|line| line - 1))
    }

    /// Whether the error subroutine runs.
    pub const fn in_error_subroutine(&self) -> bool {
        self.handler.is_some()
    }

    /// What the device is to do, or is doing, before the thread goes on.
    pub const fn pending(&self) -> Option<Exit> {
        self.pending
    }

    /// Whether another call finds room on the stack.
    pub(super) fn can_call(&self) -> bool {
        let base = self.handler.map_or(0, |handler| handler.depth);
        self.stack.len() - base < CALL_DEPTH
    }

    /// The device has read the register of [`Exit::Read`]. Without one nothing happens: the program may
    /// have been stopped meanwhile.
    pub fn complete(&mut self, value: i32) {
        if matches!(self.pending, Some(Exit::Read(_))) {
            self.pending = None;
            self.fetched = Some(value);
        }
    }

    /// The device has done what [`Exit::Write`] or [`Exit::Do`] asked for. Without one nothing happens.
    pub fn done(&mut self) {
        if matches!(self.pending, Some(Exit::Write(..) | Exit::Do(_))) {
            self.pending = None;
            self.counter += 1;
        }
    }

    /// An error has come (PMX manual 7.19.5, CMD manual 2.7.5): goes to the error subroutine, from which it
    /// comes back to the line that was executed or, if it is to `restart`, to where it was started. Without
    /// such a subroutine, or when it runs already, the program ends in [`State::Error`] and the result is
    /// `false`. A program that neither runs nor is paused has no errors.
    pub fn fail<const LINES: usize, const VARIABLES: usize>(
        &mut self,
        memory: &Memory<LINES, VARIABLES>,
        restart: bool,
    ) -> bool {
        if !matches!(self.state, State::Running | State::Paused) {
            return false;
        }
        let subroutine = memory.subroutine(ERROR_SUBROUTINE);
        let (None, Some(line)) = (self.handler, subroutine) else {
            self.end(State::Error);
            return false;
        };
        if restart {
            self.stack.clear();
        }
        let counter = if restart { self.start } else { self.counter };
        self.handler =
            Some(Handler { counter: Some(counter), depth: self.stack.len(), temporaries: self.temporaries });
        self.counter = line;
        self.pending = None;
        self.fetched = None;
        true
    }

    /// Comes back from a subroutine; `false` if there is nothing to come back to.
    pub(super) fn return_from_subroutine(&mut self) -> bool {
        if let Some(handler) = self.handler.filter(|handler| handler.depth == self.stack.len()) {
            self.handler = None;
            self.temporaries = handler.temporaries;
            return handler.counter.map(|line| self.counter = line).is_some();
        }
        self.stack.pop().map(|line| self.counter = line).is_some()
    }
}
