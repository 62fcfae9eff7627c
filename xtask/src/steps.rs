//! `cargo xtask test`: the list of steps, and how it is walked.

use crate::{clients, dependencies, documents, firmware, fuzz, page, rust, workplace::Workplace};
use anyhow::{Result, bail};
use std::{
    process::ExitCode,
    time::{Duration, Instant},
};

/// One check. It installs what it needs, so that every step can be run alone.
struct Step {
    name: &'static str,
    about: &'static str,
    run: fn(&Workplace) -> Result<()>,
}

/// In the order in which they run: what is quick and fails most often comes first.
const STEPS: &[Step] = &[
    Step { name: "format", about: "rustfmt, firmware and fuzz targets included", run: rust::format },
    Step {
        name: "dependencies",
        about: "licences, sources, duplicates and advisories of all dependencies",
        run: dependencies::check,
    },
    Step { name: "clippy", about: "clippy on everything, warnings are errors", run: rust::clippy },
    Step { name: "plain", about: "the program without what is optional", run: rust::plain },
    Step { name: "no-std", about: "the crates for the microcontroller, without std", run: rust::no_std },
    Step { name: "tests", about: "unit, property, snapshot and tidy tests with nextest", run: rust::tests },
    Step { name: "doc-tests", about: "the examples in the documentation", run: rust::doc_tests },
    Step { name: "rustdoc", about: "the API documentation, warnings are errors", run: rust::rustdoc },
    Step { name: "documents", about: "the generated documents are up to date", run: documents::check },
    Step {
        name: "clients",
        about: "unmodified third-party clients against the program",
        run: clients::check,
    },
    Step {
        name: "page",
        about: "the page: types, tests, what is committed, its size, a browser",
        run: page::check,
    },
    Step {
        name: "firmware",
        about: "the images for microcontrollers in QEMU, with the same clients",
        run: firmware::check,
    },
    Step { name: "fuzz", about: "every fuzz target for a few seconds", run: fuzz::check },
];

/// What the command line asked for.
#[derive(Debug, PartialEq)]
enum Plan {
    List,
    Run(Vec<&'static str>),
}

/// Runs `cargo xtask test` with `arguments`.
pub fn run(arguments: &[&str]) -> Result<ExitCode> {
    match plan(arguments)? {
        Plan::List => {
            for step in STEPS {
                println!("{:<14}{}", step.name, step.about);
            }
            Ok(ExitCode::SUCCESS)
        }
        Plan::Run(names) => walk(&Workplace::find()?, STEPS.iter().filter(|step| names.contains(&step.name))),
    }
}

fn plan(arguments: &[&str]) -> Result<Plan> {
    let (mut only, mut skip) = (Vec::new(), Vec::new());
    let mut rest = arguments.iter();
    while let Some(&argument) = rest.next() {
        let list = match argument {
            "--list" => return Ok(Plan::List),
            "--only" => &mut only,
            "--skip" => &mut skip,
            _ => bail!("unknown argument `{argument}`: --list, --only STEP or --skip STEP"),
        };
        let Some(&name) = rest.next() else { bail!("`{argument}` needs the name of a step") };
        let Some(step) = STEPS.iter().find(|step| step.name == name) else {
            let names: Vec<_> = STEPS.iter().map(|step| step.name).collect();
            bail!("no step is called `{name}`: {}", names.join(", "));
        };
        list.push(step.name);
    }
    let chosen = STEPS.iter().map(|step| step.name);
    let chosen = chosen.filter(|name| (only.is_empty() || only.contains(name)) && !skip.contains(name));
    Ok(Plan::Run(chosen.collect()))
}

/// Runs the steps up to the first that fails, and sums up.
fn walk<'a>(workplace: &Workplace, steps: impl Iterator<Item = &'a Step>) -> Result<ExitCode> {
    let begin = Instant::now();
    let mut times: Vec<(&str, Duration)> = Vec::new();
    let mut failure = None;
    for step in steps {
        println!("\n== {}: {}", step.name, step.about);
        let begin = Instant::now();
        let result = (step.run)(workplace);
        times.push((step.name, begin.elapsed()));
        if let Err(error) = result {
            failure = Some((step.name, error));
            break;
        }
    }
    println!();
    for (name, time) in &times {
        let word = if failure.as_ref().is_some_and(|(failed, _)| failed == name) { "  FAILED" } else { "" };
        println!("{name:<14}{:>8.1} s{word}", time.as_secs_f64());
    }
    println!("{:<14}{:>8.1} s", "together", begin.elapsed().as_secs_f64());
    let failed = usize::from(failure.is_some());
    println!("steps: {} passed, {failed} failed", times.len() - failed);
    let Some((name, error)) = failure else { return Ok(ExitCode::SUCCESS) };
    eprintln!(
        "\nerror: {error:#}\nThe step `{name}` failed. To run it alone: cargo xtask test --only {name}"
    );
    Ok(ExitCode::FAILURE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(arguments: &[&str], expected: &[&str]) {
        let expected = STEPS.iter().map(|step| step.name).filter(|name| expected.contains(name)).collect();
        assert_eq!(plan(arguments).unwrap(), Plan::Run(expected));
    }

    #[test]
    fn steps_are_chosen_by_name_and_keep_their_order() {
        check(&["--only", "tests", "--only", "format"], &["format", "tests"]);
        check(&["--only", "tests", "--only", "format", "--skip", "tests"], &["format"]);
        let all_but_fuzz: Vec<_> =
            STEPS.iter().map(|step| step.name).filter(|name| *name != "fuzz").collect();
        check(&["--skip", "fuzz"], &all_but_fuzz);
        assert_eq!(plan(&["--list"]).unwrap(), Plan::List);
    }

    #[test]
    fn a_wrong_name_is_an_error_that_says_the_right_ones() {
        let message = plan(&["--only", "lint"]).unwrap_err().to_string();
        assert!(message.contains("`lint`") && message.contains("clippy"), "{message}");
        assert!(plan(&["--only"]).is_err());
        assert!(plan(&["--fast"]).is_err());
    }

    #[test]
    fn no_two_steps_share_a_name() {
        for (at, step) in STEPS.iter().enumerate() {
            assert!(STEPS[at + 1..].iter().all(|other| other.name != step.name), "{}", step.name);
        }
    }

    #[test]
    fn the_walk_stops_at_the_first_failure() {
        let workplace = Workplace::find().unwrap();
        let steps = [
            Step { name: "good", about: "", run: |_| Ok(()) },
            Step { name: "bad", about: "", run: |_| bail!("broken") },
            Step { name: "never", about: "", run: |_| panic!("a step after the failed one ran") },
        ];
        assert_eq!(walk(&workplace, steps.iter()).unwrap(), ExitCode::FAILURE);
        assert_eq!(walk(&workplace, steps[..1].iter()).unwrap(), ExitCode::SUCCESS);
    }
}
