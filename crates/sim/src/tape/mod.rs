//! Tapes: everything that devices were told from outside, so that a run can be had again, pulse for pulse.
//!
//! What a device does is a function of its configuration, the seed of its random numbers, what was in its flash, and
//! what it was told at which clock. A tape (`.ptr`) is exactly that, as lines of JSON: first a head, then an entry
//! for each act, in the order in which they happened. Each device has its own clock; devices do not know
//! each other, so only the order of the acts of one device matters.

mod log;
mod replay;
#[cfg(test)]
mod tests;

pub use log::Log;
pub use replay::{Reader, Replay, perform};

use crate::{
    config::DeviceConfig,
    device::{PinValue, Switches},
    fault::Entry as Fault,
    flash::SharedFlash,
};
use devices::Port;
use motion::Ticks;
use serde::{Deserialize, Serialize};
use std::{
    fs::File,
    io::{self, BufWriter, Write},
    path::{Path, PathBuf},
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

/// The extension of a tape.
pub const EXTENSION: &str = "ptr";

/// Whether a recording to this file is a tape.
pub fn is_tape(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == EXTENSION)
}

/// The version of the format that is written. Others cannot be read.
pub const VERSION: u32 = 1;

/// Bytes of flash in one row.
const ROW_BYTES: usize = 64;

/// What an erased byte of flash is.
const ERASED: u8 = 0xFF;

/// Why a tape cannot be written or read; one line of text.
#[derive(Debug, thiserror::Error)]
pub enum TapeError {
    /// The file cannot be used.
    #[error("{}: {problem}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        problem: io::Error,
    },
    /// A line is not what a tape has.
    #[error("{}:{line}: {problem}", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// What is wrong.
        problem: String,
    },
}

/// The first line of a tape.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Head {
    /// [`VERSION`].
    pulsetrain_tape: u32,
    /// The devices as a bench file.
    bench: String,
    /// What each of them has beside it.
    devices: Vec<State>,
}

/// What a device had before it was switched on for the first time.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct State {
    seed: u64,
    /// The rows of its flash that are not erased: offset, bytes in hexadecimal.
    flash: Vec<(u32, String)>,
}

impl State {
    fn new(seed: u64, flash: &SharedFlash) -> Self {
        let bytes = flash.to_bytes();
        let rows = (0_u32..).step_by(ROW_BYTES).zip(bytes.chunks(ROW_BYTES));
        let used = rows.filter(|(_, row)| row.iter().any(|byte| *byte != ERASED));
        Self { seed, flash: used.map(|(offset, row)| (offset, hex(row))).collect() }
    }
}

/// One line of a tape.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    /// Number of the device.
    #[serde(default, skip_serializing_if = "is_zero")]
    device: usize,
    /// Its clock.
    at: Ticks,
    act: Act,
}

fn is_zero(number: &usize) -> bool {
    *number == 0
}

/// What a device is told from outside.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Act {
    /// Bytes, in hexadecimal, arrive at a port.
    Receive(PortName, String),
    /// Whoever was sending at the port has gone.
    HangUp(PortName),
    /// An input is driven by hand, or given back.
    Pin(String, Option<PinValue>),
    /// An input is planned to change at a clock.
    Plan(Ticks, String, Option<PinValue>),
    /// A debugger sets a register of a program.
    Register(String, i32),
    /// The load of an axis changes.
    Load(String, f64),
    /// Switches of an axis are moved.
    Switches(String, Switches),
    /// An axis is turned from outside.
    Push(String, i64),
    /// An axis loses pulses.
    Lose(String, u64),
    /// A hand wheel is turned.
    Mpg(String, i64),
    /// The supply is switched off and on.
    PowerCycle,
    /// The supply is cut.
    PowerCut,
    /// A fault is planned.
    Fault(Box<Fault>),
    /// A fault is cleared by its number, or all are.
    Clear(Option<u64>),
    /// The end of the tape.
    End,
}

impl Act {
    /// The act of a host that sends these bytes to a port.
    pub fn receive(port: Port, bytes: &[u8]) -> Self {
        Self::Receive(port.into(), hex(bytes))
    }
}

/// A port, by its name in files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum PortName {
    /// USB.
    Usb,
    /// RS-485.
    Rs485,
    /// CAN.
    Can,
}

impl PortName {
    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Usb => "usb",
            Self::Rs485 => "rs485",
            Self::Can => "can",
        }
    }
}

impl From<Port> for PortName {
    fn from(port: Port) -> Self {
        match port {
            Port::Usb => Self::Usb,
            Port::Rs485 => Self::Rs485,
            Port::Can => Self::Can,
        }
    }
}

impl From<PortName> for Port {
    fn from(name: PortName) -> Self {
        match name {
            PortName::Usb => Self::Usb,
            PortName::Rs485 => Self::Rs485,
            PortName::Can => Self::Can,
        }
    }
}

/// A tape that is being written. Its devices share it.
#[derive(Clone)]
pub struct Tape(Arc<Mutex<Reel>>);

struct Reel {
    path: PathBuf,
    output: Box<dyn Write + Send>,
    failure: Option<io::Error>,
}

impl Tape {
    /// Begins a tape for devices that have not been switched on: configuration, seed and flash of each.
    ///
    /// # Errors
    /// [`TapeError::File`].
    pub fn create(path: &Path, devices: &[(&DeviceConfig, u64, &SharedFlash)]) -> Result<Self, TapeError> {
        let file = File::create(path).map_err(|problem| TapeError::File { path: path.into(), problem })?;
        Ok(Self::new(Box::new(BufWriter::new(file)), path, devices))
    }

    /// The same on something else that takes bytes; `path` is its name for messages.
    pub fn new(
        output: Box<dyn Write + Send>,
        path: &Path,
        devices: &[(&DeviceConfig, u64, &SharedFlash)],
    ) -> Self {
        let configs: Vec<_> = devices.iter().map(|(config, ..)| (*config).clone()).collect();
        let head = Head {
            pulsetrain_tape: VERSION,
            bench: crate::config::bench_text(&configs),
            devices: devices.iter().map(|(_, seed, flash)| State::new(*seed, flash)).collect(),
        };
        let tape = Self(Arc::new(Mutex::new(Reel { path: path.into(), output, failure: None })));
        tape.reel().put(&head);
        tape
    }

    /// The part of a device, by its number.
    pub fn track(&self, device: usize) -> Track {
        Track { tape: self.clone(), device }
    }

    /// Brings everything to the disk.
    ///
    /// # Errors
    /// [`TapeError::File`], also for whatever could not be written earlier.
    pub fn finish(&self) -> Result<(), TapeError> {
        let mut reel = self.reel();
        let flushed = reel.output.flush();
        let result = reel.failure.take().map_or(flushed, Err);
        result.map_err(|problem| TapeError::File { path: reel.path.clone(), problem })
    }

    fn reel(&self) -> MutexGuard<'_, Reel> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Reel {
    fn put(&mut self, line: &impl Serialize) {
        if self.failure.is_none() {
            let written = serde_json::to_writer(&mut self.output, line).map_err(io::Error::from);
            self.failure = written.and_then(|()| self.output.write_all(b"\n")).err();
        }
    }
}

/// The part of one device on a tape.
pub struct Track {
    tape: Tape,
    device: usize,
}

impl Track {
    /// The device was told this at its clock `at`.
    pub fn put(&self, at: Ticks, act: Act) {
        self.tape.reel().put(&Entry { device: self.device, at, act });
    }
}

/// Bytes as text.
pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Text as bytes; `None` if it is not pairs of digits.
pub(crate) fn unhex(text: &str) -> Option<Vec<u8>> {
    if !text.is_ascii() || !text.len().is_multiple_of(2) {
        return None;
    }
    (0..text.len()).step_by(2).map(|at| u8::from_str_radix(&text[at..at + 2], 16).ok()).collect()
}
