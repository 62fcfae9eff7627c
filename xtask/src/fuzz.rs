//! The fuzz targets, a few seconds each: enough to replay the corpus and to catch a parser that panics
//! on nearly anything. Longer runs are started by hand (CONTRIBUTING.md).

use crate::{
    tools,
    workplace::{Workplace, read, run},
};
use anyhow::{Result, bail};
use std::{num::NonZero, process::Command, sync::Mutex, thread};

const SECONDS_A_TARGET: u32 = 5;

/// Builds all targets, then runs each.
pub fn check(workplace: &Workplace) -> Result<()> {
    tools::cargo_fuzz(workplace)?;
    let nightly = tools::nightly(workplace)?;
    // `rustup run` and not `cargo +nightly`: within `cargo xtask`, cargo may be the toolchain's own.
    let cargo = |arguments: &[&str]| {
        workplace.command("rustup", &[&["run", &nightly, "cargo", "fuzz"], arguments].concat())
    };
    let list = read(&mut cargo(&["list"]))?;
    if list.trim().is_empty() {
        bail!("fuzz/ has no target");
    }
    run(&mut cargo(&["build"]))?;
    let targets = Mutex::new(list.lines());
    let next = || targets.lock().expect("no run panics").next();
    let runner = || -> Result<()> {
        while let Some(target) = next() {
            fuzz(workplace, target, &mut cargo(&["run", target]))?;
        }
        Ok(())
    };
    let runners = thread::available_parallelism().map_or(1, NonZero::get);
    thread::scope(|scope| {
        let runners: Vec<_> = (0..runners).map(|_| scope.spawn(runner)).collect();
        runners.into_iter().try_for_each(|runner| runner.join().expect("no run panics"))
    })
}

/// Runs one target; what it prints comes in one piece, since others run at the same time.
fn fuzz(workplace: &Workplace, target: &str, command: &mut Command) -> Result<()> {
    let corpus = format!("fuzz/corpus/{target}");
    let seeds = format!("fuzz/seeds/{target}");
    std::fs::create_dir_all(workplace.root.join(&corpus))?;
    // New inputs go to the first folder; the tracked seeds are only read.
    command.arg(&corpus);
    if workplace.root.join(&seeds).exists() {
        command.arg(&seeds);
    }
    let time = format!("-max_total_time={SECONDS_A_TARGET}");
    let output = command.args(["--", &time, "-print_final_stats=1", "-verbosity=0"]).output()?;
    println!("{target}\n{}", String::from_utf8_lossy(&output.stderr));
    if !output.status.success() {
        bail!("the fuzz target {target}: {}", output.status);
    }
    Ok(())
}
