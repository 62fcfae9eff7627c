//! A value change dump, for waveform viewers (GTKWave, sigrok).
//!
//! One scope for the device, in it one for each axis and one for the pins. Viewers that show names without their
//! scopes can tell the axes apart all the same: the variables of axis X end in `_X`.
//!
//! | variable | kind | meaning |
//! |---|---|---|
//! | `step` | wire | rises at each pulse, for [`PULSE_NS`] or half the way to the next one |
//! | `dir` | wire | 1 where the counter rises |
//! | `moving` | wire | from the start of a motion to standstill |
//! | `current` | 6 wires | coil current in 1/32 of the module's maximum |
//! | `position`, `encoder` | integer | counters of the axis, every [`SAMPLE_MS`] where they change |
//! | `speed` | real | pulses a second, likewise |
//! | pins | wire or real | level, or number in the pin's unit |
//!
//! Starts and stops of axes and what happened around them stand between the changes as comments: `axis X started`,
//! `event fault TEXT`; the units of pins in the head: `unit SUPPLY V`.
//!
//! Times are nanoseconds, each rounded down from its clock by itself, so that nothing adds up.

use super::{Mark, Note, RecordError, RecordInfo, Recorder, nanoseconds};
use devices::{AxisState, Drive};
use motion::{Direction, Ticks, Train};
use std::{collections::VecDeque, io, io::Write, path::PathBuf};
use vcd::{IdCode, SimulationCommand, TimescaleUnit, Value, VarType};

/// How long a step wire is high if the next pulse leaves the time.
pub const PULSE_NS: u64 = 1000;

/// How often the counters are looked at.
pub const SAMPLE_MS: u64 = 1;

/// Bits of the coil current.
const CURRENT_BITS: u32 = 6;

/// Bits of a counter.
const COUNTER_BITS: u32 = 32;

/// What a variable becomes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Change {
    Level(bool),
    Vector { bits: u32, value: u32 },
    Real(f64),
}

impl Change {
    fn counter(value: i32) -> Self {
        Self::Vector { bits: COUNTER_BITS, value: value as u32 }
    }

    fn write(self, id: IdCode, writer: &mut vcd::Writer<impl Write>) -> io::Result<()> {
        match self {
            Self::Level(on) => writer.change_scalar(id, on),
            Self::Vector { bits, value } => {
                writer.change_vector(id, (0..bits).rev().map(|bit| Value::from(value >> bit & 1 == 1)))
            }
            Self::Real(value) => writer.change_real(id, value),
        }
    }
}

/// A variable, and what was written of it last.
struct Variable {
    id: IdCode,
    shown: Change,
}

/// The variables of an axis: places in the list of all.
struct AxisVariables {
    step: usize,
    dir: usize,
    moving: usize,
    current: usize,
    position: usize,
    encoder: usize,
    speed: usize,
    /// Pulses that are not written, and one before them whose end may be open.
    edges: VecDeque<u64>,
    /// Whether the first of them is written, but not its end.
    is_high: bool,
}

/// Writes VCD to a file or elsewhere.
pub struct VcdRecorder<W: Write> {
    writer: vcd::Writer<W>,
    path: PathBuf,
    info: RecordInfo,
    variables: Vec<Variable>,
    axes: Vec<AxisVariables>,
    pins: Vec<usize>,
    /// Changes since the last look at the axes: when, of which variable. An axis tells of its pulses when a
    /// train is over, so they come together from there and are put in order.
    pending: Vec<(u64, usize, Change)>,
    /// Comments since then.
    remarks: VecDeque<(u64, String)>,
    /// The time that was written last.
    written: u64,
    failure: Option<io::Error>,
}

impl<W: Write> VcdRecorder<W> {
    /// A recorder that writes to `output`; `path` is its name for messages.
    pub fn new(output: W, path: impl Into<PathBuf>, info: &RecordInfo) -> Self {
        let mut recorder = Self {
            writer: vcd::Writer::new(output),
            path: path.into(),
            info: info.clone(),
            variables: Vec::new(),
            axes: Vec::new(),
            pins: Vec::new(),
            pending: Vec::new(),
            remarks: VecDeque::new(),
            written: 0,
            failure: None,
        };
        recorder.failure = recorder.head().err();
        recorder
    }

    fn head(&mut self) -> io::Result<()> {
        self.writer.version("pulsetrain")?;
        self.writer.timescale(1, TimescaleUnit::NS)?;
        self.writer.add_module(&word(&self.info.device))?;
        let level = Change::Level(false);
        let counter = Change::counter(0);
        for &name in self.info.axes {
            self.writer.add_module(&format!("axis_{name}"))?;
            let axis = AxisVariables {
                step: self.variable(&format!("step_{name}"), level)?,
                dir: self.variable(&format!("dir_{name}"), Change::Level(true))?,
                moving: self.variable(&format!("moving_{name}"), level)?,
                current: self
                    .variable(&format!("current_{name}"), Change::Vector { bits: CURRENT_BITS, value: 0 })?,
                position: self.variable(&format!("position_{name}"), counter)?,
                encoder: self.variable(&format!("encoder_{name}"), counter)?,
                speed: self.variable(&format!("speed_{name}"), Change::Real(0.0))?,
                edges: VecDeque::new(),
                is_high: false,
            };
            self.axes.push(axis);
            self.writer.upscope()?;
        }
        for pin in self.info.pins.iter().filter(|pin| !pin.unit.is_empty()) {
            self.writer.comment(&format!("unit {} {}", word(pin.name), pin.unit))?;
        }
        self.writer.add_module("pins")?;
        for pin in self.info.pins {
            let first = if pin.kind.is_analog() { Change::Real(0.0) } else { level };
            let variable = self.variable(&word(pin.name), first)?;
            self.pins.push(variable);
        }
        self.writer.upscope()?;
        self.writer.upscope()?;
        self.writer.enddefinitions()?;
        self.writer.timestamp(0)?;
        self.writer.begin(SimulationCommand::Dumpvars)?;
        for variable in &self.variables {
            variable.shown.write(variable.id, &mut self.writer)?;
        }
        self.writer.end()
    }

    fn variable(&mut self, name: &str, first: Change) -> io::Result<usize> {
        let (kind, bits) = match first {
            Change::Level(_) => (VarType::Wire, 1),
            Change::Vector { bits: COUNTER_BITS, .. } => (VarType::Integer, COUNTER_BITS),
            Change::Vector { bits, .. } => (VarType::Wire, bits),
            Change::Real(_) => (VarType::Real, u64::BITS),
        };
        let id = self.writer.add_var(kind, bits, name, None)?;
        self.variables.push(Variable { id, shown: first });
        Ok(self.variables.len() - 1)
    }

    fn nanoseconds(&self, at: Ticks) -> u64 {
        nanoseconds(at, self.info.clock_hz)
    }

    fn push(&mut self, at: Ticks, variable: usize, change: Change) {
        self.pending.push((self.nanoseconds(at), variable, change));
    }

    /// Makes rising and falling wires of the pulses until `until`.
    fn raise(&mut self, until: u64) {
        for axis in &mut self.axes {
            while let Some(&edge) = axis.edges.front() {
                if edge > until {
                    break;
                }
                if !axis.is_high {
                    self.pending.push((edge, axis.step, Change::Level(true)));
                    axis.is_high = true;
                }
                let fall = axis.edges.get(1).map_or(PULSE_NS, |next| ((next - edge) / 2).min(PULSE_NS));
                if axis.edges.len() == 1 && edge + fall > until {
                    // The next pulse may come before that.
                    break;
                }
                self.pending.push((edge + fall, axis.step, Change::Level(false)));
                axis.is_high = false;
                axis.edges.pop_front();
            }
        }
    }

    /// Writes what is known to be complete: everything until `until`.
    fn flush(&mut self, until: u64) {
        self.raise(until);
        // Stable: changes of one variable in one nanosecond stay in their order.
        self.pending.sort_by_key(|(at, ..)| *at);
        let complete = self.pending.partition_point(|(at, ..)| *at <= until);
        let changes: Vec<_> = self.pending.drain(..complete).collect();
        for (at, variable, change) in changes {
            self.write_remarks(at);
            if self.failure.is_none() {
                self.failure = self.write(at, variable, change).err();
            }
        }
        self.write_remarks(until);
    }

    /// Writes the comments until `until`.
    fn write_remarks(&mut self, until: u64) {
        while let Some((at, text)) = self.remarks.pop_front_if(|(at, _)| *at <= until) {
            if self.failure.is_none() {
                self.failure = self.advance(at).and_then(|()| self.writer.comment(&text)).err();
            }
        }
    }

    /// The time is this, if it is later than the one that was written last.
    fn advance(&mut self, at: u64) -> io::Result<()> {
        if at > self.written {
            self.writer.timestamp(at)?;
            self.written = at;
        }
        Ok(())
    }

    fn write(&mut self, at: u64, variable: usize, change: Change) -> io::Result<()> {
        if self.variables[variable].shown == change {
            return Ok(());
        }
        self.advance(at)?;
        let variable = &mut self.variables[variable];
        variable.shown = change;
        change.write(variable.id, &mut self.writer)
    }
}

impl<W: Write> Recorder for VcdRecorder<W> {
    fn sample_every(&self) -> Option<Ticks> {
        Some(Ticks::from(self.info.clock_hz) * SAMPLE_MS / 1000)
    }

    fn train(&mut self, axis: usize, train: &Train) {
        // Behind the pulse before, which may be in the same nanosecond.
        let turn = self.nanoseconds(train.start.ticks) + 1;
        let positive = train.direction == Direction::Positive;
        self.pending.push((turn, self.axes[axis].dir, Change::Level(positive)));
        for edge in train.edges() {
            let edge = self.nanoseconds(edge);
            self.axes[axis].edges.push_back(edge);
        }
    }

    fn drive(&mut self, at: Ticks, axis: usize, drive: Drive) {
        let value = drive.current.into();
        self.push(at, self.axes[axis].current, Change::Vector { bits: CURRENT_BITS, value });
    }

    fn pin(&mut self, at: Ticks, pin: usize, level: i32) {
        let analog = &self.info.pins[pin];
        let change = if analog.kind.is_analog() {
            Change::Real(f64::from(level) / f64::from(analog.scale))
        } else {
            Change::Level(level != 0)
        };
        self.push(at, self.pins[pin], change);
    }

    fn mark(&mut self, at: Ticks, axis: usize, mark: Mark) {
        self.push(at, self.axes[axis].moving, Change::Level(mark == Mark::Started));
        let remark = format!("axis {} {}", self.info.axes[axis], mark.name());
        self.remarks.push_back((self.nanoseconds(at), remark));
    }

    fn note(&mut self, at: Ticks, note: Note, text: &str) {
        // A `$` would end the comment.
        let remark = format!("event {} {}", note.name(), text.replace('$', "_"));
        self.remarks.push_back((self.nanoseconds(at), remark));
    }

    fn sample(&mut self, at: Ticks, axis: usize, state: &AxisState) {
        let AxisVariables { position, encoder, speed, .. } = self.axes[axis];
        self.push(at, position, Change::counter(state.position));
        self.push(at, encoder, Change::counter(state.encoder));
        self.push(at, speed, Change::Real(state.speed_mpps as f64 / 1000.0));
        // The axes are shown together, after all that happened until then.
        if axis + 1 == self.axes.len() {
            self.flush(self.nanoseconds(at));
        }
    }

    fn finish(&mut self, at: Ticks) -> Result<(), RecordError> {
        let end = self.nanoseconds(at);
        // A last pulse ends after the recording.
        self.flush(end + PULSE_NS);
        let flushed = self.advance(end).and_then(|()| self.writer.flush());
        match self.failure.take().map_or(flushed, Err) {
            Ok(()) => Ok(()),
            Err(error) => Err(RecordError::Write { path: self.path.clone(), problem: error.to_string() }),
        }
    }
}

/// A name without white space, as identifiers are in this format.
fn word(name: &str) -> String {
    name.split_whitespace().collect::<Vec<_>>().join("_")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::testing::stage;
    use ::vcd::Command;
    use motion::{Moment, train::EVERY_SLOT};

    /// The changes of a variable with their times, as a reader of the format sees them.
    fn changes(file: &[u8], path: &[&str]) -> Vec<(u64, String)> {
        let mut parser = ::vcd::Parser::new(file);
        let header = parser.parse_header().unwrap();
        let id = header.find_var(path).unwrap_or_else(|| panic!("no variable {path:?}")).code;
        let (mut now, mut changes) = (0, Vec::new());
        for command in parser {
            match command.unwrap() {
                Command::Timestamp(at) => {
                    assert!(at > now || at == 0, "time moves forward: {at} after {now}");
                    now = at;
                }
                Command::ChangeScalar(code, value) if code == id => changes.push((now, value.to_string())),
                Command::ChangeReal(code, value) if code == id => changes.push((now, value.to_string())),
                Command::ChangeVector(code, value) if code == id => changes.push((now, value.to_string())),
                _ => {}
            }
        }
        changes
    }

    #[track_caller]
    fn check(file: &[u8], path: &[&str], expected: &[(u64, &str)]) {
        let found = changes(file, path);
        let found: Vec<_> = found.iter().map(|(at, value)| (*at, value.as_str())).collect();
        assert_eq!(found, expected, "{path:?}");
    }

    #[test]
    fn pulses_come_in_order_with_what_happened_meanwhile() {
        let mut file = Vec::new();
        let mut recorder = VcdRecorder::new(&mut file, "a.vcd", &stage());
        recorder.pin(0, 0, 12_500);
        recorder.drive(8, 0, Drive { step: 1, parts: 1, current: 31 });
        recorder.pin(40, 1, 1);
        recorder.mark(1, 0, Mark::Started);
        let plain = Train {
            start: Moment::at(16),
            interval: 16 << 32,
            add: 0,
            jerk: 0,
            count: 2,
            direction: Direction::Positive,
            mask: EVERY_SLOT,
        };
        recorder.train(0, &plain);
        let back = Train { start: Moment::at(48), count: 1, direction: Direction::Negative, ..plain };
        recorder.train(0, &back);
        recorder.mark(64, 0, Mark::Stopped);
        let state = AxisState { position: 1, encoder: -2, speed_mpps: -1500, ..AxisState::default() };
        recorder.sample(16_000, 0, &state);
        recorder.finish(32_000).unwrap();
        drop(recorder);
        let axis = |name: &'static str| ["left_stage", "axis_X", name];
        let rises: &[_] =
            &[(0, "0"), (2000, "1"), (2500, "0"), (3000, "1"), (3500, "0"), (4000, "1"), (5000, "0")];
        check(&file, &axis("step_X"), rises);
        check(&file, &axis("dir_X"), &[(0, "1"), (3001, "0")]);
        check(&file, &axis("moving_X"), &[(0, "0"), (62, "1"), (4000, "0")]);
        check(&file, &axis("current_X"), &[(0, "000000"), (500, "011111")]);
        check(&file, &axis("speed_X"), &[(0, "0"), (1_000_000, "-1.5")]);
        check(&file, &axis("encoder_X")[..], &[(0, &"0".repeat(32)), (1_000_000, &format!("{:032b}", -2))]);
        check(&file, &["left_stage", "pins", "motor_supply"], &[(0, "0"), (0, "12.5")]);
        check(&file, &["left_stage", "pins", "+LX"], &[(0, "0"), (2500, "1")]);
        assert!(String::from_utf8(file).unwrap().ends_with("#2000000\n"), "the end is there");
    }
}
