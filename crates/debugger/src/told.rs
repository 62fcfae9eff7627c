//! What can be done to a device on the way, in words: as a host does it, over USB, and as hands do it.

use crate::engine::Debugger;
use devices::{
    Language, Port,
    pd42::{axis_parameters as ap, global_parameters as gp},
};
use protocol::tmcl::{Frame, Reply, Request, Status};
use sim::{PinValue, tape::Act};
use tmcl::{
    Command,
    asm::{NoFiles, assemble},
    isa::{VARIABLE_BANK, opcode},
};

/// Banks of global parameters.
const MODULE_BANK: u8 = 0;
const INTERRUPT_BANK: u8 = 3;

/// Why something cannot be done; one line of text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ToldError {
    /// There is nothing of this name that somebody outside can set.
    #[error("`{0}` cannot be set from outside")]
    Name(String),
    /// It takes another value.
    #[error("`{0}` is no value: true, false or a number")]
    Value(String),
    /// This is no command.
    #[error("{0}")]
    Command(String),
    /// The device refuses.
    #[error("the device answers {0}")]
    Refused(String),
    /// It does not answer.
    #[error("the device does not answer")]
    Silent,
    /// What the device says against a pin or an axis.
    #[error("{0}")]
    Device(String),
}

impl Debugger {
    /// Sets a register, parameter or variable as a host does, or drives an input. What no host can set, the
    /// accumulator and the X register of TMCL, is set by hand.
    ///
    /// # Errors
    /// [`ToldError`].
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), ToldError> {
        let value: PinValue = text.parse().map_err(|_| ToldError::Value(text.into()))?;
        let pin = [name.to_owned(), name.to_uppercase()].into_iter().find(|name| self.is_input(name));
        // A port that is an output now is set by a command, as other outputs are.
        if pin.is_some_and(|pin| self.drive(&pin, Some(value)).is_ok()) {
            return Ok(());
        }
        match self.target().config.model.language {
            Language::Ascript(_) => self.send(&format!("{}={text}", name.to_uppercase())).map(drop),
            Language::Tmcl => {
                let value = text.parse().map_err(|_| ToldError::Value(text.into()))?;
                match setter(name, value) {
                    Some(command) => self.command(command).map(drop),
                    None => {
                        let set = self.perform(Act::Register(name.to_uppercase(), value));
                        set.map(drop).map_err(|_| ToldError::Name(name.into()))
                    }
                }
            }
        }
    }

    fn is_input(&mut self, name: &str) -> bool {
        self.device().pins().iter().any(|pin| pin.name == name && !pin.kind.is_output())
    }

    /// Drives an input, or gives it back to the machine.
    ///
    /// # Errors
    /// [`ToldError::Device`].
    pub fn drive(&mut self, pin: &str, value: Option<PinValue>) -> Result<(), ToldError> {
        self.perform(Act::Pin(pin.into(), value)).map(drop).map_err(ToldError::Device)
    }

    /// Sends a command over USB: a line of ASCII, or a command of TMCL in assembly language. Gives the answer.
    ///
    /// # Errors
    /// [`ToldError`].
    pub fn send(&mut self, text: &str) -> Result<String, ToldError> {
        match self.target().config.model.language {
            Language::Tmcl => self.command(direct(text)?).map(|value| value.to_string()),
            Language::Ascript(_) => {
                let answer = self.exchange(format!("{text}\r").as_bytes())?;
                let answer = String::from_utf8_lossy(&answer).trim_end().to_owned();
                if answer.starts_with('?') {
                    Err(ToldError::Refused(format!("`{answer}`")))
                } else {
                    Ok(answer)
                }
            }
        }
    }

    /// Sends a command of TMCL; the value of the reply.
    fn command(&mut self, command: Command) -> Result<i32, ToldError> {
        let Command { opcode, kind, motor, value } = command;
        let request = Request { address: 1, opcode, kind, motor, value };
        let answer = self.exchange(&request.emit().0)?;
        let frame = answer.try_into().map_err(|_| ToldError::Silent)?;
        match Reply::parse(&Frame(frame)) {
            Ok(reply) if reply.status == Status::OK => Ok(reply.value),
            Ok(reply) => Err(ToldError::Refused(reply.status.to_string())),
            Err(_) => Err(ToldError::Silent),
        }
    }

    fn exchange(&mut self, bytes: &[u8]) -> Result<Vec<u8>, ToldError> {
        let sent = self.perform(Act::receive(Port::Usb, bytes)).map_err(ToldError::Device)?;
        sent.into_iter().find(|sent| sent.port == Port::Usb).map(|sent| sent.bytes).ok_or(ToldError::Silent)
    }
}

/// The command that sets a variable or a parameter of this name.
fn setter(name: &str, value: i32) -> Option<Command> {
    let name = name.trim();
    let parameter = |table: &devices::Table| {
        let mut entries = table.iter();
        entries.find(|entry| entry.about.symbol.eq_ignore_ascii_case(name)).map(|entry| entry.number)
    };
    let variable = || name.strip_prefix(['V', 'v'])?.parse().ok();
    let (opcode, kind, motor) = if let Some(number) = variable() {
        (opcode::SGP, number, VARIABLE_BANK)
    } else if let Some(number) = parameter(ap::TABLE) {
        (opcode::SAP, number, 0)
    } else if let Some(number) = parameter(gp::module::TABLE) {
        (opcode::SGP, number, MODULE_BANK)
    } else {
        (opcode::SGP, parameter(gp::interrupts::TABLE)?, INTERRUPT_BANK)
    };
    Some(Command { opcode, kind, motor, value })
}

/// The command that a line of assembly language is.
fn direct(text: &str) -> Result<Command, ToldError> {
    let assembly = assemble("command", text.as_bytes(), &NoFiles);
    let commands = assembly.program.map(|program| program.commands).unwrap_or_default();
    let message = assembly.diagnostics.first().map(|diagnostic| diagnostic.message.clone());
    // The assembler ends a program with a STOP.
    commands
        .first()
        .copied()
        .filter(|_| commands.len() <= 2)
        .ok_or_else(|| ToldError::Command(message.unwrap_or_else(|| format!("`{text}` is not one command"))))
}
