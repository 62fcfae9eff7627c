//! The words of the language: one table, an entry a word, and the types it speaks in.

mod operators;
mod place;
mod words;

pub use operators::{Comparison, Operator};
pub use place::{Direction, Place};
pub use words::{TABLE, Word};

use crate::dialect::{Dialect, Family};

/// Subroutines that a memory can hold (PMX manual 7.19.4, CMD manual 2.7.4).
pub const SUBROUTINES: u8 = 32;

/// The subroutine that runs when an error occurs (PMX manual 7.19.5, CMD manual 2.7.5).
pub const ERROR_SUBROUTINE: u8 = 31;

/// Most programs in a memory.
pub const PROGRAMS: u8 = 4;

/// Most axes.
pub const AXES: usize = 4;

/// What a program can do with a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Access {
    /// Read it.
    Read,
    /// Write it, or have it done.
    Write,
    /// Both.
    ReadWrite,
    /// Neither: it says how the program goes.
    Flow,
}

impl Access {
    /// Whether it can stand where a value is needed.
    pub const fn reads(self) -> bool {
        matches!(self, Self::Read | Self::ReadWrite)
    }

    /// Whether it can be a statement.
    pub const fn writes(self) -> bool {
        matches!(self, Self::Write | Self::ReadWrite)
    }
}

/// What kind of word it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// The sign of a comment.
    Comment,
    /// Part of the frame of a program: blocks, subroutines, calls.
    Structure,
    /// The variables.
    Variable,
    /// A value of the device, as `HSPD` or `DI3`.
    Register,
    /// A statement of its own, as `WAITX`.
    Action,
    /// An action that takes a value behind `=`, as `DELAY=100`.
    Command,
}

/// What stands behind a word's name, which selects what it is applied to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Suffix {
    /// Nothing.
    None,
    /// The name of an axis.
    Axis,
    /// A number.
    Index(Index),
    /// The name of an axis and `+` or `-`.
    Direction,
    /// As [`Direction`](Self::Direction); then a homing mode, in dialects that have them.
    Home,
    /// A target: the word is the name of the axis.
    Target,
    /// Targets of two and more axes.
    Targets,
    /// Two axes, `P` or `N`, and so many numbers with `:` between them.
    Plane(u8),
    /// `P` or `N`, and so many numbers with `:` between them; the axes are X, Y and Z.
    Helix(u8),
}

/// What the number behind a name counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Index {
    /// Programs, from 0.
    Program,
    /// Subroutines, from 0.
    Subroutine,
    /// Variables, from 0.
    Variable,
    /// Digital inputs, from 1.
    Input,
    /// Digital outputs, from 1.
    Output,
    /// Enable outputs, from 1.
    Enable,
    /// Configurable inputs and outputs, from 1.
    Port,
    /// Analog inputs, from 1.
    AnalogInput,
    /// PWM outputs, from 1.
    PwmOutput,
}

impl Index {
    /// The first number and the last one.
    pub const fn range(self, dialect: &Dialect) -> (u8, u8) {
        match self {
            Self::Program => (0, dialect.threads - 1),
            Self::Subroutine => (0, SUBROUTINES - 1),
            Self::Variable => (0, dialect.variables - 1),
            Self::Input => (1, dialect.inputs),
            Self::Output => (1, dialect.outputs),
            Self::Enable => (1, dialect.axis_count()),
            Self::Port => (1, dialect.ports),
            Self::AnalogInput => (1, dialect.analog_inputs),
            Self::PwmOutput => (1, dialect.pwm_outputs),
        }
    }
}

/// An entry of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Which word it is.
    pub word: Word,
    /// How it is written.
    pub name: &'static str,
    /// What kind of word it is.
    pub kind: Kind,
    /// What stands behind the name.
    pub suffix: Suffix,
    /// What Performax programs can do with it; `None` if they do not have it.
    pub performax: Option<Access>,
    /// The same for Commander programs.
    pub commander: Option<Access>,
    /// Text for people.
    #[cfg(feature = "std")]
    pub doc: Doc,
}

/// What people read about a word; left out of firmware.
#[cfg(feature = "std")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Doc {
    /// The section of the PMX manual, if it has the word.
    pub performax_section: &'static str,
    /// The section of the CMD manual, if it has the word.
    pub commander_section: &'static str,
    /// What it does, in a line.
    pub summary: &'static str,
    /// A line of a program.
    pub example: &'static str,
    /// The test of this crate that holds it.
    pub test: &'static str,
}

impl Entry {
    /// What programs of a family can do with it; `None` if they do not have it.
    pub const fn access(&self, family: Family) -> Option<Access> {
        match family {
            Family::Performax => self.performax,
            Family::Commander => self.commander,
        }
    }

    /// How many numbers follow, for those words that take any without `=`.
    pub const fn arguments(&self, dialect: &Dialect) -> usize {
        match self.suffix {
            Suffix::Target => 1,
            Suffix::Plane(count) | Suffix::Helix(count) => count as usize,
            Suffix::Home if dialect.homing_modes > 0 => 1,
            _ => 0,
        }
    }

    /// The section of the manual that has it in this dialect.
    #[cfg(feature = "std")]
    pub const fn section(&self, family: Family) -> &'static str {
        match family {
            Family::Performax => self.doc.performax_section,
            Family::Commander => self.doc.commander_section,
        }
    }

    /// The word with its suffix as the manual writes it: `DI[1-8]`, `HOME[axis][+/-]`.
    #[cfg(feature = "std")]
    pub fn form(&self, dialect: &Dialect) -> String {
        let name = self.name;
        let numbers = |count: u8| (1..=count).map(|n| format!("[{n}]")).collect::<Vec<_>>().join(":");
        match self.suffix {
            Suffix::None => name.into(),
            Suffix::Axis => format!("{name}[axis]"),
            Suffix::Index(index) => {
                let (first, last) = index.range(dialect);
                format!("{name}[{first}-{last}]")
            }
            Suffix::Direction => format!("{name}[axis][+/-]"),
            Suffix::Home if dialect.homing_modes > 0 => format!("{name}[axis][+/-][mode]"),
            Suffix::Home => format!("{name}[axis][+/-]"),
            Suffix::Target => format!("{name}[position]"),
            Suffix::Targets => dialect.axes.chars().map(|axis| format!("{axis}[pos]")).collect(),
            Suffix::Plane(count) => format!("{name}[A1][A2][P/N]{}", numbers(count)),
            Suffix::Helix(count) => format!("{name}[P/N]{}", numbers(count)),
        }
    }
}

impl Word {
    /// Its entry in the table.
    pub fn entry(self) -> &'static Entry {
        &TABLE[words::position(self)]
    }

    /// The word of a number, which compiled lines carry.
    pub fn from_number(number: u8) -> Option<Self> {
        words::by_number(number)
    }

    /// What programs of a family can do with it; `None` if they do not have it.
    pub fn access(self, family: Family) -> Option<Access> {
        self.entry().access(family)
    }
}

/// The entries that a family has.
pub fn words(family: Family) -> impl Iterator<Item = &'static Entry> {
    TABLE.iter().filter(move |entry| entry.access(family).is_some())
}

#[cfg(test)]
mod tests;
