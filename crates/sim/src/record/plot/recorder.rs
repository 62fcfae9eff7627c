//! What happens, drawn when the recording ends.

use super::{Picture, Plot, Sign};
use crate::record::{Mark, Note, RecordError, RecordInfo, Recorder};
use devices::{AxisState, Drive, Wiring};
use motion::{Ticks, Train};
use std::path::{Path, PathBuf};

/// How often the encoders are looked at.
const SAMPLES_PER_SECOND: u32 = 1000;

/// Draws the plot when the recording ends.
pub struct PlotRecorder {
    path: PathBuf,
    picture: Picture,
    info: RecordInfo,
    /// It begins with the first thing that it is told.
    plot: Option<Plot>,
    /// The last level of each pin.
    levels: Vec<Option<i32>>,
}

impl PlotRecorder {
    /// A recorder that writes the plot to `path`.
    pub fn new(path: &Path, picture: Picture, info: &RecordInfo) -> Self {
        let levels = vec![None; info.pins.len()];
        Self { path: path.into(), picture, info: info.clone(), plot: None, levels }
    }

    /// The plot, with the axes and pins of the device in their order.
    fn plot(&mut self, at: Ticks) -> &mut Plot {
        let info = &self.info;
        self.plot.get_or_insert_with(|| {
            let mut plot = Plot::new(&info.device, info.clock_hz, at);
            let axes = info.axes.iter().filter_map(|name| plot.axis(name)).count();
            let pins = info.pins.iter().filter_map(|pin| plot.pin(pin.name, pin.unit)).count();
            assert_eq!((axes, pins), (info.axes.len(), info.pins.len()), "a plot has room for a device");
            plot
        })
    }
}

impl Recorder for PlotRecorder {
    fn sample_every(&self) -> Option<Ticks> {
        Some(Ticks::from(self.info.clock_hz / SAMPLES_PER_SECOND))
    }

    fn train(&mut self, axis: usize, train: &Train) {
        self.plot(train.start.ticks).train(axis, train);
    }

    fn drive(&mut self, _at: Ticks, _axis: usize, _drive: Drive) {}

    fn pin(&mut self, at: Ticks, pin: usize, level: i32) {
        let description = &self.info.pins[pin];
        let (value, wiring) = (f64::from(level) / f64::from(description.scale), description.wiring);
        let changes = self.levels[pin].replace(level).is_some_and(|before| before != level);
        let plot = self.plot(at);
        plot.level(at, pin, value);
        if let (true, Wiring::NegativeLimit(axis) | Wiring::PositiveLimit(axis) | Wiring::Home(axis)) =
            (changes, wiring)
        {
            plot.sign(at, axis, Sign::Switch);
        }
    }

    fn mark(&mut self, at: Ticks, axis: usize, mark: Mark) {
        self.plot(at).mark(at, axis, mark);
    }

    fn note(&mut self, at: Ticks, note: Note, text: &str) {
        self.plot(at).note(at, note, text);
    }

    /// Of the counters, only how far they are apart is not known from the pulses.
    fn sample(&mut self, at: Ticks, axis: usize, state: &AxisState) {
        let apart = f64::from(state.encoder.wrapping_sub(state.position));
        let position = f64::from(state.position);
        self.plot(at).encoder(at, axis, position, position + apart);
    }

    fn finish(&mut self, at: Ticks) -> Result<(), RecordError> {
        let picture = self.picture;
        let plot = self.plot(at);
        plot.finish(at);
        plot.draw(picture)
            .and_then(|bytes| std::fs::write(&self.path, bytes).map_err(|error| error.to_string()))
            .map_err(|problem| RecordError::Write { path: self.path.clone(), problem })
    }
}
