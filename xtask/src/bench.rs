//! `cargo xtask bench`: all benchmarks of the workspace, one after the other, on an otherwise idle machine.

use crate::{
    rust,
    workplace::{self, Workplace},
};
use anyhow::{Result, bail};
use cargo_metadata::{MetadataCommand, TargetKind};

/// Builds all benches first, so that no compiler runs beside a measurement, then runs each with `arguments`.
pub fn run(workplace: &Workplace, arguments: &[&str]) -> Result<()> {
    let metadata = MetadataCommand::new().current_dir(&workplace.root).no_deps().exec()?;
    let mut benches = Vec::new();
    for package in metadata.workspace_packages() {
        for target in package.targets.iter().filter(|target| target.kind.contains(&TargetKind::Bench)) {
            // What a plain build leaves out is measured, too.
            let whole = package.features.contains_key(rust::OPTIONAL);
            benches.push((package.name.as_str(), target.name.as_str(), whole));
        }
    }
    benches.sort_unstable();
    if benches.is_empty() {
        bail!("no crate has a benchmark");
    }
    let mut build = vec!["bench", "--quiet", "--locked", "--no-run"];
    for (package, bench, _) in &benches {
        build.extend(["-p", package, "--bench", bench]);
    }
    build.push(rust::ALL);
    workplace.cargo(&build)?;
    for (package, bench, whole) in benches {
        println!("\n== {package}: {bench}");
        let mut command = vec!["bench", "--quiet", "--locked", "-p", package, "--bench", bench];
        command.extend(whole.then_some(rust::ALL));
        command.push("--");
        workplace::run(&mut workplace.command("cargo", &[&command, arguments].concat()))?;
    }
    Ok(())
}
