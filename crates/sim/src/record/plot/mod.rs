//! A plot: position, speed and acceleration against time, pins as logic traces below, and for a device with several
//! axes the way of the first two that moved, seen from above. Axes that stood still and pins that did not change
//! are left out.
//!
//! [`PlotRecorder`] draws what happens. It takes speed and acceleration from the spacing of the pulses, not from
//! what the device says. [`read`](super::read) draws what a recording has, which is samples. Curves are kept in
//! buckets, so that a plot of a day takes as much memory as one of a second.

mod draw;
mod font;
mod heading;
mod page;
mod panel;
mod path;
mod png;
mod recorder;
mod series;
mod svg;
mod ticks;
mod trace;

pub use recorder::PlotRecorder;

use super::{Mark, Note};
use motion::{Ticks, Train};
use series::{Buckets, Curves, Levels};
use std::path::Path;

/// Most events that are marked; those after them are left out.
const MAX_MARKS: usize = 200;

/// Most notes that are written; those after them are left out.
const MAX_NOTES: usize = 40;

/// Most axes and pins of a plot. No device has as many; a file may say so.
const MAX_AXES: usize = 64;
const MAX_PINS: usize = 512;

/// Values further from 0 than this are drawn here: they still differ from their neighbours by less than one.
const MAX_VALUE: f64 = 1e15;

/// What a picture is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Picture {
    /// Lines and text, for papers and browsers.
    Svg,
    /// Pixels.
    Png,
}

impl Picture {
    /// The format of a file by its extension; `None` if it is no picture.
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()? {
            "svg" => Some(Self::Svg),
            "png" => Some(Self::Png),
            _ => None,
        }
    }
}

/// What is marked at a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sign {
    Started,
    TargetReached,
    Stopped,
    Switch,
}

impl From<Mark> for Sign {
    fn from(mark: Mark) -> Self {
        match mark {
            Mark::Started => Self::Started,
            Mark::TargetReached => Self::TargetReached,
            Mark::Stopped => Self::Stopped,
        }
    }
}

/// A pin.
struct Trace {
    name: String,
    unit: String,
    levels: Buckets<Levels>,
}

/// What a plot shows.
pub struct Plot {
    title: String,
    clock_hz: u32,
    origin: Ticks,
    end: Ticks,
    axes: Vec<(String, Curves)>,
    pins: Vec<Trace>,
    marks: Vec<(Ticks, usize, Sign)>,
    notes: Vec<(Ticks, Note, String)>,
}

impl Plot {
    /// An empty plot that begins at `origin`. Times are clocks, so many a second.
    pub fn new(title: &str, clock_hz: u32, origin: Ticks) -> Self {
        Self {
            title: title.into(),
            clock_hz,
            origin,
            end: origin,
            axes: Vec::new(),
            pins: Vec::new(),
            marks: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// Another title.
    pub fn set_title(&mut self, title: &str) {
        self.title = title.into();
    }

    /// The axis of this name; `None` if there are too many.
    pub fn axis(&mut self, name: &str) -> Option<usize> {
        let known = self.axes.iter().position(|(other, _)| other == name);
        known.or_else(|| {
            let room = self.axes.len() < MAX_AXES;
            room.then(|| self.axes.push((name.into(), Curves::new(self.origin))))?;
            Some(self.axes.len() - 1)
        })
    }

    /// The pin of this name; `None` if there are too many. One without a unit that is 0 or 1 is a logic trace.
    pub fn pin(&mut self, name: &str, unit: &str) -> Option<usize> {
        let known = self.pins.iter().position(|pin| pin.name == name);
        known.or_else(|| {
            let levels = Buckets::new(self.origin);
            let room = self.pins.len() < MAX_PINS;
            room.then(|| self.pins.push(Trace { name: name.into(), unit: unit.into(), levels }))?;
            Some(self.pins.len() - 1)
        })
    }

    /// Pulses of an axis. An axis has pulses or samples, not both.
    pub fn train(&mut self, axis: usize, train: &Train) {
        self.axes[axis].1.add(train);
        self.end = self.end.max(train.end());
    }

    /// What an axis said of itself: position in pulses, speed in pulses a second.
    pub fn sample(&mut self, at: Ticks, axis: usize, position: f64, speed_pps: f64) {
        let [position, speed_pps] = [position, speed_pps].map(|value| value.clamp(-MAX_VALUE, MAX_VALUE));
        self.axes[axis].1.sample(at, position, speed_pps / f64::from(self.clock_hz));
        self.end = self.end.max(at);
    }

    /// What the counters of an axis were, in pulses, behind its pulses or its sample of that time.
    pub fn encoder(&mut self, at: Ticks, axis: usize, position: f64, encoder: f64) {
        let [position, encoder] = [position, encoder].map(|value| value.clamp(-MAX_VALUE, MAX_VALUE));
        self.axes[axis].1.encoder(at, position, encoder);
        self.end = self.end.max(at);
    }

    /// A pin has this value from now on.
    pub fn level(&mut self, at: Ticks, pin: usize, value: f64) {
        self.pins[pin].levels.add(at, value.clamp(-MAX_VALUE, MAX_VALUE));
        self.end = self.end.max(at);
    }

    /// An axis started or stopped.
    pub fn mark(&mut self, at: Ticks, axis: usize, mark: Mark) {
        self.sign(at, axis, mark.into());
    }

    fn sign(&mut self, at: Ticks, axis: usize, sign: Sign) {
        if self.marks.len() < MAX_MARKS {
            self.marks.push((at, axis, sign));
        }
        self.end = self.end.max(at);
    }

    /// Something happened around the axes.
    pub fn note(&mut self, at: Ticks, note: Note, text: &str) {
        if self.notes.len() < MAX_NOTES {
            self.notes.push((at, note, text.into()));
        }
        self.end = self.end.max(at);
    }

    /// The plot ends here, or later where it has something later.
    pub fn finish(&mut self, at: Ticks) {
        self.end = self.end.max(at);
        for (_, curves) in &mut self.axes {
            curves.end(self.end);
        }
    }

    /// The file, or what is wrong.
    ///
    /// # Errors
    /// One line of text: the picture is too large.
    pub fn draw(&self, picture: Picture) -> Result<Vec<u8>, String> {
        let page = draw::page(self);
        match picture {
            Picture::Svg => Ok(svg::svg(&page).into_bytes()),
            Picture::Png => png::png(&page),
        }
    }

    /// What it shows, in words.
    #[cfg(test)]
    pub(super) fn summary(&self) -> Vec<String> {
        let time = |at: Ticks| format!("{:.6}", self.seconds(at));
        let mut lines = vec![format!("from {} to {}", time(self.origin), time(self.end))];
        for (name, curves) in self.axes.iter().filter(|(_, curves)| curves.has_moved()) {
            let hundredth = |part: Ticks| self.origin + (self.end - self.origin) * part / 100;
            let places =
                [0, 50, 100].map(|part| curves.position_at(hundredth(part)).unwrap_or(f64::NAN).round());
            let encoder = if curves.has_other_encoder() { ", encoder elsewhere" } else { "" };
            lines.push(format!("axis {name}: {places:?}{encoder}"));
        }
        for Trace { name, unit, levels } in &self.pins {
            let series::Span { low, high, last } =
                levels.span().unwrap_or(series::Span { low: 0.0, high: 0.0, last: 0.0 });
            lines.push(format!("pin {}: {low} to {high}, then {last} {unit}", name.replace(' ', "_")));
        }
        lines.extend(
            self.marks
                .iter()
                .map(|(at, axis, sign)| format!("{} {} {sign:?}", time(*at), self.axes[*axis].0)),
        );
        lines.extend(self.notes.iter().map(|(at, note, text)| format!("{} {note:?} {text}", time(*at))));
        lines
    }

    fn seconds(&self, at: Ticks) -> f64 {
        at as f64 / f64::from(self.clock_hz)
    }
}
