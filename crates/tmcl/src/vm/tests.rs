//! One topic a test, each a rule of how programs execute.

use super::*;
use crate::isa::{Condition, Flag, GLOBAL_INTERRUPT, Operation, PROGRAM_LENGTH, opcode::*};

/// Plenty for any program here.
const BUDGET: u32 = 10_000;

fn c(opcode: u8, kind: u8, motor: u8, value: i32) -> Command {
    Command::new(opcode, kind, motor, value)
}

fn load(value: i32) -> Command {
    c(CALC, Operation::Load as u8, 0, value)
}

fn started(program: &[Command]) -> Vm {
    let mut vm = Vm::new();
    vm.load(program).expect("fits");
    vm.start(Some(0)).expect("an address");
    vm
}

/// Runs a program that needs no device, to its end.
fn finished(program: &[Command]) -> Vm {
    let mut vm = started(program);
    assert!(matches!(vm.run(BUDGET).1, Exit::Stopped(_)));
    vm
}

/// Which of the conditions 0 to 7 hold.
fn conditions(vm: &Vm) -> Vec<&'static str> {
    let names = Condition::KEYWORDS.iter().take(8);
    names.filter(|word| vm.registers.flags.holds(word.number)).map(|word| word.name).collect()
}

#[test]
fn arithmetic_wraps_and_truncates() {
    let check = |operation: Operation, left: i32, right: i32, expected: i32| {
        let kind = operation as u8;
        let vm = finished(&[load(left), c(CALC, kind, 0, right)]);
        assert_eq!(vm.accumulator(), expected, "CALC {operation:?} {left} {right}");
        // The relatives do the same with other operands.
        let (first, second) = (c(SGP, 1, 2, left), c(SGP, 2, 2, right));
        let x = [load(right), c(CALCX, Operation::Load as u8, 0, 0), load(left)];
        let vm = finished(&[first, second, c(CALCVV, kind, 1, 2)]);
        assert_eq!(vm.variable(1), expected, "CALCVV {operation:?}");
        let vm = finished(&[first, load(right), c(CALCVA, kind, 1, 0)]);
        assert_eq!(vm.variable(1), expected, "CALCVA {operation:?}");
        let vm = finished(&[second, load(left), c(CALCAV, kind, 2, 0)]);
        assert_eq!(vm.accumulator(), expected, "CALCAV {operation:?}");
        let vm = finished(&[x[0], x[1], first, c(CALCVX, kind, 1, 0)]);
        assert_eq!(vm.variable(1), expected, "CALCVX {operation:?}");
        let vm = finished(&[load(left), x[1], second, c(CALCXV, kind, 2, 0)]);
        assert_eq!(vm.x(), expected, "CALCXV {operation:?}");
        if operation != Operation::Not {
            let vm = finished(&[x[0], x[1], x[2], c(CALCX, kind, 0, 0)]);
            assert_eq!(vm.accumulator(), expected, "CALCX {operation:?}");
            let vm = finished(&[first, c(CALCV, kind, 1, right)]);
            assert_eq!(vm.variable(1), expected, "CALCV {operation:?}");
        }
    };
    check(Operation::Add, i32::MAX, 1, i32::MIN);
    check(Operation::Sub, i32::MIN, 1, i32::MAX);
    check(Operation::Mul, 0x10000, 0x10001, 0x10000);
    check(Operation::Div, -7, 2, -3);
    check(Operation::Div, i32::MIN, -1, i32::MIN);
    check(Operation::Mod, -7, 2, -1);
    check(Operation::Mod, 7, -2, 1);
    check(Operation::Mod, i32::MIN, -1, 0);
    check(Operation::Div, 5, 0, 5);
    check(Operation::Mod, 5, 0, 5);
    check(Operation::And, 0b1100, 0b1010, 0b1000);
    check(Operation::Or, 0b1100, 0b1010, 0b1110);
    check(Operation::Xor, 0b1100, 0b1010, 0b0110);
}

#[test]
fn complement_takes_the_last_operand() {
    let not = Operation::Not as u8;
    let (five, nine) = (c(SGP, 1, 2, 5), c(SGP, 2, 2, 9));
    let x_is_three = [load(3), c(CALCX, Operation::Load as u8, 0, 0)];
    assert_eq!(finished(&[load(5), c(CALC, not, 0, 77)]).accumulator(), !5);
    assert_eq!(finished(&[five, c(CALCV, not, 1, 77)]).variable(1), !5);
    assert_eq!(finished(&[five, nine, c(CALCVV, not, 1, 2)]).variable(1), !9);
    assert_eq!(finished(&[load(3), c(CALCVA, not, 1, 0)]).variable(1), !3);
    assert_eq!(finished(&[five, c(CALCAV, not, 1, 0)]).accumulator(), !5);
    assert_eq!(finished(&[x_is_three[0], x_is_three[1], c(CALCVX, not, 1, 0)]).variable(1), !3);
    assert_eq!(finished(&[five, c(CALCXV, not, 1, 0)]).x(), !5);
    let vm = finished(&[x_is_three[0], x_is_three[1], load(8), c(CALCX, not, 0, 0)]);
    assert_eq!((vm.accumulator(), vm.x()), (8, !3));
}

#[test]
fn load_and_swap_leave_the_flags_alone() {
    let (load_kind, swap) = (Operation::Load as u8, Operation::Swap as u8);
    for command in [
        load(0),
        c(CALCX, load_kind, 0, 0),
        c(CALCX, swap, 0, 0),
        c(CALCVV, load_kind, 1, 2),
        c(CALCVV, swap, 1, 2),
        c(CALCVA, load_kind, 1, 0),
        c(CALCVA, swap, 1, 0),
        c(CALCAV, load_kind, 1, 0),
        c(CALCAV, swap, 1, 0),
        c(CALCVX, load_kind, 1, 0),
        c(CALCVX, swap, 1, 0),
        c(CALCXV, load_kind, 1, 0),
        c(CALCXV, swap, 1, 0),
        c(CALCV, load_kind, 1, 0),
        c(AGP, 1, 2, 0),
        c(SGP, 1, 2, 0),
        c(SIV, 0, 0, 0),
        c(AIV, 0, 0, 0),
    ] {
        let vm = finished(&[load(7), c(COMP, 0, 0, 5), command]);
        assert_eq!(conditions(&vm), ["NZ", "NE", "GT", "GE"], "{command:?}");
    }
}

#[test]
fn swap_exchanges() {
    let swap = Operation::Swap as u8;
    let vm = finished(&[c(SGP, 1, 2, 5), c(SGP, 2, 2, 9), c(CALCVV, swap, 1, 2)]);
    assert_eq!((vm.variable(1), vm.variable(2)), (9, 5));
    for command in [c(CALCVA, swap, 1, 0), c(CALCAV, swap, 1, 0)] {
        let vm = finished(&[c(SGP, 1, 2, 5), load(9), command]);
        assert_eq!((vm.variable(1), vm.accumulator()), (9, 5));
    }
    for command in [c(CALCVX, swap, 1, 0), c(CALCXV, swap, 1, 0)] {
        let vm = finished(&[c(SGP, 1, 2, 5), load(9), c(CALCX, Operation::Load as u8, 0, 0), command]);
        assert_eq!((vm.variable(1), vm.x()), (9, 5));
    }
    let vm = finished(&[load(9), c(CALCX, swap, 0, 0)]);
    assert_eq!((vm.accumulator(), vm.x()), (0, 9));
}

#[test]
fn comparisons_set_all_flags() {
    let check = |left: i32, right: i32, expected: &[&str]| {
        let comp = Operation::Comp as u8;
        let x_is_right = [load(right), c(CALCX, Operation::Load as u8, 0, 0)];
        let (first, second) = (c(SGP, 1, 2, left), c(SGP, 2, 2, right));
        let programs: [&[Command]; 7] = [
            &[load(left), c(COMP, 0, 0, right)],
            &[first, second, c(CALCVV, comp, 1, 2)],
            &[first, load(right), c(CALCVA, comp, 1, 0)],
            &[second, load(left), c(CALCAV, comp, 2, 0)],
            &[x_is_right[0], x_is_right[1], first, c(CALCVX, comp, 1, 0)],
            &[load(left), x_is_right[1], second, c(CALCXV, comp, 2, 0)],
            &[first, c(CALCV, comp, 1, right)],
        ];
        for program in programs {
            assert_eq!(conditions(&finished(program)), expected, "{program:?}");
        }
    };
    check(5, 5, &["ZE", "EQ", "GE", "LE"]);
    check(5, 6, &["NZ", "NE", "LT", "LE"]);
    check(6, 5, &["NZ", "NE", "GT", "GE"]);
    check(i32::MIN, i32::MAX, &["NZ", "NE", "LT", "LE"]);
}

#[test]
fn results_set_zero_and_sign_but_not_equality() {
    let check = |compared: i32, operand: i32, expected: &[&str]| {
        let program = [load(5), c(COMP, 0, 0, compared), c(CALC, Operation::Add as u8, 0, operand)];
        assert_eq!(conditions(&finished(&program)), expected);
    };
    check(5, -5, &["ZE", "EQ", "GE", "LE"]);
    check(5, 1, &["NZ", "EQ", "GT", "GE"]);
    check(4, -5, &["ZE", "NE", "GE", "LE"]);
    check(5, -6, &["NZ", "EQ", "LT", "LE"]);
}

#[test]
fn division_by_zero_leaves_the_flags() {
    for operation in [Operation::Div, Operation::Mod] {
        let vm = finished(&[load(7), c(COMP, 0, 0, 9), c(CALC, operation as u8, 0, 0)]);
        assert_eq!(conditions(&vm), ["NZ", "NE", "LT", "LE"]);
    }
}

#[test]
fn reading_compares_with_zero() {
    let check = |value: i32, expected: &[&str]| {
        let vm = finished(&[c(SGP, 9, 2, value), c(GGP, 9, 2, 0)]);
        assert_eq!((vm.accumulator(), conditions(&vm)), (value, expected.to_vec()));
        let vm = finished(&[c(SGP, 0, 2, value), c(GIV, 0, 0, 0)]);
        assert_eq!((vm.accumulator(), conditions(&vm)), (value, expected.to_vec()));
        let mut vm = started(&[c(GAP, 1, 0, 0)]);
        assert_eq!(vm.run(BUDGET), (0, Exit::Host(c(GAP, 1, 0, 0))));
        vm.complete(Outcome::Value(value));
        assert_eq!((vm.accumulator(), conditions(&vm)), (value, expected.to_vec()));
    };
    check(0, &["ZE", "EQ", "GE", "LE"]);
    check(-3, &["NZ", "NE", "LT", "LE"]);
    check(3, &["NZ", "NE", "GT", "GE"]);
}

#[test]
fn indexed_variables() {
    let x_is = |value| [load(value), c(CALCX, Operation::Load as u8, 0, 0)];
    let run = |x: i32, tail: &[Command]| finished(&[&x_is(x)[..], tail].concat());
    assert_eq!(run(255, &[c(SIV, 0, 0, 42)]).variable(255), 42);
    assert_eq!(run(7, &[load(6), c(AIV, 0, 0, 0)]).variable(7), 6);
    assert_eq!(run(7, &[c(SIV, 0, 0, 42), c(GIV, 0, 0, 0)]).accumulator(), 42);
    for x in [-1, 256, i32::MIN] {
        let vm = run(x, &[load(6), c(COMP, 0, 0, 9), c(SIV, 0, 0, 42), c(AIV, 0, 0, 0), c(GIV, 0, 0, 0)]);
        assert_eq!(vm.variables, [0; 256]);
        assert_eq!((vm.accumulator(), conditions(&vm)), (6, vec!["NZ", "NE", "LT", "LE"]));
    }
}

#[test]
fn conditional_jumps() {
    for condition in Condition::KEYWORDS {
        // The accumulator tells whether the jump was taken.
        let program = [load(1), c(JC, condition.number, 0, 3), load(2), c(STOP, 0, 0, 0)];
        for raised in [false, true] {
            let mut vm = started(&program);
            vm.run(1);
            let error = Condition::from_number(condition.number).expect("a condition");
            if raised {
                vm.set_error(error);
            }
            vm.run(BUDGET);
            // After a reset, only NZ and NE hold; only error flags can be raised.
            let holds = matches!(condition.name, "NZ" | "NE") || raised && condition.number >= 8;
            assert_eq!(vm.accumulator(), if holds { 1 } else { 2 }, "{condition:?}");
        }
    }
}

#[test]
fn clearing_error_flags() {
    let errors = [
        (Flag::Timeout, Condition::Timeout),
        (Flag::Alarm, Condition::Alarm),
        (Flag::Deviation, Condition::Deviation),
        (Flag::PositionError, Condition::PositionError),
        (Flag::Shutdown, Condition::Shutdown),
    ];
    for flag in Flag::KEYWORDS {
        let mut vm = started(&[load(1), c(COMP, 0, 0, 1), c(CLE, flag.number, 0, 0)]);
        errors.iter().for_each(|&(_, condition)| vm.set_error(condition));
        vm.run(3);
        for (own, condition) in errors {
            let cleared = flag.name == "ALL" || flag.number == own as u8;
            assert_eq!(vm.condition(condition), !cleared, "{flag:?} {condition:?}");
        }
        assert_eq!(conditions(&vm), ["ZE", "EQ", "GE", "LE"]);
    }
}

#[test]
fn counting_loop() {
    let vm = finished(&[c(SGP, 42, 2, 3), c(CALCV, 0, 1, 10), c(DJNZ, 42, 0, 1)]);
    assert_eq!((vm.variable(42), vm.variable(1), vm.instructions()), (0, 30, 7));
    let mut vm = started(&[c(SGP, 42, 2, i32::MIN), c(DJNZ, 42, 0, 5)]);
    vm.run(2);
    assert_eq!((vm.variable(42), vm.counter()), (i32::MAX, 5));
}

#[test]
fn subroutines_nest_eight_deep() {
    // Calls itself; the ninth call does nothing, and the program goes on behind it.
    let mut vm = started(&[c(CSUB, 0, 0, 0), c(CALCV, 0, 1, 1), c(RSUB, 0, 0, 0)]);
    assert_eq!(vm.run(9), (9, Exit::Budget));
    assert_eq!((vm.stack(), vm.counter()), (&[1u16; 8][..], 1));
    // Nine returns: eight of them come back to address 1, the last finds the stack empty.
    assert_eq!(vm.run(BUDGET).1, Exit::Stopped(Stopped::End));
    assert_eq!((vm.variable(1), vm.stack().len(), vm.counter()), (9, 0, 3));
}

#[test]
fn conditional_calls() {
    let program = |condition: Condition| {
        [
            load(1),
            c(COMP, 0, 0, 1),
            c(CALL, condition as u8, 0, 5),
            c(CALCV, 0, 1, 1),
            STOP_COMMAND,
            c(CALCV, 0, 1, 10),
            c(RSUB, 0, 0, 0),
        ]
    };
    const STOP_COMMAND: Command = Command::STOP;
    assert_eq!(finished(&program(Condition::Equal)).variable(1), 11);
    assert_eq!(finished(&program(Condition::NotEqual)).variable(1), 1);
}

#[test]
fn failing_commands_are_passed_over() {
    let check = |command: Command, status: Status| {
        let mut vm = started(&[load(5), c(COMP, 0, 0, 5), command, Command::STOP]);
        let before = vm.variables;
        let fault = Fault { address: 2, command, status };
        assert_eq!(vm.run(BUDGET), (3, Exit::Skipped(fault)));
        assert_eq!((vm.accumulator(), vm.x(), vm.counter(), vm.variables), (5, 0, 3, before));
        assert_eq!(conditions(&vm), ["ZE", "EQ", "GE", "LE"]);
        assert_eq!(vm.run(BUDGET), (1, Exit::Stopped(Stopped::Stop)));
        assert_eq!(vm.instructions(), 4);
    };
    for kind in [10, 11, 12, 255] {
        check(c(CALC, kind, 0, 1), Status::WRONG_TYPE);
    }
    check(c(CALCX, 11, 0, 0), Status::WRONG_TYPE);
    check(c(CALCV, 10, 1, 0), Status::WRONG_TYPE);
    for opcode in [CALCVV, CALCVA, CALCAV, CALCVX, CALCXV, CALCV] {
        check(c(opcode, 12, 1, 0), Status::WRONG_TYPE);
    }
    check(c(CALCVV, 0, 1, 256), Status::INVALID_VALUE);
    check(c(CALCVV, 10, 1, -1), Status::INVALID_VALUE);
    check(c(CLE, 6, 0, 0), Status::WRONG_TYPE);
    check(c(JC, 13, 0, 0), Status::WRONG_TYPE);
    check(c(CALL, 13, 0, 0), Status::WRONG_TYPE);
    for opcode in [JA, CSUB, RST, DJNZ] {
        check(c(opcode, 0, 0, 2048), Status::INVALID_VALUE);
        check(c(opcode, 0, 0, -1), Status::INVALID_VALUE);
    }
    check(c(JC, 0, 0, 2048), Status::INVALID_VALUE);
    check(c(CALL, 0, 0, -1), Status::INVALID_VALUE);
    check(c(VECT, 0, 0, 2048), Status::INVALID_VALUE);
    check(c(VECT, 4, 0, 0), Status::WRONG_TYPE);
    check(c(EI, 4, 0, 0), Status::WRONG_TYPE);
    check(c(DI, 254, 0, 0), Status::WRONG_TYPE);
    check(c(WAIT, 5, 0, 0), Status::WRONG_TYPE);
    check(c(WAIT, 0, 0, -2), Status::INVALID_VALUE);
    check(c(UF0, 0, 0, 0), Status::NOT_AVAILABLE);
    check(c(16, 0, 0, 0), Status::INVALID_COMMAND);
    check(c(0, 1, 0, 0), Status::INVALID_COMMAND);
}

#[test]
fn a_program_ends() {
    let check = |program: &[Command], executed: u32, stopped: Stopped, counter: u16| {
        let mut vm = started(program);
        assert_eq!(vm.run(BUDGET), (executed, Exit::Stopped(stopped)));
        assert_eq!((vm.mode(), vm.counter()), (Mode::Stop, counter));
        assert_eq!(vm.run(BUDGET), (0, Exit::Idle));
    };
    check(&[load(1), Command::STOP, load(2)], 2, Stopped::Stop, 1);
    check(&[load(1)], 1, Stopped::End, 1);
    check(&[load(1); 2048], 2048, Stopped::End, 2048);
    for opcode in (128..=139).chain([255]) {
        let command = c(opcode, 0, 0, 1234);
        check(&[load(1), command], 1, Stopped::DirectOnly(command), 1);
    }
}

#[test]
fn the_device_executes_what_concerns_it() {
    for opcode in [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 30, 31, 32, 34, 35, 39, 46, 50, 51] {
        let command = c(opcode, 1, 0, 17);
        let mut vm = started(&[load(5), command, load(6)]);
        assert_eq!(vm.run(BUDGET), (1, Exit::Host(command)), "{command:?}");
        assert_eq!((vm.counter(), vm.instructions()), (1, 1));
        // Until it is done nothing moves on.
        assert_eq!(vm.run(BUDGET), (0, Exit::Host(command)));
        vm.complete(Outcome::Done);
        assert_eq!((vm.counter(), vm.instructions(), vm.accumulator()), (2, 2, 5));
        vm.complete(Outcome::Value(9));
        assert_eq!((vm.counter(), vm.accumulator()), (2, 5), "nothing to complete");
    }
    let mut vm = started(&[load(5), c(GAP, 250, 0, 0)]);
    vm.run(BUDGET);
    vm.complete(Outcome::Skipped);
    assert_eq!((vm.counter(), vm.accumulator()), (2, 5));
}

#[test]
fn the_budget_is_kept() {
    let mut vm = started(&[c(CALCV, 0, 1, 1), c(JA, 0, 0, 0)]);
    assert_eq!(vm.run(0), (0, Exit::Budget));
    assert_eq!(vm.run(7), (7, Exit::Budget));
    assert_eq!((vm.variable(1), vm.counter(), vm.instructions()), (4, 1, 7));
}

#[test]
fn waiting() {
    let wait = Wait { event: WaitFor::Position, motor: 0, ticks: 20 };
    let hold = Hold { event: WaitFor::Position, motor: 0, until: 777 };
    for timed_out in [false, true] {
        let mut vm = started(&[c(WAIT, 1, 0, 20), Command::STOP]);
        assert_eq!(vm.run(BUDGET), (0, Exit::Wait(wait)));
        assert_eq!((vm.run(BUDGET), vm.waiting()), ((0, Exit::Wait(wait)), None));
        vm.hold(777);
        assert_eq!((vm.run(BUDGET), vm.waiting()), ((0, Exit::Waiting(hold)), Some(hold)));
        assert_eq!(vm.counter(), 0);
        vm.wait_over(timed_out);
        assert_eq!((vm.counter(), vm.condition(Condition::Timeout)), (1, timed_out));
        assert_eq!(vm.run(BUDGET), (1, Exit::Stopped(Stopped::Stop)));
    }
}

#[test]
fn waiting_as_long_as_the_accumulator_says() {
    let check = |accumulator: i32, value: i32, expected: Option<u32>| {
        let mut vm = started(&[load(accumulator), c(WAIT, 0, 0, value)]);
        let exit = vm.run(BUDGET).1;
        assert_eq!(if let Exit::Wait(wait) = exit { Some(wait.ticks) } else { None }, expected);
    };
    check(50, 20, Some(20));
    check(50, -1, Some(50));
    check(-1, -1, None);
}

/// Sets up interrupts 0 and 3 with handlers at 20 and 30 that add 1 and 100 to variable 1, and loops.
fn with_interrupts(body: &[Command]) -> Vm {
    let mut program = vec![
        c(VECT, 0, 0, 20),
        c(VECT, 3, 0, 30),
        c(EI, 0, 0, 0),
        c(EI, 3, 0, 0),
        c(EI, GLOBAL_INTERRUPT, 0, 0),
    ];
    program.extend_from_slice(body);
    program.resize(20, c(JA, 0, 0, 5));
    program.extend([load(-1), c(CALCX, 9, 0, 0), c(COMP, 0, 0, -1), c(CALCV, 0, 1, 1), c(RETI, 0, 0, 0)]);
    program.resize(30, Command::STOP);
    program.extend([c(CALCV, 0, 1, 100), c(RETI, 0, 0, 0)]);
    let mut vm = started(&program);
    assert_eq!(vm.run(5), (5, Exit::Budget));
    vm
}

#[test]
fn an_interrupt_saves_and_restores_the_registers() {
    let mut vm = with_interrupts(&[load(8), c(CALCX, 9, 0, 0), load(7), c(COMP, 0, 0, 9)]);
    vm.run(4);
    vm.raise(0);
    assert_eq!(vm.run(1).0, 1);
    assert_eq!((vm.counter(), vm.accumulator(), vm.in_handler()), (21, -1, true));
    vm.run(4);
    assert_eq!((vm.counter(), vm.accumulator(), vm.x(), vm.in_handler()), (9, 7, 8, false));
    assert_eq!((conditions(&vm), vm.variable(1)), (vec!["NZ", "NE", "LT", "LE"], 1));
}

#[test]
fn an_error_flag_survives_the_return_from_a_handler() {
    let mut vm = with_interrupts(&[]);
    vm.raise(3);
    vm.run(1);
    vm.set_error(Condition::Deviation);
    vm.run(1);
    assert!(vm.condition(Condition::Deviation) && !vm.in_handler());
}

#[test]
fn interrupts_do_not_nest_and_the_lowest_comes_first() {
    let mut vm = with_interrupts(&[]);
    vm.raise(3);
    vm.raise(0);
    vm.run(1);
    assert_eq!(vm.counter(), 21);
    vm.raise(0);
    // Handler 0 ends, comes again, and then it is handler 3's turn.
    vm.run(4 + 5);
    assert_eq!((vm.variable(1), vm.in_handler()), (2, false));
    vm.run(2);
    assert_eq!((vm.variable(1), vm.in_handler()), (102, false));
}

#[test]
fn an_interrupt_needs_enable_vector_and_a_running_program() {
    let runs_handler = |prepare: fn(&mut Vm)| {
        let mut vm = with_interrupts(&[]);
        prepare(&mut vm);
        vm.run(20);
        vm.variable(1) != 0
    };
    assert!(runs_handler(|vm| vm.raise(0)));
    assert!(!runs_handler(|vm| vm.raise(1)), "no vector");
    assert!(!runs_handler(|vm| vm.raise(4)), "no such interrupt");
    assert!(!runs_handler(|vm| {
        vm.direct(c(DI, 0, 0, 0));
        vm.raise(0);
    }));
    assert!(!runs_handler(|vm| {
        vm.raise(0);
        vm.direct(c(DI, 0, 0, 0));
        vm.direct(c(EI, 0, 0, 0));
    }));
    assert!(!runs_handler(|vm| {
        vm.direct(c(DI, GLOBAL_INTERRUPT, 0, 0));
        vm.raise(0);
    }));
    // Disabled all together, an interrupt waits.
    assert!(runs_handler(|vm| {
        vm.direct(c(DI, GLOBAL_INTERRUPT, 0, 0));
        vm.raise(0);
        vm.run(3);
        vm.direct(c(EI, GLOBAL_INTERRUPT, 0, 0));
    }));
    assert!(!runs_handler(|vm| {
        vm.stop();
        vm.raise(0);
        vm.start(None).expect("no address");
    }));
}

#[test]
fn an_interrupt_during_a_wait() {
    let mut vm = with_interrupts(&[c(WAIT, 0, 0, 50)]);
    assert_eq!(vm.run(1), (0, Exit::Wait(Wait { event: WaitFor::Ticks, motor: 0, ticks: 50 })));
    vm.hold(1234);
    vm.raise(3);
    // The handler runs, and then the same wait goes on.
    let hold = Hold { event: WaitFor::Ticks, motor: 0, until: 1234 };
    assert_eq!(vm.run(BUDGET), (2, Exit::Waiting(hold)));
    assert_eq!((vm.variable(1), vm.counter()), (100, 5));
    vm.wait_over(false);
    assert_eq!(vm.counter(), 6);
}

#[test]
fn a_handler_may_wait_too() {
    let mut vm = with_interrupts(&[c(WAIT, 0, 0, 50)]);
    vm.store(30, c(WAIT, 1, 0, 0)).expect("an address");
    vm.run(1);
    vm.hold(1234);
    vm.raise(3);
    assert!(matches!(vm.run(BUDGET), (0, Exit::Wait(_))));
    vm.hold(u64::MAX);
    assert_eq!(vm.waiting().map(|hold| hold.until), Some(u64::MAX));
    vm.wait_over(false);
    assert_eq!(vm.run(BUDGET).0, 1);
    assert_eq!(vm.waiting().map(|hold| hold.until), Some(1234));
}

#[test]
fn a_restart_leaves_subroutine_and_handler() {
    let mut vm = with_interrupts(&[c(CSUB, 0, 0, 6), load(5), c(COMP, 0, 0, 5)]);
    vm.store(30, c(RST, 0, 0, 5)).expect("an address");
    vm.run(3);
    vm.set_error(Condition::Timeout);
    vm.raise(3);
    vm.run(1);
    assert_eq!((vm.counter(), vm.accumulator(), vm.x(), vm.stack().len()), (5, 0, 0, 0));
    assert_eq!((vm.in_handler(), vm.condition(Condition::Timeout)), (false, false));
    assert_eq!(conditions(&vm), ["NZ", "NE"]);
    // Interrupts are still set up.
    vm.raise(3);
    vm.run(1);
    assert_eq!((vm.counter(), vm.mode()), (5, Mode::Run));
}

#[test]
fn a_return_without_a_handler_does_nothing() {
    let vm = finished(&[load(3), c(RETI, 0, 0, 0), c(CALC, 0, 0, 1)]);
    assert_eq!(vm.accumulator(), 4);
}

#[test]
fn run_stop_step_reset() {
    let mut vm = Vm::new();
    vm.load(&[load(5), c(CSUB, 0, 0, 2), c(COMP, 0, 0, 5), c(SGP, 3, 2, 9), c(JA, 0, 0, 2)]).expect("fits");
    assert_eq!((vm.mode(), vm.run(9)), (Mode::Stop, (0, Exit::Idle)));
    vm.step();
    assert_eq!((vm.mode(), vm.run(9)), (Mode::Step, (1, Exit::Budget)));
    assert_eq!((vm.counter(), vm.run(9)), (1, (0, Exit::Idle)));
    vm.start(None).expect("no address");
    assert_eq!((vm.mode(), vm.run(4)), (Mode::Run, (4, Exit::Budget)));
    vm.stop();
    assert_eq!((vm.mode(), vm.run(4)), (Mode::Stop, (0, Exit::Idle)));
    assert_eq!((vm.counter(), vm.stack()), (2, &[2u16][..]));
    vm.reset();
    assert_eq!((vm.mode(), vm.run(4)), (Mode::Reset, (0, Exit::Idle)));
    assert_eq!((vm.counter(), vm.stack().len(), vm.accumulator(), vm.variable(3)), (0, 0, 0, 9));
    assert_eq!(conditions(&vm), ["NZ", "NE"]);
    assert_eq!(vm.start(Some(2048)), Err(AddressError));
    assert_eq!(vm.start(Some(-1)), Err(AddressError));
    vm.start(Some(3)).expect("an address");
    assert_eq!((vm.run(1), vm.counter()), ((1, Exit::Budget), 4));
}

#[test]
fn stepping_over_a_command_of_the_device() {
    let mut vm = Vm::new();
    vm.load(&[c(MST, 0, 0, 0), c(WAIT, 1, 0, 0), load(1)]).expect("fits");
    vm.step();
    assert!(matches!(vm.run(9), (0, Exit::Host(_))));
    vm.complete(Outcome::Done);
    assert_eq!((vm.counter(), vm.run(9)), (1, (0, Exit::Idle)));
    vm.step();
    assert!(matches!(vm.run(9), (0, Exit::Wait(_))));
    vm.hold(5);
    assert!(matches!(vm.run(9), (0, Exit::Waiting(_))));
    vm.wait_over(false);
    assert_eq!((vm.counter(), vm.run(9)), (2, (0, Exit::Idle)));
}

#[test]
fn a_wait_that_was_stopped_begins_anew() {
    let mut vm = started(&[c(WAIT, 0, 0, 50)]);
    vm.run(1);
    vm.hold(5);
    vm.stop();
    assert_eq!(vm.waiting(), None);
    vm.start(None).expect("no address");
    assert!(matches!(vm.run(1), (0, Exit::Wait(_))));
}

#[test]
fn breakpoints() {
    let mut vm = started(&[c(CALCV, 0, 1, 1), c(CALCV, 0, 1, 1), c(JA, 0, 0, 0)]);
    vm.set_breakpoints(&[0, 2]).expect("two");
    // Not where it was started, but when it comes back there.
    assert_eq!((vm.run(BUDGET), vm.counter(), vm.mode()), ((2, Exit::Breakpoint), 2, Mode::Stop));
    vm.start(None).expect("no address");
    assert_eq!((vm.run(BUDGET), vm.counter()), ((1, Exit::Breakpoint), 0));
    vm.start(None).expect("no address");
    vm.set_breakpoints(&[]).expect("none");
    assert_eq!(vm.run(100), (100, Exit::Budget));
    assert_eq!(vm.set_breakpoints(&[0; 17]), Err(control::BreakpointError));
}

#[test]
fn direct_commands_share_the_registers() {
    let mut vm = Vm::new();
    assert_eq!(vm.direct(load(6)), Direct::Done(6));
    assert_eq!(vm.direct(c(CALC, Operation::Mul as u8, 0, -7)), Direct::Done(-7));
    assert_eq!((vm.accumulator(), conditions(&vm)), (-42, vec!["NZ", "NE", "LT", "LE"]));
    assert_eq!(vm.direct(c(COMP, 0, 0, -42)), Direct::Done(-42));
    assert_eq!(conditions(&vm), ["ZE", "EQ", "GE", "LE"]);
    assert_eq!(vm.direct(c(AGP, 200, 2, 0)), Direct::Done(0));
    assert_eq!(vm.variable(200), -42);
}

#[test]
fn direct_reading_leaves_the_registers_alone() {
    let mut vm = Vm::new();
    vm.set_variable(0, 17);
    vm.direct(load(3));
    vm.direct(c(COMP, 0, 0, 9));
    for command in [c(GGP, 0, 2, 0), c(GIV, 0, 0, 0)] {
        assert_eq!(vm.direct(command), Direct::Done(17));
        assert_eq!((vm.accumulator(), conditions(&vm)), (3, vec!["NZ", "NE", "LT", "LE"]));
    }
}

#[test]
fn direct_refusals() {
    let check = |command, expected| assert_eq!(Vm::new().direct(command), expected, "{command:?}");
    for opcode in [JC, JA, CSUB, CALL, RSUB, RETI, WAIT, STOP, RST, DJNZ, UF0, UF7] {
        check(c(opcode, 0, 0, 0), Direct::Refused(Status::NOT_AVAILABLE));
    }
    check(c(0, 0, 0, 0), Direct::Refused(Status::INVALID_COMMAND));
    check(c(140, 0, 0, 0), Direct::Refused(Status::INVALID_COMMAND));
    check(c(CALC, 10, 0, 0), Direct::Refused(Status::WRONG_TYPE));
    check(c(CALCVV, 0, 0, 256), Direct::Refused(Status::INVALID_VALUE));
    check(c(VECT, 0, 0, 2048), Direct::Refused(Status::INVALID_VALUE));
    check(c(VECT, 5, 0, 0), Direct::Refused(Status::WRONG_TYPE));
    check(c(EI, 5, 0, 0), Direct::Refused(Status::WRONG_TYPE));
    check(c(VECT, 0, 0, 50), Direct::Done(50));
    check(c(EI, 255, 0, 0), Direct::Done(0));
    for command in [
        c(ROR, 0, 0, 1),
        c(SGP, 66, 0, 3),
        c(GGP, 66, 0, 0),
        c(AGP, 0, 3, 0),
        c(GAP, 1, 0, 0),
        c(129, 1, 0, 0),
        c(255, 0, 0, 1234),
    ] {
        check(command, Direct::Device);
    }
}

#[test]
fn program_memory() {
    let mut vm = Vm::new();
    assert_eq!(vm.load(&vec![Command::STOP; 2049]), Err(AddressError));
    vm.load(&[load(1), load(2)]).expect("fits");
    vm.load(&[load(3)]).expect("fits");
    assert!(vm.program().take(3).eq([load(3), Command::EMPTY, Command::EMPTY]));
    vm.store(2047, load(4)).expect("the last cell");
    assert_eq!(vm.store(2048, load(4)), Err(AddressError));
    assert_eq!([2047, 2048].map(|address| vm.command(address)), [Some(load(4)), None]);
    vm.erase();
    assert!(vm.program().eq([Command::EMPTY; PROGRAM_LENGTH]));
}

mod random {
    use super::*;
    use proptest::prelude::*;

    fn command() -> impl Strategy<Value = Command> {
        (0u8..90, 0u8..16, 0u8..4, -3i32..40)
            .prop_map(|(opcode, kind, motor, value)| c(opcode, kind, motor, value))
    }

    proptest! {
        /// Any program runs without a panic, and how the budget is dealt out makes no difference.
        #[test]
        fn a_run_can_be_cut_anywhere(
            program in prop::collection::vec(command(), 1..40),
            cuts in prop::collection::vec(1u32..9, 1..20),
        ) {
            let run = |cuts: &[u32]| {
                let mut vm = started(&program);
                let mut left = 500u32;
                let mut cut = cuts.iter().cycle();
                let mut trace = Vec::new();
                while left > 0 {
                    let (executed, exit) = vm.run(left.min(*cut.next().expect("endless")));
                    left -= executed;
                    match exit {
                        Exit::Host(_) => vm.complete(Outcome::Value(left as i32 - 250)),
                        Exit::Wait(_) => {
                            vm.hold(u64::from(left));
                            vm.raise(3);
                        }
                        Exit::Waiting(hold) => vm.wait_over(hold.until % 2 == 0),
                        Exit::Stopped(_) | Exit::Idle | Exit::Breakpoint => break,
                        Exit::Skipped(_) | Exit::Budget => (),
                    }
                    if exit != Exit::Budget {
                        trace.push(exit);
                    }
                    left = left.saturating_sub(u32::from(matches!(exit, Exit::Host(_) | Exit::Waiting(_))));
                }
                (trace, vm.registers, vm.counter, vm.variables)
            };
            prop_assert_eq!(run(&cuts), run(&[500]));
        }
    }
}
