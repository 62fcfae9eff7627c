//! The loop that executes a program.

use super::calculate::{Effect, calculate, indexed};
use super::{Context, Exit, Fault, Mode, Pending, Stopped, Vm, Wait, control};
use crate::isa::{self, Command, Condition, VARIABLE_BANK, WaitFor, opcode};
use protocol::tmcl::Status;

/// Conditions are numbered from 0.
const CONDITIONS: u8 = Condition::KEYWORDS.len() as u8;

/// What a command leaves to the loop.
enum Next {
    /// Go on with the command behind it.
    Following,
    /// Go on there.
    Jump(u16),
    /// It failed; go on with the command behind it.
    Failed(Status),
    /// It is not done: leave, with the program counter on it.
    Leave(Exit),
}

impl Vm {
    /// Executes at most `budget` commands, and tells how many it executed and why it came back. The
    /// command of [`Exit::Host`] and [`Exit::Wait`] is not among them yet.
    pub fn run(&mut self, budget: u32) -> (u32, Exit) {
        let budget = match self.mode {
            Mode::Run => budget,
            Mode::Step if self.step => budget.min(1),
            _ => return (0, Exit::Idle),
        };
        let mut executed = 0;
        let exit = loop {
            if executed == budget {
                break Exit::Budget;
            }
            if self.interrupts.is_due() && !matches!(self.pending, Pending::Host(_)) {
                self.interrupt();
            }
            match self.pending {
                Pending::Nothing => (),
                Pending::Host(command) => break Exit::Host(command),
                Pending::Wait(wait) => break Exit::Wait(wait),
                Pending::Hold(hold) => break Exit::Waiting(hold),
            }
            if !self.breakpoints.is_empty() && self.at_breakpoint() {
                break Exit::Breakpoint;
            }
            // Nothing in a burst can make an interrupt due, so one look at them before it is enough.
            let limit = if self.breakpoints.is_empty() { budget - executed } else { 1 };
            let burst = self.burst(limit);
            executed += burst;
            if burst == limit {
                continue;
            }
            let Some(command) = self.command(self.counter.into()) else {
                self.stop();
                break Exit::Stopped(Stopped::End);
            };
            let next = self.execute(command);
            if let Next::Leave(exit) = next {
                executed += u32::from(exit == Exit::Stopped(Stopped::Stop));
                break exit;
            }
            executed += 1;
            let address = self.counter;
            match next {
                Next::Jump(target) => self.counter = target,
                _ => self.counter += 1,
            }
            if let Next::Failed(status) = next {
                break Exit::Skipped(Fault { address, command, status });
            }
        };
        self.instructions += u64::from(executed);
        if executed > 0 {
            self.step = false;
            self.past_breakpoint = false;
        }
        (executed, exit)
    }

    /// Executes at most `limit` commands that calculate and jump, with the registers in local variables;
    /// ends at the first command of another kind, or one that fails. This is the hot loop.
    fn burst(&mut self, limit: u32) -> u32 {
        let Self { memory, variables, stack, .. } = self;
        let mut registers = self.registers;
        let mut counter = usize::from(self.counter);
        let mut left = limit;
        while left > 0 {
            let Some(cell) = memory.get(counter) else { break };
            let command = cell.command();
            let Command { opcode, kind, motor, value } = command;
            let mut next = counter + 1;
            match opcode {
                opcode::JC if kind < CONDITIONS => {
                    if registers.flags.holds(kind) {
                        let Ok(address) = control::address(value) else { break };
                        next = usize::from(address);
                    }
                }
                opcode::JA => {
                    let Ok(address) = control::address(value) else { break };
                    next = usize::from(address);
                }
                opcode::DJNZ => {
                    let Ok(address) = control::address(value) else { break };
                    let variable = &mut variables[usize::from(kind)];
                    *variable = variable.wrapping_sub(1);
                    if *variable != 0 {
                        next = usize::from(address);
                    }
                }
                // A call with a full stack does nothing.
                opcode::CSUB => {
                    let Ok(address) = control::address(value) else { break };
                    if stack.push(next as u16).is_ok() {
                        next = usize::from(address);
                    }
                }
                opcode::CALL if kind < CONDITIONS => {
                    if registers.flags.holds(kind) {
                        let Ok(address) = control::address(value) else { break };
                        if stack.push(next as u16).is_ok() {
                            next = usize::from(address);
                        }
                    }
                }
                opcode::RSUB => {
                    if let Some(address) = stack.pop() {
                        next = usize::from(address);
                    }
                }
                opcode::GGP if motor == VARIABLE_BANK => registers.read(variables[usize::from(kind)]),
                opcode::GIV => {
                    if let Some(value) = indexed(registers.x).map(|index| variables[usize::from(index)]) {
                        registers.read(value);
                    }
                }
                _ => {
                    if calculate(command, &mut registers, variables) != Effect::Done {
                        break;
                    }
                }
            }
            counter = next;
            left -= 1;
        }
        self.registers = registers;
        self.counter = counter as u16;
        limit - left
    }

    /// Executes the command at the program counter, which no [`burst`](Self::burst) would: it fails, or
    /// it concerns more than registers and variables.
    #[inline(never)]
    fn execute(&mut self, command: Command) -> Next {
        let Command { opcode, kind, value, .. } = command;
        match opcode {
            opcode::EI | opcode::DI => {
                if self.interrupts.enable(kind, opcode == opcode::EI) {
                    Next::Following
                } else {
                    Next::Failed(Status::WRONG_TYPE)
                }
            }
            opcode::VECT => match control::address(value) {
                Ok(address) if self.interrupts.set_vector(kind, address) => Next::Following,
                Ok(_) => Next::Failed(Status::WRONG_TYPE),
                Err(error) => Next::Failed(error.into()),
            },
            opcode::RETI => match self.interrupts.leave() {
                Some(Context { registers, counter, pending, .. }) => {
                    let flags = registers.flags.with_errors_of(self.registers.flags);
                    self.registers = super::Registers { flags, ..registers };
                    self.pending = pending;
                    Next::Jump(counter)
                }
                None => Next::Following,
            },
            opcode::RST => match control::address(value) {
                Ok(address) => {
                    self.restart(address);
                    Next::Jump(address)
                }
                Err(error) => Next::Failed(error.into()),
            },
            opcode::STOP => {
                self.stop();
                Next::Leave(Exit::Stopped(Stopped::Stop))
            }
            opcode::WAIT => match self.wait(command) {
                Ok(wait) => {
                    self.pending = Pending::Wait(wait);
                    Next::Leave(Exit::Wait(wait))
                }
                Err(status) => Next::Failed(status),
            },
            opcode::JC | opcode::CALL if kind >= CONDITIONS => Next::Failed(Status::WRONG_TYPE),
            opcode::JC | opcode::JA | opcode::DJNZ | opcode::CSUB | opcode::CALL => {
                Next::Failed(control::AddressError.into())
            }
            // Only an empty cell: any other command 0 is an unknown command.
            _ if command == Command::EMPTY => {
                self.stop();
                Next::Leave(Exit::Stopped(Stopped::End))
            }
            _ => match calculate(command, &mut self.registers, &mut self.variables) {
                Effect::Done => Next::Following,
                Effect::Failed(status) => Next::Failed(status),
                Effect::Other => self.delegate(command),
            },
        }
    }

    /// Hands a command to the device, if a program may contain it.
    fn delegate(&mut self, command: Command) -> Next {
        match isa::available(command.opcode, isa::Mode::Program) {
            Ok(_) => {
                self.pending = Pending::Host(command);
                Next::Leave(Exit::Host(command))
            }
            Err(_) if isa::available(command.opcode, isa::Mode::Direct).is_ok() => {
                self.stop();
                Next::Leave(Exit::Stopped(Stopped::DirectOnly(command)))
            }
            Err(status) => Next::Failed(status),
        }
    }

    /// What a `WAIT` waits for.
    fn wait(&self, command: Command) -> Result<Wait, Status> {
        let event = WaitFor::from_number(command.kind).ok_or(Status::WRONG_TYPE)?;
        let ticks = if command.value == -1 { self.registers.accumulator } else { command.value };
        let ticks = u32::try_from(ticks).map_err(|_| Status::INVALID_VALUE)?;
        Ok(Wait { event, motor: command.motor, ticks })
    }

    #[cold]
    fn interrupt(&mut self) {
        let context = Context {
            registers: self.registers,
            counter: self.counter,
            pending: self.pending,
            depth: self.stack.len() as u8,
        };
        self.pending = Pending::Nothing;
        self.counter = self.interrupts.enter(context);
    }

    /// Whether the program is to stop before this command.
    #[cold]
    fn at_breakpoint(&mut self) -> bool {
        if core::mem::take(&mut self.past_breakpoint) || !self.breakpoints.contains(&self.counter) {
            return false;
        }
        self.stop();
        true
    }
}
