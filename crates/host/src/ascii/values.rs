//! Parameters, and what is kept when the power goes.

use super::Unit;
use crate::error::{Error, Result};
use crate::key::Key;
use crate::types::Value;

impl Unit {
    /// The value of a parameter.
    pub async fn read(&self, key: &Key) -> Result<Value> {
        let name = name(key)?;
        let text: String = self.ask(name).await?;
        Ok(value(&text))
    }

    /// Sets a parameter.
    pub async fn write(&self, key: &Key, value: &Value) -> Result<()> {
        let name = name(key)?;
        let line = match value {
            // No parameter has more digits after the point.
            Value::Decimal(number) if number.fract() != 0.0 => format!("{name}={number:.3}"),
            value => format!("{name}={value}"),
        };
        self.tell(&line).await
    }

    /// Stores all settings that can be stored (PMX-2ED-SA manual, 7.20; CMD-4CR manual, 2.1.7).
    pub async fn store(&self) -> Result<()> {
        self.tell("STORE").await
    }

    /// Sets what it had from the factory and stores that. There is no command for it.
    pub async fn restore(&self, defaults: &[(Key, Value)]) -> Result<()> {
        for (key, value) in defaults {
            self.write(key, value).await?;
        }
        self.store().await
    }

    /// Variables of programs, from a number on.
    pub async fn variables(&self, first: u16, count: u16) -> Result<Vec<i32>> {
        let mut values = Vec::new();
        for number in first..first.saturating_add(count) {
            values.push(self.ask(&format!("V{number}")).await?);
        }
        Ok(values)
    }
}

fn name(key: &Key) -> Result<&str> {
    match key {
        Key::Command(name) => Ok(name),
        other => Err(Error::NoSuch(other.to_string())),
    }
}

/// A value as it is written in a reply.
fn value(text: &str) -> Value {
    let decimal = || text.contains('.').then(|| text.parse().ok())?;
    match text.parse() {
        Ok(number) => Value::Number(number),
        Err(_) => decimal().map_or_else(|| Value::Text(text.into()), Value::Decimal),
    }
}
