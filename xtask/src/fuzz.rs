//! The fuzz targets, a few seconds each: enough to replay the corpus and to catch a parser that panics
//! on nearly anything. Longer runs are started by hand (CONTRIBUTING.md).

use crate::{
    tools,
    workplace::{Workplace, read, run},
};
use anyhow::{Result, bail};

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
    let time = format!("-max_total_time={SECONDS_A_TARGET}");
    for target in list.lines() {
        let corpus = format!("fuzz/corpus/{target}");
        let seeds = format!("fuzz/seeds/{target}");
        std::fs::create_dir_all(workplace.root.join(&corpus))?;
        // New inputs go to the first folder; the tracked seeds are only read.
        let mut arguments = vec!["run", target, &corpus];
        if workplace.root.join(&seeds).exists() {
            arguments.push(&seeds);
        }
        arguments.extend(["--", &time, "-print_final_stats=1", "-verbosity=0"]);
        run(&mut cargo(&arguments))?;
    }
    Ok(())
}
