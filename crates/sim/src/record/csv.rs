//! A table of text: one row an event, and one row an axis at regular times.
//!
//! | column | in rows | meaning |
//! |---|---|---|
//! | `seconds` | all | device time, with all its digits |
//! | `event` | all | `sample`, `started`, `target_reached`, `stopped`, `pin`, `drive`, `fault`, `cleared`, `notice`, `power_up`, `received`, `sent`, `pulse` |
//! | `axis` | of axes | name of the axis |
//! | `position`, `encoder` | `sample` | counters of the axis |
//! | `speed` | `sample` | pulses a second |
//! | `target`, `status` | `sample` | as the device defines them |
//! | `pin` | `pin` | name of the pin |
//! | `value` | `pin`, `drive`, `pulse` | level, or number in the pin's unit; coil current of 32; pulses from the start |
//! | `steps` | `sample` | all pulses, in both directions |
//! | `unit` | `pin` | of the value, if it has one |
//! | `text` | `drive`, notes, bytes | full steps of an angle; what a fault or notice says; port and bytes in hexadecimal |
//!
//! A plotting program that takes the rows with `event` = `sample` has equally spaced series. Rows stand
//! in order of time, except that `pulse` rows come when their train is over.

use super::{Mark, Note, RecordError, RecordInfo, Recorder, decimal_seconds, wire_text};
use devices::{AxisState, Drive, Port};
use motion::{Ticks, Train};
use std::{io::Write, path::PathBuf};

/// How much is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// Events, and the axes every millisecond.
    Samples,
    /// Also every single pulse.
    Edges,
}

/// How often the axes are written.
pub const SAMPLES_PER_SECOND: u32 = 1000;

const COLUMNS: [&str; 13] = [
    "seconds", "event", "axis", "position", "encoder", "speed", "target", "status", "pin", "value", "steps",
    "unit", "text",
];

/// The cells of a row that is no sample.
#[derive(Default)]
struct Event<'a> {
    axis: &'a str,
    pin: &'a str,
    value: String,
    unit: &'a str,
    text: &'a str,
}

/// Writes CSV to a file or elsewhere.
pub struct CsvRecorder<W: Write> {
    writer: csv::Writer<W>,
    path: PathBuf,
    info: RecordInfo,
    detail: Detail,
    /// Pulses of each axis since the recording began.
    odometers: Vec<i64>,
    failure: Option<csv::Error>,
}

impl<W: Write> CsvRecorder<W> {
    /// A recorder that writes to `output`; `path` is its name for messages.
    pub fn new(output: W, path: impl Into<PathBuf>, info: &RecordInfo, detail: Detail) -> Self {
        let mut recorder = Self {
            writer: csv::Writer::from_writer(output),
            path: path.into(),
            info: info.clone(),
            detail,
            odometers: vec![0; info.axes.len()],
            failure: None,
        };
        recorder.put(&COLUMNS);
        recorder
    }

    fn put(&mut self, row: &[&str; COLUMNS.len()]) {
        if self.failure.is_none() {
            self.failure = self.writer.write_record(row).err();
        }
    }

    fn event(&mut self, at: Ticks, event: &str, cells: &Event<'_>) {
        let seconds = decimal_seconds(at, self.info.clock_hz);
        let Event { axis, pin, value, unit, text } = cells;
        self.put(&[&seconds, event, axis, "", "", "", "", "", pin, value, "", unit, text]);
    }
}

impl<W: Write> Recorder for CsvRecorder<W> {
    fn sample_every(&self) -> Option<Ticks> {
        Some(Ticks::from(self.info.clock_hz / SAMPLES_PER_SECOND))
    }

    fn train(&mut self, axis: usize, train: &Train) {
        let sign = train.direction.sign();
        if self.detail == Detail::Edges {
            for (number, edge) in (1..).zip(train.edges()) {
                let odometer = self.odometers[axis] + number * sign;
                let cells =
                    Event { axis: self.info.axes[axis], value: odometer.to_string(), ..Event::default() };
                self.event(edge, "pulse", &cells);
            }
        }
        self.odometers[axis] += i64::from(train.count) * sign;
    }

    fn drive(&mut self, at: Ticks, axis: usize, drive: Drive) {
        let Drive { step, parts, current } = drive;
        let (axis, text) = (self.info.axes[axis], format!("step {step}/{parts}"));
        let cells = Event { axis, value: current.to_string(), text: &text, ..Event::default() };
        self.event(at, "drive", &cells);
    }

    fn pin(&mut self, at: Ticks, pin: usize, level: i32) {
        let pin = &self.info.pins[pin];
        let value = (f64::from(level) / f64::from(pin.scale)).to_string();
        self.event(at, "pin", &Event { pin: pin.name, value, unit: pin.unit, ..Event::default() });
    }

    fn mark(&mut self, at: Ticks, axis: usize, mark: Mark) {
        self.event(at, mark.name(), &Event { axis: self.info.axes[axis], ..Event::default() });
    }

    fn note(&mut self, at: Ticks, note: Note, text: &str) {
        self.event(at, note.name(), &Event { text, ..Event::default() });
    }

    fn received(&mut self, at: Ticks, port: Port, bytes: &[u8]) {
        self.event(at, "received", &Event { text: &wire_text(port, bytes), ..Event::default() });
    }

    fn sent(&mut self, at: Ticks, port: Port, bytes: &[u8]) {
        self.event(at, "sent", &Event { text: &wire_text(port, bytes), ..Event::default() });
    }

    fn sample(&mut self, at: Ticks, axis: usize, state: &AxisState) {
        let seconds = decimal_seconds(at, self.info.clock_hz);
        let speed = decimal_thousandths(state.speed_mpps);
        self.put(&[
            &seconds,
            "sample",
            self.info.axes[axis],
            &state.position.to_string(),
            &state.encoder.to_string(),
            &speed,
            &state.target.to_string(),
            &state.status.to_string(),
            "",
            "",
            &state.steps.to_string(),
            "",
            "",
        ]);
    }

    fn finish(&mut self, _at: Ticks) -> Result<(), RecordError> {
        let flushed = self.writer.flush().map_err(Into::into);
        match self.failure.take().map_or(flushed, Err) {
            Ok(()) => Ok(()),
            Err(error) => Err(RecordError::Write { path: self.path.clone(), problem: error.to_string() }),
        }
    }
}

fn decimal_thousandths(value: i64) -> String {
    let sign = if value < 0 { "-" } else { "" };
    let (whole, part) = (value.unsigned_abs() / 1000, value.unsigned_abs() % 1000);
    if part == 0 { format!("{sign}{whole}") } else { format!("{sign}{whole}.{part:03}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::testing::stage;
    use motion::{Direction, Moment, train::EVERY_SLOT};
    use std::io;

    #[track_caller]
    fn check(detail: Detail, expected: &str) {
        let mut bytes = Vec::new();
        let mut recorder = CsvRecorder::new(&mut bytes, "a.csv", &stage(), detail);
        recorder.pin(0, 0, 12_500);
        recorder.drive(8, 0, Drive { step: 1, parts: 1, current: 31 });
        recorder.received(8, Port::Usb, &[1, 255]);
        let start = Moment::at(16);
        let direction = Direction::Negative;
        let train =
            Train { start, interval: 16 << 32, add: 0, jerk: 0, count: 2, direction, mask: EVERY_SLOT };
        recorder.train(0, &train);
        recorder
            .train(0, &Train { start: Moment::at(48), count: 1, direction: Direction::Positive, ..train });
        let state =
            AxisState { position: -1, encoder: -2, speed_mpps: -1500, target: 7, status: 3, steps: 3 };
        recorder.sample(16_000_000, 0, &state);
        recorder.mark(16_000_001, 0, Mark::TargetReached);
        recorder.note(16_000_001, Note::Fault, "slip, X");
        recorder.finish(16_000_002).unwrap();
        drop(recorder);
        assert_eq!(String::from_utf8(bytes).unwrap(), expected);
    }

    const HEAD: &str = "seconds,event,axis,position,encoder,speed,target,status,pin,value,steps,unit,text\n\
        0,pin,,,,,,,motor supply,12.5,,V,\n\
        0.0000005,drive,X,,,,,,,31,,,step 1/1\n\
        0.0000005,received,,,,,,,,,,,usb 01ff\n";
    const TAIL: &str = "1,sample,X,-1,-2,-1.500,7,3,,,3,,\n\
        1.0000000625,target_reached,X,,,,,,,,,,\n\
        1.0000000625,fault,,,,,,,,,,,\"slip, X\"\n";

    #[test]
    fn rows_are_events_and_samples() {
        check(Detail::Samples, &format!("{HEAD}{TAIL}"));
        let pulses =
            "0.000002,pulse,X,,,,,,,-1,,,\n0.000003,pulse,X,,,,,,,-2,,,\n0.000004,pulse,X,,,,,,,-1,,,\n";
        check(Detail::Edges, &format!("{HEAD}{pulses}{TAIL}"));
    }

    #[test]
    fn a_full_disk_is_told_at_the_end() {
        struct Full;

        impl io::Write for Full {
            fn write(&mut self, _: &[u8]) -> io::Result<usize> {
                Err(io::Error::from(io::ErrorKind::StorageFull))
            }

            fn flush(&mut self) -> io::Result<()> {
                Ok(())
            }
        }

        let mut recorder = CsvRecorder::new(Full, "a.csv", &stage(), Detail::Samples);
        for _ in 0..10_000 {
            recorder.sample(0, 0, &AxisState::default());
        }
        let error = recorder.finish(0).unwrap_err().to_string();
        assert!(error.starts_with("a.csv: ") && !error.contains('\n'), "{error}");
    }
}
