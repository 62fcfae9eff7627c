//! A command typed at the ASCII interface (manual 3.4): one line of mnemonic and numbers.

use crate::isa::{self, Command, Field, Instruction, Mode, Operand, Role};
use protocol::tmcl::Status;

/// What a typed line asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Line {
    /// Execute this command.
    Command(Command),
    /// `BIN`: go back to binary frames.
    Binary,
    /// `RUN`: start the program.
    Run,
    /// `STOP`: stop the program.
    Stop,
}

/// Reads a line behind its address character, such as `MVP ABS, 0, 50000`. Mnemonics and words may be in
/// any case; numbers are decimal, or hexadecimal behind `$` or `0x`.
///
/// # Errors
/// The status to reply: [`Status::INVALID_COMMAND`] for an unknown word, [`Status::NOT_AVAILABLE`] for a
/// command that cannot be typed, [`Status::WRONG_TYPE`] for an operand of the type field that is missing
/// or wrong, [`Status::INVALID_VALUE`] for any other and for too many.
pub fn parse(line: &str) -> Result<Line, Status> {
    let line = line.trim_matches(' ');
    let (mnemonic, rest) = line.split_once(' ').unwrap_or((line, ""));
    let rest = rest.trim_matches(' ');
    for (word, special) in [("BIN", Line::Binary), ("RUN", Line::Run), ("STOP", Line::Stop)] {
        if mnemonic.eq_ignore_ascii_case(word) {
            return if rest.is_empty() { Ok(special) } else { Err(Status::INVALID_VALUE) };
        }
    }
    let entry = isa::by_mnemonic(mnemonic).ok_or(Status::INVALID_COMMAND)?;
    isa::available(entry.opcode, Mode::Ascii)?;
    operands(entry, rest).map(Line::Command)
}

fn operands(entry: &Instruction, text: &str) -> Result<Command, Status> {
    let mut command = Command::new(entry.opcode, 0, 0, 0);
    let mut words = text.split(',').map(|word| word.trim_matches(' '));
    if text.is_empty() {
        words.next();
    }
    for operand in entry.operands {
        let Some(word) = words.next() else {
            if operand.optional {
                break;
            }
            return Err(misuse(operand));
        };
        let number = number(operand, word).ok_or(misuse(operand))?;
        match operand.field {
            Field::Kind => command.kind = number as u8,
            Field::Motor => command.motor = number as u8,
            Field::Value => command.value = number as i32,
        }
    }
    if words.next().is_some() { Err(Status::INVALID_VALUE) } else { Ok(command) }
}

/// The status for a missing or wrong operand.
fn misuse(operand: &Operand) -> Status {
    match operand.field {
        Field::Kind => Status::WRONG_TYPE,
        Field::Motor | Field::Value => Status::INVALID_VALUE,
    }
}

/// An operand's number, if the word is one and in range.
fn number(operand: &Operand, word: &str) -> Option<i64> {
    if let Role::Keyword(words) = operand.role
        && let Some(keyword) = words.iter().find(|keyword| keyword.name.eq_ignore_ascii_case(word))
    {
        return Some(i64::from(keyword.number));
    }
    let (negative, digits) = match word.strip_prefix('-') {
        Some(digits) => (true, digits),
        None => (false, word),
    };
    let hexadecimal = digits.strip_prefix('$').or(digits.strip_prefix("0x")).or(digits.strip_prefix("0X"));
    let (digits, radix) = hexadecimal.map_or((digits, 10), |digits| (digits, 16));
    // The number parser would take a sign of its own.
    if !digits.starts_with(|digit: char| digit.is_digit(radix)) {
        return None;
    }
    let magnitude = i64::from_str_radix(digits, radix).ok()?;
    Some(if negative { -magnitude } else { magnitude }).filter(|number| operand.range().contains(number))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn lines() {
        let check = |line: &str, opcode, kind, motor, value| {
            assert_eq!(parse(line), Ok(Line::Command(Command::new(opcode, kind, motor, value))), "{line}");
        };
        check("MVP ABS, 1, 50000", 4, 0, 1, 50000);
        check(" MVP ABS, 1, 50000", 4, 0, 1, 50000);
        check("mvp rel,0,-10000 ", 4, 1, 0, -10000);
        check("MVP 2, 0, 8", 4, 2, 0, 8);
        check("ROL 2, 500", 2, 0, 2, 500);
        check("MST 1", 3, 0, 1, 0);
        check("GAP 0, 1", 6, 0, 1, 0);
        check("SAP $04 , 0 , 0x3E8", 5, 4, 0, 1000);
        check("SAP 0, 0, -2147483648", 5, 0, 0, i32::MIN);
        check("SGP 0, 3, 4294967295", 9, 0, 3, -1);
        check("RFS STATUS, 0", 13, 2, 0, 0);
        check("GCO 1, 0", 31, 1, 0, 0);
        check("GCO 1, 255, 0", 31, 1, 255, 0);
    }

    #[test]
    fn special_lines() {
        let check = |line, expected| assert_eq!(parse(line), expected, "{line}");
        check("BIN", Ok(Line::Binary));
        check(" bin ", Ok(Line::Binary));
        check("RUN", Ok(Line::Run));
        check("STOP", Ok(Line::Stop));
        check("BIN 1", Err(Status::INVALID_VALUE));
    }

    #[test]
    fn misuse() {
        let check = |line, status| assert_eq!(parse(line), Err(status), "{line}");
        check("", Status::INVALID_COMMAND);
        check("MOVE ABS, 0, 1", Status::INVALID_COMMAND);
        check("MVP", Status::WRONG_TYPE);
        check("MVP FAR, 0, 1", Status::WRONG_TYPE);
        check("SAP 256, 0, 1", Status::WRONG_TYPE);
        check("SAP -1, 0, 1", Status::WRONG_TYPE);
        check("SCO 21, 0, 1", Status::WRONG_TYPE);
        check("MVP ABS, 0", Status::INVALID_VALUE);
        check("MVP ABS, 256, 1", Status::INVALID_VALUE);
        check("MVP ABS, 0, 1, 2", Status::INVALID_VALUE);
        check("MVP ABS, 0, ", Status::INVALID_VALUE);
        check("MVP ABS, 0, 5000000000", Status::INVALID_VALUE);
        check("MVP ABS, 0, 99999999999999999999999", Status::INVALID_VALUE);
        check("MVP ABS, 0, --1", Status::INVALID_VALUE);
        check("MVP ABS, 0, +1", Status::INVALID_VALUE);
        check("MST 0,", Status::INVALID_VALUE);
        check("UF0", Status::NOT_AVAILABLE);
        check("CALC ADD, 1", Status::NOT_AVAILABLE);
        check("JA 0", Status::NOT_AVAILABLE);
    }

    #[test]
    #[cfg(feature = "std")]
    fn the_examples_of_the_table_can_be_typed() {
        for entry in isa::TABLE.iter().filter(|entry| entry.ascii && entry.direct) {
            let line = parse(entry.doc.example);
            assert!(
                matches!(line, Ok(Line::Command(command)) if command.opcode == entry.opcode),
                "{entry:?}"
            );
        }
    }

    proptest! {
        #[test]
        fn any_line(line in "\\PC{0,40}") {
            let _ = parse(&line);
        }

        #[test]
        fn any_operands(line in "(MVP|SAP|UF0|GCO) ?[ ,A-Z0-9$x-]{0,30}") {
            let _ = parse(&line);
        }
    }
}
