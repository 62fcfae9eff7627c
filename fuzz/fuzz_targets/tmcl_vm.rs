//! Any program under any treatment: interrupts, direct commands, stops and steps between short runs.
#![no_main]

use libfuzzer_sys::fuzz_target;
use tmcl::isa::INTERRUPTS;
use tmcl::vm::{Exit, Outcome};
use tmcl::{Command, Vm};

/// Most commands of a run.
const BUDGET: u32 = 100;

fn command(&[opcode, kind, motor, high, low]: &[u8; 5]) -> Command {
    Command::new(opcode, kind, motor, i32::from(i16::from_be_bytes([high, low])))
}

fuzz_target!(|input: (Vec<[u8; 5]>, Vec<(u8, [u8; 5])>)| {
    let (program, treatment) = input;
    let mut vm = Vm::new();
    let program: Vec<Command> = program.iter().take(2048).map(command).collect();
    vm.load(&program).expect("no longer than the memory");
    vm.start(Some(0)).expect("an address");
    for (action, bytes) in treatment.into_iter().take(1000) {
        let command = command(&bytes);
        match action {
            0..=99 => (),
            100..=139 => vm.raise(INTERRUPTS[usize::from(action) % INTERRUPTS.len()].number),
            140..=199 => {
                vm.direct(command);
            }
            200 => vm.stop(),
            201 => vm.reset(),
            202 => vm.step(),
            203 => {
                let _ = vm.start(Some(command.value));
            }
            204 => {
                let _ = vm.store(usize::from(command.kind), command);
            }
            205 => vm.set_breakpoints(&[u16::from(command.kind)]).expect("one is not too many"),
            _ => vm.start(None).expect("no address is not wrong"),
        }
        let before = vm.instructions();
        let (executed, exit) = vm.run(BUDGET);
        assert!(executed <= BUDGET && vm.instructions() == before + u64::from(executed));
        match exit {
            Exit::Host(_) => vm.complete(Outcome::Value(command.value)),
            Exit::Wait(_) => vm.hold(u64::from(command.kind)),
            Exit::Waiting(_) => vm.wait_over(command.kind % 2 == 0),
            Exit::Budget => assert!(executed == BUDGET || executed == 1),
            _ => (),
        }
        assert!(usize::from(vm.counter()) <= vm.program().len());
    }
});
