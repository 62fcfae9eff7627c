//! Running a standalone program in virtual time, from its download to its end.

mod ascript;
#[cfg(test)]
mod tests;
mod tmcl;

use crate::{
    device::{AxisView, PinError, TimedInput, VirtualDevice},
    fault::{FaultError, Planned},
};
use devices::{Language, Port, ProgramRun};
use motion::Ticks;
use serde::{Serialize, Serializer};
use std::{collections::BTreeMap, time::Instant};

/// A program in the form in which a device holds it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Program {
    /// Commands of TMCL, from address 0.
    Tmcl(Vec<::tmcl::Command>),
    /// Compiled lines of A-SCRIPT, from line 0.
    Ascript(Vec<::ascript::Line>),
}

/// How long a run without a time limit waits, after the program has ended, for the axes to stand.
pub const MAX_COAST_SECONDS: u64 = 60;

/// How often progress is reported, in device time.
const PROGRESS_PER_SECOND: u64 = 10;

/// How to run a program.
#[derive(Clone, Debug, Default)]
pub struct RunOptions {
    /// Seconds of device time after which the run ends at the latest; without it it ends with the
    /// program.
    pub for_seconds: Option<f64>,
    /// Inputs that change on the way; times count from the start of the program.
    pub inputs: Vec<TimedInput>,
    /// Faults; times count from the start of the program, and messages after its download.
    pub faults: Vec<Planned>,
}

/// Why a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopReason {
    /// The program ended, and the axes stand.
    Ended,
    /// The time was up.
    TimeUp,
    /// The program went into its error state.
    Error,
}

impl StopReason {
    /// Its name: `ended`, `time up`, `error`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ended => "ended",
            Self::TimeUp => "time up",
            Self::Error => "error",
        }
    }
}

impl Serialize for StopReason {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

/// What came out of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RunResult {
    /// Device time from the start of the program.
    pub device_seconds: f64,
    /// Time that it took.
    pub wall_seconds: f64,
    /// Why it ended.
    pub stop_reason: StopReason,
    /// Instructions of all programs.
    pub instructions: u64,
    /// The axes by name.
    pub axes: BTreeMap<&'static str, AxisResult>,
}

/// An axis at the end of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct AxisResult {
    /// Position counter in pulses.
    pub position: i32,
    /// Position as the encoder says.
    pub encoder: i32,
    /// All pulses, in both directions.
    pub steps: u64,
    /// The status word.
    pub status: u32,
}

impl From<AxisView> for AxisResult {
    fn from(axis: AxisView) -> Self {
        Self { position: axis.position, encoder: axis.encoder, steps: axis.steps, status: axis.status }
    }
}

/// How far a run has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Device time from the start of the program.
    pub device_seconds: f64,
    /// The limit, if there is one.
    pub for_seconds: Option<f64>,
}

/// Why a program cannot be run.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RunError {
    /// It is in another language.
    #[error("a {0} has programs of another language")]
    Language(&'static str),
    /// The device did not take a part of the download.
    #[error("the device answers {answer} to {command}")]
    Refused {
        /// What it was told.
        command: String,
        /// What it said.
        answer: String,
    },
    /// The device did not answer to a part of the download.
    #[error("the device does not answer to {0}")]
    Silent(String),
    /// A planned input is not possible.
    #[error(transparent)]
    Pin(#[from] PinError),
    /// A planned fault is not possible.
    #[error(transparent)]
    Fault(#[from] FaultError),
}

/// Runs a program until it ends or the time is up. Of A-SCRIPT all programs are started that there are, as
/// at a power-up with all bits of `SLOAD` set.
///
/// The program has ended when it stands and so do the axes, so that a program whose last command is a
/// move shows its outcome.
///
/// # Errors
/// [`RunError`].
pub fn run(
    device: &mut VirtualDevice,
    program: &Program,
    options: &RunOptions,
    mut progress: impl FnMut(Progress),
) -> Result<RunResult, RunError> {
    let wall = Instant::now();
    load(device, program)?;
    let start = device.now();
    for timed in &options.inputs {
        device.schedule(start.saturating_add(device.ticks(timed.seconds)), &timed.input)?;
    }
    for planned in &options.faults {
        device.plan(planned)?;
    }
    let instructions = device.instructions();
    self::start(device, program)?;

    let limit = options.for_seconds.map(|seconds| start.saturating_add(device.ticks(seconds)));
    let end = limit.unwrap_or(Ticks::MAX);
    let hz = u64::from(device.clock_hz());
    let mut report_at = start;
    let mut ended_at = None;
    let stop_reason = loop {
        if device.programs().any(|program| program.run == ProgramRun::Error) {
            break StopReason::Error;
        }
        if device.programs().all(|program| program.run == ProgramRun::Idle) {
            let since = *ended_at.get_or_insert(device.now());
            // Who has no supply has not ended: it may start again.
            let standing =
                device.is_powered() && (0..device.axes().len()).all(|axis| device.axis(axis).speed_mpps == 0);
            let coasted = limit.is_none() && device.now() >= since + MAX_COAST_SECONDS * hz;
            if standing || coasted {
                break StopReason::Ended;
            }
        }
        if device.now() >= end {
            break StopReason::TimeUp;
        }
        if device.now() >= report_at {
            progress(Progress { device_seconds: seconds(device, start), for_seconds: options.for_seconds });
            report_at = device.now() + hz / PROGRESS_PER_SECOND;
        }
        // No later than the next report, so that a device with nothing to do is heard of too; when all programs have
        // ended, to the next moment at which the axes may have come to rest.
        let look_at = if ended_at.is_some() { device.wake() } else { Ticks::MAX };
        device.advance_some(look_at.min(report_at).min(end));
    };
    let axes = device.state().axes.into_iter().map(|(name, axis)| (name, axis.into())).collect();
    Ok(RunResult {
        device_seconds: seconds(device, start),
        wall_seconds: wall.elapsed().as_secs_f64(),
        stop_reason,
        instructions: device.instructions() - instructions,
        axes,
    })
}

fn seconds(device: &VirtualDevice, start: Ticks) -> f64 {
    (device.now() - start) as f64 / f64::from(device.clock_hz())
}

/// Downloads a program over the wire, as a host does, and leaves it standing.
///
/// # Errors
/// [`RunError`].
pub fn load(device: &mut VirtualDevice, program: &Program) -> Result<(), RunError> {
    let model = device.config().model;
    match (program, model.language) {
        (Program::Tmcl(commands), Language::Tmcl) => tmcl::load(device, commands),
        (Program::Ascript(lines), Language::Ascript(dialect)) => ascript::load(device, dialect, lines),
        _ => Err(RunError::Language(model.name)),
    }
}

/// Starts a program that was [loaded](load): of A-SCRIPT all that there are.
///
/// # Errors
/// [`RunError`].
pub fn start(device: &mut VirtualDevice, program: &Program) -> Result<(), RunError> {
    let model = device.config().model;
    match (program, model.language) {
        (Program::Tmcl(_), Language::Tmcl) => tmcl::start(device),
        (Program::Ascript(lines), Language::Ascript(dialect)) => ascript::start(device, dialect, lines),
        _ => Err(RunError::Language(model.name)),
    }
}

/// Sends bytes over USB, where any address will do, and gives what comes back.
fn exchange(device: &mut VirtualDevice, bytes: &[u8]) -> Option<Vec<u8>> {
    device.drain_sent().for_each(drop);
    device.receive(Port::Usb, bytes);
    device.drain_sent().find(|sent| sent.port == Port::Usb).map(|sent| sent.bytes)
}
