//! How fast the virtual machine executes a loop of arithmetic, `IF` and `WHILE`. The yardstick is the same
//! loop in an interpreter that can do nothing else; both are measured in turns, so that a change of the
//! machine's pace hits both.

use ascript::dialect::PERFORMAX_2;
use ascript::{Exit, Memory, Thread, compile};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// Lines a measurement.
const LINES: u32 = 5_000_000;

/// Measurements of each.
const ROUNDS: usize = 21;

const SOURCE: &str = "\
PRG 0
WHILE V1!=-1
  V1=V1+1
  V2=V1&7
  IF V2=V4
    V3=V3+V1
  ENDIF
ENDWHILE
END
";

struct Machine {
    memory: Memory<1275, 64>,
    thread: Thread,
}

fn machine() -> Machine {
    let code = compile("bench", SOURCE.as_bytes(), &PERFORMAX_2).code.expect("correct");
    let mut machine = Machine { memory: Memory::new(), thread: Thread::new() };
    assert!(machine.memory.load(&code.lines));
    machine.memory.set_variable(4, 3);
    machine.thread.start(0);
    machine
}

fn run(Machine { memory, thread }: &mut Machine) {
    assert_eq!(thread.run(memory, black_box(LINES)), (LINES, Exit::Budget));
}

/// The lines of the loop, and nothing else.
#[derive(Clone, Copy)]
enum Bare {
    /// Leaves if the variable has the value.
    WhileNot(u8, i32, u16),
    Add(u8, u8, i32),
    And(u8, u8, i32),
    /// Goes on there unless the variables are equal.
    If(u8, u8, u16),
    AddVariables(u8, u8, u8),
    Nothing,
    Jump(u16),
}

struct Baseline {
    program: Vec<Bare>,
    variables: [i32; 64],
}

fn baseline() -> Baseline {
    let program = vec![
        Bare::WhileNot(1, -1, 7),
        Bare::Add(1, 1, 1),
        Bare::And(2, 1, 7),
        Bare::If(2, 4, 5),
        Bare::AddVariables(3, 3, 1),
        Bare::Nothing,
        Bare::Jump(0),
    ];
    let mut variables = [0; 64];
    variables[4] = 3;
    Baseline { program, variables }
}

#[inline(never)]
fn run_baseline(Baseline { program, variables }: &mut Baseline) {
    let mut counter = 0u16;
    for _ in 0..black_box(LINES) {
        let Some(&line) = program.get(usize::from(counter)) else { break };
        counter += 1;
        match line {
            Bare::WhileNot(x, value, target) => {
                if variables[usize::from(x)] == value {
                    counter = target;
                }
            }
            Bare::Add(target, x, value) => {
                variables[usize::from(target)] = variables[usize::from(x)].wrapping_add(value);
            }
            Bare::And(target, x, value) => variables[usize::from(target)] = variables[usize::from(x)] & value,
            Bare::If(x, y, target) => {
                if variables[usize::from(x)] != variables[usize::from(y)] {
                    counter = target;
                }
            }
            Bare::AddVariables(target, x, y) => {
                variables[usize::from(target)] =
                    variables[usize::from(x)].wrapping_add(variables[usize::from(y)]);
            }
            Bare::Nothing => (),
            Bare::Jump(target) => counter = target,
        }
    }
    black_box(variables);
}

fn time<T>(machine: &mut T, run: fn(&mut T)) -> Duration {
    let start = Instant::now();
    run(machine);
    start.elapsed()
}

/// Nanoseconds a line: the median of the measurements.
fn nanoseconds(mut times: Vec<Duration>) -> f64 {
    times.sort_unstable();
    times[times.len() / 2].as_secs_f64() * 1e9 / f64::from(LINES)
}

fn compare() {
    let (mut machine, mut bare) = (machine(), baseline());
    let (mut machine_times, mut bare_times) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        bare_times.push(time(&mut bare, run_baseline));
        machine_times.push(time(&mut machine, run));
    }
    let (machine, bare) = (nanoseconds(machine_times), nanoseconds(bare_times));
    println!(
        "virtual machine {machine:.2} ns a line ({:.0} million a second), bare match loop {bare:.2} ns, ratio {:.2}",
        1e3 / machine,
        machine / bare
    );
}

#[divan::bench]
fn virtual_machine(bencher: divan::Bencher<'_, '_>) {
    bencher.counter(divan::counter::ItemsCount::new(LINES)).with_inputs(machine).bench_refs(run);
}

#[divan::bench]
fn bare_match_loop(bencher: divan::Bencher<'_, '_>) {
    bencher.counter(divan::counter::ItemsCount::new(LINES)).with_inputs(baseline).bench_refs(run_baseline);
}

fn main() {
    compare();
    divan::main();
}
