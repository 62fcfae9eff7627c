use super::*;
use crate::compile;
use crate::dialect::{COMMANDER, PERFORMAX_2};
use crate::line::Line;

type Device = Memory<1275, 64>;

fn memory(source: &str) -> Device {
    let compilation = compile("test", source.as_bytes(), &PERFORMAX_2);
    let Some(code) = &compilation.code else { panic!("{}", compilation.render(false)) };
    let mut memory = Device::new();
    assert!(memory.load(&code.lines));
    memory
}

/// Program 0 of this memory, started.
fn started(memory: &Device) -> Thread {
    let mut thread = Thread::new();
    thread.start(memory.program(0).expect("program 0"));
    thread
}

fn action(word: Word, axis: u8) -> Exit {
    let place = Place::new(word, axis);
    Exit::Do(Action::new(place, [None; OPERANDS]))
}

#[test]
fn lines_are_counted() {
    let mut memory = memory("PRG 0\nV1=1\nDO=V1\nV2=DI1+2\nWAITX\nEND\n");
    let mut thread = started(&memory);
    assert_eq!(thread.run(&mut memory, 0), (0, Exit::Budget));
    assert_eq!(thread.run(&mut memory, 1), (1, Exit::Budget));
    let write = Exit::Write(Place::new(Word::Do, 0), 1);
    assert_eq!(thread.run(&mut memory, 100), (2, write));
    // The device is busy: nothing goes on, and completing something else does not help.
    assert_eq!(thread.counter(), 2);
    thread.complete(5);
    assert_eq!(thread.run(&mut memory, 100), (0, write));
    assert_eq!(thread.pending(), Some(write));
    thread.done();
    assert_eq!((thread.counter(), thread.pending()), (3, None));
    let read = Exit::Read(Place::new(Word::DiBit, 1));
    assert_eq!(thread.run(&mut memory, 100), (0, read));
    thread.done();
    assert_eq!(thread.run(&mut memory, 100), (0, read));
    thread.complete(40);
    // What was read waits for a budget.
    assert_eq!(thread.run(&mut memory, 0), (0, Exit::Budget));
    assert_eq!(thread.run(&mut memory, 2), (2, Exit::Budget));
    assert_eq!(memory.variable(2), Some(42));
    assert_eq!(thread.run(&mut memory, 100), (1, action(Word::Wait, 0)));
    thread.done();
    assert_eq!(thread.run(&mut memory, 100), (1, Exit::Stopped));
    assert_eq!((thread.state(), thread.instructions()), (State::Idle, 7));
    assert_eq!(thread.run(&mut memory, 100), (0, Exit::Idle));
}

#[test]
fn states() {
    let mut memory = memory("PRG 0\nWHILE 1=1\nWAITX\nENDWHILE\nEND\n");
    let mut thread = Thread::new();
    thread.pause();
    thread.resume();
    assert_eq!(thread.state(), State::Idle);
    thread.start(memory.program(0).expect("program 0"));
    let wait = action(Word::Wait, 0);
    assert_eq!(thread.run(&mut memory, 100), (4, wait));
    thread.pause();
    assert_eq!((thread.state(), thread.run(&mut memory, 100)), (State::Paused, (0, Exit::Idle)));
    // The wait goes on meanwhile, and may end.
    thread.done();
    thread.resume();
    assert_eq!(thread.run(&mut memory, 100), (4, wait));
    thread.stop();
    assert_eq!((thread.state(), thread.counter()), (State::Idle, 3));
    thread.done();
    assert_eq!((thread.counter(), thread.run(&mut memory, 100)), (3, (0, Exit::Idle)));
    assert_eq!(
        [State::Idle, State::Running, State::Paused, State::Error].map(|state| state as u8),
        [0, 1, 2, 4]
    );
}

#[test]
fn calls() {
    // Each subroutine calls the next one; the last one is at the depth that it asks for.
    let nested = |depth: usize| {
        let mut source = "PRG 0\nGOSUB 1\nEND\n".to_owned();
        for number in 1..=depth {
            let call = if number < depth { format!("GOSUB {}\n", number + 1) } else { String::new() };
            source += &format!("SUB {number}\n{call}V{number}=1\nENDSUB\n");
        }
        let mut memory = memory(&source);
        let mut thread = started(&memory);
        let (_, exit) = thread.run(&mut memory, 1000);
        (exit, (1..=9).map(|number| memory.variable(number).unwrap_or(0)).sum::<i32>(), thread.depth())
    };
    assert_eq!(nested(1), (Exit::Stopped, 1, 0));
    assert_eq!(nested(CALL_DEPTH), (Exit::Stopped, 8, 0));
    assert_eq!(nested(CALL_DEPTH + 1), (Exit::Fault(Fault::CallDepth), 0, 8));
    let mut memory = memory("PRG 0\nGOSUB 5\nEND\n");
    let mut thread = started(&memory);
    assert_eq!(thread.run(&mut memory, 100), (1, Exit::Fault(Fault::NoSubroutine(5))));
}

#[test]
fn a_subroutine_by_itself() {
    let mut memory = memory("PRG 0\nEND\nSUB 4\nGOSUB 5\nV1=V1+1\nENDSUB\nSUB 5\nV1=10\nENDSUB\n");
    let mut thread = Thread::new();
    assert!(!thread.start_sub(&memory, 6));
    assert_eq!(thread.state(), State::Idle);
    assert!(thread.start_sub(&memory, 4));
    assert_eq!(thread.run(&mut memory, 100), (7, Exit::Stopped));
    assert_eq!(memory.variable(1), Some(11));
}

#[test]
fn faults() {
    let check = |statement: &str, fault: Fault| {
        let mut memory = memory(&format!("PRG 0\nV1=7\n{statement}\nEND\n"));
        let mut thread = started(&memory);
        let mut exit = thread.run(&mut memory, 100).1;
        if let Exit::Read(_) = exit {
            thread.complete(0);
            exit = thread.run(&mut memory, 100).1;
        }
        assert_eq!((exit, thread.counter()), (Exit::Fault(fault), 2), "{statement}");
        // Until the device deals with it, it is the same.
        if !statement.contains("DI") {
            assert_eq!(thread.run(&mut memory, 100), (0, exit));
        }
        assert_eq!((thread.fail(&memory, false), thread.state()), (false, State::Error));
        assert_eq!((memory.variable(1), thread.run(&mut memory, 100)), (Some(7), (0, Exit::Idle)));
    };
    check("V1=V1/V2", Fault::DivisionByZero);
    check("V1=V1%0", Fault::DivisionByZero);
    check("V1=V1/DI1", Fault::DivisionByZero);
    check("IF V1/V2=DI\nENDIF", Fault::DivisionByZero);
    check("WHILE V1%V2=V3\nENDWHILE", Fault::DivisionByZero);
    check("GOSUB 1", Fault::NoSubroutine(1));
}

#[test]
fn what_a_small_memory_lacks() {
    let check = |line: &str, fault: Fault| {
        let mut memory = Memory::<2, 4>::new();
        assert!(memory.set_line(0, Line::parse(line, &COMMANDER).expect("a line")));
        let mut thread = Thread::new();
        thread.start(0);
        assert_eq!(thread.run(&mut memory, 10).1, Exit::Fault(fault), "{line}");
    };
    check("V4 = 1", Fault::NoVariable);
    check("V1 = V4", Fault::NoVariable);
    check("V1 = V2 + V99", Fault::NoVariable);
    check("IF V1 = V4 -> 1", Fault::NoVariable);
    check("HSPD = V4", Fault::NoVariable);
    check("X V1 Y V4", Fault::NoVariable);
    check("V3 = 1", Fault::NoLine);
    check("ELSE -> 1799", Fault::NoLine);
    check("", Fault::NoLine);
}

#[test]
fn memory_knows_where_programs_begin() {
    let mut memory = Memory::<10, 4>::new();
    let parse = |text: &str| Line::parse(text, &PERFORMAX_2).expect("a line");
    assert!(memory.set_line(3, parse("SUB 7")) && memory.set_line(5, parse("SUB 7")));
    assert_eq!(memory.subroutine(7), Some(3));
    assert!(memory.set_line(3, parse("PRG 1")));
    assert_eq!((memory.subroutine(7), memory.program(1), memory.program(0)), (Some(5), Some(3), None));
    assert!(memory.set_line(5, Line::Empty));
    assert_eq!((memory.subroutine(7), memory.subroutine(32), memory.program(4)), (None, None, None));
    assert!(!memory.set_line(10, Line::End));
    assert!(!memory.load(&[Line::Program(0); 11]) && memory.program(1) == Some(3));
    assert!(memory.load(&[Line::End, Line::Program(0)]));
    assert_eq!((memory.program(0), memory.program(1), memory.line(3)), (Some(1), None, Some(Line::Empty)));
    assert_eq!((memory.line(10), memory.variable(4)), (None, None));
    assert!(memory.set_variable(3, -1) && !memory.set_variable(4, 0));
    assert_eq!(memory.variable(3), Some(-1));
}

/// A program that is in the middle of a statement of two axes when an error comes, at depth 1.
const FAILING: &str = "PRG 0\nV1=V1+1\nGOSUB 1\nV2=1\nEND\nSUB 1\nX11Y22\nENDSUB\nSUB 31\nT\nGOSUB 2\nENDSUB\nSUB 2\nV4=V4+1\nENDSUB\n";

/// Runs it to its move, and lets that fail.
fn failing(statement: &str, restart: bool) -> (Device, Thread, bool) {
    let mut memory = memory(&FAILING.replace("T\n", &format!("{statement}\n")));
    let mut thread = started(&memory);
    let (_, exit) = thread.run(&mut memory, 100);
    assert!(matches!(exit, Exit::Do(Action { word: Word::Linear, .. })), "{exit:?}");
    assert_eq!(thread.depth(), 1);
    let handled = thread.fail(&memory, restart);
    (memory, thread, handled)
}

#[test]
fn the_error_subroutine_comes_back_to_the_line() {
    // It uses temporaries of its own.
    let (mut memory, mut thread, handled) = failing("V3=5+6", false);
    assert!(handled && thread.in_error_subroutine());
    let (_, exit) = thread.run(&mut memory, 100);
    let Exit::Do(action) = exit else { panic!("{exit:?}") };
    assert_eq!(action.targets, [Some(11), Some(22), None, None]);
    assert!(!thread.in_error_subroutine());
    thread.done();
    assert_eq!(thread.run(&mut memory, 100).1, Exit::Stopped);
    assert_eq!([1, 2, 3, 4].map(|index| memory.variable(index)), [Some(1), Some(1), Some(11), Some(1)]);
}

#[test]
fn the_error_subroutine_comes_back_to_the_beginning() {
    let (mut memory, mut thread, handled) = failing("V3=5+6", true);
    assert!(handled);
    let (_, exit) = thread.run(&mut memory, 100);
    assert!(matches!(exit, Exit::Do(_)));
    // It is as deep as the first time, so nothing of the first round is left on the stack.
    assert_eq!((memory.variable(1), thread.depth()), (Some(2), 1));
}

#[test]
fn an_error_in_the_error_subroutine_ends_the_program() {
    let (mut memory, mut thread, handled) = failing("V3=1/0", false);
    assert!(handled);
    assert_eq!(thread.run(&mut memory, 100).1, Exit::Fault(Fault::DivisionByZero));
    assert_eq!((thread.fail(&memory, false), thread.state()), (false, State::Error));
    // An error of the device does so too.
    let (memory, mut thread, _) = failing("V3=1", false);
    assert!(!thread.fail(&memory, true) && thread.state() == State::Error);
    // Only a start helps then.
    thread.resume();
    assert!(!thread.fail(&memory, false) && thread.state() == State::Error);
    thread.start(memory.program(0).expect("program 0"));
    assert!(thread.fail(&memory, false));
}

#[test]
fn a_program_that_stops_itself_in_its_error_subroutine_ends_with_it() {
    let mut memory = memory("PRG 0\nV1=1\nV2=2\nEND\nSUB 31\nV3=3\nENDSUB\n");
    let mut thread = started(&memory);
    assert_eq!(thread.run(&mut memory, 2), (2, Exit::Budget));
    assert!(thread.fail(&memory, false));
    thread.stop_itself();
    assert_eq!(thread.state(), State::Running);
    assert_eq!(thread.run(&mut memory, 100).1, Exit::Stopped);
    assert_eq!(thread.state(), State::Idle);
    assert_eq!([1, 2, 3].map(|number| memory.variable(number)), [Some(1), Some(0), Some(3)]);
    // Anywhere else it stops at once.
    let mut thread = started(&memory);
    thread.stop_itself();
    assert_eq!(thread.state(), State::Idle);
}

#[test]
fn without_an_error_subroutine_the_program_ends() {
    let mut memory = memory("PRG 0\nWAITX\nEND\n");
    let mut thread = started(&memory);
    thread.run(&mut memory, 100);
    assert_eq!((thread.fail(&memory, false), thread.state()), (false, State::Error));
    assert_eq!((thread.counter(), thread.pending()), (1, None));
    // Without a program there are no errors.
    let mut thread = Thread::new();
    assert_eq!((thread.fail(&memory, false), thread.state()), (false, State::Idle));
}

#[test]
fn a_paused_program_handles_its_error_later() {
    let (mut memory, mut thread, _) = failing("V3=1", false);
    thread.start(memory.program(0).expect("program 0"));
    thread.pause();
    assert!(thread.fail(&memory, false) && thread.state() == State::Paused);
    thread.resume();
    assert!(matches!(thread.run(&mut memory, 100).1, Exit::Do(_)));
    assert_eq!(memory.variable(3), Some(1));
}

#[test]
fn the_error_subroutine_has_a_stack_of_its_own() {
    let mut source = "PRG 0\nGOSUB 1\nEND\n".to_owned();
    for number in 1..=8 {
        let call = if number < 8 { format!("GOSUB {}", number + 1) } else { "WAITX".to_owned() };
        source += &format!("SUB {number}\n{call}\nENDSUB\n");
    }
    source += "SUB 31\nGOSUB 11\nENDSUB\n";
    for number in 11..=18 {
        let call = if number < 18 { format!("GOSUB {}", number + 1) } else { "V1=1".to_owned() };
        source += &format!("SUB {number}\n{call}\nENDSUB\n");
    }
    let mut memory = memory(&source);
    let mut thread = started(&memory);
    let wait = action(Word::Wait, 0);
    assert_eq!(thread.run(&mut memory, 100).1, wait);
    assert!(thread.fail(&memory, false));
    assert_eq!(thread.run(&mut memory, 100).1, wait);
    assert_eq!((memory.variable(1), thread.depth()), (Some(1), 8));
    thread.done();
    assert_eq!(thread.run(&mut memory, 100).1, Exit::Stopped);
}
