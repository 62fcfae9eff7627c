//! Parquet, for pandas, DuckDB, Polars and whoever else reads tables: one file, one table, the columns of CSV.
//!
//! | column | type | in rows | meaning |
//! |---|---|---|---|
//! | `time_ns` | int64 | all | device time in nanoseconds, rounded down from its clock |
//! | `event` | text | all | as in CSV, and `pulse` |
//! | `axis` | text | of axes | name of the axis |
//! | `position`, `encoder`, `target` | int32 | `sample` | counters of the axis |
//! | `speed` | double | `sample` | pulses a second |
//! | `status`, `steps` | int64 | `sample` | as the device defines it; all pulses, in both directions |
//! | `odometer` | int64 | `pulse` | pulses from the start of the recording: up less down |
//! | `pin`, `value`, `unit` | text, double, text | `pin`, `drive` | as in CSV |
//! | `text` | text | as in CSV | |
//!
//! A group of rows has either samples, or the pulses of one axis, or everything else, and inside it time does not
//! fall. A reader that asks for rows with `event` = `pulse` skips the groups of the others unread.
//!
//! Pulses come by millions, so a group of them is written in another way than the rest, in whole pages: the two
//! columns that differ from pulse to pulse are encoded as differences, many at a time, and the others say once what
//! all rows have.

mod chunk;
mod delta;
mod pulses;
mod read;
mod rows;
mod schema;
#[cfg(test)]
mod tests;

pub(super) use read::read;

use super::{Mark, Note, RecordError, RecordInfo, Recorder, nanoseconds, wire_text};
use ::parquet::{errors::Result, file::writer::SerializedFileWriter};
use devices::{AxisState, Drive, Port};
use motion::{Ticks, Train};
use pulses::Pulses;
use rows::{Row, write_rows};
use std::{io::Write, mem, path::PathBuf};

/// How often the axes are written.
pub const SAMPLES_PER_SECOND: u32 = 1000;

/// Rows of a group that has no pulses.
pub const GROUP_ROWS: usize = 1 << 16;

/// Pulses of a group: 16 bytes each wait until it is full.
pub const GROUP_PULSES: usize = 1 << 18;

/// Most groups of a file. What is known of each is kept until the end of the file.
pub const MAX_GROUPS: usize = 1 << 16;

/// Writes Parquet to a file or elsewhere.
pub struct ParquetRecorder<W: Write + Send> {
    writer: SerializedFileWriter<W>,
    path: PathBuf,
    info: RecordInfo,
    samples: Vec<Row>,
    events: Vec<Row>,
    pulses: Vec<Pulses>,
    groups: usize,
    failure: Option<String>,
}

impl<W: Write + Send> ParquetRecorder<W> {
    /// A recorder that writes to `output`; `path` is its name for messages.
    ///
    /// # Errors
    /// [`RecordError::Write`].
    pub fn new(
        output: W,
        path: impl Into<PathBuf>,
        info: &RecordInfo,
    ) -> std::result::Result<Self, RecordError> {
        let path = path.into();
        match schema::create(output, info) {
            Ok(writer) => Ok(Self {
                pulses: info.axes.iter().map(|name| Pulses::new(name, info.clock_hz)).collect(),
                writer,
                path,
                info: info.clone(),
                samples: Vec::new(),
                events: Vec::new(),
                groups: 0,
                failure: None,
            }),
            Err(error) => Err(RecordError::Write { path, problem: error.to_string() }),
        }
    }

    fn time(&self, at: Ticks) -> i64 {
        nanoseconds(at, self.info.clock_hz) as i64
    }

    fn event(&mut self, row: Row) {
        self.events.push(row);
        if self.events.len() == GROUP_ROWS {
            let rows = mem::take(&mut self.events);
            self.group(|writer| write_rows(&rows, writer));
        }
    }

    /// Writes a group, unless something went wrong before.
    fn group(&mut self, write: impl FnOnce(&mut SerializedFileWriter<W>) -> Result<()>) {
        if self.failure.is_some() {
            return;
        }
        if self.groups == MAX_GROUPS {
            self.failure = Some("the recording is too long for one file".into());
            return;
        }
        self.groups += 1;
        self.failure = write(&mut self.writer).err().map(|error| error.to_string());
    }

    fn bytes(&mut self, at: Ticks, event: &'static str, port: Port, bytes: &[u8]) {
        let text = Some(wire_text(port, bytes));
        self.event(Row { text, ..Row::new(self.time(at), event) });
    }

    fn write_rest(&mut self) {
        for rows in [mem::take(&mut self.samples), mem::take(&mut self.events)] {
            if !rows.is_empty() {
                self.group(|writer| write_rows(&rows, writer));
            }
        }
        let mut pulses = mem::take(&mut self.pulses);
        for pulses in pulses.iter_mut().filter(|pulses| !pulses.is_empty()) {
            self.group(|writer| pulses.write(writer));
        }
    }
}

impl<W: Write + Send> Recorder for ParquetRecorder<W> {
    fn sample_every(&self) -> Option<Ticks> {
        Some(Ticks::from(self.info.clock_hz / SAMPLES_PER_SECOND))
    }

    fn train(&mut self, axis: usize, train: &Train) {
        let mut edges = train.edges();
        while edges.len() > 0 {
            self.pulses[axis].add(&mut edges, train.direction);
            if self.pulses[axis].is_full() {
                let mut pulses = mem::take(&mut self.pulses[axis]);
                self.group(|writer| pulses.write(writer));
                self.pulses[axis] = pulses;
            }
        }
    }

    fn drive(&mut self, at: Ticks, axis: usize, drive: Drive) {
        let Drive { step, parts, current } = drive;
        let text = Some(format!("step {step}/{parts}"));
        let (axis, value) = (Some(self.info.axes[axis]), Some(current.into()));
        self.event(Row { axis, value, text, ..Row::new(self.time(at), "drive") });
    }

    fn pin(&mut self, at: Ticks, pin: usize, level: i32) {
        let pin = &self.info.pins[pin];
        let value = Some(f64::from(level) / f64::from(pin.scale));
        let unit = Some(pin.unit).filter(|unit| !unit.is_empty());
        self.event(Row { pin: Some(pin.name), value, unit, ..Row::new(self.time(at), "pin") });
    }

    fn mark(&mut self, at: Ticks, axis: usize, mark: Mark) {
        self.event(Row { axis: Some(self.info.axes[axis]), ..Row::new(self.time(at), mark.name()) });
    }

    fn note(&mut self, at: Ticks, note: Note, text: &str) {
        self.event(Row { text: Some(text.into()), ..Row::new(self.time(at), note.name()) });
    }

    fn sample(&mut self, at: Ticks, axis: usize, state: &AxisState) {
        self.samples.push(Row {
            axis: Some(self.info.axes[axis]),
            state: Some(*state),
            ..Row::new(self.time(at), "sample")
        });
        if self.samples.len() == GROUP_ROWS {
            let rows = mem::take(&mut self.samples);
            self.group(|writer| write_rows(&rows, writer));
        }
    }

    fn received(&mut self, at: Ticks, port: Port, bytes: &[u8]) {
        self.bytes(at, "received", port, bytes);
    }

    fn sent(&mut self, at: Ticks, port: Port, bytes: &[u8]) {
        self.bytes(at, "sent", port, bytes);
    }

    fn finish(&mut self, _at: Ticks) -> std::result::Result<(), RecordError> {
        self.write_rest();
        // Also after a failure: what came before it can be read.
        let finished = self.writer.finish().map(drop).map_err(|error| error.to_string());
        let result = self.failure.take().map_or(finished, Err);
        result.map_err(|problem| RecordError::Write { path: self.path.clone(), problem })
    }
}
