//! The project's chores. `cargo xtask` prints what there is; CONTRIBUTING.md says when to use it.

mod advisories;
mod bench;
mod clients;
mod dependencies;
mod documents;
mod firmware;
mod fuzz;
mod page;
mod rust;
mod steps;
mod tools;
mod workplace;

use anyhow::{Result, bail};
use std::{path::Path, process::ExitCode};
use workplace::Workplace;

const USAGE: &str = "\
cargo xtask test [--list] [--only STEP]... [--skip STEP]...   every check, or some of them
cargo xtask docs [--check]                                    write the generated documents, or compare them
cargo xtask firmware                                          build the images for microcontrollers
cargo xtask firmware --test                                   test them in QEMU, as the step `firmware` does
cargo xtask firmware --figures                                the same, and write the figures of docs/firmware.md
cargo xtask firmware --run MODEL [--tcp PORT] [--flash FILE]  a controller in QEMU
cargo xtask bench [ARGUMENT]...                               every benchmark; arguments go to each of them
cargo xtask advisories DIR                                    read the advisories that concern us from a clone
                                                              of the RustSec database";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments.iter().map(String::as_str).collect::<Vec<_>>()) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &[&str]) -> Result<ExitCode> {
    match arguments {
        [] | ["help" | "-h" | "--help"] => println!("{USAGE}"),
        ["test", rest @ ..] => return steps::run(rest),
        ["docs"] => documents::write(&Workplace::find()?)?,
        ["docs", "--check"] => documents::check(&Workplace::find()?)?,
        ["firmware", rest @ ..] => firmware::run(&Workplace::find()?, rest)?,
        ["bench", rest @ ..] => bench::run(&Workplace::find()?, rest)?,
        ["advisories", directory] => advisories::refresh(&Workplace::find()?, Path::new(directory))?,
        _ => bail!("unknown command `{}`\n\n{USAGE}", arguments.join(" ")),
    }
    Ok(ExitCode::SUCCESS)
}
