//! `pulsetrain run`

use crate::{Failure, Outcome, args::RunArgs, programs};
use devices::{Model, ProgramRun};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use sim::{
    Bench, DeviceConfig, RunOptions, RunResult, Scenario, SharedFlash, VirtualDevice,
    device::notice_text,
    fault::{Planned, scenario::Find},
    record::{self, Picture},
    run::Progress,
    tape::{self, Tape},
};
use std::{
    io::{IsTerminal, stderr},
    path::Path,
    time::{Duration, Instant},
};

/// Exit status when the program went into its error state.
const PROGRAM_ERROR: u8 = 2;

/// A run that takes longer than this shows how far it is.
const PATIENCE: Duration = Duration::from_millis(500);

/// Positions of the bar.
const BAR_STEPS: u64 = 1000;

/// Random numbers of a device whose bench file has no seed: the same in every run.
const SEED: u64 = 0;

/// Runs a program and shows what came of it.
pub fn run(args: RunArgs) -> Outcome {
    let loaded = programs::load(&args.program, args.device)?;
    let config = config(args.bench.as_deref(), args.device)?;
    let faults = faults(args.scenario.as_deref(), &config, &|place| loaded.find(&args.program, place))?;
    let flash = SharedFlash::erased(config.model.flash_bytes);
    let head = [(&config, config.seed.unwrap_or(SEED), &flash)];
    let (tapes, files): (Vec<_>, Vec<_>) = args.record.iter().partition(|path| tape::is_tape(path));
    if let Some(plot) = &args.plot
        && Picture::of(plot).is_none()
    {
        return Err(Failure::Line(format!("{}: a plot is an .svg or .png file", plot.display())));
    }
    let all: Vec<_> = args.record.iter().chain(&args.plot).collect();
    if let Some((_, file)) = all.iter().enumerate().find(|(at, file)| all[..*at].contains(file)) {
        return Err(Failure::Line(format!("{}: one file cannot hold two recordings", file.display())));
    }
    let tapes = tapes.into_iter().map(|path| Tape::create(path, &head)).collect::<Result<Vec<_>, _>>()?;
    let mut device = VirtualDevice::with_flash(&config, flash.clone(), SEED);
    tapes.iter().for_each(|tape| device.add_tape(tape.track(0)));
    for file in files.into_iter().chain(&args.plot) {
        device.add_recorder(record::create(file, &device.record_info())?);
    }

    let options = RunOptions { for_seconds: Some(args.limit_s), inputs: args.at, faults };
    let mut bar = Bar::new();
    let result = sim::run(&mut device, &loaded.program, &options, |progress| bar.show(progress));
    drop(bar);
    let result = result.map_err(|error| Failure::Line(format!("{}: {error}", args.program.display())))?;
    device.end_tape();
    device.finish_recordings()?;
    tapes.iter().try_for_each(Tape::finish)?;

    while let Some(notice) = device.take_notice() {
        eprintln!("warning: {}: {}", args.program.display(), notice_text(&notice));
    }
    programs::show(&if args.json { serde_json::to_string(&result)? + "\n" } else { report(&result) })?;
    let error = device.programs().enumerate().find(|(_, program)| program.run == ProgramRun::Error);
    if let Some((number, program)) = error {
        let counter = program.counter;
        let place = loaded.places.get(counter as usize).cloned();
        let place = place.unwrap_or_else(|| format!("{}: line {counter}", args.program.display()));
        eprintln!("error: {place}: program {number} went into its error state");
        return Err(Failure::Told(PROGRAM_ERROR));
    }
    Ok(())
}

/// The device in its machine: the first of its model in the bench file, if there is one.
pub fn config(bench: Option<&Path>, model: &'static Model) -> Result<DeviceConfig, Failure> {
    let Some(file) = bench else { return Ok(DeviceConfig::new(model)) };
    let bench = Bench::read(file)?;
    let found = bench.devices.into_iter().find(|device| device.model.name == model.name);
    found.ok_or_else(|| Failure::Line(format!("{}: there is no {}", file.display(), model.name)))
}

/// The faults of a scenario, if there is one; `find` knows the lines and labels of the program that it may name.
pub fn faults(
    scenario: Option<&Path>,
    config: &DeviceConfig,
    find: Find<'_>,
) -> Result<Vec<Planned>, Failure> {
    let Some(file) = scenario else { return Ok(Vec::new()) };
    let scenario = Scenario::read(file, std::slice::from_ref(config), find)?;
    Ok(scenario.of(0).cloned().collect())
}

fn report(result: &RunResult) -> String {
    let RunResult { stop_reason, device_seconds, wall_seconds, instructions, axes } = result;
    let mut text = format!(
        "{} after {device_seconds:.6} s and {instructions} instructions, in {wall_seconds:.3} s\n",
        stop_reason.name()
    );
    for (name, axis) in axes {
        text += &format!(
            "axis {name}: position {}, encoder {}, steps {}, status {}\n",
            axis.position, axis.encoder, axis.steps, axis.status
        );
    }
    text
}

/// The progress bar, on a terminal, once it is worth one.
struct Bar {
    started: Instant,
    bar: Option<ProgressBar>,
}

impl Bar {
    fn new() -> Self {
        Self { started: Instant::now(), bar: None }
    }

    fn show(&mut self, progress: Progress) {
        if self.started.elapsed() < PATIENCE || !stderr().is_terminal() {
            return;
        }
        let bar = self.bar.get_or_insert_with(|| {
            let style = ProgressStyle::with_template("{bar:40} {msg}, {eta} left");
            let bar = ProgressBar::with_draw_target(Some(BAR_STEPS), ProgressDrawTarget::stderr());
            // The template is ours; a test draws it.
            bar.with_style(style.expect("the template is right"))
        });
        let whole = progress.for_seconds.unwrap_or(f64::INFINITY);
        bar.set_position((BAR_STEPS as f64 * progress.device_seconds / whole) as u64);
        bar.set_message(format!("{:.0} s of {whole} s", progress.device_seconds));
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
