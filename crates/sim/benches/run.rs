//! How much faster than real time programs run: the examples, and a job of three axes that make 370,000 pulses a second
//! together. The baseline is the clock on the wall: each line is device time divided by the time that it took. An argument
//! is a part of a model's or program's name; only such are run.

#[path = "../tests/examples/programs.rs"]
mod programs;

use devices::Language;
use sim::{DeviceConfig, Program, RunOptions, VirtualDevice, run};
use std::time::{Duration, Instant};

/// Device time of a run, unless the program ends before.
const SECONDS: f64 = 100.0;

/// The best of so many runs counts, and of more while they are short: others were disturbed.
const RUNS: usize = 5;

/// Wall time for the runs of a program.
const PATIENCE: Duration = Duration::from_millis(200);

/// Shorter runs measure how a run begins.
const SHORTEST_SECONDS: f64 = 0.1;

/// 123,400 pulses a second on each axis but for the ramps.
const THREE_AXES: &str = "\
PRG 0
  HSPD=123400
  LSPD=1000
  ACC=300
  EO=15
  WHILE 1=1
    X1000000Y1000000Z1000000
    WAITX
    X-1000000Y-1000000Z-1000000
    WAITX
  ENDWHILE
END
";

fn measure(model: &'static devices::Model, name: &str, program: &Program) {
    let wanted = |part: String| part.starts_with("--") || model.name.contains(&part) || name.contains(&part);
    if !std::env::args().skip(1).all(wanted) {
        return;
    }
    let options = RunOptions { for_seconds: Some(SECONDS), ..RunOptions::default() };
    let begin = Instant::now();
    let results = (0..).take_while(|&done| done < RUNS || begin.elapsed() < PATIENCE).map(|_| {
        let mut device = VirtualDevice::new(&DeviceConfig::new(model), 1);
        run(&mut device, program, &options, |_| ()).expect("an example runs")
    });
    let best = results.min_by(|a, b| a.wall_seconds.total_cmp(&b.wall_seconds)).expect("there are runs");
    if best.device_seconds < SHORTEST_SECONDS {
        return;
    }
    let pulses: u64 = best.axes.values().map(|axis| axis.steps).sum();
    println!(
        "{:<10} {name:<28} {:>8.0} times real time, {:>7.0} pulses/s, {:>6.0} instructions/s",
        model.name,
        best.device_seconds / best.wall_seconds,
        pulses as f64 / best.device_seconds,
        best.instructions as f64 / best.device_seconds,
    );
}

fn main() {
    for model in devices::MODELS {
        for (name, program) in programs::of_model(model) {
            measure(model, &name, &program);
        }
    }
    let model = devices::model("cmd-4cr").expect("there is one");
    let Language::Ascript(dialect) = model.language else { unreachable!("it speaks A-SCRIPT") };
    let code = ascript::compile("three axes", THREE_AXES.as_bytes(), dialect).code.expect("it compiles");
    measure(model, "(three axes)", &Program::Ascript(code.lines));
}
