//! Compiled lines. A statement becomes one to four of them.
//!
//! An operand is a variable, one of three temporaries or the line's one immediate, which is a number or a
//! register to read. Where a statement has more of those, lines before its own put them into temporaries:
//! `IF DI1=1` is `T0 = DI1` and `IF T0 = 1 -> 12`. The lines keep the structure of the program, so that
//! it can be had back from them.

mod bytes;
mod text;

pub use bytes::BYTES;

use crate::dialect::Dialect;
use crate::isa::{Comparison, Kind, Operator, PROGRAMS, Place, SUBROUTINES, Suffix, Word};

/// Temporaries of a thread.
pub const TEMPORARIES: usize = 3;

/// Most operands of a statement.
pub const OPERANDS: usize = 4;

/// Most lines of a statement.
pub const LINES_A_STATEMENT: usize = 4;

/// Most characters of a line as text.
pub const TEXT_LENGTH: usize = 48;

/// Where a line takes a value from, or puts it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Operand(pub(crate) u8);

impl Operand {
    /// No operand.
    pub const NONE: Self = Self(0xFF);
    /// The line's number.
    pub const NUMBER: Self = Self(0xFE);
    /// The line's register.
    pub const REGISTER: Self = Self(0xFD);

    /// Most variables that there can be; the numbers behind theirs are temporaries.
    pub const VARIABLES: u8 = 0xF0;

    /// Variable `index`, which is below [`VARIABLES`](Self::VARIABLES).
    pub const fn variable(index: u8) -> Self {
        assert!(index < Self::VARIABLES);
        Self(index)
    }

    /// Temporary `index`, which is below [`TEMPORARIES`].
    pub const fn temporary(index: u8) -> Self {
        assert!((index as usize) < TEMPORARIES);
        Self(Self::VARIABLES + index)
    }

    /// The number of the variable, if it is one.
    pub const fn as_variable(self) -> Option<u8> {
        if self.0 < Self::VARIABLES { Some(self.0) } else { None }
    }

    /// The number of the temporary, if it is one.
    pub const fn as_temporary(self) -> Option<u8> {
        match self.0.wrapping_sub(Self::VARIABLES) {
            index if (index as usize) < TEMPORARIES => Some(index),
            _ => None,
        }
    }

    /// Whether it is the line's immediate.
    pub const fn is_immediate(self) -> bool {
        matches!(self, Self::NUMBER | Self::REGISTER)
    }
}

/// A compiled line. `value` is the immediate: a number, or a register as [`pack`] makes it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Line {
    /// Memory that no program uses.
    #[default]
    Empty,
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
    /// `V1=V2+V3`.
    Calculate {
        /// A variable or a temporary.
        target: Operand,
        /// What is done.
        operator: Operator,
        /// First operand.
        x: Operand,
        /// Second operand, or none.
        y: Operand,
        /// Immediate.
        value: i32,
    },
    /// `IF`, and the condition of an `ELSEIF`: `x operator y comparison z`.
    If {
        /// What is done with `x` and `y`.
        operator: Operator,
        /// What the result is asked.
        comparison: Comparison,
        /// First operand.
        x: Operand,
        /// Second operand, or none.
        y: Operand,
        /// What the result is compared with.
        z: Operand,
        /// Where it goes on if the condition does not hold.
        target: u16,
        /// Immediate.
        value: i32,
    },
    /// `WHILE`, in the same way.
    While {
        /// What is done with `x` and `y`.
        operator: Operator,
        /// What the result is asked.
        comparison: Comparison,
        /// First operand.
        x: Operand,
        /// Second operand, or none.
        y: Operand,
        /// What the result is compared with.
        z: Operand,
        /// Where it goes on if the condition does not hold: behind the `ENDWHILE`.
        target: u16,
        /// Immediate.
        value: i32,
    },
    /// The beginning of `ELSEIF`: leads from the branch before it to the `ENDIF`. The condition follows.
    ElseIf {
        /// The line of the `ENDIF`.
        target: u16,
    },
    /// `ELSE`: leads from the branch before it to the `ENDIF`.
    Else {
        /// The line of the `ENDIF`.
        target: u16,
    },
    /// `ENDIF`.
    EndIf,
    /// `ENDWHILE`.
    EndWhile {
        /// The first line of the `WHILE`.
        target: u16,
    },
    /// `HSPDX=V1`.
    Set {
        /// A register of the device.
        place: Place,
        /// What it gets.
        operand: Operand,
        /// Immediate.
        value: i32,
    },
    /// A statement for the device.
    Do {
        /// The statement: an action or a command.
        place: Place,
        /// Targets by axis for [`Word::Linear`], else arguments, then none.
        operands: [Operand; OPERANDS],
        /// Immediate.
        value: i32,
    },
}

const _: () = assert!(size_of::<Line>() == 12);

/// A register as the immediate of a line.
pub const fn pack(place: Place) -> i32 {
    place.word as i32 | (place.index as i32) << 8
}

/// The register that [`pack`] made an immediate of.
pub fn unpack(value: i32) -> Option<Place> {
    let [word, index, 0, 0] = value.to_le_bytes() else { return None };
    Some(Place { word: Word::from_number(word)?, index })
}

impl Line {
    /// Its operands and its immediate.
    pub(crate) fn operands(&self) -> ([Operand; OPERANDS], i32) {
        const NONE: Operand = Operand::NONE;
        match *self {
            Self::Calculate { x, y, value, .. } => ([x, y, NONE, NONE], value),
            Self::If { x, y, z, value, .. } | Self::While { x, y, z, value, .. } => ([x, y, z, NONE], value),
            Self::Set { operand, value, .. } => ([operand, NONE, NONE, NONE], value),
            Self::Do { operands, value, .. } => (operands, value),
            _ => ([NONE; OPERANDS], 0),
        }
    }

    /// The register it reads, if it reads one.
    pub fn register(&self) -> Option<Place> {
        let (operands, value) = self.operands();
        operands.contains(&Operand::REGISTER).then(|| unpack(value))?
    }

    /// Whether a dialect has everything that it speaks of. A jump may lead anywhere in the memory.
    pub fn fits(&self, dialect: &Dialect) -> bool {
        let readable = |place: Place| {
            place.exists(dialect) && place.word.entry().kind == Kind::Register && reads(place, dialect)
        };
        let (operands, value) = self.operands();
        let immediates = operands.iter().filter(|operand| operand.is_immediate()).count();
        let immediate = match immediates {
            0 => value == 0,
            1 => !operands.contains(&Operand::REGISTER) || unpack(value).is_some_and(readable),
            _ => false,
        };
        let known = |operand: &Operand| {
            operand.as_variable().is_none_or(|index| index < dialect.variables)
                && (operand.as_variable().is_some()
                    || operand.as_temporary().is_some()
                    || operand.is_immediate()
                    || *operand == Operand::NONE)
        };
        let pair = |operator: Operator, x: Operand, y: Operand| {
            x != Operand::NONE && (y != Operand::NONE) == (operator.operands() == 2)
        };
        let jump = |target: u16| target < dialect.lines;
        immediate
            && operands.iter().all(known)
            && match *self {
                Self::Empty | Self::End | Self::EndSubroutine | Self::EndIf => true,
                Self::Program(number) => number < dialect.threads.min(PROGRAMS),
                Self::Subroutine(number) | Self::Call(number) => number < SUBROUTINES,
                Self::Calculate { target, operator, x, y, .. } => {
                    let storage = target.as_variable().is_some() || target.as_temporary().is_some();
                    storage && known(&target) && pair(operator, x, y)
                }
                Self::If { operator, x, y, z, target, .. }
                | Self::While { operator, x, y, z, target, .. } => {
                    pair(operator, x, y) && z != Operand::NONE && jump(target)
                }
                Self::ElseIf { target } | Self::Else { target } | Self::EndWhile { target } => jump(target),
                Self::Set { place, operand, .. } => {
                    place.exists(dialect)
                        && place.word.entry().kind == Kind::Register
                        && writes(place, dialect)
                        && operand != Operand::NONE
                        && operand != Operand::REGISTER
                }
                Self::Do { place, operands, value } => fits_do(place, operands, value, dialect),
            }
    }
}

fn reads(place: Place, dialect: &Dialect) -> bool {
    place.word.access(dialect.family).is_some_and(|access| access.reads())
}

fn writes(place: Place, dialect: &Dialect) -> bool {
    place.word.access(dialect.family).is_some_and(|access| access.writes())
}

/// Whether a statement for the device has the operands it needs.
fn fits_do(place: Place, operands: [Operand; OPERANDS], value: i32, dialect: &Dialect) -> bool {
    let entry = place.word.entry();
    if !place.exists(dialect) || operands.contains(&Operand::REGISTER) {
        return false;
    }
    let given = operands.map(|operand| operand != Operand::NONE);
    let count = given.iter().filter(|&&given| given).count();
    let leading = given.iter().take_while(|&&given| given).count();
    match (entry.kind, entry.suffix) {
        (Kind::Command, _) => count == 1 && leading == 1,
        (Kind::Action, Suffix::Targets) => {
            count >= 2 && !given[usize::from(dialect.axis_count())..].contains(&true)
        }
        (Kind::Action, Suffix::Home) if dialect.homing_modes > 0 => {
            let mode = u8::try_from(value).is_ok_and(|mode| mode < dialect.homing_modes);
            count == 1 && operands[0] == Operand::NUMBER && mode
        }
        (Kind::Action, _) => count == entry.arguments(dialect) && leading == count,
        _ => false,
    }
}

#[cfg(test)]
mod tests;
