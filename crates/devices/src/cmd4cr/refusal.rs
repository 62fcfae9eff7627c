//! Why a command is not done. Nothing has changed then.

use crate::ascii::ParseError;

/// The reasons that have a reply (CMD-4CR manual, table 4-41).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// There is no such command.
    Unknown,
    /// An axis moves, or waits, or is in an error that has to be cleared.
    Moving,
    /// The alarm input of an axis is on.
    Alarm,
    /// The positive limit input of an axis is on.
    PlusLimit,
    /// The negative limit input of an axis is on.
    MinusLimit,
    /// The emergency stop input is on.
    EmergencyStop,
    /// An axis is in a StepNLoop error.
    ClosedLoop,
    /// A number is out of range, or none.
    Index,
    /// A program is in its error state.
    Program,
    /// There is no such subroutine.
    NoSubroutine,
    /// The buffer of moves is full.
    BufferFull,
    /// The command needs the buffered mode.
    BufferDisabled,
    /// The command cannot be used in buffered mode.
    BufferEnabled,
    /// The speed is outside its window, none was chosen, or S-curves are on.
    Speed,
    /// A motion cannot be changed any more, or there is none.
    Override,
}

impl Refusal {
    /// The reply, but for the command that follows it when it is unknown.
    pub const fn text(self) -> &'static str {
        match self {
            Self::Unknown => "?Unknown Command: ",
            Self::Moving => "?Error Moving",
            Self::Alarm => "?Error Alarm",
            Self::PlusLimit => "?Error +Limit",
            Self::MinusLimit => "?Error -Limit",
            Self::EmergencyStop => "?Error ESTOP",
            Self::ClosedLoop => "?Error SNL",
            Self::Index => "?Invalid Index",
            Self::Program => "?Program Error",
            Self::NoSubroutine => "?Sub not Initialized",
            Self::BufferFull => "?Buffer Full",
            Self::BufferDisabled => "?Buffer Disabled",
            Self::BufferEnabled => "?Buffer Enabled",
            Self::Speed => "?SSPD Error",
            Self::Override => "?Override Failed",
        }
    }
}

impl From<ParseError> for Refusal {
    fn from(error: ParseError) -> Self {
        match error {
            ParseError::Unknown => Self::Unknown,
            ParseError::Index | ParseError::Value => Self::Index,
        }
    }
}
