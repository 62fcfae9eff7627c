//! What the assembler has to know of the module that a program is for: its symbols, and what it refuses.
//!
//! Nothing of that is written a second time. The symbols are those of the tables of parameters, and whether the
//! module refuses a command is asked of one that was just switched on.

use super::{FLASH_BYTES, Pd42, axis_parameters as ap, global_parameters as gp};
use crate::board::{Board, Drive, Port};
use crate::controller::Controller;
use crate::flash::{Flash, FlashError};
use crate::parameter::{Parameter, Table};
use ::motion::{Ticks, Train};
use alloc::{boxed::Box, format, string::String, vec, vec::Vec};
use core::{cell::RefCell, fmt::Write, ops::Range};
use protocol::tmcl::{Frame, Reply, Request, Status};
use tmcl::asm::{Environment, Include};
use tmcl::isa::{Command, VARIABLE_BANK, opcode};

/// The built-in file of parameter symbols.
pub const PARAMETERS_FILE: &str = "TMCLParam.tmc";

/// The bank of the parameters of the module itself.
pub const MODULE_BANK: u8 = 0;

/// The bank of the parameters of interrupts.
pub const INTERRUPT_BANK: u8 = 3;

/// Address of a module from the factory.
const ADDRESS: u8 = 1;

/// A module to try commands on: the [`Environment`] of a source that includes nothing but built-in files.
#[derive(Default)]
pub struct Module {
    /// None if a command may have changed what the next one does.
    trial: RefCell<Option<Box<Pd42<Memory>>>>,
}

impl Module {
    /// One that is switched on when it is needed.
    pub const fn new() -> Self {
        Self { trial: RefCell::new(None) }
    }

    /// The status with which the module answers a command, if it answers.
    fn status(&self, command: Command) -> Option<Status> {
        // What only hosts can send, as a restart, no program executes.
        command.instruction().filter(|instruction| instruction.program)?;
        let mut trial = self.trial.borrow_mut();
        let module = trial.get_or_insert_with(|| Box::new(Pd42::new(Memory::erased(), 0)));
        let Command { opcode, kind, motor, value } = command;
        let request = Request { address: ADDRESS, opcode, kind, motor, value };
        let mut ear = Ear::default();
        module.receive(Port::Usb, &request.emit().0, &mut ear);
        if opcode == opcode::SGP {
            // It may lock the module, silence it, or change its address.
            *trial = None;
        }
        let frame = Frame(ear.heard.try_into().ok()?);
        Reply::parse(&frame).ok().map(|reply| reply.status)
    }
}

impl Environment for Module {
    fn include(&self, name: &str, _: &str) -> Option<Include> {
        let text = || symbols().into_bytes();
        name.eq_ignore_ascii_case(PARAMETERS_FILE)
            .then(|| Include { name: PARAMETERS_FILE.into(), text: text() })
    }

    fn check(&self, command: Command) -> Option<String> {
        // What these write is in the accumulator, which nobody knows yet.
        let unknown = [opcode::AAP, opcode::AGP, opcode::ACO].contains(&command.opcode);
        match self.status(command)? {
            Status::WRONG_TYPE => Some(match parameter(command) {
                Some(parameter) => format!(
                    "the module skips this: parameter {} ({}) is {}",
                    parameter.number,
                    parameter.about.name,
                    parameter.access.letters()
                ),
                None => "the module skips this: it knows no such type".into(),
            }),
            Status::INVALID_VALUE if !unknown => Some(match parameter(command) {
                Some(Parameter { about, low, high, .. }) if command.motor == 0 && low <= high => {
                    format!("the module skips this: {} goes from {low} to {high}", about.name.to_lowercase())
                }
                _ => "the module skips this: motor, bank or value is out of range".into(),
            }),
            _ => None,
        }
    }
}

/// The parameters of a bank of global parameters, if it has any with names.
pub fn bank(number: u8) -> Option<&'static Table> {
    match number {
        MODULE_BANK => Some(gp::module::TABLE),
        INTERRUPT_BANK => Some(gp::interrupts::TABLE),
        _ => None,
    }
}

/// The entry of the parameter that a command is about.
pub fn parameter(command: Command) -> Option<&'static Parameter> {
    let table = match command.opcode {
        opcode::SAP | opcode::GAP | opcode::STAP | opcode::RSAP | opcode::AAP => ap::TABLE,
        opcode::SGP | opcode::GGP | opcode::STGP | opcode::RSGP | opcode::AGP => bank(command.motor)?,
        _ => return None,
    };
    table.find(command.kind)
}

/// The text of [`PARAMETERS_FILE`].
fn symbols() -> String {
    let mut text = format!("Motor0 = 0\nUserVariableBank = {VARIABLE_BANK}\n");
    for table in [ap::TABLE, gp::module::TABLE, gp::interrupts::TABLE] {
        for Parameter { number, about, .. } in table {
            writeln!(text, "{} = {number} // {}", about.symbol, about.name)
                .expect("a string takes everything");
        }
    }
    text
}

/// Flash that lasts as long as the trial.
struct Memory(Vec<u8>);

impl Memory {
    fn erased() -> Self {
        Self(vec![u8::MAX; FLASH_BYTES as usize])
    }

    fn cells(&mut self, range: Range<u32>) -> Result<&mut [u8], FlashError> {
        self.0.get_mut(range.start as usize..range.end as usize).ok_or(FlashError::Range)
    }
}

impl Flash for Memory {
    fn capacity(&self) -> u32 {
        FLASH_BYTES
    }

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), FlashError> {
        bytes.copy_from_slice(self.cells(offset..offset + bytes.len() as u32)?);
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), FlashError> {
        self.cells(offset..offset + bytes.len() as u32)?.copy_from_slice(bytes);
        Ok(())
    }

    fn erase(&mut self, from: u32, to: u32) -> Result<(), FlashError> {
        self.cells(from..to)?.fill(u8::MAX);
        Ok(())
    }
}

/// A board on which nothing happens, but whoever listens hears the replies.
#[derive(Default)]
struct Ear {
    heard: Vec<u8>,
}

impl Board for Ear {
    fn clock(&mut self, _: Ticks) {}

    fn pulses(&mut self, _: usize, _: &Train) {}

    fn drive(&mut self, _: usize, _: Drive) {}

    fn send(&mut self, _: Port, bytes: &[u8], _: u32) {
        self.heard.extend_from_slice(bytes);
    }

    fn output(&mut self, _: usize, _: bool) {}

    fn release(&mut self, _: usize) {}

    fn output_analog(&mut self, _: usize, _: i32) {}

    fn encoder(&mut self, _: usize) -> i32 {
        0
    }

    fn digital(&mut self, _: usize) -> bool {
        false
    }

    fn load(&mut self, _: usize) -> u16 {
        0
    }

    fn analog(&mut self, pin: usize) -> i32 {
        super::pins::PINS[pin].rest
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmcl::asm::assemble;

    #[track_caller]
    fn check(line: &str, expected: Option<&str>) {
        let source = format!("#include tmclparam.tmc\n#include Interrupts.inc\n{line}\nSTOP");
        let assembly = assemble("test.tmc", source.as_bytes(), &Module::new());
        assert!(!assembly.has_errors(), "{line}: {}", assembly.render(false));
        let message = assembly.diagnostics.first().map(|diagnostic| diagnostic.message.as_str());
        assert_eq!(message, expected, "{line}");
    }

    #[test]
    fn what_a_module_refuses_is_known_before() {
        check("SAP APMaxPositioningSpeed, Motor0, 2047", None);
        check("SAP 5, 0, 10000", Some("the module skips this: maximum acceleration goes from 1 to 2047"));
        check("SAP 3, 0, 5", Some("the module skips this: parameter 3 (Actual speed) is R"));
        check("SAP 99, 0, 5", Some("the module skips this: it knows no such type"));
        check("SAP 5, 1, 100", Some("the module skips this: motor, bank or value is out of range"));
        check("ROL 0, 51200", Some("the module skips this: motor, bank or value is out of range"));
        check("SIO 3, 2, 1", Some("the module skips this: it knows no such type"));
        check("SGP 42, 2, -1", None);
        check(
            "SGP GPTelegramPauseTime, 0, 256",
            Some("the module skips this: telegram pause time goes from 0 to 255"),
        );
        // A direct command of a program, and one whose value is only known when it runs.
        check("WAIT POS, 0, 0", None);
        check("AAP 4, 0", None);
        check("AAP 3, 0", Some("the module skips this: parameter 3 (Actual speed) is R"));
    }

    #[test]
    fn a_silenced_trial_does_not_hide_the_rest() {
        check(
            "SGP 255, 0, 1\nSAP 5, 0, 0",
            Some("the module skips this: maximum acceleration goes from 1 to 2047"),
        );
        check(
            "SGP 81, 0, 3\nSAP 5, 0, 0",
            Some("the module skips this: maximum acceleration goes from 1 to 2047"),
        );
    }
}
