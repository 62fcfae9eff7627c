//! `pulsetrain debug`: a terminal at the debugger.

use crate::{FAILED, Failure, Outcome, args::DebugArgs, programs, run};
use debugger::{
    Debugger, Target,
    console::{Console, PROMPT},
};
use rustyline::{
    Config, Context, Editor, Helper, completion::Completer, error::ReadlineError, highlight::Highlighter,
    hint::Hinter, history::MemHistory, validate::Validator,
};
use std::{
    cell::RefCell,
    io::{BufRead, IsTerminal, Read, Write, stderr, stdin, stdout},
    rc::Rc,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    thread,
};
use tokio::signal::unix::{SignalKind, signal};

/// Longest line that is read from what is no terminal.
const MAX_LINE_BYTES: u64 = 1 << 16;

/// What is said to Ctrl-C where nothing runs.
const HINT: &str = "nothing runs; `quit` or Ctrl-D leaves\n";

/// Debugs a program until somebody leaves.
pub fn debug(args: DebugArgs) -> Outcome {
    let (code, said) = programs::translate(&args.program, args.device)?;
    // Whoever closed standard error does not want to know.
    let _ = stderr().write_all(said.as_bytes());
    let code = code.ok_or(Failure::Told(FAILED))?;
    let config = run::config(args.bench.as_deref(), args.device)?;
    let faults = run::faults(args.scenario.as_deref(), &config, &|place| {
        programs::address(&code, &args.program, place)
    })?;
    let debugger = Debugger::new(Target { code, config, inputs: args.at, faults }, args.limit_s)
        .map_err(|error| Failure::Line(format!("{}: {error}", args.program.display())))?;
    let mut console = Console::new(debugger);
    programs::show(&console.greeting())?;
    if stdin().is_terminal() { at_terminal(console) } else { scripted(console) }
}

/// Lines come from a file or a pipe: each is shown behind the prompt, so that the output reads as a session.
fn scripted(mut console: Console) -> Outcome {
    let mut input = stdin().lock();
    loop {
        let mut line = Vec::new();
        if (&mut input).take(MAX_LINE_BYTES).read_until(b'\n', &mut line)? == 0 {
            return Ok(());
        }
        let line = String::from_utf8_lossy(&line);
        let line = line.trim_end();
        let answer = console.execute(line);
        programs::show(&format!("{PROMPT}{line}\n{}", answer.text))?;
        if answer.quits {
            return Ok(());
        }
    }
}

fn at_terminal(console: Console) -> Outcome {
    let console = Rc::new(RefCell::new(console));
    let config = Config::builder().auto_add_history(true).build();
    let interrupt = interrupts()?;
    console.borrow_mut().debugger().set_interrupt(interrupt.clone());
    let mut editor: Editor<Completion, MemHistory> = Editor::with_history(config, MemHistory::new())?;
    editor.set_helper(Some(Completion(console.clone())));
    loop {
        match editor.readline(PROMPT) {
            Ok(line) => {
                // What came while nothing ran is over.
                interrupt.store(false, Ordering::Relaxed);
                let answer = console.borrow_mut().execute(&line);
                stdout().write_all(answer.text.as_bytes())?;
                if answer.quits {
                    return Ok(());
                }
            }
            Err(ReadlineError::Interrupted) => programs::show(HINT)?,
            Err(ReadlineError::Eof) => return Ok(()),
            Err(error) => return Err(error.into()),
        }
    }
}

/// A flag that Ctrl-C sets, instead of ending the process.
fn interrupts() -> std::io::Result<Arc<AtomicBool>> {
    let flag: Arc<AtomicBool> = Arc::default();
    let set = flag.clone();
    let runtime = tokio::runtime::Builder::new_current_thread().enable_io().build()?;
    let mut signals = runtime.block_on(async { signal(SignalKind::interrupt()) })?;
    thread::spawn(move || {
        runtime.block_on(async {
            while signals.recv().await.is_some() {
                set.store(true, Ordering::Relaxed);
            }
        });
    });
    Ok(flag)
}

/// Completes commands, labels, registers and pins.
struct Completion(Rc<RefCell<Console>>);

impl Completer for Completion {
    type Candidate = String;

    fn complete(&self, line: &str, at: usize, _: &Context<'_>) -> rustyline::Result<(usize, Vec<String>)> {
        Ok(self.0.borrow_mut().complete(&line[..at]))
    }
}

impl Helper for Completion {}

impl Highlighter for Completion {}

impl Hinter for Completion {
    type Hint = String;
}

impl Validator for Completion {}
