//! The loop that executes a program.

use super::calculate::{Effect, calculate, read};
use super::{Context, Exit, Fault, Mode, Pending, Stopped, Vm, Wait, control};
use crate::isa::{self, Command, Condition, WaitFor, opcode};
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
            let Some(&command) = self.memory.get(usize::from(self.counter)) else {
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

    /// Executes the command at the program counter.
    #[inline(always)]
    fn execute(&mut self, command: Command) -> Next {
        let Command { opcode, kind, value, .. } = command;
        match opcode {
            opcode::JA => jump(value),
            opcode::JC if kind < CONDITIONS => {
                if self.registers.flags.holds(kind) {
                    jump(value)
                } else {
                    Next::Following
                }
            }
            opcode::DJNZ => {
                let variable = &mut self.variables[usize::from(kind)];
                *variable = variable.wrapping_sub(1);
                if *variable != 0 { jump(value) } else { Next::Following }
            }
            opcode::CSUB => self.call(value),
            opcode::CALL if kind < CONDITIONS => {
                if self.registers.flags.holds(kind) {
                    self.call(value)
                } else {
                    Next::Following
                }
            }
            opcode::JC | opcode::CALL => Next::Failed(Status::WRONG_TYPE),
            opcode::RSUB => self.stack.pop().map_or(Next::Following, Next::Jump),
            _ => match calculate(command, &mut self.registers, &mut self.variables) {
                Effect::Done => Next::Following,
                Effect::Failed(status) => Next::Failed(status),
                Effect::Other => match read(command, &self.registers, &self.variables) {
                    Some(value) => {
                        if let Some(value) = value {
                            self.registers.read(value);
                        }
                        Next::Following
                    }
                    None => self.execute_rare(command),
                },
            },
        }
    }

    /// Commands that a loop seldom meets, and those for the device.
    #[inline(never)]
    fn execute_rare(&mut self, command: Command) -> Next {
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
                Some(Context { registers, counter, pending }) => {
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
            // Only an empty cell: any other command 0 is an unknown command.
            _ if command == Command::EMPTY => {
                self.stop();
                Next::Leave(Exit::Stopped(Stopped::End))
            }
            _ => match isa::available(opcode, isa::Mode::Program) {
                Ok(_) => {
                    self.pending = Pending::Host(command);
                    Next::Leave(Exit::Host(command))
                }
                Err(_) if isa::available(opcode, isa::Mode::Direct).is_ok() => {
                    self.stop();
                    Next::Leave(Exit::Stopped(Stopped::DirectOnly(command)))
                }
                Err(status) => Next::Failed(status),
            },
        }
    }

    /// What a `WAIT` waits for.
    fn wait(&self, command: Command) -> Result<Wait, Status> {
        let event = WaitFor::from_number(command.kind).ok_or(Status::WRONG_TYPE)?;
        let ticks = if command.value == -1 { self.registers.accumulator } else { command.value };
        let ticks = u32::try_from(ticks).map_err(|_| Status::INVALID_VALUE)?;
        Ok(Wait { event, motor: command.motor, ticks })
    }

    /// A call with a full stack does nothing.
    #[inline(always)]
    fn call(&mut self, value: i32) -> Next {
        match control::address(value) {
            Ok(address) if self.stack.push(self.counter + 1).is_ok() => Next::Jump(address),
            Ok(_) => Next::Following,
            Err(error) => Next::Failed(error.into()),
        }
    }

    #[cold]
    fn interrupt(&mut self) {
        let context = Context { registers: self.registers, counter: self.counter, pending: self.pending };
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

#[inline(always)]
fn jump(value: i32) -> Next {
    match control::address(value) {
        Ok(address) => Next::Jump(address),
        Err(error) => Next::Failed(error.into()),
    }
}
