//! What a line of a program says, and how it is written.

use crate::dialect::axis_name;
use crate::isa::{Comparison, Kind, Operator, Place, Suffix, Word};
use crate::line::OPERANDS;
use std::fmt;

/// A value in a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Value {
    /// A number. A delay's is unsigned.
    Number(i32),
    /// A variable.
    Variable(u8),
    /// A register of the device.
    Register(Place),
}

/// A value, or one operator with its operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Expression {
    /// What is done.
    pub operator: Operator,
    /// First operand.
    pub x: Value,
    /// Second operand, if the operator has two.
    pub y: Option<Value>,
}

/// A condition. One of its sides at most is more than a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Condition {
    /// What is left of the comparison.
    pub left: Expression,
    /// What the two sides are asked.
    pub comparison: Comparison,
    /// What is right of it.
    pub right: Expression,
}

/// A line of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Statement {
    /// `PRG`.
    Program(u8),
    /// `END`.
    End,
    /// `SUB`.
    Subroutine(u8),
    /// `ENDSUB`.
    EndSubroutine,
    /// `GOSUB`.
    Call(u8),
    /// `IF`.
    If(Condition),
    /// `ELSEIF`.
    ElseIf(Condition),
    /// `ELSE`.
    Else,
    /// `ENDIF`.
    EndIf,
    /// `WHILE`.
    While(Condition),
    /// `ENDWHILE`.
    EndWhile,
    /// A variable gets a value.
    Assign(u8, Expression),
    /// A register of the device gets a value: a number or a variable.
    Set(Place, Value),
    /// A statement for the device, with its numbers and variables: targets by axis for
    /// [`Word::Linear`], else arguments, then none.
    Do(Place, [Option<Value>; OPERANDS]),
}

impl Statement {
    /// Whether it ends a block, as `ENDIF`, or a branch, as `ELSE`.
    pub(crate) const fn closes(&self) -> bool {
        use Statement::{Else, ElseIf, End, EndIf, EndSubroutine, EndWhile};
        matches!(self, End | EndSubroutine | ElseIf(_) | Else | EndIf | EndWhile)
    }

    /// Whether it begins a block or a branch.
    pub(crate) const fn opens(&self) -> bool {
        use Statement::{Else, ElseIf, If, Program, Subroutine, While};
        matches!(self, Program(_) | Subroutine(_) | If(_) | ElseIf(_) | Else | While(_))
    }
}

impl Expression {
    /// Just a value.
    pub const fn value(x: Value) -> Self {
        Self { operator: Operator::Copy, x, y: None }
    }

    /// Whether it is more than a value.
    pub fn is_compound(&self) -> bool {
        self.operator != Operator::Copy
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Variable(index) => write!(f, "V{index}"),
            Self::Register(place) => write!(f, "{place}"),
        }
    }
}

impl fmt::Display for Expression {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { operator, x, y } = self;
        match y {
            Some(y) => write!(f, "{x}{operator}{y}"),
            None => write!(f, "{operator}{x}"),
        }
    }
}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}{}", self.left, self.comparison, self.right)
    }
}

impl fmt::Display for Statement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Program(number) => write!(f, "PRG {number}"),
            Self::End => f.write_str("END"),
            Self::Subroutine(number) => write!(f, "SUB {number}"),
            Self::EndSubroutine => f.write_str("ENDSUB"),
            Self::Call(number) => write!(f, "GOSUB {number}"),
            Self::If(condition) => write!(f, "IF {condition}"),
            Self::ElseIf(condition) => write!(f, "ELSEIF {condition}"),
            Self::Else => f.write_str("ELSE"),
            Self::EndIf => f.write_str("ENDIF"),
            Self::While(condition) => write!(f, "WHILE {condition}"),
            Self::EndWhile => f.write_str("ENDWHILE"),
            Self::Assign(variable, expression) => write!(f, "V{variable}={expression}"),
            Self::Set(place, value) => write!(f, "{place}={value}"),
            Self::Do(place, values) => {
                let entry = place.word.entry();
                let given = values.iter().zip(0..).filter_map(|(value, axis)| Some(((*value)?, axis)));
                write!(f, "{place}")?;
                for (count, (value, axis)) in given.enumerate() {
                    match (entry.kind, entry.suffix) {
                        (Kind::Command, _) => f.write_str("=")?,
                        (_, Suffix::Targets) => write!(f, "{}", axis_name(axis))?,
                        _ if count > 0 => f.write_str(":")?,
                        _ => (),
                    }
                    match value {
                        Value::Number(number) if place.word == Word::Delay => write!(f, "{}", number as u32)?,
                        _ => write!(f, "{value}")?,
                    }
                }
                Ok(())
            }
        }
    }
}
