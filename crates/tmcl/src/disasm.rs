//! The disassembler: commands to source text that assembles to the same commands, whatever they are.

use crate::asm::RAW_MNEMONIC;
use crate::isa::{Command, Field, Instruction, Operand, Role, opcode};
use std::collections::BTreeSet;
use std::fmt::Write;

/// The source of a program: a line a command, with labels where it jumps to. A command that has no
/// mnemonic, or something in a field that its mnemonic cannot say, is written with [`RAW_MNEMONIC`].
pub fn disassemble(program: &[Command]) -> String {
    let labels: BTreeSet<usize> = program
        .iter()
        .filter_map(|&command| target(command))
        .filter(|&address| address <= program.len())
        .collect();
    let label = |address: usize| labels.contains(&address).then(|| format!("L{address}"));
    let mut text = String::new();
    for (address, &command) in program.iter().enumerate() {
        if let Some(label) = label(address) {
            writeln!(text, "{label}:").expect("a string takes everything");
        }
        writeln!(text, "    {}", written(command, &label)).expect("a string takes everything");
    }
    if let Some(label) = label(program.len()) {
        writeln!(text, "{label}:").expect("a string takes everything");
    }
    if program.last().is_none_or(|command| command.opcode != opcode::STOP) {
        text.push_str("#nostop // the program does not end with STOP\n");
    }
    text
}

/// A single command as it is written in a source, with addresses as numbers.
pub fn command(command: Command) -> String {
    written(command, &|_| None)
}

/// The address in a command that can be written with its mnemonic.
fn target(command: Command) -> Option<usize> {
    let entry = expressible(command)?;
    entry.operands.iter().any(|operand| operand.role == Role::Address).then_some(command.value as usize)
}

/// The table's entry, if the mnemonic and its operands say everything that is in the command.
fn expressible(command: Command) -> Option<&'static Instruction> {
    let entry = command.instruction()?;
    entry.mnemonic?;
    let says = |field: Field| entry.operands.iter().any(|operand| operand.field == field);
    let silent = |field| says(field) || command.field(field) == 0;
    let fits = |operand: &Operand| {
        let number = i64::from(command.field(operand.field));
        match operand.role {
            Role::Keyword(words) => words.iter().any(|word| i64::from(word.number) == number),
            _ => operand.range().contains(&number),
        }
    };
    let all =
        [Field::Kind, Field::Motor, Field::Value].into_iter().all(silent) && entry.operands.iter().all(fits);
    all.then_some(entry)
}

fn written(command: Command, label: &dyn Fn(usize) -> Option<String>) -> String {
    let Some(entry) = expressible(command) else {
        let Command { opcode, kind, motor, value } = command;
        return format!("{RAW_MNEMONIC} {opcode}, {kind}, {motor}, {value}");
    };
    let omitted = entry
        .operands
        .iter()
        .rev()
        .take_while(|operand| operand.optional && command.field(operand.field) == 0)
        .count();
    let operand = |operand: &Operand| {
        let number = command.field(operand.field);
        let word = match operand.role {
            Role::Keyword(words) => {
                words.iter().find(|word| i32::from(word.number) == number).map(|word| word.name.to_owned())
            }
            Role::Address => label(number as usize),
            _ => None,
        };
        word.unwrap_or_else(|| number.to_string())
    };
    let operands: Vec<_> = entry.operands[..entry.operands.len() - omitted].iter().map(operand).collect();
    format!("{} {}", entry.mnemonic.unwrap_or_default(), operands.join(", ")).trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asm::{NoFiles, assemble};
    use crate::isa::TABLE;
    use proptest::prelude::*;

    fn assembled(text: &str) -> Vec<Command> {
        let assembly = assemble("test", text.as_bytes(), &NoFiles);
        let program = assembly.program.as_ref();
        program.unwrap_or_else(|| panic!("{text}\n{}", assembly.render(false))).commands.clone()
    }

    #[test]
    fn lines() {
        let check = |opcode, kind, motor, value, expected: &str| {
            assert_eq!(command(Command::new(opcode, kind, motor, value)), expected);
        };
        check(4, 0, 0, -5, "MVP ABS, 0, -5");
        check(4, 3, 0, -5, "DATA 4, 3, 0, -5");
        check(21, 12, 0, 7, "JC ESD, 7");
        check(21, 12, 0, 2048, "DATA 21, 12, 0, 2048");
        check(28, 0, 0, 0, "STOP");
        check(28, 0, 0, 1, "DATA 28, 0, 0, 1");
        check(31, 1, 255, 0, "GCO 1, 255");
        check(31, 1, 255, 9, "GCO 1, 255, 9");
        check(64, 0, 0, 0, "UF0");
        check(64, 0, 3, 0, "UF0 0, 3");
        check(45, 10, 0, 0, "DATA 45, 10, 0, 0");
        check(129, 1, 0, 0, "DATA 129, 1, 0, 0");
        check(0, 0, 0, 0, "DATA 0, 0, 0, 0");
    }

    #[test]
    fn jumps_get_labels() {
        let program = [
            Command::new(opcode::JA, 0, 0, 1),
            Command::new(opcode::DJNZ, 42, 0, 0),
            Command::new(opcode::CSUB, 0, 0, 100),
            Command::STOP,
        ];
        let expected = "L0:\n    JA L1\nL1:\n    DJNZ 42, L0\n    CSUB 100\n    STOP\n";
        assert_eq!(disassemble(&program), expected);
    }

    #[test]
    fn programs_without_stop() {
        assert_eq!(assembled(&disassemble(&[])), []);
        let program = vec![Command::new(opcode::JA, 0, 0, 2047); 2048];
        assert_eq!(assembled(&disassemble(&program)), program);
    }

    /// Mostly commands that exist, with fields mostly in range.
    fn any_command() -> impl Strategy<Value = Command> {
        let opcode = prop_oneof![
            3 => prop::sample::select(TABLE.iter().map(|entry| entry.opcode).collect::<Vec<_>>()),
            1 => any::<u8>(),
        ];
        let byte = || prop_oneof![2 => Just(0u8), 3 => 0u8..16, 1 => any::<u8>()];
        let value = prop_oneof![2 => Just(0i32), 3 => -2i32..50, 1 => any::<i32>()];
        (opcode, byte(), byte(), value)
            .prop_map(|(opcode, kind, motor, value)| Command::new(opcode, kind, motor, value))
    }

    proptest! {
        #[test]
        fn assembles_back(program in prop::collection::vec(any_command(), 0..60)) {
            prop_assert_eq!(assembled(&disassemble(&program)), program);
        }
    }
}
