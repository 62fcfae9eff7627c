//! Why a command is not done. Nothing has changed then.

use crate::ascii::ParseError;

/// The reasons that have a reply (PMX-2ED-SA manual, table 9.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// There is no such command.
    Unknown,
    /// A target is changed, but the axis does not go to one.
    NoTarget,
    /// The axis is in a StepNLoop error.
    ClosedLoop,
    /// The axis is part of an interpolated move.
    Interpolating,
    /// The number after the name is out of range.
    Index,
    /// The value is out of range, or none.
    Value,
    /// The low speed is above the high one.
    LowSpeed,
    /// The axis moves.
    Moving,
    /// S-curves are on.
    SCurve,
    /// The speed is outside the window of on-the-fly changes.
    Speed,
    /// No such window was chosen.
    NoWindow,
    /// There is no such subroutine.
    NoSubroutine,
    /// A state of the axis or of a program forbids it: a limit error, the joystick.
    State,
}

impl Refusal {
    /// The reply, but for the command that follows it when it is unknown.
    pub const fn text(self) -> &'static str {
        match self {
            Self::Unknown => "?",
            Self::NoTarget => "?ABS/INC is not in operation",
            Self::ClosedLoop => "?Clear SNL Error",
            Self::Interpolating => "?ICommandOn",
            Self::Index => "?Index out of Range",
            Self::Value => "?Invalid Answer",
            Self::LowSpeed => "?Low speed out of range",
            Self::Moving => "?Moving",
            Self::SCurve => "?S-curve on",
            Self::Speed => "?Speed out of range",
            Self::NoWindow => "?SSPD Mode not Initialized",
            Self::NoSubroutine => "?Sub not Initialized",
            Self::State => "?State Error",
        }
    }
}

impl From<ParseError> for Refusal {
    fn from(error: ParseError) -> Self {
        match error {
            ParseError::Unknown => Self::Unknown,
            ParseError::Index => Self::Index,
            ParseError::Value => Self::Value,
        }
    }
}
