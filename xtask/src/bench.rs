//! `cargo xtask bench`: all benchmarks of the workspace, one after the other, on an otherwise idle machine.

use crate::workplace::{self, Workplace};
use anyhow::{Result, bail};
use cargo_metadata::{MetadataCommand, TargetKind};

/// Builds all benches first, so that no compiler runs beside a measurement, then runs each with `arguments`.
pub fn run(workplace: &Workplace, arguments: &[&str]) -> Result<()> {
    let metadata = MetadataCommand::new().current_dir(&workplace.root).no_deps().exec()?;
    let mut benches = Vec::new();
    for package in metadata.workspace_packages() {
        for target in package.targets.iter().filter(|target| target.kind.contains(&TargetKind::Bench)) {
            benches.push((package.name.as_str(), target.name.as_str()));
        }
    }
    benches.sort_unstable();
    if benches.is_empty() {
        bail!("no crate has a benchmark");
    }
    let mut build = vec!["bench", "--quiet", "--locked", "--no-run"];
    for (package, bench) in &benches {
        build.extend(["-p", package, "--bench", bench]);
    }
    workplace.cargo(&build)?;
    for (package, bench) in benches {
        println!("\n== {package}: {bench}");
        let command = ["bench", "--quiet", "--locked", "-p", package, "--bench", bench, "--"];
        workplace::run(&mut workplace.command("cargo", &[&command, arguments].concat()))?;
    }
    Ok(())
}
