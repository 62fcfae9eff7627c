//! Recordings: what happened, written to files while it happens.
//!
//! A [`Recorder`] is told of every train, change of a pin, change of a driver stage and standstill, and
//! is shown the axes from time to time. It keeps only what its format needs, so a recording may be as
//! long as the disk is large. A format is one file here and one line in [`create`].

mod csv;
mod mcap;
#[cfg(feature = "parquet")]
mod parquet;
mod plot;
mod read;
mod vcd;

pub use self::csv::{CsvRecorder, Detail};
pub use self::mcap::McapRecorder;
#[cfg(feature = "parquet")]
pub use self::parquet::ParquetRecorder;
pub use self::vcd::VcdRecorder;
pub use plot::{Picture, Plot, PlotRecorder};
pub use read::{READABLE, ReadError, read};

use crate::tape::{PortName, hex};

use devices::{AxisState, Drive, Pin, Port};
use motion::{Ticks, Train};
use std::{
    fs::File,
    io::BufWriter,
    path::{Path, PathBuf},
};

/// What a recorder has to know of a device.
#[derive(Clone, Debug)]
pub struct RecordInfo {
    /// Name of the device.
    pub device: String,
    /// Clocks a second.
    pub clock_hz: u32,
    /// Names of the axes.
    pub axes: &'static [&'static str],
    /// The pins; events name them by index.
    pub pins: &'static [Pin],
}

/// Something that happened to an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mark {
    /// It began to move.
    Started,
    /// It came to rest at its target.
    TargetReached,
    /// It came to rest elsewhere.
    Stopped,
}

impl Mark {
    /// Its name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Started => "started",
            Self::TargetReached => "target_reached",
            Self::Stopped => "stopped",
        }
    }
}

/// Something that happened to the device, or around it, that is no axis' and no pin's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Note {
    /// A fault begins.
    Fault,
    /// A fault is over. The text is that of its beginning.
    Cleared,
    /// A program had a command that was passed over.
    Notice,
    /// The power is on again.
    PowerUp,
}

impl Note {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Fault, Self::Cleared, Self::Notice, Self::PowerUp];

    /// Its name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fault => "fault",
            Self::Cleared => "cleared",
            Self::Notice => "notice",
            Self::PowerUp => "power_up",
        }
    }
}

/// Why a recording cannot be made; one line of text.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// No format has this extension.
    #[error("{}: no recording format with this extension, known: {FORMATS}", .0.display())]
    Format(PathBuf),
    /// The file cannot be written.
    #[error("{}: {problem}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What went wrong.
        problem: String,
    },
}

/// The extensions of all formats.
pub const FORMATS: &str = if cfg!(feature = "parquet") {
    ".csv, .mcap, .parquet, .png, .svg, .vcd"
} else {
    ".csv, .mcap, .png, .svg, .vcd (.parquet where it was built in)"
};

/// Takes down what happens. Times are clocks of device time and never fall, except that a train is told
/// of when it is over.
pub trait Recorder {
    /// How often [`sample`](Self::sample) is wanted, in clocks; `None` for never.
    fn sample_every(&self) -> Option<Ticks> {
        None
    }

    /// Pulses of an axis; `train.start` is in device time.
    fn train(&mut self, axis: usize, train: &Train);

    /// The driver stage of an axis changed.
    fn drive(&mut self, at: Ticks, axis: usize, drive: Drive);

    /// A pin has this level from now on: 0 or 1, or the board's integer of an analog one.
    fn pin(&mut self, at: Ticks, pin: usize, level: i32);

    /// An axis started or stopped.
    fn mark(&mut self, at: Ticks, axis: usize, mark: Mark);

    /// Something happened around the axes; `text` is a short line that says what.
    fn note(&mut self, _at: Ticks, _note: Note, _text: &str) {}

    /// What an axis looks like now.
    fn sample(&mut self, at: Ticks, axis: usize, state: &AxisState);

    /// Bytes came in at a port.
    fn received(&mut self, _at: Ticks, _port: Port, _bytes: &[u8]) {}

    /// Bytes left through a port.
    fn sent(&mut self, _at: Ticks, _port: Port, _bytes: &[u8]) {}

    /// The recording ends. Nothing is called after this.
    ///
    /// # Errors
    /// [`RecordError::Write`], also for whatever could not be written earlier.
    fn finish(&mut self, at: Ticks) -> Result<(), RecordError>;
}

/// A recorder for a file, by the file's extension.
///
/// # Errors
/// [`RecordError`].
pub fn create(path: &Path, info: &RecordInfo) -> Result<Box<dyn Recorder + Send>, RecordError> {
    if let Some(picture) = Picture::of(path) {
        // An unwritable place is better known before the run.
        open(path)?;
        return Ok(Box::new(PlotRecorder::new(path, picture, info)));
    }
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or("");
    match extension {
        "csv" => Ok(Box::new(CsvRecorder::new(open(path)?, path, info, Detail::Samples))),
        "mcap" => Ok(Box::new(McapRecorder::new(open(path)?, path, info)?)),
        #[cfg(feature = "parquet")]
        "parquet" => Ok(Box::new(ParquetRecorder::new(open(path)?, path, info)?)),
        "vcd" => Ok(Box::new(VcdRecorder::new(open(path)?, path, info))),
        _ => Err(RecordError::Format(path.into())),
    }
}

/// The file for the recording of a device: the one that was asked for, or beside others one with the device's name in
/// front of the extension.
pub fn file_of(path: &Path, device: &str, alone: bool) -> PathBuf {
    if alone {
        return path.into();
    }
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-{device}.{extension}"))
}

fn open(path: &Path) -> Result<BufWriter<File>, RecordError> {
    let file = File::create(path);
    file.map(BufWriter::new)
        .map_err(|error| RecordError::Write { path: path.into(), problem: error.to_string() })
}

/// Clocks as seconds with all their digits, or to a picosecond where there is no end of digits.
pub fn decimal_seconds(ticks: Ticks, clock_hz: u32) -> String {
    const DIGITS: usize = 12;
    let hz = u128::from(clock_hz);
    let scaled = (u128::from(ticks) * 10_u128.pow(DIGITS as u32) + hz / 2) / hz;
    let (whole, fraction) = (scaled / 10_u128.pow(DIGITS as u32), scaled % 10_u128.pow(DIGITS as u32));
    let text = format!("{whole}.{fraction:0DIGITS$}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Clocks as whole nanoseconds; an edge is in the one in which its clock begins.
fn nanoseconds(ticks: Ticks, clock_hz: u32) -> u64 {
    (u128::from(ticks) * 1_000_000_000 / u128::from(clock_hz)) as u64
}

/// Bytes on a wire as text.
fn wire_text(port: Port, bytes: &[u8]) -> String {
    format!("{} {}", PortName::from(port).name(), hex(bytes))
}

/// A device for the tests of the formats.
#[cfg(test)]
mod testing {
    use super::RecordInfo;
    use devices::{Pin, PinKind, Wiring};

    static PINS: &[Pin] = &[
        Pin {
            name: "motor supply",
            kind: PinKind::Analog,
            wiring: Wiring::Supply,
            unit: "V",
            scale: 1000,
            rest: 24_000,
        },
        Pin {
            name: "+LX",
            kind: PinKind::Input,
            wiring: Wiring::PositiveLimit(0),
            unit: "",
            scale: 1,
            rest: 0,
        },
    ];

    pub fn stage() -> RecordInfo {
        RecordInfo { device: "left stage".into(), clock_hz: 16_000_000, axes: &["X"], pins: PINS }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn several_devices_have_files_of_their_own() {
        let file = Path::new("runs/a.b.csv");
        assert_eq!(file_of(file, "stage", true), file);
        assert_eq!(file_of(file, "stage", false), Path::new("runs/a.b-stage.csv"));
    }

    #[test]
    fn seconds_are_exact() {
        for (ticks, hz, expected) in [
            (0, 16_000_000, "0"),
            (16_000_000, 16_000_000, "1"),
            (1, 16_000_000, "0.0000000625"),
            (160_000_001, 16_000_000, "10.0000000625"),
            (1, 3, "0.333333333333"),
            (Ticks::MAX, 16_000_000, "1152921504606.8469759375"),
        ] {
            assert_eq!(decimal_seconds(ticks, hz), expected);
        }
    }
}
