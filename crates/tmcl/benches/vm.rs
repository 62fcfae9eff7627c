//! How fast the virtual machine executes a counting loop of a load, an addition, a store, a comparison
//! and a jump, with an interrupt armed. The yardstick is the same loop in an interpreter that can do
//! nothing else; both are measured in turns, so that a change of the machine's pace hits both.

use std::hint::black_box;
use std::time::{Duration, Instant};
use tmcl::isa::{Condition, Operation, opcode};
use tmcl::vm::Exit;
use tmcl::{Command, Vm};

/// Commands a measurement.
const COMMANDS: u32 = 5_000_000;

/// Measurements of each.
const ROUNDS: usize = 21;

fn counting_loop() -> Vm {
    let mut vm = Vm::new();
    vm.load(&[
        Command::new(opcode::VECT, 0, 0, 100),
        Command::new(opcode::EI, 0, 0, 0),
        Command::new(opcode::EI, 255, 0, 0),
        Command::new(opcode::GGP, 7, 2, 0),
        Command::new(opcode::CALC, Operation::Add as u8, 0, 1),
        Command::new(opcode::AGP, 7, 2, 0),
        Command::new(opcode::COMP, 0, 0, i32::MIN),
        Command::new(opcode::JC, Condition::NotEqual as u8, 0, 3),
    ])
    .expect("fits");
    vm.start(Some(0)).expect("an address");
    assert_eq!(vm.run(3), (3, Exit::Budget));
    vm
}

fn run(vm: &mut Vm) {
    assert_eq!(vm.run(black_box(COMMANDS)), (COMMANDS, Exit::Budget));
}

/// The five commands, and nothing else.
#[derive(Clone, Copy)]
enum Bare {
    Load(u8),
    Add(i32),
    Store(u8),
    Compare(i32),
    JumpIfNotEqual(u16),
}

struct Baseline {
    program: Vec<Bare>,
    variables: [i32; 256],
}

fn baseline() -> Baseline {
    let program =
        vec![Bare::Load(7), Bare::Add(1), Bare::Store(7), Bare::Compare(i32::MIN), Bare::JumpIfNotEqual(0)];
    Baseline { program, variables: [0; 256] }
}

#[inline(never)]
fn run_baseline(machine: &mut Baseline) {
    let (mut counter, mut accumulator, mut equal) = (0u16, 0i32, false);
    for _ in 0..black_box(COMMANDS) {
        let Some(&command) = machine.program.get(usize::from(counter)) else { break };
        counter += 1;
        match command {
            Bare::Load(variable) => accumulator = machine.variables[usize::from(variable)],
            Bare::Add(value) => accumulator = accumulator.wrapping_add(value),
            Bare::Store(variable) => machine.variables[usize::from(variable)] = accumulator,
            Bare::Compare(value) => equal = accumulator == value,
            Bare::JumpIfNotEqual(target) => {
                if !equal {
                    counter = target;
                }
            }
        }
    }
    black_box(accumulator);
}

fn time<T>(machine: &mut T, run: fn(&mut T)) -> Duration {
    let start = Instant::now();
    run(machine);
    start.elapsed()
}

/// Nanoseconds a command: the median of the measurements.
fn nanoseconds(mut times: Vec<Duration>) -> f64 {
    times.sort_unstable();
    times[times.len() / 2].as_secs_f64() * 1e9 / f64::from(COMMANDS)
}

fn compare() {
    let (mut vm, mut bare) = (counting_loop(), baseline());
    let (mut vm_times, mut bare_times) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        bare_times.push(time(&mut bare, run_baseline));
        vm_times.push(time(&mut vm, run));
    }
    let (vm, bare) = (nanoseconds(vm_times), nanoseconds(bare_times));
    println!(
        "virtual machine {vm:.2} ns a command ({:.0} million a second), bare match loop {bare:.2} ns, ratio {:.2}",
        1e3 / vm,
        vm / bare
    );
}

#[divan::bench]
fn virtual_machine(bencher: divan::Bencher<'_, '_>) {
    bencher.counter(divan::counter::ItemsCount::new(COMMANDS)).with_inputs(counting_loop).bench_refs(run);
}

#[divan::bench]
fn bare_match_loop(bencher: divan::Bencher<'_, '_>) {
    bencher.counter(divan::counter::ItemsCount::new(COMMANDS)).with_inputs(baseline).bench_refs(run_baseline);
}

fn main() {
    compare();
    divan::main();
}
