//! Commands that a host sends and the program's own state answers.

use super::calculate::{Effect, calculate, indexed};
use super::{Vm, control};
use crate::isa::{Command, Mode, VARIABLE_BANK, available, opcode};
use protocol::tmcl::Status;

/// What became of a command that a host has sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direct {
    /// It is done; the reply carries this value.
    Done(i32),
    /// It is refused with this status.
    Refused(Status),
    /// It is the device's to execute.
    Device,
}

impl Vm {
    /// Executes a command that a host has sent, if it concerns registers, flags, user variables or
    /// interrupts. It acts on the registers that the program uses, but what it reads goes into the reply
    /// only. Commands that cannot be sent are refused.
    pub fn direct(&mut self, command: Command) -> Direct {
        if let Err(status) = available(command.opcode, Mode::Direct) {
            return Direct::Refused(status);
        }
        let done = match command.opcode {
            opcode::GGP if command.motor == VARIABLE_BANK => {
                return Direct::Done(self.variable(command.kind));
            }
            opcode::GIV => {
                let value = indexed(self.registers.x).map(|index| self.variable(index));
                return Direct::Done(value.unwrap_or(command.value));
            }
            opcode::EI | opcode::DI => self.interrupts.enable(command.kind, command.opcode == opcode::EI),
            opcode::VECT => match control::address(command.value) {
                Ok(address) => self.interrupts.set_vector(command.kind, address),
                Err(error) => return Direct::Refused(error.into()),
            },
            _ => match calculate(command, &mut self.registers, &mut self.variables) {
                Effect::Done => true,
                Effect::Failed(status) => return Direct::Refused(status),
                Effect::Other => return Direct::Device,
            },
        };
        if done { Direct::Done(command.value) } else { Direct::Refused(Status::WRONG_TYPE) }
    }
}
