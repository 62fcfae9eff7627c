//! The commands that concern nothing but registers and user variables. A program and a host execute them
//! alike.

use super::Variables;
use super::registers::{Flags, Registers};
use crate::isa::{Command, Flag, Operation, VARIABLE_BANK, opcode};
use protocol::tmcl::Status;

/// What became of a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Effect {
    /// It is done.
    Done,
    /// It failed and changed nothing.
    Failed(Status),
    /// It is none of these commands.
    Other,
}

const ADD: u8 = Operation::Add as u8;
const SUB: u8 = Operation::Sub as u8;
const MUL: u8 = Operation::Mul as u8;
const DIV: u8 = Operation::Div as u8;
const MOD: u8 = Operation::Mod as u8;
const AND: u8 = Operation::And as u8;
const OR: u8 = Operation::Or as u8;
const XOR: u8 = Operation::Xor as u8;
const NOT: u8 = Operation::Not as u8;
const LOAD: u8 = Operation::Load as u8;
const SWAP: u8 = Operation::Swap as u8;
const COMP: u8 = Operation::Comp as u8;

/// Applies an operation, other than `SWAP`, to `target`. `None` if there is no such operation.
#[inline(always)]
fn operate(operation: u8, target: i32, operand: i32, flags: &mut Flags) -> Option<i32> {
    let result = match operation {
        ADD => target.wrapping_add(operand),
        SUB => target.wrapping_sub(operand),
        MUL => target.wrapping_mul(operand),
        DIV | MOD if operand == 0 => return Some(target),
        DIV => target.wrapping_div(operand),
        MOD => target.wrapping_rem(operand),
        AND => target & operand,
        OR => target | operand,
        XOR => target ^ operand,
        NOT => !operand,
        LOAD => return Some(operand),
        COMP => {
            flags.compare(target, operand);
            return Some(target);
        }
        _ => return None,
    };
    flags.result(result);
    Some(result)
}

/// The variable that the X register names, if there is such a one.
pub(super) fn indexed(x: i32) -> Option<u8> {
    u8::try_from(x).ok()
}

/// Executes a command if it is one of these. Reading a variable (`GGP`, `GIV`) is not among them: a
/// program reads into the accumulator, a host into the reply.
#[inline(always)]
pub(super) fn calculate(command: Command, registers: &mut Registers, variables: &mut Variables) -> Effect {
    let Command { opcode, kind, motor, value } = command;
    let flags = &mut registers.flags;
    let variable = &mut variables[usize::from(motor)];
    let done = match opcode {
        opcode::CALC if kind <= LOAD => {
            let operand = if kind == NOT { registers.accumulator } else { value };
            operate(kind, registers.accumulator, operand, flags).map(|result| registers.accumulator = result)
        }
        opcode::COMP => {
            flags.compare(registers.accumulator, value);
            Some(())
        }
        opcode::CALCX => match kind {
            NOT => {
                registers.x = !registers.x;
                flags.result(registers.x);
                Some(())
            }
            LOAD => {
                registers.x = registers.accumulator;
                Some(())
            }
            SWAP => {
                core::mem::swap(&mut registers.accumulator, &mut registers.x);
                Some(())
            }
            COMP.. => None,
            _ => operate(kind, registers.accumulator, registers.x, flags)
                .map(|result| registers.accumulator = result),
        },
        opcode::CALCVV => {
            let Ok(second) = u8::try_from(value) else { return Effect::Failed(Status::INVALID_VALUE) };
            if kind == SWAP {
                variables.swap(usize::from(motor), usize::from(second));
                Some(())
            } else {
                let operand = variables[usize::from(second)];
                let variable = &mut variables[usize::from(motor)];
                operate(kind, *variable, operand, flags).map(|result| *variable = result)
            }
        }
        opcode::CALCVA => match kind {
            SWAP => {
                core::mem::swap(variable, &mut registers.accumulator);
                Some(())
            }
            _ => operate(kind, *variable, registers.accumulator, flags).map(|result| *variable = result),
        },
        opcode::CALCAV => match kind {
            SWAP => {
                core::mem::swap(variable, &mut registers.accumulator);
                Some(())
            }
            _ => operate(kind, registers.accumulator, *variable, flags)
                .map(|result| registers.accumulator = result),
        },
        opcode::CALCVX => match kind {
            SWAP => {
                core::mem::swap(variable, &mut registers.x);
                Some(())
            }
            _ => operate(kind, *variable, registers.x, flags).map(|result| *variable = result),
        },
        opcode::CALCXV => match kind {
            SWAP => {
                core::mem::swap(variable, &mut registers.x);
                Some(())
            }
            _ => operate(kind, registers.x, *variable, flags).map(|result| registers.x = result),
        },
        opcode::CALCV if kind != SWAP => {
            let operand = if kind == NOT { *variable } else { value };
            operate(kind, *variable, operand, flags).map(|result| *variable = result)
        }
        opcode::CALC | opcode::CALCV => None,
        opcode::CLE => Flag::from_number(kind).map(|flag| flags.clear(flag)),
        opcode::SGP if motor == VARIABLE_BANK => {
            variables[usize::from(kind)] = value;
            Some(())
        }
        opcode::AGP if motor == VARIABLE_BANK => {
            variables[usize::from(kind)] = registers.accumulator;
            Some(())
        }
        // An index out of range is not an error: the command does nothing.
        opcode::SIV => {
            if let Some(index) = indexed(registers.x) {
                variables[usize::from(index)] = value;
            }
            Some(())
        }
        opcode::AIV => {
            if let Some(index) = indexed(registers.x) {
                variables[usize::from(index)] = registers.accumulator;
            }
            Some(())
        }
        _ => return Effect::Other,
    };
    if done.is_some() { Effect::Done } else { Effect::Failed(Status::WRONG_TYPE) }
}
