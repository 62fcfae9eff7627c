//! `bench`: what a bench file may say, and whether one says it right.

use crate::{Failure, Outcome, args::BenchCommand};
use sim::{
    Bench, DeviceConfig,
    config::{reference, schema},
};
use std::io::{Write, stdout};

/// Prints the keys or their schema, or looks through a file.
pub fn bench(command: &BenchCommand) -> Outcome {
    let text = match command {
        BenchCommand::Keys => reference(),
        BenchCommand::Schema => format!("{:#}\n", schema()),
        BenchCommand::Check { file } => Bench::read(file)?.devices.iter().map(line).collect(),
    };
    stdout().write_all(text.as_bytes()).map_err(Failure::from)
}

/// What a device of a file is, where it listens, and of which of its axes the file speaks.
fn line(device: &DeviceConfig) -> String {
    let listed = |words: Vec<String>, none: &str| match words.is_empty() {
        true => none.to_owned(),
        false => words.join(", "),
    };
    let places = listed(device.listen.iter().map(ToString::to_string).collect(), "nowhere");
    let axes = listed(device.axes.keys().cloned().collect(), "the usual ones");
    format!("{} ({}) at {places}; axes: {axes}\n", device.name, device.model.name)
}
