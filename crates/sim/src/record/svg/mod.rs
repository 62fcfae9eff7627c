//! A plot: position, speed and acceleration against time, switches and other digital pins below, and for a
//! device with several axes the way of the first two that moved, seen from above. Axes that stood still are
//! left out.
//!
//! Speed and acceleration come from the spacing of the pulses, not from what the device says. Curves are
//! kept in buckets, so that a recording of a day takes as much memory as one of a second.

mod canvas;
mod draw;
mod path;
mod series;
mod ticks;

use super::{Mark, RecordError, RecordInfo, Recorder};
use devices::{AxisState, Drive, Wiring};
use motion::{Ticks, Train};
use series::{Buckets, Curves, Levels};
use std::path::{Path, PathBuf};

/// Most events that are marked; those after them are left out.
const MAX_MARKS: usize = 200;

/// What is marked at a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sign {
    TargetReached,
    Stopped,
    Switch,
}

/// Draws the plot when the recording ends.
pub struct SvgRecorder {
    path: PathBuf,
    info: RecordInfo,
    origin: Option<Ticks>,
    axes: Vec<Curves>,
    pins: Vec<Buckets<Levels>>,
    /// The last level of each pin, and whether it ever changed.
    levels: Vec<(Option<i32>, bool)>,
    /// When, at which axis and position.
    marks: Vec<(Ticks, usize, i64, Sign)>,
}

impl SvgRecorder {
    /// A recorder that writes the plot to `path`.
    pub fn new(path: &Path, info: &RecordInfo) -> Self {
        Self {
            path: path.into(),
            info: info.clone(),
            origin: None,
            axes: Vec::new(),
            pins: Vec::new(),
            levels: vec![(None, false); info.pins.len()],
            marks: Vec::new(),
        }
    }

    /// The plot begins with the first thing that it is told.
    fn begin(&mut self, at: Ticks) {
        if self.origin.is_none() {
            self.origin = Some(at);
            self.axes = vec![Curves::new(at); self.info.axes.len()];
            self.pins = vec![Buckets::new(at); self.info.pins.len()];
        }
    }

    fn sign(&mut self, at: Ticks, axis: usize, sign: Sign) {
        if self.marks.len() < MAX_MARKS {
            self.marks.push((at, axis, self.axes[axis].position(), sign));
        }
    }
}

impl Recorder for SvgRecorder {
    fn train(&mut self, axis: usize, train: &Train) {
        self.begin(train.start.ticks);
        self.axes[axis].add(train);
    }

    fn drive(&mut self, _at: Ticks, _axis: usize, _drive: Drive) {}

    fn pin(&mut self, at: Ticks, pin: usize, level: i32) {
        self.begin(at);
        let description = &self.info.pins[pin];
        let (before, changed) = self.levels[pin];
        let changes = before.is_some_and(|before| before != level);
        self.levels[pin] = (Some(level), changed || changes);
        if description.kind.is_analog() {
            return;
        }
        self.pins[pin].add(at, level != 0);
        if let (true, Wiring::NegativeLimit(axis) | Wiring::PositiveLimit(axis) | Wiring::Home(axis)) =
            (changes, description.wiring)
        {
            self.sign(at, axis, Sign::Switch);
        }
    }

    fn mark(&mut self, at: Ticks, axis: usize, mark: Mark) {
        self.begin(at);
        match mark {
            Mark::Started => {}
            Mark::TargetReached => self.sign(at, axis, Sign::TargetReached),
            Mark::Stopped => self.sign(at, axis, Sign::Stopped),
        }
    }

    fn sample(&mut self, _at: Ticks, _axis: usize, _state: &AxisState) {}

    fn finish(&mut self, at: Ticks) -> Result<(), RecordError> {
        self.begin(at);
        for curves in &mut self.axes {
            curves.end(at);
        }
        draw::draw(self, at)
            .and_then(|text| std::fs::write(&self.path, text).map_err(|error| error.to_string()))
            .map_err(|problem| RecordError::Write { path: self.path.clone(), problem })
    }
}
