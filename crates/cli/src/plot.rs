//! `pulsetrain plot`

use crate::{Failure, Outcome, args::PlotArgs};
use sim::{
    record::{self, Picture, PlotRecorder},
    tape::{self, Reader},
};
use std::{
    fs,
    path::{Path, PathBuf},
};

/// Draws a recording. A tape is played for it, and has a picture of each of its devices.
pub fn plot(args: &PlotArgs) -> Outcome {
    let output = args.output.clone().unwrap_or_else(|| args.recording.with_extension("svg"));
    let Some(picture) = Picture::of(&output) else {
        return Err(Failure::Line(format!("{}: a plot is an .svg or .png file", output.display())));
    };
    if output == args.recording {
        return Err(Failure::Line(format!("{}: the plot would replace the recording", output.display())));
    }
    if tape::is_tape(&args.recording) {
        return play(&args.recording, &output, picture);
    }
    let drawn = record::read(&args.recording)?.draw(picture);
    let written = drawn.and_then(|bytes| fs::write(&output, bytes).map_err(|error| error.to_string()));
    written.map_err(|problem| Failure::Line(format!("{}: {problem}", output.display())))
}

fn play(tape: &Path, output: &Path, picture: Picture) -> Outcome {
    let mut replay = Reader::open(tape)?.replay()?;
    let alone = replay.devices().len() == 1;
    for device in replay.devices() {
        let info = device.record_info();
        let file: PathBuf = record::file_of(output, &info.device, alone);
        device.add_recorder(Box::new(PlotRecorder::new(&file, picture, &info)));
    }
    let played = replay.play(|_, _, _| ());
    for device in replay.devices() {
        device.finish_recordings()?;
    }
    Ok(played?)
}
