//! The virtual machine that executes A-SCRIPT programs.
//!
//! It has no clock and knows no device. Threads share a [`Memory`] of lines and variables. [`Thread::run`]
//! executes lines until its budget is used up or one comes that is not its own business, and says which
//! ([`Exit`]):
//!
//! - [`Exit::Read`]: the device reads a register, then calls [`Thread::complete`].
//! - [`Exit::Write`] and [`Exit::Do`]: the device does it, for as long as it takes, then calls
//!   [`Thread::done`].
//! - [`Exit::Fault`]: the line cannot be executed; the device calls [`Thread::fail`], as it does for errors
//!   of its own.
//!
//! The counter stands on the line until then. Everything else, which is variables, conditions, loops and
//! calls, never leaves the machine.

mod memory;
mod run;
#[cfg(feature = "std")]
mod situation;
mod thread;

pub use memory::Memory;
#[cfg(feature = "std")]
pub use situation::Situation;
pub use thread::Thread;

use crate::isa::{AXES, Direction, Place, Word};
use crate::line::OPERANDS;

/// How deep subroutines nest. The error subroutine may nest them as deep again.
pub const CALL_DEPTH: usize = 8;

/// What a thread is doing, with the numbers of `SASTAT` (PMX manual 7.19.3, CMD manual 2.7.9).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum State {
    /// It was not started, was stopped, or has ended.
    #[default]
    Idle = 0,
    /// It runs.
    Running = 1,
    /// It is to go on later.
    Paused = 2,
    /// An error has ended it.
    Error = 4,
}

/// Why a line cannot be executed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Fault {
    /// `V/0` or `V%0`.
    DivisionByZero,
    /// Subroutines nest deeper than [`CALL_DEPTH`].
    CallDepth,
    /// There is no such subroutine.
    NoSubroutine(u8),
    /// The program has no end: it came to memory without a line.
    NoLine,
    /// The memory has fewer variables than the line needs.
    NoVariable,
}

/// Why [`Thread::run`] came back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Exit {
    /// All lines of the budget are executed.
    Budget,
    /// The thread does not run.
    Idle,
    /// The program has ended: `END`, or `ENDSUB` of a subroutine that was started by itself.
    Stopped,
    /// The device is to read this register and call [`Thread::complete`].
    Read(Place),
    /// The device is to write this register and call [`Thread::done`].
    Write(Place, i32),
    /// The device is to do this and call [`Thread::done`] when it is done: for a wait, when it is over.
    Do(Action),
    /// The line at the counter cannot be executed; the device calls [`Thread::fail`].
    Fault(Fault),
}

/// A statement for the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Action {
    /// What it is.
    pub word: Word,
    /// The number behind the word, which only [`Word::Sr`] has.
    pub index: u8,
    /// The axis, if it is about one; the first one of a plane.
    pub axis: Option<u8>,
    /// The second axis of a plane.
    pub second_axis: Option<u8>,
    /// The direction, if it has one; for arcs and circles plus is clockwise.
    pub direction: Option<Direction>,
    /// Targets by axis, of moves.
    pub targets: [Option<i32>; AXES],
    /// What else it was given, then zeros: the value behind `=` (that of [`Word::Delay`] is unsigned), the
    /// homing mode, or the numbers of a circle or an arc in their order.
    pub arguments: [i32; OPERANDS],
}

impl Action {
    /// The statement, with the values of its operands; `None` where it has none.
    pub fn new(place: Place, values: [Option<i32>; OPERANDS]) -> Self {
        let Place { word, index } = place;
        let mut action = Self {
            word,
            index: if word == Word::Sr { index } else { 0 },
            axis: place.axis(),
            second_axis: place.second_axis(),
            direction: place.direction(),
            targets: [None; AXES],
            arguments: [0; OPERANDS],
        };
        match (word, action.axis) {
            (Word::Linear, _) => action.targets = values,
            (Word::X | Word::Y | Word::Z | Word::U, Some(axis)) => {
                action.targets[usize::from(axis)] = values[0];
            }
            _ => action.arguments = values.map(Option::unwrap_or_default),
        }
        action
    }
}

#[cfg(test)]
mod tests;
