//! Controllers that are told lines of text: PMX-2ED-SA and CMD-4CR (PMX-2ED-SA manual, 6.2.3 and 9; CMD-4CR manual,
//! 3.2.2 and 4).

mod act;
mod program;
mod status;
mod terminal;
mod values;

#[cfg(test)]
mod tests;

use crate::bits::Bit;
use crate::bus::{Bus, FLASH_PATIENCE, PATIENCE, Talk, shown};
use crate::error::{Error, Result};
use crate::model::Model;
use crate::types::Found;
use crate::wire::End;
use ascript::dialect::{Dialect, Family};
use protocol::performax::MAX_COMMAND;
use std::{
    str::FromStr,
    sync::{Mutex, MutexGuard, PoisonError},
    time::Duration,
};

/// What a command that has no value to give is answered with.
const DONE: &str = "OK";

/// What every refusal begins with.
const REFUSAL: char = '?';

/// What a Performax says that it is.
const PERFORMAX: &str = "PERFORMAX-2ED-SA";

/// Letters before the number in the name of a Performax.
const PERFORMAX_NAME: &str = "2ED";

/// A controller of this kind.
pub(crate) struct Unit {
    bus: Bus,
    model: Model,
    dialect: &'static Dialect,
    address: Option<u8>,
    bits: Vec<Bit>,
    /// Where the axes were sent last.
    targets: Mutex<Vec<Option<i32>>>,
    rest: tokio::sync::Mutex<status::Rest>,
    /// Two downloads at once would be none.
    downloads: tokio::sync::Mutex<()>,
}

impl Unit {
    pub fn new(
        bus: Bus,
        model: Model,
        dialect: &'static Dialect,
        address: Option<u8>,
        bits: Vec<Bit>,
    ) -> Self {
        let targets = Mutex::new(vec![None; dialect.axes.len()]);
        let (rest, downloads) = Default::default();
        Self { bus, model, dialect, address, bits, targets, rest, downloads }
    }

    const fn is_commander(&self) -> bool {
        matches!(self.dialect.family, Family::Commander)
    }

    /// Its address. Another that it is given counts from its next start on.
    pub const fn address(&self) -> Option<u8> {
        self.address
    }

    /// Who answers.
    pub async fn identify(&self) -> Result<Found> {
        identify(&self.bus, self.address, PATIENCE).await
    }

    /// The number of an axis, from 0.
    fn axis(&self, name: &str) -> Result<usize> {
        let axes = self.model.axes();
        axes.iter().position(|axis| *axis == name).ok_or_else(|| Error::NoSuch(name.into()))
    }

    /// A line and its reply, whatever it is.
    async fn say(&self, talk: &mut Talk<'_>, line: &str) -> Result<String> {
        say(talk, self.address, line, patience(line)).await
    }

    /// Something to read. It is asked for again if the reply got lost or is another's.
    async fn ask_in<T: FromStr>(&self, talk: &mut Talk<'_>, line: &str) -> Result<T> {
        match self.ask_once(talk, line).await {
            Err(Error::Wire(crate::WireError::Timeout(_)) | Error::Malformed { .. }) => {
                self.ask_once(talk, line).await
            }
            answer => answer,
        }
    }

    async fn ask_once<T: FromStr>(&self, talk: &mut Talk<'_>, line: &str) -> Result<T> {
        let reply = accepted(line, self.say(talk, line).await?)?;
        reply.parse().map_err(|_| {
            talk.doubt();
            malformed(line, &reply)
        })
    }

    /// Something to do, which is not said twice: it may have been done.
    async fn tell_in(&self, talk: &mut Talk<'_>, line: &str) -> Result<()> {
        let reply = accepted(line, self.say(talk, line).await?)?;
        if reply == DONE {
            return Ok(());
        }
        talk.doubt();
        Err(malformed(line, &reply))
    }

    async fn ask<T: FromStr>(&self, line: &str) -> Result<T> {
        self.ask_in(&mut self.bus.talk().await, line).await
    }

    async fn tell(&self, line: &str) -> Result<()> {
        self.tell_in(&mut self.bus.talk().await, line).await
    }

    fn targets(&self) -> MutexGuard<'_, Vec<Option<i32>>> {
        // A target is known or not, whoever panicked.
        self.targets.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// How long the reply to a line may take.
fn patience(line: &str) -> Duration {
    if line == "STORE" { FLASH_PATIENCE } else { PATIENCE }
}

/// Sends a line and gives the reply without its end.
async fn say(talk: &mut Talk<'_>, address: Option<u8>, line: &str, patience: Duration) -> Result<String> {
    let is_text = !line.is_empty() && line.bytes().all(|byte| matches!(byte, b' '..=b'~'));
    if !is_text || line.len() > MAX_COMMAND {
        return Err(Error::Value(format!("a command has 1 to {MAX_COMMAND} ASCII characters")));
    }
    let request = match address {
        None => format!("{line}\r"),
        Some(address) => format!("@{address:02}{line}\r"),
    };
    let reply = talk.exchange(request.as_bytes(), request.trim_end(), End::Line, patience, shown).await?;
    match text(&reply) {
        Some(text) => Ok(text.to_owned()),
        None => {
            talk.doubt();
            Err(Error::Malformed { request: line.into(), reply: shown(&reply) })
        }
    }
}

/// The text of a reply. Some converters send a line feed behind a carriage return, which then comes first.
fn text(reply: &[u8]) -> Option<&str> {
    let text = std::str::from_utf8(reply).ok()?.trim_start_matches(['\n', '\0']).strip_suffix('\r')?;
    text.bytes().all(|byte| matches!(byte, b' '..=b'~')).then_some(text)
}

fn accepted(line: &str, reply: String) -> Result<String> {
    if reply.starts_with(REFUSAL) {
        return Err(Error::Refused { request: line.into(), words: reply });
    }
    Ok(reply)
}

fn malformed(line: &str, reply: &str) -> Error {
    Error::Malformed { request: line.into(), reply: reply.into() }
}

/// Asks whoever listens to an address, or is alone on a line, who it is.
pub(crate) async fn identify(bus: &Bus, address: Option<u8>, patience: Duration) -> Result<Found> {
    let mut talk = bus.talk().await;
    let mut ask = async |line: &'static str| accepted(line, say(&mut talk, address, line, patience).await?);
    let identity = match ask("ID").await {
        // Half a line of somebody else stood before it.
        Err(Error::Refused { .. } | Error::Malformed { .. }) => ask("ID").await?,
        identity => identity?,
    };
    let version = ask("VER").await?;
    // A Commander's identity is its number (CMD-4CR manual, 3.3), a Performax has it in its name (PMX manual, 6.3).
    let (model, number) = match identity.as_str() {
        PERFORMAX => (Some(Model::Pmx2ed), ask("DN").await?),
        number if number.len() == 2 && number.parse::<u8>().is_ok() => (Some(Model::Cmd4cr), identity),
        _ => (None, String::new()),
    };
    // The number may have been changed and wait for the next start; the one that was asked is in force.
    let number = number.strip_prefix(PERFORMAX_NAME).unwrap_or(&number).parse().unwrap_or(0);
    Ok(Found { address: address.unwrap_or(number), model: model.map(|model| model.name().into()), version })
}
