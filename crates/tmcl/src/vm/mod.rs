//! The virtual machine that executes a TMCL program.
//!
//! It has no clock and knows no device. [`Vm::run`] executes commands until its budget is used up or one
//! comes that is not its own business, and says which ([`Exit`]):
//!
//! - [`Exit::Host`]: the device executes the command, then calls [`Vm::complete`].
//! - [`Exit::Wait`]: the device computes when the `WAIT` times out and calls [`Vm::hold`]. While it holds,
//!   [`Vm::waiting`] says what for; the device calls [`Vm::wait_over`] when it happens.
//!
//! The program counter stands on the command until then. Between two commands, and during a `WAIT`, an
//! interrupt that [`Vm::raise`] has announced is taken.

mod calculate;
mod cell;
mod control;
mod direct;
mod interrupts;
mod registers;
mod run;
#[cfg(feature = "std")]
mod situation;

pub use control::AddressError;
pub use direct::Direct;
#[cfg(feature = "std")]
pub use situation::Situation;

use crate::isa::{Command, VARIABLES, WaitFor};
use cell::Cells;
use interrupts::Interrupts;
use protocol::tmcl::Status;
use registers::Registers;

/// How deep subroutines nest (manual 3.7.20).
pub const STACK_DEPTH: usize = 8;

/// Most breakpoints at a time.
pub const BREAKPOINTS: usize = 16;

type Variables = [i32; VARIABLES];

/// Program memory, registers and state of a program.
#[derive(Clone, Debug)]
pub struct Vm {
    memory: Cells,
    variables: Variables,
    registers: Registers,
    counter: u16,
    stack: heapless::Vec<u16, STACK_DEPTH>,
    interrupts: Interrupts,
    mode: Mode,
    /// In step mode, whether a command is still to be executed.
    step: bool,
    pending: Pending,
    breakpoints: heapless::Vec<u16, BREAKPOINTS>,
    /// Whether the next command is executed even if a breakpoint stands on it.
    past_breakpoint: bool,
    instructions: u64,
}

/// What the program is doing, with the numbers of global parameter 128.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Mode {
    /// It stands still.
    Stop = 0,
    /// It runs.
    Run = 1,
    /// It executes single commands.
    Step = 2,
    /// It stands still and was reset.
    Reset = 3,
}

/// What the command at the program counter waits for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Pending {
    Nothing,
    /// The device is to execute this command.
    Host(Command),
    /// The device is to say until when the `WAIT` holds.
    Wait(Wait),
    /// The `WAIT` holds.
    Hold(Hold),
}

/// What an interrupt saves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Context {
    registers: Registers,
    counter: u16,
    pending: Pending,
    /// How many subroutines it was in.
    depth: u8,
}

/// A `WAIT` that begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Wait {
    /// What for.
    pub event: WaitFor,
    /// The motor it concerns; as written, not checked.
    pub motor: u8,
    /// How long, in units of 10 ms. For [`WaitFor::Ticks`] this is the wait; for others, the time-out, and
    /// 0 means none.
    pub ticks: u32,
}

/// A `WAIT` under way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Hold {
    /// What for.
    pub event: WaitFor,
    /// The motor it concerns.
    pub motor: u8,
    /// The time the device gave to [`Vm::hold`].
    pub until: u64,
}

/// A command that a program could not execute and passed over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Fault {
    /// Where it stands.
    pub address: u16,
    /// The command.
    pub command: Command,
    /// What a host would have been told.
    pub status: Status,
}

/// Why a program ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stopped {
    /// By `STOP`.
    Stop,
    /// It came to an empty cell, or past the end of the memory.
    End,
    /// By a command that only a host may send.
    DirectOnly(Command),
}

/// Why [`Vm::run`] came back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Exit {
    /// All commands of the budget are executed.
    Budget,
    /// The device is to execute this command, then to call [`Vm::complete`].
    Host(Command),
    /// A `WAIT` begins: the device is to call [`Vm::hold`] or, if it is over already, [`Vm::wait_over`].
    Wait(Wait),
    /// A `WAIT` is under way, or goes on after an interrupt; [`Vm::waiting`] has it too.
    Waiting(Hold),
    /// A command was passed over; the program goes on.
    Skipped(Fault),
    /// The next command has a breakpoint. The program has stopped; [`Vm::start`] goes on.
    Breakpoint,
    /// The program has ended.
    Stopped(Stopped),
    /// The program stands still: it was not started, or its single step is done.
    Idle,
}

/// How the device got on with the command of [`Exit::Host`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Outcome {
    /// It is done.
    Done,
    /// It has read this value: the accumulator takes it, and the flags its comparison with 0.
    Value(i32),
    /// It could not be executed; nothing happens.
    Skipped,
}

impl Default for Vm {
    fn default() -> Self {
        Self::new()
    }
}

impl Vm {
    /// One with empty memory and all variables 0, standing still.
    pub const fn new() -> Self {
        Self {
            memory: Cells::new(),
            variables: [0; VARIABLES],
            registers: Registers::RESET,
            counter: 0,
            stack: heapless::Vec::new(),
            interrupts: Interrupts::new(),
            mode: Mode::Stop,
            step: false,
            pending: Pending::Nothing,
            breakpoints: heapless::Vec::new(),
            past_breakpoint: false,
            instructions: 0,
        }
    }

    /// As new, where it is.
    pub fn power_on(&mut self) {
        let Self {
            memory,
            variables,
            registers,
            counter,
            stack,
            interrupts,
            mode,
            step,
            pending,
            breakpoints,
            past_breakpoint,
            instructions,
        } = self;
        memory.clear();
        variables.fill(0);
        (*registers, *counter, *interrupts) = (Registers::RESET, 0, Interrupts::new());
        (*mode, *step, *pending) = (Mode::Stop, false, Pending::Nothing);
        stack.clear();
        breakpoints.clear();
        (*past_breakpoint, *instructions) = (false, 0);
    }

    /// The accumulator, which `AAP`, `MVPA`, `ROLA` and others take their value from.
    pub const fn accumulator(&self) -> i32 {
        self.registers.accumulator
    }

    /// The X register.
    pub const fn x(&self) -> i32 {
        self.registers.x
    }

    /// Sets the accumulator, as nobody but a debugger can.
    pub const fn set_accumulator(&mut self, value: i32) {
        self.registers.accumulator = value;
    }

    /// Sets the X register.
    pub const fn set_x(&mut self, value: i32) {
        self.registers.x = value;
    }

    /// The address of the command that is executed next, or now.
    pub const fn counter(&self) -> u16 {
        self.counter
    }

    /// What the program is doing.
    pub const fn mode(&self) -> Mode {
        self.mode
    }

    /// Whether a condition holds for `JC`.
    pub const fn condition(&self, condition: crate::isa::Condition) -> bool {
        self.registers.flags.holds(condition as u8)
    }

    /// Whether an interrupt handler is running.
    pub const fn in_handler(&self) -> bool {
        self.interrupts.in_handler()
    }

    /// The return addresses of the subroutines, innermost last.
    pub fn stack(&self) -> &[u16] {
        &self.stack
    }

    /// Whether an interrupt is taken before the next command.
    pub const fn is_interrupted(&self) -> bool {
        self.interrupts.is_due() && !matches!(self.pending, Pending::Host(_))
    }

    /// Where the program is: the address of the command that is executed next or now, and the one from which
    /// each routine that it is in was called or interrupted, innermost first.
    pub fn frames(&self) -> impl Iterator<Item = u16> {
        let vector = self.is_interrupted().then(|| self.interrupts.vector());
        let (interrupted, depth) = match self.interrupts.saved() {
            Some(context) => (Some(context.counter), usize::from(context.depth).min(self.stack.len())),
            None => (None, 0),
        };
        let (outer, inner) = self.stack.split_at(depth);
        vector
            .into_iter()
            .chain([self.counter])
            .chain(inner.iter().rev().map(|address| address - 1))
            .chain(interrupted)
            .chain(outer.iter().rev().map(|address| address - 1))
    }

    /// Commands executed since power-up, in programs.
    pub const fn instructions(&self) -> u64 {
        self.instructions
    }

    /// A user variable.
    pub const fn variable(&self, index: u8) -> i32 {
        self.variables[index as usize]
    }

    /// Sets a user variable.
    pub const fn set_variable(&mut self, index: u8, value: i32) {
        self.variables[index as usize] = value;
    }

    /// The `WAIT` under way, if there is one.
    pub const fn waiting(&self) -> Option<Hold> {
        match self.pending {
            Pending::Hold(hold) => Some(hold),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests;
