//! The program `pulsetrain`: virtual stepper motion controllers, and the tools for their programs.
//!
//! What was asked for goes to standard output, everything else to standard error; an error of the
//! arguments or of a file is one line there, `error: ...`, and status 1.

mod args;
mod bench;
mod dap;
mod debug;
mod lsp;
mod plot;
mod programs;
mod replay;
mod run;
mod serve;

use args::{Args, Command};
use clap::{CommandFactory, Parser, error::ErrorKind};
use std::process::ExitCode;

/// Exit status when the arguments, a file, or the system is at fault.
const FAILED: u8 = 1;

/// Why a command fails.
enum Failure {
    /// One line that is still to be printed.
    Line(String),
    /// Everything has been said, with this exit status.
    Told(u8),
}

impl<E: std::error::Error> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::Line(error.to_string())
    }
}

/// What a command gives back.
type Outcome = Result<(), Failure>;

fn main() -> ExitCode {
    let outcome = match Args::try_parse() {
        Ok(args) => execute(args.command),
        Err(error) => refuse(&error),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failure::Told(status)) => status.into(),
        Err(Failure::Line(line)) => {
            eprintln!("error: {line}");
            FAILED.into()
        }
    }
}

fn execute(command: Command) -> Outcome {
    match command {
        Command::Serve(args) => serve::serve(args),
        Command::Run(args) => run::run(args),
        Command::Replay(args) => replay::replay(&args),
        Command::Bench { command } => bench::bench(&command),
        Command::Plot(args) => plot::plot(&args),
        Command::Debug(args) => debug::debug(args),
        Command::Dap => dap::dap(),
        Command::Lsp(args) => lsp::lsp(&args),
        Command::Asm(args) => programs::asm(&args),
        Command::Disasm(args) => programs::disasm(&args),
        Command::Compile(args) => programs::compile_file(&args),
        Command::Decompile(args) => programs::decompile_file(&args),
        Command::Check(args) => programs::check(&args),
        Command::Fmt(args) => programs::fmt(&args),
        Command::Completions { shell } => {
            clap_complete::generate(shell, &mut Args::command(), "pulsetrain", &mut std::io::stdout());
            Ok(())
        }
    }
}

/// Help goes out as it is. A mistake becomes one line, and status 1 instead of 2, which `run` has for
/// programs that fail.
fn refuse(error: &clap::Error) -> Outcome {
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
            // Nobody is left to tell that standard output is closed.
            let _ = error.print();
            Ok(())
        }
        ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            let _ = error.print();
            Err(Failure::Told(FAILED))
        }
        _ => {
            let text = error.to_string();
            let first = text.split("\n\n").next().unwrap_or(&text);
            let line = first.split_whitespace().collect::<Vec<_>>().join(" ");
            Err(Failure::Line(line.trim_start_matches("error: ").to_owned()))
        }
    }
}
