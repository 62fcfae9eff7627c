//! Compiled lines to the text of a program.

use crate::compiler::compile;
use crate::compiler::syntax::{Condition, Expression, Statement, Value};
use crate::dialect::Dialect;
use crate::isa::{Comparison, Operator};
use crate::layout::{Row, lay_out};
use crate::line::{Line, OPERANDS, Operand, TEMPORARIES, unpack};
use thiserror::Error;

/// Why lines are no program.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum DecompileError {
    /// There are more than the memory has.
    #[error("the memory has {most} lines, these are {count}")]
    TooLong {
        /// How many there are.
        count: usize,
        /// How many there is room for.
        most: u16,
    },
    /// A line speaks of something that the dialect does not have.
    #[error("line {address}, `{line}`: there is no such line in this language")]
    Foreign {
        /// Where it stands.
        address: usize,
        /// The line.
        line: Line,
    },
    /// A line does not stand where the compiler would have put it.
    #[error("line {address}, `{line}`: no program has this line here")]
    Misplaced {
        /// Where it stands.
        address: usize,
        /// The line.
        line: Line,
    },
}

/// A program that compiles to these lines. Empty lines at the end do not count.
///
/// # Errors
/// If no program compiles to them, the first line that is wrong.
pub fn decompile(lines: &[Line], dialect: &Dialect) -> Result<String, DecompileError> {
    let count = lines.iter().rposition(|line| *line != Line::Empty).map_or(0, |last| last + 1);
    let lines = &lines[..count];
    if count > usize::from(dialect.lines) {
        return Err(DecompileError::TooLong { count, most: dialect.lines });
    }
    if let Some(address) = lines.iter().position(|line| !line.fits(dialect)) {
        return Err(DecompileError::Foreign { address, line: lines[address] });
    }
    let misplaced = |address: usize| DecompileError::Misplaced { address, line: lines[address] };

    // For each line of text the compiled line it begins with.
    let mut rows = Vec::new();
    let mut starts = Vec::new();
    for (start, statement) in statements(lines).map_err(misplaced)? {
        let frame = matches!(statement, Statement::Program(_) | Statement::Subroutine(_));
        if frame && !rows.is_empty() {
            rows.push(Row::default());
            starts.push(start);
        }
        rows.push(Row { statement: Some(statement), ..Row::default() });
        starts.push(start);
    }
    let text = lay_out(rows);

    // The one proof that it is a program.
    let compilation = compile("", text.as_bytes(), dialect);
    let Some(code) = compilation.code else {
        let line = compilation.diagnostics.iter().find(|diagnostic| diagnostic.kind().is_some());
        let row = line.map_or(0, |diagnostic| diagnostic.place.line - 1);
        return Err(misplaced(starts[row]));
    };
    match (0..count.max(code.lines.len())).find(|&address| code.lines.get(address) != lines.get(address)) {
        Some(address) => Err(misplaced(address.min(count - 1))),
        None => Ok(text),
    }
}

/// The statements, each with its first line; or the line that belongs to none.
fn statements(lines: &[Line]) -> Result<Vec<(usize, Statement)>, usize> {
    let mut statements = Vec::new();
    let mut start = 0;
    let mut temporaries: Vec<Value> = Vec::with_capacity(TEMPORARIES);
    let mut else_if = false;
    for (address, line) in lines.iter().enumerate() {
        if let Line::Calculate { target, operator: Operator::Copy, x, value, .. } = *line
            && let Some(index) = target.as_temporary()
        {
            // Temporaries are taken in their order.
            let value =
                read(x, value, &[]).filter(|_| x.is_immediate() && usize::from(index) == temporaries.len());
            temporaries.push(value.ok_or(address)?);
            continue;
        }
        if let Line::ElseIf { .. } = line {
            else_if = true;
            continue;
        }
        let statement = statement(*line, &temporaries, else_if).ok_or(address)?;
        statements.push((start, statement));
        start = address + 1;
        temporaries.clear();
        else_if = false;
    }
    if start == lines.len() { Ok(statements) } else { Err(start) }
}

/// The statement that ends with this line.
fn statement(line: Line, temporaries: &[Value], else_if: bool) -> Option<Statement> {
    let value = |operand, value| read(operand, value, temporaries);
    let condition = |operator: Operator, comparison: Comparison, [x, y, z]: [Operand; 3], number| {
        let left = Expression { operator, x: value(x, number)?, y: optional(y, number, temporaries)? };
        Some(Condition { left, comparison, right: Expression::value(value(z, number)?) })
    };
    Some(match line {
        Line::If { operator, comparison, x, y, z, value, .. } => {
            let condition = condition(operator, comparison, [x, y, z], value)?;
            if else_if { Statement::ElseIf(condition) } else { Statement::If(condition) }
        }
        _ if else_if => return None,
        Line::While { operator, comparison, x, y, z, value, .. } => {
            Statement::While(condition(operator, comparison, [x, y, z], value)?)
        }
        Line::Program(number) => Statement::Program(number),
        Line::End => Statement::End,
        Line::Subroutine(number) => Statement::Subroutine(number),
        Line::EndSubroutine => Statement::EndSubroutine,
        Line::Call(number) => Statement::Call(number),
        Line::Else { .. } => Statement::Else,
        Line::EndIf => Statement::EndIf,
        Line::EndWhile { .. } => Statement::EndWhile,
        Line::Calculate { target, operator, x, y, value: number } => {
            let (x, y) = (value(x, number)?, optional(y, number, temporaries)?);
            Statement::Assign(target.as_variable()?, Expression { operator, x, y })
        }
        Line::Set { place, operand, value: number } => Statement::Set(place, value(operand, number)?),
        Line::Do { place, operands, value: number } => {
            let mut values = [None; OPERANDS];
            for (value, operand) in values.iter_mut().zip(operands) {
                *value = optional(operand, number, temporaries)?;
            }
            Statement::Do(place, values)
        }
        Line::Empty | Line::ElseIf { .. } => return None,
    })
}

/// What an operand stands for.
fn read(operand: Operand, value: i32, temporaries: &[Value]) -> Option<Value> {
    if let Some(variable) = operand.as_variable() {
        return Some(Value::Variable(variable));
    }
    match operand {
        Operand::NUMBER => Some(Value::Number(value)),
        Operand::REGISTER => unpack(value).map(Value::Register),
        _ => temporaries.get(usize::from(operand.as_temporary()?)).copied(),
    }
}

/// The same for an operand that need not be there; the outer `None` is an error.
fn optional(operand: Operand, value: i32, temporaries: &[Value]) -> Option<Option<Value>> {
    match operand {
        Operand::NONE => Some(None),
        _ => read(operand, value, temporaries).map(Some),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dialect::{COMMANDER, PERFORMAX_2};

    fn lines(text: &str) -> Vec<Line> {
        text.lines().map(|line| Line::parse(line.trim(), &COMMANDER).expect("a line")).collect()
    }

    #[test]
    fn programs() {
        let check = |text: &str, expected: &str| {
            assert_eq!(decompile(&lines(text), &COMMANDER).as_deref(), Ok(expected), "{text}");
        };
        check("", "");
        check("\n\n", "");
        check("PRG 0\nEND\n\n", "PRG 0\nEND\n");
        check(
            "PRG 1\nT0 = DI1\nIF T0 = 1 -> 6\nT0 = 5\nX T0 Y -6\nELSE -> 7\nDELAY = 4294967295\nENDIF\nEND\nSUB 3\nENDSUB",
            "PRG 1\n  IF DI1=1\n    X5Y-6\n  ELSE\n    DELAY=4294967295\n  ENDIF\nEND\n\nSUB 3\nENDSUB\n",
        );
    }

    #[test]
    fn lines_of_no_program() {
        let check = |text: &str, address: usize| {
            let lines = lines(text);
            let expected = DecompileError::Misplaced { address, line: lines[address] };
            assert_eq!(decompile(&lines, &COMMANDER), Err(expected), "{text}");
        };
        check("PRG 0", 0);
        check("END", 0);
        check("V1 = 1\nEND", 0);
        check("PRG 0\n\nEND", 1);
        check("PRG 0\nENDIF\nEND", 1);
        check("PRG 0\nEND\nT0 = 1", 2);
        // Temporaries that nothing uses, are missing, out of order, not needed, or calculated.
        check("PRG 0\nT0 = 1\nV1 = 5\nEND", 1);
        check("PRG 0\nV1 = T0\nEND", 1);
        check("PRG 0\nT1 = 1\nV1 = T1 + 2\nEND", 1);
        check("PRG 0\nT0 = 1\nV1 = 2 + T0\nEND", 1);
        check("PRG 0\nT0 = 1\nV1 = T0 + V2\nEND", 1);
        check("PRG 0\nT0 = V1\nV1 = T0 + 1\nEND", 1);
        check("PRG 0\nT0 = ~PX\nV1 = T0 + 1\nEND", 1);
        check("PRG 0\nT0 = 1\nT1 = 2\nT2 = 3\nT0 = 4\nX 1\nEND", 4);
        // Jumps to other places.
        check("PRG 0\nIF V1 = V2 -> 3\nENDIF\nEND", 1);
        check("PRG 0\nWHILE V1 = 1 -> 2\nENDWHILE -> 1\nEND", 1);
        check("PRG 0\nWHILE V1 = 1 -> 3\nENDWHILE -> 0\nEND", 2);
        check("PRG 0\nIF V1 = V2 -> 2\nELSE -> 2\nENDIF\nEND", 1);
        check("PRG 0\nELSEIF -> 3\nABS\nEND", 2);
        check("PRG 0\nELSEIF -> 2", 1);
        // Two programs, or subroutines, of one number.
        check("PRG 0\nEND\nPRG 0\nEND", 2);
        check("SUB 0\nENDSUB\nSUB 0\nENDSUB", 2);
    }

    #[test]
    fn lines_of_another_dialect() {
        let foreign = DecompileError::Foreign { address: 1, line: Line::Program(3) };
        assert_eq!(decompile(&lines("END\nPRG 3"), &PERFORMAX_2), Err(foreign));
        let long = vec![Line::End; 1276];
        let too_long = DecompileError::TooLong { count: 1276, most: 1275 };
        assert_eq!(decompile(&long, &PERFORMAX_2), Err(too_long));
    }
}
