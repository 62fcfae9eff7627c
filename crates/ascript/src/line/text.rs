//! Compiled lines as text, which is what `SA[n]` transfers: at most [`TEXT_LENGTH`](super::TEXT_LENGTH) ASCII
//! characters. An empty line is empty text.

use super::{Line, OPERANDS, Operand, TEMPORARIES, pack, unpack};
use crate::dialect::{Dialect, axis_name};
use crate::isa::{Comparison, Direction, Kind, Operator, Place, Suffix, Word};
use core::fmt;

impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (_, value) = self.operands();
        let show = |operand| Shown { operand, value };
        match *self {
            Self::Empty => Ok(()),
            Self::Program(number) => write!(f, "PRG {number}"),
            Self::End => f.write_str("END"),
            Self::Subroutine(number) => write!(f, "SUB {number}"),
            Self::EndSubroutine => f.write_str("ENDSUB"),
            Self::Call(number) => write!(f, "GOSUB {number}"),
            Self::Calculate { target, operator, x, y, .. } => {
                write!(f, "{} = {}", show(target), Formula { operator, x: show(x), y: show(y) })
            }
            Self::If { operator, comparison, x, y, z, target, .. } => {
                let formula = Formula { operator, x: show(x), y: show(y) };
                write!(f, "IF {formula} {comparison} {} -> {target}", show(z))
            }
            Self::While { operator, comparison, x, y, z, target, .. } => {
                let formula = Formula { operator, x: show(x), y: show(y) };
                write!(f, "WHILE {formula} {comparison} {} -> {target}", show(z))
            }
            Self::ElseIf { target } => write!(f, "ELSEIF -> {target}"),
            Self::Else { target } => write!(f, "ELSE -> {target}"),
            Self::EndIf => f.write_str("ENDIF"),
            Self::EndWhile { target } => write!(f, "ENDWHILE -> {target}"),
            Self::Set { place, operand, .. } => write!(f, "{place} = {}", show(operand)),
            Self::Do { place, operands, .. } => {
                let given = operands.into_iter().zip(0..).filter(|&(operand, _)| operand != Operand::NONE);
                write!(f, "{place}")?;
                for (count, (operand, axis)) in given.enumerate() {
                    match place.word.entry().suffix {
                        Suffix::Targets if count == 0 => write!(f, "{} ", axis_name(axis))?,
                        Suffix::Targets => write!(f, " {} ", axis_name(axis))?,
                        _ if place.word.entry().kind == Kind::Command => f.write_str(" = ")?,
                        _ => f.write_str(" ")?,
                    }
                    // A delay is unsigned (PMX manual, table 10.0).
                    if place.word == Word::Delay && operand == Operand::NUMBER {
                        write!(f, "{}", value as u32)?;
                    } else {
                        write!(f, "{}", show(operand))?;
                    }
                }
                Ok(())
            }
        }
    }
}

/// An operand and the line's immediate.
#[derive(Clone, Copy)]
struct Shown {
    operand: Operand,
    value: i32,
}

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { operand, value } = *self;
        if let Some(index) = operand.as_variable() {
            write!(f, "V{index}")
        } else if let Some(index) = operand.as_temporary() {
            write!(f, "T{index}")
        } else if operand == Operand::NUMBER {
            write!(f, "{value}")
        } else if let Some(place) = unpack(value).filter(|_| operand == Operand::REGISTER) {
            write!(f, "{place}")
        } else {
            f.write_str("?")
        }
    }
}

struct Formula {
    operator: Operator,
    x: Shown,
    y: Shown,
}

impl fmt::Display for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { operator, x, y } = self;
        match operator.operands() {
            1 => write!(f, "{operator}{x}"),
            _ => write!(f, "{x} {operator} {y}"),
        }
    }
}

impl Line {
    /// The line that is written so; `None` if there is none in the dialect. Between words are spaces.
    pub fn parse(text: &str, dialect: &Dialect) -> Option<Self> {
        let mut reader = Reader { words: text.split_ascii_whitespace(), value: 0, dialect };
        let line = reader.line()?;
        (reader.words.next().is_none() && line.fits(dialect)).then_some(line)
    }
}

struct Reader<'a> {
    words: core::str::SplitAsciiWhitespace<'a>,
    /// The immediate, once there was one.
    value: i32,
    dialect: &'a Dialect,
}

/// A decimal number as [`fmt::Display`] writes it.
fn number<T: core::str::FromStr>(text: &str) -> Option<T> {
    let digits = text.strip_prefix('-').unwrap_or(text);
    digits.bytes().all(|byte| byte.is_ascii_digit()).then(|| text.parse().ok())?
}

impl Reader<'_> {
    fn line(&mut self) -> Option<Line> {
        let Some(first) = self.words.next() else { return Some(Line::Empty) };
        Some(match first {
            "PRG" => Line::Program(number(self.words.next()?)?),
            "END" => Line::End,
            "SUB" => Line::Subroutine(number(self.words.next()?)?),
            "ENDSUB" => Line::EndSubroutine,
            "GOSUB" => Line::Call(number(self.words.next()?)?),
            "ELSEIF" => Line::ElseIf { target: self.target()? },
            "ELSE" => Line::Else { target: self.target()? },
            "ENDIF" => Line::EndIf,
            "ENDWHILE" => Line::EndWhile { target: self.target()? },
            "IF" | "WHILE" => {
                let first_operand = self.words.next()?;
                let (operator, x, y, symbol) = self.formula(first_operand)?;
                let comparison = Comparison::from_symbol(symbol?)?;
                let operand = self.words.next()?;
                let z = self.operand(operand)?;
                let (target, value) = (self.target()?, self.value);
                if first == "IF" {
                    Line::If { operator, comparison, x, y, z, target, value }
                } else {
                    Line::While { operator, comparison, x, y, z, target, value }
                }
            }
            _ => match storage(first) {
                Some(target) => {
                    self.take("=")?;
                    let operand = self.words.next()?;
                    let (operator, x, y, None) = self.formula(operand)? else { return None };
                    Line::Calculate { target, operator, x, y, value: self.value }
                }
                None => self.statement(first)?,
            },
        })
    }

    fn take(&mut self, word: &str) -> Option<()> {
        (self.words.next()? == word).then_some(())
    }

    fn target(&mut self) -> Option<u16> {
        self.take("->")?;
        number(self.words.next()?)
    }

    /// `x`, `~x` or `x operator y`, and the word behind it.
    fn formula(&mut self, first: &str) -> Option<(Operator, Operand, Operand, Option<&str>)> {
        if let Some(operand) = first.strip_prefix('~') {
            return Some((Operator::Not, self.operand(operand)?, Operand::NONE, self.words.next()));
        }
        let x = self.operand(first)?;
        let next = self.words.next();
        let Some(operator) = next.and_then(Operator::from_symbol) else {
            return Some((Operator::Copy, x, Operand::NONE, next));
        };
        let second = self.words.next()?;
        Some((operator, x, self.operand(second)?, self.words.next()))
    }

    fn operand(&mut self, text: &str) -> Option<Operand> {
        if let Some(operand) = storage(text) {
            return Some(operand);
        }
        if let Some(value) = number(text) {
            self.value = value;
            return Some(Operand::NUMBER);
        }
        self.value = pack(place(text, self.dialect)?);
        Some(Operand::REGISTER)
    }

    /// A register that is set, or a statement for the device.
    fn statement(&mut self, first: &str) -> Option<Line> {
        let mut operands = [Operand::NONE; OPERANDS];
        if self.dialect.axes.contains(first) && self.words.clone().count() > 1 {
            let mut axis = first;
            loop {
                let slot = operands.get_mut(usize::from(self.dialect.axis(axis.chars().next()?)?))?;
                if *slot != Operand::NONE || axis.len() != 1 {
                    return None;
                }
                let text = self.words.next()?;
                *slot = self.operand(text)?;
                let Some(next) = self.words.next() else { break };
                axis = next;
            }
            return Some(Line::Do { place: Place::new(Word::Linear, 0), operands, value: self.value });
        }
        let place = place(first, self.dialect)?;
        match place.word.entry().kind {
            Kind::Register => {
                self.take("=")?;
                let text = self.words.next()?;
                Some(Line::Set { place, operand: self.operand(text)?, value: self.value })
            }
            Kind::Action | Kind::Command => {
                if place.word.entry().kind == Kind::Command {
                    self.take("=")?;
                }
                let mut slots = operands.iter_mut();
                while let Some(text) = self.words.next() {
                    *slots.next()? = match number::<u32>(text) {
                        None if place.word == Word::Delay && text.starts_with('-') => return None,
                        Some(value) if place.word == Word::Delay => {
                            self.value = value as i32;
                            Operand::NUMBER
                        }
                        _ => self.operand(text)?,
                    };
                }
                Some(Line::Do { place, operands, value: self.value })
            }
            _ => None,
        }
    }
}

/// The variable or temporary that is written so.
fn storage(text: &str) -> Option<Operand> {
    if let Some(index) = text.strip_prefix('V') {
        let index: u8 = number(index)?;
        return (index < Operand::VARIABLES).then(|| Operand::variable(index));
    }
    let index: u8 = number(text.strip_prefix('T')?)?;
    (usize::from(index) < TEMPORARIES).then(|| Operand::temporary(index))
}

/// The place that is written so.
fn place(text: &str, dialect: &Dialect) -> Option<Place> {
    let letters = text.trim_end_matches(|c: char| !c.is_ascii_uppercase());
    let rest = &text[letters.len()..];
    match rest {
        "+" | "-" => {
            let place = Place::from_letters(letters, false, dialect)?;
            let direction = if rest == "+" { Direction::Plus } else { Direction::Minus };
            matches!(place.word.entry().suffix, Suffix::Direction | Suffix::Home)
                .then(|| Place::directed(place.word, place.index, direction))
        }
        "" => Place::from_letters(letters, false, dialect)
            .filter(|place| !matches!(place.word.entry().suffix, Suffix::Direction | Suffix::Home)),
        _ => {
            let Place { word, .. } = Place::from_letters(letters, true, dialect)?;
            matches!(word.entry().suffix, Suffix::Index(_)).then(|| Some(Place::new(word, number(rest)?)))?
        }
    }
}
