//! Modules that are told TMCL commands of nine bytes: PD42-1140 (TMCL manual, 3).

mod act;
mod program;
mod status;
mod terminal;
mod values;

#[cfg(test)]
mod tests;

use crate::bits::Bit;
use crate::bus::{Bus, PATIENCE, Talk};
use crate::error::{Error, Result};
use crate::model::Model;
use crate::traffic::hex;
use crate::types::Found;
use crate::wire::{End, WireError};
use protocol::tmcl::{FRAME_LENGTH, Frame, Reply, Request, Status};
use std::{
    sync::{
        Mutex, MutexGuard, PoisonError,
        atomic::{AtomicBool, AtomicU8, AtomicU64, Ordering::Relaxed},
    },
    time::Duration,
};
use tmcl::isa::{Command, opcode};

/// The address from the factory.
const DEFAULT_ADDRESS: u8 = 1;

/// The global parameter that is the address, and its bank (TMCL manual, chapter 5).
const ADDRESS: (u8, u8) = (66, 0);

/// The number of the module in its version.
const MODULE: u16 = 1140;

/// A module.
pub(crate) struct Module {
    bus: Bus,
    /// Where it listens now: it may be told another over this wire.
    address: AtomicU8,
    /// Whether it is alone at the other end, whatever its address.
    alone: bool,
    bits: Vec<Bit>,
    memory: Mutex<Memory>,
    rest: tokio::sync::Mutex<status::Rest>,
    /// It stores commands instead of executing them, or may do so.
    downloading: AtomicBool,
    /// How often everything was stopped.
    stops: AtomicU64,
}

/// What the module does not say again.
#[derive(Debug, Default)]
struct Memory {
    /// Extended error flags, which are cleared when they are read.
    errors: u32,
    /// Where the axis stood when they were read, if it has not moved since.
    looked_at: Option<i32>,
    /// Where the program was when it was made to wait.
    paused: Option<u16>,
}

impl Module {
    pub fn new(bus: Bus, address: Option<u8>, bits: Vec<Bit>) -> Self {
        Self {
            bus,
            address: AtomicU8::new(address.unwrap_or(DEFAULT_ADDRESS)),
            alone: address.is_none(),
            bits,
            memory: Mutex::default(),
            rest: tokio::sync::Mutex::default(),
            downloading: AtomicBool::new(false),
            stops: AtomicU64::new(0),
        }
    }

    /// Who answers.
    pub async fn identify(&self) -> Result<Found> {
        identify(&self.bus, self.listens_at(), PATIENCE).await
    }

    /// Its address, if that matters or has been changed.
    pub fn address(&self) -> Option<u8> {
        let address = self.listens_at();
        (!self.alone || address != DEFAULT_ADDRESS).then_some(address)
    }

    fn listens_at(&self) -> u8 {
        self.address.load(Relaxed)
    }

    /// Follows the module to the address that a command gives it.
    fn follow(&self, command: Command, reply: &Reply) {
        if let Some(address) = address_after(command, reply) {
            self.address.store(address, Relaxed);
        }
    }

    /// The module's only axis.
    fn axis(&self, name: &str) -> Result<u8> {
        if name == Model::Pd42.axes()[0] { Ok(0) } else { Err(Error::NoSuch(name.into())) }
    }

    /// The wire for oneself. A download that nobody ended is ended first.
    async fn talk(&self) -> Result<Talk<'_>> {
        let mut talk = self.bus.talk().await;
        self.end_download(&mut talk).await?;
        Ok(talk)
    }

    /// A command and its value.
    async fn send_in(&self, talk: &mut Talk<'_>, command: Command) -> Result<i32> {
        self.reply_in(talk, command).await.map(|reply| reply.value)
    }

    async fn send(&self, command: Command) -> Result<i32> {
        self.send_in(&mut self.talk().await?, command).await
    }

    /// A command that changes nothing. It is sent again if the reply got lost or is another's.
    async fn ask(&self, command: Command) -> Result<i32> {
        let mut talk = self.talk().await?;
        match self.send_in(&mut talk, command).await {
            Err(Error::Wire(WireError::Timeout(_)) | Error::Malformed { .. }) => {
                self.send_in(&mut talk, command).await
            }
            answer => answer,
        }
    }

    /// A command and its reply. Of a command that did not arrive as it was sent nothing was executed, so it is sent again.
    async fn reply_in(&self, talk: &mut Talk<'_>, command: Command) -> Result<Reply> {
        let mut reply = self.reply_once(talk, command).await?;
        if reply.status == Status::WRONG_CHECKSUM {
            reply = self.reply_once(talk, command).await?;
        }
        if reply.status.is_ok() {
            return Ok(reply);
        }
        Err(Error::Refused { request: words(command), words: reply.status.to_string() })
    }

    async fn reply_once(&self, talk: &mut Talk<'_>, command: Command) -> Result<Reply> {
        let address = self.listens_at();
        let frame = exchange(talk, address, command, PATIENCE, show).await?;
        let meant = |reply: &Reply| {
            let opcode = reply.opcode == command.opcode || reply.status == Status::WRONG_CHECKSUM;
            let is_its = reply.module == address || address_after(command, reply) == Some(reply.module);
            opcode && (self.alone || is_its)
        };
        let reply = Reply::parse(&frame).ok().filter(meant).ok_or_else(|| malformed(talk, command, frame))?;
        self.follow(command, &reply);
        Ok(reply)
    }

    fn memory(&self) -> MutexGuard<'_, Memory> {
        // Every field is right by itself, whoever panicked.
        self.memory.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The address that a module has after a command that was to change it. The reply may come from the old one or the new.
fn address_after(command: Command, reply: &Reply) -> Option<u8> {
    let is_address = (command.kind, command.motor) == ADDRESS && reply.status.is_ok();
    match command.opcode {
        opcode::SGP if is_address => u8::try_from(command.value).ok(),
        opcode::RSGP if is_address => Some(reply.module),
        _ => None,
    }
}

/// Sends a command and gives the frame that comes back.
async fn exchange(
    talk: &mut Talk<'_>,
    address: u8,
    command: Command,
    patience: Duration,
    read: fn(Frame) -> String,
) -> Result<Frame> {
    let Command { opcode, kind, motor, value } = command;
    let request = Request { address, opcode, kind, motor, value }.emit();
    let show = |bytes: &[u8]| frame(bytes).map_or_else(String::new, read);
    let reply = talk.exchange(&request.0, &words(command), End::Length(FRAME_LENGTH), patience, show).await?;
    frame(&reply).ok_or_else(|| Error::Malformed { request: words(command), reply: hex(&reply) })
}

fn frame(bytes: &[u8]) -> Option<Frame> {
    bytes.try_into().ok().map(Frame)
}

/// Something else came than a reply to this command.
fn malformed(talk: &mut Talk<'_>, command: Command, frame: Frame) -> Error {
    talk.doubt();
    Error::Malformed { request: words(command), reply: hex(&frame.0) }
}

/// A command as people write it.
fn words(command: Command) -> String {
    match command.instruction() {
        Some(instruction) if instruction.mnemonic.is_some() => tmcl::disasm::command(command),
        _ => format!("command {}, type {}, value {}", command.opcode, command.kind, command.value),
    }
}

/// A reply in words.
fn show(frame: Frame) -> String {
    match Reply::parse(&frame) {
        Ok(reply) => format!("{}, value {}", reply.status, reply.value),
        Err(error) => error.to_string(),
    }
}

/// Asks the module with an address, or the one that is alone on a line, who it is.
pub(crate) async fn identify(bus: &Bus, address: u8, patience: Duration) -> Result<Found> {
    let mut talk = bus.talk().await;
    let command = Command::new(opcode::FIRMWARE_VERSION, 1, 0, 0);
    let frame = exchange(&mut talk, address, command, patience, show).await?;
    let reply = Reply::parse(&frame).ok().filter(|reply| reply.opcode == command.opcode);
    let reply = reply.ok_or_else(|| malformed(&mut talk, command, frame))?;
    let [high, low, major, minor] = reply.value.to_be_bytes();
    let module = u16::from_be_bytes([high, low]);
    let model = (module == MODULE).then(|| Model::Pd42.name().into());
    Ok(Found { address: reply.module, model, version: format!("{module}V{major}.{minor:02}") })
}
