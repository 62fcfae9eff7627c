//! `pulsetrain dap`: an editor at the debugger.

use crate::{Failure, Outcome, programs, run};
use debugger::{Debugger, Target, dap, engine::DEFAULT_SECONDS};
use std::io::{BufReader, stdin, stdout};

/// Speaks with an editor over standard input and output until it leaves.
pub fn dap() -> Outcome {
    Ok(dap::serve(BufReader::new(stdin()), stdout().lock(), launch)?)
}

/// What a launch configuration says.
fn launch(launch: &dap::Launch) -> Result<Debugger, String> {
    let model = devices::model(&launch.device).ok_or_else(|| format!("unknown model `{}`", launch.device))?;
    let line = |failure: Failure| match failure {
        Failure::Line(line) => line,
        Failure::Told(_) => format!("{}: it has errors", launch.program.display()),
    };
    let (code, said) = programs::translate(&launch.program, model).map_err(line)?;
    let code = code.ok_or(said)?;
    let config = run::config(launch.bench.as_deref(), model).map_err(line)?;
    let inputs = launch.at.iter().map(|input| input.parse()).collect::<Result<_, _>>();
    let inputs = inputs.map_err(|error: sim::device::TimedInputError| error.to_string())?;
    let faults = run::faults(launch.scenario.as_deref(), &config, &|place| {
        programs::address(&code, &launch.program, place)
    });
    let faults = faults.map_err(line)?;
    let seconds = launch.seconds.unwrap_or(DEFAULT_SECONDS);
    if !(0.0..=1e9).contains(&seconds) {
        return Err(format!("`for`: {seconds} is no time in seconds"));
    }
    Debugger::new(Target { code, config, inputs, faults }, seconds).map_err(|error| error.to_string())
}
