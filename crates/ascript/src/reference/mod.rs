//! A second way to execute programs, for tests and fuzzing: programs made up at random, and an interpreter
//! that walks over their statements and shares nothing with the virtual machine but the operators.

mod interpreter;
mod programs;

pub use interpreter::{End, Interpreter};
pub use programs::{Choices, program};

use crate::dialect::Dialect;
use crate::isa::Place;
use crate::vm::{Action, Exit, Fault, Memory, Thread};

/// What a program did, in the order it did it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// It read a register.
    Read(Place),
    /// It wrote one.
    Write(Place, i32),
    /// It had something done.
    Do(Action),
}

/// What the register at the n-th event reads: anything, but the same for machine and interpreter.
pub const fn reading(event: usize) -> i32 {
    (event as i32).wrapping_mul(0x9E37_79B9_u32 as i32) >> (event % 32)
}

/// Executes a program with the virtual machine until it ends or has had so many events.
///
/// # Panics
/// If the program does not fit the memory, or executes more than `lines` lines.
pub fn execute<const LINES: usize, const VARIABLES: usize>(
    memory: &mut Memory<LINES, VARIABLES>,
    program: u8,
    events: usize,
    lines: u32,
) -> (Vec<Event>, End) {
    let mut trace = Vec::new();
    let mut thread = Thread::new();
    let Some(line) = memory.program(program) else { return (trace, End::Stopped) };
    thread.start(line);
    let mut left = lines;
    while trace.len() < events {
        let (executed, exit) = thread.run(memory, left);
        left -= executed;
        match exit {
            Exit::Read(place) => {
                thread.complete(reading(trace.len()));
                trace.push(Event::Read(place));
            }
            Exit::Write(place, value) => {
                thread.done();
                trace.push(Event::Write(place, value));
            }
            Exit::Do(action) => {
                thread.done();
                trace.push(Event::Do(action));
            }
            Exit::Fault(fault) => return (trace, End::Fault(fault)),
            Exit::Stopped | Exit::Idle => return (trace, End::Stopped),
            Exit::Budget => panic!("more than {lines} lines"),
        }
    }
    (trace, End::Events)
}

/// Compiles a program that was made up, executes it both ways and compares: what it did, how it ended, and
/// the variables.
///
/// # Panics
/// If anything differs, or the program does not compile.
pub fn compare(source: &str, dialect: &Dialect) {
    const EVENTS: usize = 300;
    const LINES: u32 = 10_000_000;
    let compilation = crate::compile("made up", source.as_bytes(), dialect);
    let code = compilation.code.unwrap_or_else(|| panic!("{source}{:?}", compilation.diagnostics));
    for number in 0..dialect.threads {
        let mut memory = Memory::<1800, 100>::new();
        assert!(memory.load(&code.lines));
        let executed = execute(&mut memory, number, EVENTS, LINES);
        let mut interpreter = Interpreter::new(source, dialect);
        let interpreted = interpreter.run(number, EVENTS);
        assert_eq!(executed, interpreted, "program {number} of\n{source}");
        let variables: Vec<_> = (0..dialect.variables).filter_map(|index| memory.variable(index)).collect();
        assert_eq!(variables, interpreter.variables(), "program {number} of\n{source}");
    }
}

impl From<Fault> for End {
    fn from(fault: Fault) -> Self {
        Self::Fault(fault)
    }
}
