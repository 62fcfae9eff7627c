//! A table of text: one row an event, and one row an axis at regular times.
//!
//! | column | in rows | meaning |
//! |---|---|---|
//! | `seconds` | all | device time, with all its digits |
//! | `event` | all | `sample`, `started`, `target_reached`, `stopped`, `pin`, `drive`, `pulse` |
//! | `axis` | all but `pin` | name of the axis |
//! | `position`, `encoder` | `sample` | counters of the axis |
//! | `speed` | `sample` | pulses a second |
//! | `target`, `status` | `sample` | as the device defines them |
//! | `pin` | `pin` | name of the pin |
//! | `value` | `pin`, `drive`, `pulse` | level, or number in the pin's unit; coil current of 32; pulses from the start |
//!
//! A plotting program that takes the rows with `event` = `sample` has equally spaced series. Rows stand
//! in order of time, except that `pulse` rows come when their train is over.

use super::{Mark, RecordError, RecordInfo, Recorder, decimal_seconds};
use devices::{AxisState, Drive};
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

const COLUMNS: [&str; 10] =
    ["seconds", "event", "axis", "position", "encoder", "speed", "target", "status", "pin", "value"];

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

    fn put(&mut self, row: &[&str; 10]) {
        if self.failure.is_none() {
            self.failure = self.writer.write_record(row).err();
        }
    }

    fn event(&mut self, at: Ticks, event: &str, axis: usize, value: &str) {
        let seconds = decimal_seconds(at, self.info.clock_hz);
        self.put(&[&seconds, event, self.info.axes[axis], "", "", "", "", "", "", value]);
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
                self.event(edge, "pulse", axis, &odometer.to_string());
            }
        }
        self.odometers[axis] += i64::from(train.count) * sign;
    }

    fn drive(&mut self, at: Ticks, axis: usize, drive: Drive) {
        self.event(at, "drive", axis, &drive.current.to_string());
    }

    fn pin(&mut self, at: Ticks, pin: usize, level: i32) {
        let seconds = decimal_seconds(at, self.info.clock_hz);
        let pin = &self.info.pins[pin];
        let value = f64::from(level) / f64::from(pin.scale);
        self.put(&[&seconds, "pin", "", "", "", "", "", "", pin.name, &value.to_string()]);
    }

    fn mark(&mut self, at: Ticks, axis: usize, mark: Mark) {
        self.event(at, mark.name(), axis, "");
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
        recorder.finish(16_000_002).unwrap();
        drop(recorder);
        assert_eq!(String::from_utf8(bytes).unwrap(), expected);
    }

    const HEAD: &str = "seconds,event,axis,position,encoder,speed,target,status,pin,value\n\
        0,pin,,,,,,,motor supply,12.5\n\
        0.0000005,drive,X,,,,,,,31\n";
    const TAIL: &str = "1,sample,X,-1,-2,-1.500,7,3,,\n\
        1.0000000625,target_reached,X,,,,,,,\n";

    #[test]
    fn rows_are_events_and_samples() {
        check(Detail::Samples, &format!("{HEAD}{TAIL}"));
        let pulses = "0.000002,pulse,X,,,,,,,-1\n0.000003,pulse,X,,,,,,,-2\n0.000004,pulse,X,,,,,,,-1\n";
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
