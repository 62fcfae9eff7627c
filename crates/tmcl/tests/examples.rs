//! The manual's programs in `examples/tmcl`: they assemble, and what they ask of a device is written down here.

use std::collections::VecDeque;
use tmcl::asm::{Assembly, Environment, Include, Place, assemble, format};
use tmcl::isa::opcode;
use tmcl::vm::{Exit, Outcome, Stopped};
use tmcl::{Command, Vm, disasm, image};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/tmcl");

/// The programs of the manual. Others in the folder may need more of a device than [`Module`].
const MANUAL: [&str; 16] = [
    "compare",
    "conditional_call",
    "copy_inputs",
    "counting_loop",
    "endless_moves",
    "first_steps",
    "interrupt_vector",
    "main_loop",
    "potentiometer",
    "restart",
    "routines",
    "subroutine",
    "symbolic_constants",
    "timer_interrupt",
    "timer_interrupt_symbols",
    "user_variables",
];

/// Enough of a device's symbols and ranges for the examples.
struct Module;

impl Environment for Module {
    fn include(&self, name: &str, _: &str) -> Option<Include> {
        let text = b"APMaxPositioningSpeed = 4\nAPMaxAcceleration = 5\nMotor0 = 0\n".to_vec();
        (name == "TMCLParam.tmc").then(|| Include { name: name.into(), text })
    }

    fn check(&self, command: Command) -> Option<String> {
        match command.opcode {
            opcode::SAP if command.value > 2047 => Some("too large".into()),
            opcode::SIO if command.kind > 1 && command.kind != 255 => Some("no such output".into()),
            _ => None,
        }
    }
}

fn assembled(name: &str) -> Assembly {
    let path = format!("{FOLDER}/{name}.tmc");
    let source = std::fs::read(&path).expect("the example is there");
    let assembly = assemble(&path, &source, &Module);
    assert!(!assembly.has_errors(), "{}", assembly.render(false));
    assembly
}

fn program(name: &str) -> Vec<Command> {
    assembled(name).program.expect("no errors").commands
}

/// A device that notes what it is asked for and takes its answers from a list.
struct Device {
    vm: Vm,
    answers: VecDeque<i32>,
    log: Vec<String>,
}

impl Device {
    fn new(name: &str, address: i32, answers: &[i32]) -> Self {
        let mut vm = Vm::new();
        vm.load(&program(name)).expect("fits");
        vm.start(Some(address)).expect("an address");
        Self { vm, answers: answers.iter().copied().collect(), log: Vec::new() }
    }

    /// Runs until it was asked so many times, or the program has ended.
    fn asked(&mut self, times: usize) -> &mut Self {
        let until = self.log.len() + times;
        while self.log.len() < until {
            match self.vm.run(1_000).1 {
                Exit::Host(command) => {
                    let text = disasm::command(command);
                    let accumulator = self.vm.accumulator();
                    let takes = matches!(command.opcode, opcode::AAP | opcode::ROLA | opcode::RORA)
                        || command.opcode == opcode::SIO && command.value == -1;
                    let reads = matches!(command.opcode, opcode::GAP | opcode::GIO);
                    self.log.push(if takes { format!("{text} = {accumulator}") } else { text });
                    self.vm.complete(if reads {
                        Outcome::Value(self.answers.pop_front().expect("an answer"))
                    } else {
                        Outcome::Done
                    });
                }
                Exit::Wait(wait) => {
                    self.log.push(format!("wait {} {}", wait.event.name(), wait.ticks));
                    self.vm.wait_over(false);
                }
                Exit::Stopped(Stopped::Stop) => {
                    self.log.push("end".into());
                    break;
                }
                Exit::Budget => break,
                other => panic!("{other:?} after {:?}", self.log),
            }
        }
        self
    }
}

/// What the program asks for, from an address on, when the device answers so.
fn check_from(name: &str, address: i32, answers: &[i32], expected: &[&str]) {
    let mut device = Device::new(name, address, answers);
    device.asked(expected.len());
    assert_eq!(device.log, expected, "{name}");
}

fn check(name: &str, answers: &[i32], expected: &[&str]) {
    check_from(name, 0, answers, expected);
}

#[test]
fn motion() {
    check(
        "first_steps",
        &[],
        &[
            "ROL 0, 1000",
            "wait TICKS 500",
            "MST 0",
            "ROR 0, 100",
            "wait TICKS 500",
            "MST 0",
            "SAP 4, 0, 100",
            "SAP 5, 0, 100",
            "MVP ABS, 0, 512000",
            "wait POS 0",
            "MVP ABS, 0, -512000",
            "wait POS 0",
            "MVP ABS, 0, 512000",
        ],
    );
    let between = ["MVP ABS, 0, 51200", "wait POS 0", "MVP ABS, 0, 0", "wait POS 0", "MVP ABS, 0, 51200"];
    check("endless_moves", &[], &between);
    check(
        "main_loop",
        &[],
        &[
            "SAP 4, 0, 50000",
            "SAP 5, 0, 10000",
            "MVP ABS, 0, 5000",
            "wait POS 0",
            "MVP ABS, 0, 0",
            "wait POS 0",
            "MVP ABS, 0, 5000",
        ],
    );
    check(
        "symbolic_constants",
        &[],
        &[
            "SAP 4, 0, 2047",
            "SAP 5, 0, 2047",
            "MVP ABS, 0, 500000",
            "wait POS 0",
            "MVP ABS, 0, 0",
            "wait POS 0",
            "MVP ABS, 0, 500000",
        ],
    );
}

#[test]
fn inputs() {
    check("copy_inputs", &[5, 8], &["GIO 255, 0", "SIO 255, 2, -1 = 5", "GIO 255, 0", "SIO 255, 2, -1 = 8"]);
    check("potentiometer", &[0, 4095], &["GIO 0, 1", "AAP 0, 0 = 0", "GIO 0, 1", "AAP 0, 0 = 16380"]);
    check("compare", &[999], &["GAP 1, 0", "end"]);
    check("compare", &[1000], &["GAP 1, 0", "ROL 0, 1000", "end"]);
}

#[test]
fn subroutines() {
    let round =
        ["MVP ABS, 0, 10000", "wait POS 0", "wait TICKS 50", "MVP ABS, 0, 0", "wait POS 0", "wait TICKS 50"];
    check("subroutine", &[], &[round, round].concat());
    check("restart", &[], &["MVP ABS, 0, 51200"; 20]);
    let mut device = Device::new("conditional_call", 0, &[700, 0]);
    for (speed, times) in [(0, 3), (500, 2), (-300, 2), (0, 2)] {
        device.vm.set_variable(0, speed);
        device.asked(times);
    }
    let wait = "wait TICKS 10";
    assert_eq!(
        device.log,
        ["GAP 2, 0", "MST 0", wait, "RORA 0 = 500", wait, "ROLA 0 = 300", wait, "GAP 2, 0", wait]
    );
}

#[test]
fn counting() {
    let round = ["MVP REL, 0, 51200", "wait POS 0", "wait TICKS 500"];
    check("counting_loop", &[], &[round.repeat(100), vec!["end"]].concat());
}

#[test]
fn variables() {
    let mut device = Device::new("user_variables", 0, &[]);
    device.asked(1);
    assert_eq!((device.log.as_slice(), device.vm.variable(42)), (&["end".to_owned()][..], 2468));
}

#[test]
fn routines() {
    check_from("routines", 0, &[], &["MVP ABS, 0, 1000", "wait POS 0", "MVP ABS, 0, 0", "wait POS 0", "end"]);
    check_from("routines", 1, &[], &["ROL 0, 500", "wait TICKS 100", "MST 0", "end"]);
    check_from("routines", 2, &[], &["ROR 0, 1000", "wait TICKS 700", "MST 0", "end"]);
    let assembly = assembled("routines");
    let program = assembly.program.expect("no errors");
    let symbols = program.symbol_file();
    assert!(
        symbols.starts_with("Labels\n    0 Func1\n    1 Func2\n    2 Func3\n    3 Func1Start\n"),
        "{symbols}"
    );
    assert_eq!(program.map[0], Place { file: 0, line: 4 });
    assert_eq!(program.addresses(Place { file: 0, line: 9 }).collect::<Vec<_>>(), [3]);
}

#[test]
fn timer_interrupts() {
    for (name, output) in [("timer_interrupt", 3), ("timer_interrupt_symbols", 1)] {
        let mut device = Device::new(name, 0, &[0, 1]);
        device.asked(3);
        device.vm.raise(0);
        device.asked(3);
        device.vm.raise(0);
        device.asked(3);
        let (on, off) = (format!("SIO {output}, 2, 1"), format!("SIO {output}, 2, 0"));
        let expected = [
            "SGP 0, 3, 1000",
            &on,
            "wait TICKS 50",
            "GIO 0, 2",
            "SIO 0, 2, 1",
            &off,
            "GIO 0, 2",
            "SIO 0, 2, 0",
            "wait TICKS 50",
        ];
        assert_eq!(device.log, expected, "{name}");
    }
    let mut device = Device::new("interrupt_vector", 0, &[]);
    device.asked(1);
    assert_eq!(device.log, [""; 0]);
    device.vm.raise(0);
    device.asked(1);
    assert_eq!(device.log, ["SIO 0, 2, 1"]);
}

#[test]
fn warnings() {
    let check = |name: &str, lines: &[usize]| {
        let found: Vec<_> =
            assembled(name).diagnostics.iter().map(|diagnostic| diagnostic.place.line).collect();
        assert_eq!(found, lines, "{name}");
    };
    check("timer_interrupt", &[11, 13]);
    check("main_loop", &[4, 5]);
    check("first_steps", &[]);
    check("symbolic_constants", &[]);
}

#[test]
fn every_example_survives_file_and_disassembler() {
    for name in MANUAL {
        let commands = program(name);
        assert_eq!(commands.last(), Some(&Command::STOP), "{name}");
        assert_eq!(image::from_bytes(&image::to_bytes(&commands)), Ok(commands.clone()), "{name}");
        let again = assemble(name, disasm::disassemble(&commands).as_bytes(), &Module);
        assert_eq!(again.program.expect("no errors").commands, commands, "{name}");
    }
}

#[test]
fn the_examples_are_laid_out_as_the_formatter_would() {
    let folders = [FOLDER, concat!(env!("CARGO_MANIFEST_DIR"), "/../../clients/programs")];
    let files = folders.iter().flat_map(|folder| std::fs::read_dir(folder).expect("the folder is there"));
    let mut sources = 0;
    for file in files.map(|file| file.expect("it can be read").path()) {
        if file.extension().is_some_and(|extension| extension == "tmc") {
            let source = std::fs::read(&file).expect("the example is there");
            assert_eq!(String::from_utf8(format(&source)), String::from_utf8(source), "{}", file.display());
            sources += 1;
        }
    }
    assert!(sources > MANUAL.len());
}
