//! Compiled lines as bytes, for flash and program files.

use super::{Line, OPERANDS, Operand};
use crate::dialect::Dialect;
use crate::isa::{Comparison, Operator, Place, Word};

/// Bytes of a line: what it is, seven bytes of that kind's own, and the immediate, LSB first.
pub const BYTES: usize = 12;

const HEAD: usize = BYTES - size_of::<i32>();

impl Line {
    /// The line as bytes; [`from_bytes`](Self::from_bytes) has it back.
    pub fn to_bytes(&self) -> [u8; BYTES] {
        let (_, value) = self.operands();
        let head: [u8; HEAD] = match *self {
            Self::Empty => [0; HEAD],
            Self::Program(number) => [1, number, 0, 0, 0, 0, 0, 0],
            Self::End => [2, 0, 0, 0, 0, 0, 0, 0],
            Self::Subroutine(number) => [3, number, 0, 0, 0, 0, 0, 0],
            Self::EndSubroutine => [4, 0, 0, 0, 0, 0, 0, 0],
            Self::Call(number) => [5, number, 0, 0, 0, 0, 0, 0],
            Self::Calculate { target, operator, x, y, .. } => {
                [6, target.0, operator as u8, x.0, y.0, 0, 0, 0]
            }
            Self::If { operator, comparison, x, y, z, target, .. } => {
                condition(7, operator, comparison, [x, y, z], target)
            }
            Self::While { operator, comparison, x, y, z, target, .. } => {
                condition(8, operator, comparison, [x, y, z], target)
            }
            Self::ElseIf { target } => jump(9, target),
            Self::Else { target } => jump(10, target),
            Self::EndIf => [11, 0, 0, 0, 0, 0, 0, 0],
            Self::EndWhile { target } => jump(12, target),
            Self::Set { place, operand, .. } => [13, place.word as u8, place.index, operand.0, 0, 0, 0, 0],
            Self::Do { place, operands: [a, b, c, d], .. } => {
                [14, place.word as u8, place.index, a.0, b.0, c.0, d.0, 0]
            }
        };
        let mut bytes = [0; BYTES];
        bytes[..HEAD].copy_from_slice(&head);
        bytes[HEAD..].copy_from_slice(&value.to_le_bytes());
        bytes
    }

    /// The line of these bytes; `None` unless [`to_bytes`](Self::to_bytes) makes them of a line that
    /// [`fits`](Self::fits) the dialect.
    pub fn from_bytes(bytes: &[u8; BYTES], dialect: &Dialect) -> Option<Self> {
        let &[kind, a, b, c, d, e, f, g, v0, v1, v2, v3] = bytes;
        let value = i32::from_le_bytes([v0, v1, v2, v3]);
        let target = u16::from_le_bytes([f, g]);
        let place = || Some(Place { word: Word::from_number(a)?, index: b });
        let line = match kind {
            0 => Self::Empty,
            1 => Self::Program(a),
            2 => Self::End,
            3 => Self::Subroutine(a),
            4 => Self::EndSubroutine,
            5 => Self::Call(a),
            6 => Self::Calculate {
                target: Operand(a),
                operator: Operator::from_number(b)?,
                x: Operand(c),
                y: Operand(d),
                value,
            },
            7 | 8 => {
                let operator = Operator::from_number(a & 0xF)?;
                let comparison = Comparison::from_number(a >> 4)?;
                let (x, y, z) = (Operand(b), Operand(c), Operand(d));
                if kind == 7 {
                    Self::If { operator, comparison, x, y, z, target, value }
                } else {
                    Self::While { operator, comparison, x, y, z, target, value }
                }
            }
            9 => Self::ElseIf { target },
            10 => Self::Else { target },
            11 => Self::EndIf,
            12 => Self::EndWhile { target },
            13 => Self::Set { place: place()?, operand: Operand(c), value },
            14 => {
                let operands: [Operand; OPERANDS] = [c, d, e, f].map(Operand);
                Self::Do { place: place()?, operands, value }
            }
            _ => return None,
        };
        (line.to_bytes() == *bytes && line.fits(dialect)).then_some(line)
    }
}

fn condition(
    kind: u8,
    operator: Operator,
    comparison: Comparison,
    operands: [Operand; 3],
    target: u16,
) -> [u8; HEAD] {
    let [low, high] = target.to_le_bytes();
    let [x, y, z] = operands;
    [kind, operator as u8 | (comparison as u8) << 4, x.0, y.0, z.0, 0, low, high]
}

const fn jump(kind: u8, target: u16) -> [u8; HEAD] {
    let [low, high] = target.to_le_bytes();
    [kind, 0, 0, 0, 0, 0, low, high]
}
