//! Parameters, and what is kept when the power goes.

use super::act::parameter;
use super::{DEFAULT_ADDRESS, Memory, Module};
use crate::bus::FLASH_PATIENCE;
use crate::error::{Error, Result};
use crate::key::Key;
use crate::types::Value;
use crate::wire::End;
use protocol::tmcl::Request;
use std::sync::atomic::Ordering::Relaxed;
use tmcl::isa::{Command, VARIABLE_BANK, opcode};

/// Without this value the module keeps its settings (TMCL manual, 3.7.53).
const CONFIRMATION: i32 = 1234;

impl Module {
    /// The value of a parameter.
    pub async fn read(&self, key: &Key) -> Result<Value> {
        let value = self.ask(command(key, opcode::GAP, opcode::GGP, 0)?).await?;
        if *key == (Key::Axis { number: parameter::EXTENDED_ERRORS, motor: 0 }) {
            // The module has forgotten them now.
            self.memory().errors |= value as u32;
        }
        Ok(Value::Number(value))
    }

    /// Sets a parameter.
    pub async fn write(&self, key: &Key, value: &Value) -> Result<()> {
        let number = match *value {
            Value::Number(number) => Some(number),
            // Some have 32 bits without a sign.
            Value::Decimal(number) => {
                let bits = number as i64;
                (bits as f64 == number).then(|| u32::try_from(bits).ok()).flatten().map(|bits| bits as i32)
            }
            Value::Text(_) => None,
        };
        let number = number.ok_or_else(|| Error::Value(format!("{key} takes a whole number")))?;
        self.send(command(key, opcode::SAP, opcode::SGP, number)?).await.map(drop)
    }

    /// Stores these parameters.
    pub async fn store(&self, keys: &[Key]) -> Result<()> {
        for key in keys {
            self.send(command(key, opcode::STAP, opcode::STGP, 0)?).await?;
        }
        Ok(())
    }

    /// Factory settings. The module starts again and does not answer; what is asked next waits until it is there.
    pub async fn restore(&self) -> Result<()> {
        let mut talk = self.talk().await?;
        let words = "restore factory settings";
        let request = Request {
            address: self.listens_at(),
            opcode: opcode::FACTORY_SETTINGS,
            kind: 0,
            motor: 0,
            value: CONFIRMATION,
        };
        let read = |_: &[u8]| String::new();
        talk.exchange(&request.emit().0, words, End::Silence, FLASH_PATIENCE, read).await?;
        talk.doubt();
        *self.memory() = Memory::default();
        self.address.store(DEFAULT_ADDRESS, Relaxed);
        Ok(())
    }

    /// User variables, from a number on.
    pub async fn variables(&self, first: u16, count: u16) -> Result<Vec<i32>> {
        let mut values = Vec::new();
        for number in first..first.saturating_add(count) {
            let number = u8::try_from(number).map_err(|_| Error::NoSuch(format!("variable {number}")))?;
            values.push(self.ask(Command::new(opcode::GGP, number, VARIABLE_BANK, 0)).await?);
        }
        Ok(values)
    }
}

/// The command for an axis parameter or a global one.
fn command(key: &Key, axis: u8, global: u8, value: i32) -> Result<Command> {
    match *key {
        Key::Axis { number, motor } => Ok(Command::new(axis, number, motor, value)),
        Key::Global { number, bank } => Ok(Command::new(global, number, bank, value)),
        Key::Command(ref name) => Err(Error::NoSuch(name.clone())),
    }
}
