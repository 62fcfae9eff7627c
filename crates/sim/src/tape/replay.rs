//! A tape played again.

use super::{Act, ERASED, Entry, Head, State, TapeError, VERSION, unhex};
use crate::{
    config::{Bench, DeviceConfig},
    device::{Input, VirtualDevice},
    flash::SharedFlash,
};
use std::{
    fs::File,
    io::{BufRead, BufReader, Read as _},
    path::{Path, PathBuf},
};

/// The longest line of a tape: a head with the flash of as many devices as a bench has.
const MAX_LINE_BYTES: u64 = 256 << 20;

/// A tape that is being read.
pub struct Reader<R: BufRead> {
    input: R,
    path: PathBuf,
    line: usize,
}

impl Reader<BufReader<File>> {
    /// The tape in a file.
    ///
    /// # Errors
    /// [`TapeError::File`].
    pub fn open(path: &Path) -> Result<Self, TapeError> {
        match File::open(path) {
            Ok(file) => Ok(Self::new(BufReader::new(file), path)),
            Err(problem) => Err(TapeError::File { path: path.into(), problem }),
        }
    }
}

impl<R: BufRead> Reader<R> {
    /// A tape from anywhere; `path` is its name for messages.
    pub fn new(input: R, path: &Path) -> Self {
        Self { input, path: path.into(), line: 0 }
    }

    /// Builds the devices of the tape as they were before its first act.
    ///
    /// # Errors
    /// [`TapeError`].
    pub fn replay(mut self) -> Result<Replay<R>, TapeError> {
        let head: Head = self.next()?.ok_or_else(|| self.wrong("a tape begins with its devices"))?;
        if head.pulsetrain_tape != VERSION {
            let problem = format!("a tape of version {}, known is {VERSION}", head.pulsetrain_tape);
            return Err(self.wrong(problem));
        }
        let bench = Bench::parse(&head.bench, "bench").map_err(|error| self.wrong(error))?;
        if bench.devices.len() != head.devices.len() {
            return Err(self.wrong("the bench has other devices than the tape"));
        }
        let devices = bench.devices.iter().zip(&head.devices).map(|(config, state)| {
            let flash = flash(config, state).ok_or_else(|| self.wrong("rows of flash out of place"))?;
            Ok(VirtualDevice::with_flash(config, flash, state.seed))
        });
        let devices = devices.collect::<Result<_, TapeError>>()?;
        Ok(Replay { devices, tape: self })
    }

    /// The next line; `None` at the end.
    fn next<T: serde::de::DeserializeOwned>(&mut self) -> Result<Option<T>, TapeError> {
        let mut line = Vec::new();
        self.line += 1;
        let read = (&mut self.input).take(MAX_LINE_BYTES).read_until(b'\n', &mut line);
        match read {
            Ok(0) => Ok(None),
            Ok(_) => serde_json::from_slice(&line).map(Some).map_err(|error| self.wrong(error)),
            Err(problem) => Err(TapeError::File { path: self.path.clone(), problem }),
        }
    }

    fn wrong(&self, problem: impl ToString) -> TapeError {
        TapeError::Line { path: self.path.clone(), line: self.line, problem: problem.to_string() }
    }
}

/// The flash of a device; `None` if a row does not lie in it.
fn flash(config: &DeviceConfig, state: &State) -> Option<SharedFlash> {
    let mut bytes = vec![ERASED; config.model.flash_bytes as usize];
    for (offset, row) in &state.flash {
        let row = unhex(row)?;
        let start = *offset as usize;
        bytes.get_mut(start..start.checked_add(row.len())?)?.copy_from_slice(&row);
    }
    Some(SharedFlash::from_bytes(bytes))
}

/// The devices of a tape, and what is still to come.
pub struct Replay<R: BufRead> {
    devices: Vec<VirtualDevice>,
    tape: Reader<R>,
}

impl<R: BufRead> Replay<R> {
    /// The devices, in the order of the tape.
    pub fn devices(&mut self) -> &mut [VirtualDevice] {
        &mut self.devices
    }

    /// Plays the tape to its end. After each act `seen` is shown the device, with its number, and the act.
    ///
    /// # Errors
    /// [`TapeError`]; also where the device refuses what it took when the tape was made.
    pub fn play(&mut self, mut seen: impl FnMut(usize, &mut VirtualDevice, &Act)) -> Result<(), TapeError> {
        while let Some(Entry { device: number, at, act }) = self.tape.next()? {
            let Some(device) = self.devices.get_mut(number) else {
                return Err(self.tape.wrong(format!("there is no device {number}")));
            };
            if at < device.now() {
                return Err(self.tape.wrong(format!("clock {at} has passed")));
            }
            // At one clock nothing comes between two acts that did not when the tape was made.
            if at > device.now() {
                device.advance(at);
            }
            perform(device, &act).map_err(|problem| self.tape.wrong(problem))?;
            seen(number, device, &act);
        }
        Ok(())
    }
}

/// Tells a device what a tape says.
///
/// # Errors
/// What the device says against it.
pub fn perform(device: &mut VirtualDevice, act: &Act) -> Result<(), String> {
    fn text(error: impl ToString) -> String {
        error.to_string()
    }
    match act {
        Act::Receive(port, bytes) => {
            let bytes = unhex(bytes).ok_or("bytes are pairs of hexadecimal digits")?;
            device.receive((*port).into(), &bytes);
        }
        Act::HangUp(port) => device.hang_up((*port).into()),
        Act::Pin(pin, Some(value)) => device.drive_pin(pin, *value).map_err(text)?,
        Act::Pin(pin, None) => device.release_pin(pin).map_err(text)?,
        Act::Plan(at, pin, value) => {
            device.schedule(*at, &Input { pin: pin.clone(), value: *value }).map_err(text)?;
        }
        Act::Register(name, value) => {
            if !device.set_register(name, *value) {
                return Err(format!("no register `{name}` can be set"));
            }
        }
        Act::Load(axis, load) => device.set_load(axis, *load).map_err(text)?,
        Act::Switches(axis, switches) => device.move_switches(axis, switches).map_err(text)?,
        Act::Push(axis, distance) => device.push(axis, *distance).map_err(text)?,
        Act::Lose(axis, pulses) => device.lose(axis, *pulses).map_err(text)?,
        Act::Mpg(axis, counts) => device.pulser(axis, *counts).map_err(text)?,
        Act::PowerCycle => device.power_cycle(),
        Act::PowerCut => device.power_cut(),
        Act::Fault(entry) => drop(device.plan_entry(entry).map_err(text)?),
        Act::Clear(Some(id)) => device.clear_fault(*id).map_err(text)?,
        Act::Clear(None) => device.clear_faults(),
        Act::End => {}
    }
    Ok(())
}
