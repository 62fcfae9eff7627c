//! Program memory, and what the control commands 128 to 131 do.

use super::cell::Cell;
use super::{Hold, Mode, Outcome, Pending, Vm, Wait};
use crate::isa::{Command, Condition, PROGRAM_LENGTH};
use core::fmt;
use protocol::tmcl::Status;

/// An address is outside the program memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct AddressError;

impl fmt::Display for AddressError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the program memory has {PROGRAM_LENGTH} commands")
    }
}

impl core::error::Error for AddressError {}

impl From<AddressError> for Status {
    fn from(_: AddressError) -> Self {
        Self::INVALID_VALUE
    }
}

/// A value as an address of the program memory.
#[inline(always)]
pub(super) fn address(value: i32) -> Result<u16, AddressError> {
    if (0..PROGRAM_LENGTH as i32).contains(&value) { Ok(value as u16) } else { Err(AddressError) }
}

impl Vm {
    /// The content of the program memory.
    pub fn program(&self) -> impl ExactSizeIterator<Item = Command> {
        (0..PROGRAM_LENGTH).map(|address| self.cell(address).command())
    }

    /// A cell of it; `None` if the memory has none there.
    pub fn command(&self, address: usize) -> Option<Command> {
        (address < PROGRAM_LENGTH).then(|| self.cell(address).command())
    }

    fn cell(&self, address: usize) -> Cell {
        self.memory.get(address).copied().unwrap_or(Cell::EMPTY)
    }

    /// Writes a cell of the program memory.
    pub fn store(&mut self, address: usize, command: Command) -> Result<(), AddressError> {
        if address >= PROGRAM_LENGTH {
            return Err(AddressError);
        }
        self.memory.set(address, Cell::new(command));
        Ok(())
    }

    /// Writes a program from address 0 and empties the rest of the memory.
    pub fn load(&mut self, program: &[Command]) -> Result<(), AddressError> {
        if program.len() > PROGRAM_LENGTH {
            return Err(AddressError);
        }
        self.erase();
        for (address, &command) in program.iter().enumerate() {
            self.memory.set(address, Cell::new(command));
        }
        Ok(())
    }

    /// Empties the program memory.
    pub fn erase(&mut self) {
        self.memory.clear();
    }

    /// Command 129: runs the program from `address`, with empty stacks, or from where it stands. A
    /// running one goes on, or jumps. A `WAIT` at which it was stopped begins anew.
    pub fn start(&mut self, address: Option<i32>) -> Result<(), AddressError> {
        if let Some(value) = address {
            self.counter = self::address(value)?;
            self.stack.clear();
            self.interrupts.reset();
            self.pending = Pending::Nothing;
        }
        self.mode = Mode::Run;
        self.past_breakpoint = true;
        Ok(())
    }

    /// Command 128: stops the program where it stands.
    pub fn stop(&mut self) {
        self.mode = Mode::Stop;
        self.pending = Pending::Nothing;
        self.step = false;
    }

    /// Command 130: has the next call of [`run`](Self::run) execute a single command. A running program
    /// stops after it.
    pub fn step(&mut self) {
        self.mode = Mode::Step;
        self.step = true;
        self.past_breakpoint = true;
    }

    /// Command 131: stops the program and clears program counter, stack, accumulator, X register and
    /// flags. Variables stay, as do interrupt vectors and enables.
    pub fn reset(&mut self) {
        self.stop();
        self.mode = Mode::Reset;
        self.restart(0);
    }

    /// What `RST` and a reset have in common.
    pub(super) fn restart(&mut self, address: u16) {
        self.counter = address;
        self.registers = super::Registers::RESET;
        self.stack.clear();
        self.interrupts.reset();
    }

    /// Whether the program runs or single-steps.
    pub const fn is_active(&self) -> bool {
        matches!(self.mode, Mode::Run) || self.step
    }

    /// An interrupt of this number happens. It counts only while the program runs, and if it is enabled
    /// and has a vector.
    pub fn raise(&mut self, number: u8) {
        if matches!(self.mode, Mode::Run | Mode::Step) {
            self.interrupts.raise(number);
        }
    }

    /// Sets an error flag (`ETO`, `EAL`, `EDV`, `EPO`, `ESD`); other conditions cannot be set.
    pub fn set_error(&mut self, condition: Condition) {
        self.registers.flags.raise(condition);
    }

    /// The device has executed the command of [`Exit::Host`](super::Exit::Host), or cannot begin the
    /// `WAIT` of [`Exit::Wait`](super::Exit::Wait). If nothing is to be completed (the program was stopped
    /// meanwhile) nothing happens.
    pub fn complete(&mut self, outcome: Outcome) {
        if !matches!(self.pending, Pending::Host(_) | Pending::Wait(_)) {
            return;
        }
        if let Outcome::Value(value) = outcome {
            self.registers.read(value);
        }
        self.advance();
    }

    /// The `WAIT` of [`Exit::Wait`](super::Exit::Wait) holds until something happens, or until a time in
    /// any unit the device likes; it is only kept for [`waiting`](Self::waiting).
    pub fn hold(&mut self, until: u64) {
        if let Pending::Wait(Wait { event, motor, .. }) = self.pending {
            self.pending = Pending::Hold(Hold { event, motor, until });
        }
    }

    /// The `WAIT` is over: what it waited for has happened, or (`timed_out`, which sets `ETO`) has not in
    /// time. A wait for ticks never times out. If none is under way nothing happens.
    pub fn wait_over(&mut self, timed_out: bool) {
        if !matches!(self.pending, Pending::Wait(_) | Pending::Hold(_)) {
            return;
        }
        if timed_out {
            self.registers.flags.raise(Condition::Timeout);
        }
        self.advance();
    }

    /// Goes on to the next command after one that took the device's help.
    fn advance(&mut self) {
        self.pending = Pending::Nothing;
        self.counter += 1;
        self.instructions += 1;
        self.step = false;
        self.past_breakpoint = false;
    }

    /// Sets the addresses at which a running program stops; none removes them.
    pub fn set_breakpoints(&mut self, addresses: &[u16]) -> Result<(), BreakpointError> {
        self.breakpoints = heapless::Vec::from_slice(addresses).map_err(|_| BreakpointError)?;
        Ok(())
    }
}

/// More breakpoints than [`BREAKPOINTS`](super::BREAKPOINTS).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BreakpointError;

impl fmt::Display for BreakpointError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "at most {} breakpoints", super::BREAKPOINTS)
    }
}

impl core::error::Error for BreakpointError {}
