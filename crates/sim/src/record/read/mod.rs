//! Recordings read back, to be drawn. A reader goes once through its file and keeps curves, so a long recording
//! takes as much memory as a short one. Times are whole nanoseconds here, whatever clock the device had.

mod csv;
mod mcap;
mod table;
#[cfg(test)]
mod tests;
mod vcd;

#[cfg(feature = "parquet")]
pub(super) use table::{Row, put};

use super::{Mark, Note, Plot};
use std::{
    fs::File,
    io::{self, BufReader},
    path::{Path, PathBuf},
};

/// Clocks a second of a plot from a file.
pub(super) const NS_PER_SECOND: u32 = 1_000_000_000;

/// The longest recording: a time behind this one is a broken file.
pub(super) const MAX_SECONDS: f64 = 1e9;

/// The extensions that [`read`] knows. A tape is played instead.
pub const READABLE: &str =
    if cfg!(feature = "parquet") { ".csv, .mcap, .parquet, .vcd" } else { ".csv, .mcap, .vcd" };

/// Why a recording cannot be read; one line of text.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// No format has this extension.
    #[error("{}: no recording with this extension can be read, known: {READABLE}", .0.display())]
    Format(PathBuf),
    /// The file cannot be read.
    #[error("{}: {problem}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        problem: io::Error,
    },
    /// A place in the file is not what a recording has.
    #[error("{}{place}: {problem}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// The line in a text, or empty.
        place: String,
        /// What is wrong.
        problem: String,
    },
}

/// What is wrong with a file, and in which line of it, if it has lines.
pub(super) struct Problem {
    line: Option<u64>,
    text: String,
}

impl Problem {
    pub(super) fn at(line: u64, text: impl ToString) -> Self {
        Self { line: Some(line), text: text.to_string() }
    }
}

impl<T: ToString> From<T> for Problem {
    fn from(text: T) -> Self {
        Self { line: None, text: text.to_string() }
    }
}

/// Reads a recording.
///
/// # Errors
/// [`ReadError`].
pub fn read(path: &Path) -> Result<Plot, ReadError> {
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or("");
    let reader = match extension {
        "csv" => csv::read,
        "mcap" => mcap::read,
        #[cfg(feature = "parquet")]
        "parquet" => return content(path, super::parquet::read(open(path)?, &title(path))),
        "vcd" => vcd::read,
        _ => return Err(ReadError::Format(path.into())),
    };
    content(path, reader(&mut BufReader::new(open(path)?), &title(path)))
}

fn open(path: &Path) -> Result<File, ReadError> {
    File::open(path).map_err(|problem| ReadError::File { path: path.into(), problem })
}

/// What a plot is called whose file does not say.
fn title(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

fn content(path: &Path, read: Result<Plot, Problem>) -> Result<Plot, ReadError> {
    read.map_err(|Problem { line, text }| {
        let place = line.map_or_else(String::new, |line| format!(":{line}"));
        ReadError::Content { path: path.into(), place, problem: text }
    })
}

fn mark(name: &str) -> Option<Mark> {
    [Mark::Started, Mark::TargetReached, Mark::Stopped].into_iter().find(|mark| mark.name() == name)
}

fn note(name: &str) -> Option<Note> {
    Note::ALL.into_iter().find(|note| note.name() == name)
}
