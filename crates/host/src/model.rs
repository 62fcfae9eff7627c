//! The controllers that this crate can talk to.

use ascript::dialect::{COMMANDER, Dialect, PERFORMAX_2};
use std::{fmt, str::FromStr};
use tmcl::isa::VARIABLES;

/// A kind of controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Model {
    /// Trinamic PD42-1140.
    Pd42,
    /// Arcus PMX-2ED-SA.
    Pmx2ed,
    /// Nippon Pulse CMD-4CR.
    Cmd4cr,
}

impl Model {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Pd42, Self::Pmx2ed, Self::Cmd4cr];

    /// Its name on a command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Pd42 => "pd42-1140",
            Self::Pmx2ed => "pmx-2ed",
            Self::Cmd4cr => "cmd-4cr",
        }
    }

    /// The dialect of A-SCRIPT that it speaks; `None` if it speaks TMCL.
    pub const fn dialect(self) -> Option<&'static Dialect> {
        match self {
            Self::Pd42 => None,
            Self::Pmx2ed => Some(&PERFORMAX_2),
            Self::Cmd4cr => Some(&COMMANDER),
        }
    }

    /// The names of its axes.
    pub const fn axes(self) -> &'static [&'static str] {
        match self {
            Self::Pd42 => &["0"],
            Self::Pmx2ed => &["X", "Y"],
            Self::Cmd4cr => &["X", "Y", "Z", "U"],
        }
    }

    /// How many programs it runs side by side.
    pub const fn programs(self) -> u8 {
        match self.dialect() {
            None => 1,
            Some(dialect) => dialect.threads,
        }
    }

    /// How many variables its programs have.
    pub const fn variables(self) -> u16 {
        match self.dialect() {
            None => VARIABLES as u16,
            Some(dialect) => dialect.variables as u16,
        }
    }

    /// The kinds of [`Action`](crate::Action) that it has, by their names.
    pub const fn actions(self) -> &'static [&'static str] {
        match self {
            Self::Pd42 => &[
                "jog",
                "move",
                "stop",
                "home",
                "set_position",
                "set_encoder",
                "clear_error",
                "change_speed",
                "change_target",
                "output",
            ],
            Self::Pmx2ed | Self::Cmd4cr => &[
                "power",
                "jog",
                "move",
                "stop",
                "abort",
                "home",
                "set_position",
                "set_encoder",
                "clear_error",
                "change_speed",
                "change_target",
                "set_mode",
                "output",
            ],
        }
    }
}

impl fmt::Display for Model {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Model {
    type Err = ();

    fn from_str(name: &str) -> Result<Self, ()> {
        Self::ALL.into_iter().find(|model| model.name() == name).ok_or(())
    }
}
