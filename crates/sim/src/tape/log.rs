//! What happened, as lines of text that are the same whenever the same happens: however the time was cut into
//! pieces, and whatever else was recorded.

use super::{PortName, hex};
use crate::record::{Mark, RecordError, RecordInfo, Recorder, decimal_seconds};
use devices::{AxisState, Drive, Port};
use motion::{Direction, Ticks, Train};
use std::{
    io::{self, Write},
    path::PathBuf,
};

/// Writes a line for everything that crosses the pins or the wires, and at the end one for each axis: its pulses,
/// how far they went, and a checksum of the clock and direction of every one.
pub struct Log<W: Write> {
    output: W,
    path: PathBuf,
    info: RecordInfo,
    axes: Vec<Pulses>,
    failure: Option<io::Error>,
}

/// The pulses of an axis.
#[derive(Clone)]
struct Pulses {
    count: u64,
    net: i64,
    checksum: u64,
}

impl Pulses {
    /// FNV-1a of 64 bits.
    const NONE: Self = Self { count: 0, net: 0, checksum: 0xCBF2_9CE4_8422_2325 };
    const PRIME: u64 = 0x100_0000_01B3;

    fn add(&mut self, edge: Ticks, direction: Direction) {
        self.count += 1;
        self.net += direction.sign();
        for byte in (edge << 1 | u64::from(direction == Direction::Positive)).to_le_bytes() {
            self.checksum = (self.checksum ^ u64::from(byte)).wrapping_mul(Self::PRIME);
        }
    }
}

impl<W: Write> Log<W> {
    /// A log that is written to `output`; `path` is its name for messages.
    pub fn new(output: W, path: impl Into<PathBuf>, info: &RecordInfo) -> Self {
        let axes = vec![Pulses::NONE; info.axes.len()];
        Self { output, path: path.into(), info: info.clone(), axes, failure: None }
    }

    fn line(&mut self, at: Ticks, what: &str) {
        if self.failure.is_none() {
            let seconds = decimal_seconds(at, self.info.clock_hz);
            self.failure = writeln!(self.output, "{seconds} {} {what}", self.info.device).err();
        }
    }
}

impl<W: Write> Recorder for Log<W> {
    fn train(&mut self, axis: usize, train: &Train) {
        train.edges().for_each(|edge| self.axes[axis].add(edge, train.direction));
    }

    fn drive(&mut self, at: Ticks, axis: usize, drive: Drive) {
        let Drive { step, parts, current } = drive;
        let axis = self.info.axes[axis];
        self.line(at, &format!("drive {axis}: step {step}/{parts}, current {current}/32"));
    }

    fn pin(&mut self, at: Ticks, pin: usize, level: i32) {
        let pin = &self.info.pins[pin];
        self.line(at, &format!("pin {} {}", pin.name, f64::from(level) / f64::from(pin.scale)));
    }

    /// When a motion is seen to begin depends on when somebody looks.
    fn mark(&mut self, _at: Ticks, _axis: usize, _mark: Mark) {}

    fn sample(&mut self, _at: Ticks, _axis: usize, _state: &AxisState) {}

    fn received(&mut self, at: Ticks, port: Port, bytes: &[u8]) {
        self.line(at, &format!("received {} {}", PortName::from(port).name(), hex(bytes)));
    }

    fn sent(&mut self, at: Ticks, port: Port, bytes: &[u8]) {
        self.line(at, &format!("sent {} {}", PortName::from(port).name(), hex(bytes)));
    }

    fn finish(&mut self, at: Ticks) -> Result<(), RecordError> {
        for (axis, Pulses { count, net, checksum }) in self.axes.clone().into_iter().enumerate() {
            let axis = self.info.axes[axis];
            self.line(at, &format!("axis {axis}: {count} pulses, {net} in sum, checksum {checksum:016x}"));
        }
        let flushed = self.output.flush();
        let result = self.failure.take().map_or(flushed, Err);
        result.map_err(|error| RecordError::Write { path: self.path.clone(), problem: error.to_string() })
    }
}
