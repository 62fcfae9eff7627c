//! What the assembler has to know of the module that a program is for: its symbols, and what it refuses.

use devices::{
    Port,
    parameter::Parameter,
    pd42::{axis_parameters as ap, global_parameters as gp},
};
use sim::{DeviceConfig, VirtualDevice};
use std::{cell::RefCell, fmt::Write, fs, io::Read, path::Path};
use tmcl::{
    Command,
    asm::{Environment, Include, MAX_SOURCE_BYTES},
    isa::{VARIABLE_BANK, opcode},
};

/// The built-in file of parameter symbols.
const PARAMETERS_FILE: &str = "TMCLParam.tmc";

/// The model that TMCL programs are for.
const MODEL: &str = "pd42-1140";

/// Status replies of a module (manual, section 3.3).
const WRONG_TYPE: u8 = 3;
const INVALID_VALUE: u8 = 4;

/// The bank of the parameters of the module itself, and that of interrupts.
const MODULE_BANK: u8 = 0;
const INTERRUPT_BANK: u8 = 3;

/// The module and the files beside the source.
pub struct Module {
    /// A module to try commands on; none if a command may have changed what the next one does.
    trial: RefCell<Option<VirtualDevice>>,
}

impl Module {
    pub fn new() -> Self {
        Self { trial: RefCell::new(None) }
    }

    /// The status with which a module answers a command, if it answers.
    fn status(&self, command: Command) -> Option<u8> {
        let mut trial = self.trial.borrow_mut();
        let device = match &mut *trial {
            Some(device) => device,
            empty => empty.insert(VirtualDevice::new(&DeviceConfig::new(devices::model(MODEL)?), 0)),
        };
        let Command { opcode, kind, motor, value } = command;
        let [a, b, c, d] = value.to_be_bytes();
        let mut frame = [1, opcode, kind, motor, a, b, c, d, 0];
        frame[8] = frame.iter().fold(0, |sum: u8, byte| sum.wrapping_add(*byte));
        device.receive(Port::Usb, &frame);
        let status = device.drain_sent().find_map(|sent| sent.bytes.get(2).copied());
        if opcode == opcode::SGP {
            // A parameter of the module may lock it, silence it, or change its address.
            *trial = None;
        }
        status
    }
}

impl Environment for Module {
    fn include(&self, name: &str, from: &str) -> Option<Include> {
        let path = Path::new(from).parent().unwrap_or(Path::new("")).join(name);
        let limit = MAX_SOURCE_BYTES as u64 + 1;
        let mut text = Vec::new();
        let read = fs::File::open(&path).and_then(|file| file.take(limit).read_to_end(&mut text));
        if read.is_ok() {
            return Some(Include { name: path.display().to_string(), text });
        }
        let built_in = name.eq_ignore_ascii_case(PARAMETERS_FILE);
        built_in.then(|| Include { name: PARAMETERS_FILE.into(), text: symbols().into_bytes() })
    }

    fn check(&self, command: Command) -> Option<String> {
        // What these write is in the accumulator, which nobody knows yet.
        let unknown = [opcode::AAP, opcode::AGP, opcode::ACO].contains(&command.opcode);
        match self.status(command)? {
            WRONG_TYPE => Some(match parameter(command) {
                Some(parameter) => format!(
                    "the module skips this: parameter {} ({}) is {}",
                    parameter.number,
                    parameter.about.name,
                    parameter.access.letters()
                ),
                None => "the module skips this: it knows no such type".into(),
            }),
            INVALID_VALUE if !unknown => Some(match parameter(command) {
                Some(Parameter { about, low, high, .. }) if command.motor == 0 && low <= high => {
                    format!("the module skips this: {} goes from {low} to {high}", about.name.to_lowercase())
                }
                _ => "the module skips this: motor, bank or value is out of range".into(),
            }),
            _ => None,
        }
    }
}

/// The entry of the parameter that a command is about.
fn parameter(command: Command) -> Option<&'static Parameter> {
    let table = match command.opcode {
        opcode::SAP | opcode::GAP | opcode::STAP | opcode::RSAP | opcode::AAP => ap::TABLE,
        opcode::SGP | opcode::GGP | opcode::STGP | opcode::RSGP | opcode::AGP => match command.motor {
            MODULE_BANK => gp::module::TABLE,
            INTERRUPT_BANK => gp::interrupts::TABLE,
            _ => return None,
        },
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
