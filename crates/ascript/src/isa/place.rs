//! A word with what it is applied to: `HSPDX`, `DI3`, `JOGX+`, `CIRXYP`.

use super::{Entry, Suffix, Word, words};
use crate::dialect::{Dialect, axis_name};
use core::fmt;

/// The second axis of a plane in an index.
const SECOND_SHIFT: u32 = 2;
const AXIS_MASK: u8 = 0b11;

/// The direction in an index.
const DIRECTION_BIT: u8 = 0b1_0000;

/// A direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// `+`; for arcs `P`, clockwise.
    Plus,
    /// `-`; for arcs `N`, counter-clockwise.
    Minus,
}

/// A word with what it is applied to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Place {
    /// The word.
    pub word: Word,
    /// Which one of those that the word names: the axis (X is 0), or the number as it is written (`DI3`
    /// is 3); 0 if the word names one thing. With a direction or two axes it is packed:
    /// [`axis`](Self::axis), [`second_axis`](Self::second_axis) and [`direction`](Self::direction) tell.
    pub index: u8,
}

impl Place {
    /// The word with this index.
    pub const fn new(word: Word, index: u8) -> Self {
        Self { word, index }
    }

    /// With an axis and a direction, as `JOGX+`.
    pub(crate) const fn directed(word: Word, axis: u8, direction: Direction) -> Self {
        let bit = if matches!(direction, Direction::Minus) { DIRECTION_BIT } else { 0 };
        Self { word, index: axis | bit }
    }

    /// The axis, if it is about one; the first one, if about two.
    pub fn axis(self) -> Option<u8> {
        match self.word.entry().suffix {
            Suffix::Axis | Suffix::Target => Some(self.index),
            Suffix::Direction | Suffix::Home | Suffix::Plane(_) => Some(self.index & AXIS_MASK),
            Suffix::None | Suffix::Index(_) | Suffix::Targets | Suffix::Helix(_) => None,
        }
    }

    /// The second axis of a plane.
    pub fn second_axis(self) -> Option<u8> {
        match self.word.entry().suffix {
            Suffix::Plane(_) => Some(self.index >> SECOND_SHIFT & AXIS_MASK),
            _ => None,
        }
    }

    /// The direction, if it has one.
    pub fn direction(self) -> Option<Direction> {
        match self.word.entry().suffix {
            Suffix::Direction | Suffix::Home | Suffix::Plane(_) | Suffix::Helix(_) => {
                Some(if self.index & DIRECTION_BIT == 0 { Direction::Plus } else { Direction::Minus })
            }
            _ => None,
        }
    }

    /// Whether a dialect has it.
    pub fn exists(self, dialect: &Dialect) -> bool {
        let entry = self.word.entry();
        let axes = dialect.axis_count();
        entry.access(dialect.family).is_some()
            && match entry.suffix {
                Suffix::None | Suffix::Targets => self.index == 0,
                Suffix::Axis => self.index < axes,
                Suffix::Target => {
                    entry.name.chars().next().and_then(|axis| dialect.axis(axis)) == Some(self.index)
                }
                Suffix::Index(index) => {
                    let (first, last) = index.range(dialect);
                    (first..=last).contains(&self.index)
                }
                Suffix::Direction | Suffix::Home => self.index & !DIRECTION_BIT < axes,
                Suffix::Plane(_) => {
                    let (first, second) = (self.index & AXIS_MASK, self.index >> SECOND_SHIFT & AXIS_MASK);
                    self.index < DIRECTION_BIT << 1 && first != second && first.max(second) < axes
                }
                Suffix::Helix(_) => self.index & !DIRECTION_BIT == 0,
            }
    }

    /// The place that these letters name. A word with a direction gets `+`, the letters end before it; one
    /// with a number gets 0 and is found only if `numbered`.
    pub fn from_letters(letters: &str, numbered: bool, dialect: &Dialect) -> Option<Self> {
        words(dialect.family).find_map(|entry| {
            let rest = letters.strip_prefix(entry.name)?;
            let index = index(entry, rest, numbered, dialect)?;
            Some(Self { word: entry.word, index })
        })
    }
}

/// The index that the letters behind a word's name say, if they are its suffix.
fn index(entry: &Entry, rest: &str, numbered: bool, dialect: &Dialect) -> Option<u8> {
    let axis = |letters| first_axis(letters, dialect);
    let turn = |letters| match letters {
        "P" => Some(0),
        "N" => Some(DIRECTION_BIT),
        _ => None,
    };
    match entry.suffix {
        Suffix::None => (rest.is_empty() && !numbered).then_some(0),
        Suffix::Index(_) => (rest.is_empty() && numbered).then_some(0),
        Suffix::Axis | Suffix::Direction | Suffix::Home => {
            axis(rest).filter(|(_, rest)| rest.is_empty()).map(|(axis, _)| axis)
        }
        Suffix::Target => rest.is_empty().then(|| dialect.axis(entry.name.chars().next()?))?,
        Suffix::Targets => None,
        Suffix::Plane(_) => {
            let (first, rest) = axis(rest)?;
            let (second, rest) = axis(rest)?;
            (first != second).then_some(first | second << SECOND_SHIFT | turn(rest)?)
        }
        Suffix::Helix(_) => turn(rest),
    }
}

/// The axis that letters begin with, and the rest of them.
fn first_axis<'a>(letters: &'a str, dialect: &Dialect) -> Option<(u8, &'a str)> {
    let mut letters = letters.chars();
    let axis = dialect.axis(letters.next()?)?;
    Some((axis, letters.as_str()))
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let entry = self.word.entry();
        f.write_str(entry.name)?;
        let direction = self.direction();
        let sign = if direction == Some(Direction::Minus) { '-' } else { '+' };
        let turn = if direction == Some(Direction::Minus) { 'N' } else { 'P' };
        let axis = self.axis().map_or('?', axis_name);
        match entry.suffix {
            Suffix::None | Suffix::Target | Suffix::Targets => Ok(()),
            Suffix::Axis => write!(f, "{axis}"),
            Suffix::Index(_) => write!(f, "{}", self.index),
            Suffix::Direction | Suffix::Home => write!(f, "{axis}{sign}"),
            Suffix::Plane(_) => {
                write!(f, "{axis}{}{turn}", self.second_axis().map_or('?', axis_name))
            }
            Suffix::Helix(_) => write!(f, "{turn}"),
        }
    }
}
