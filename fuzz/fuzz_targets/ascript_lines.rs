//! Any lines, as text or bytes, in a memory that two threads execute under any treatment. The treatment stands
//! behind the last byte 0.
#![no_main]

use ascript::dialect::{COMMANDER, PERFORMAX_2};
use ascript::line::{BYTES, TEXT_LENGTH};
use ascript::{Dialect, Exit, Line, Memory, Thread, decompile, image};
use libfuzzer_sys::fuzz_target;

/// Most lines of a run.
const BUDGET: u32 = 100;

/// Most runs.
const RUNS: usize = 300;

/// The lines of a program: text if it is any, else bytes.
fn lines(program: &[u8], dialect: &Dialect) -> Vec<Line> {
    match std::str::from_utf8(program) {
        Ok(text) => text.lines().filter_map(|line| Line::parse(line, dialect)).collect(),
        Err(_) => program
            .as_chunks::<BYTES>()
            .0
            .iter()
            .filter_map(|bytes| Line::from_bytes(bytes, dialect))
            .collect(),
    }
}

fuzz_target!(|input: &[u8]| {
    let end = input.iter().rposition(|&byte| byte == 0).unwrap_or(input.len());
    let (program, treatment) = input.split_at(end);
    for dialect in [&PERFORMAX_2, &COMMANDER] {
        let mut memory = Memory::<200, 64>::new();
        let lines = lines(program, dialect);
        for (&line, address) in lines.iter().zip(0..) {
            let text = line.to_string();
            assert!(text.is_ascii() && text.len() <= TEXT_LENGTH, "{text}");
            assert_eq!(Line::parse(&text, dialect), Some(line), "{text}");
            assert_eq!(Line::from_bytes(&line.to_bytes(), dialect), Some(line), "{text}");
            memory.set_line(address, line);
        }
        let _ = decompile(&lines, dialect);
        let _ = image::from_file(program, dialect);

        let mut threads = [const { Thread::new() }; 2];
        for (run, &action) in treatment.iter().take(RUNS).enumerate() {
            let thread = &mut threads[run % 2];
            match action {
                0..=99 => (),
                100..=131 => {
                    thread.start_sub(&memory, action - 100);
                }
                132 => thread.stop(),
                133..=135 => thread.pause(),
                136..=145 => thread.resume(),
                146..=160 => {
                    thread.fail(&memory, action % 2 == 0);
                }
                161..=170 => {
                    memory.set_variable(action % 8, i32::from(action) - 165);
                }
                171..=180 => {
                    memory.set_line(u16::from(action), Line::Empty);
                }
                _ => {
                    if let Some(line) = memory.program(action % 4) {
                        thread.start(line);
                    }
                }
            }
            let before = thread.instructions();
            let (executed, exit) = thread.run(&mut memory, BUDGET);
            assert!(executed <= BUDGET && thread.instructions() == before + u64::from(executed));
            match exit {
                Exit::Budget => assert_eq!(executed, BUDGET),
                Exit::Read(_) => thread.complete(i32::from(action) - 100),
                Exit::Write(..) | Exit::Do(_) if action % 3 > 0 => thread.done(),
                Exit::Fault(_) => {
                    assert_eq!(thread.fail(&memory, action % 2 == 0), thread.in_error_subroutine())
                }
                _ => (),
            }
        }
    }
});
