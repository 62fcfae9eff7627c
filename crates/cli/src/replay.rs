//! `pulsetrain replay`

use crate::{Failure, Outcome, args::ReplayArgs};
use sim::{
    record,
    tape::{self, Log, Reader},
};
use std::io::stdout;

/// Plays a tape and prints the log of all its devices.
pub fn replay(args: &ReplayArgs) -> Outcome {
    if let Some(file) = args.record.iter().find(|file| tape::is_tape(file)) {
        return Err(Failure::Line(format!("{}: a tape of a tape would be the same", file.display())));
    }
    let mut replay = Reader::open(&args.tape)?.replay()?;
    let alone = replay.devices().len() == 1;
    for device in replay.devices() {
        let info = device.record_info();
        device.add_recorder(Box::new(Log::new(stdout(), "standard output", &info)));
        for file in &args.record {
            device.add_recorder(record::create(&record::file_of(file, &info.device, alone), &info)?);
        }
    }
    let played = replay.play(|_, _, _| ());
    for device in replay.devices() {
        device.finish_recordings()?;
    }
    Ok(played?)
}
