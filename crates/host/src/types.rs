//! What controllers are told and what they say, as it goes on to whoever asks.

use serde::{Deserialize, Serialize};
use std::{collections::BTreeMap, fmt};
use ts_rs::TS;
use utoipa::ToSchema;

/// What a controller is doing.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS, ToSchema)]
pub struct Status {
    /// When this was so, in seconds since the wire was opened.
    pub seconds: f64,
    /// Its axes, by name.
    pub axes: BTreeMap<String, AxisStatus>,
    /// Digital inputs, and analog ones in their unit, by the names of their pins.
    pub inputs: BTreeMap<String, Level>,
    /// Outputs likewise.
    pub outputs: BTreeMap<String, Level>,
    /// Its standalone programs.
    pub programs: Vec<ProgramStatus>,
    /// Whether targets of moves are positions, or count from where the axis stands; `None` if each move says so.
    pub absolute: Option<bool>,
    /// What is wrong, one sentence each.
    pub alarms: Vec<String>,
}

/// What an axis is doing.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS, ToSchema)]
pub struct AxisStatus {
    /// Position, in pulses (TMCL: microsteps); with StepNLoop the target position now, in encoder counts.
    pub position: i32,
    /// Encoder position, in counts (TMCL: microsteps).
    pub encoder: Option<i32>,
    /// Speed, in pulses a second (TMCL: internal units). ASCII controllers say no sign: it is that of the way from one
    /// look to the next.
    pub speed: i32,
    /// Where it goes, or has gone last. What was not said over this wire is only known of TMCL modules.
    pub target: Option<i32>,
    /// Difference of the position where it should be and the encoder's, if a closed loop looks at it.
    pub delta: Option<i32>,
    /// Load value; lower is more.
    pub load: Option<i32>,
    /// The status word.
    pub status: u32,
    /// The names of its bits that are 1.
    pub flags: Vec<String>,
    /// What it does, in a word: `idle`, `accelerating`, `constant speed`, `decelerating`, `moving`, `homing`.
    pub state: String,
    /// What its closed loop does; `None` if it is off or there is none.
    pub loop_state: Option<String>,
    /// Whether the motor has power; `None` if that cannot be switched.
    pub enabled: Option<bool>,
    /// Whether the negative limit switch is on.
    pub negative_limit: Option<bool>,
    /// Whether the positive limit switch is on.
    pub positive_limit: Option<bool>,
    /// Whether the home switch is on.
    pub home: Option<bool>,
    /// Whether the index of the encoder is on.
    pub index: Option<bool>,
    /// What is wrong and has to be cleared.
    pub error: Option<String>,
}

/// A standalone program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS, ToSchema)]
pub struct ProgramStatus {
    /// Whether it runs.
    pub state: ProgramState,
    /// The address of the line or command that it is at.
    pub counter: u16,
}

/// Whether a program runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum ProgramState {
    /// It does not.
    Idle,
    /// It does.
    Running,
    /// It will go on where it is.
    Paused,
    /// Something went wrong in it.
    Error,
}

/// The level of an input or output: on or off, or how much.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(untagged)]
pub enum Level {
    /// On or off.
    Digital(bool),
    /// How much, in the pin's unit.
    Analog(f64),
}

/// A direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(try_from = "i8", into = "i8")]
pub enum Direction {
    /// Towards lower positions.
    Negative,
    /// Towards higher ones.
    Positive,
}

impl Direction {
    /// -1 or 1.
    pub const fn sign(self) -> i8 {
        match self {
            Self::Negative => -1,
            Self::Positive => 1,
        }
    }

    /// As the ASCII commands write it.
    pub(crate) const fn letter(self) -> char {
        match self {
            Self::Negative => '-',
            Self::Positive => '+',
        }
    }
}

impl From<Direction> for i8 {
    fn from(direction: Direction) -> Self {
        direction.sign()
    }
}

impl TryFrom<i8> for Direction {
    type Error = &'static str;

    fn try_from(sign: i8) -> Result<Self, &'static str> {
        match sign {
            -1 => Ok(Self::Negative),
            1 => Ok(Self::Positive),
            _ => Err("a direction is 1 or -1"),
        }
    }
}

/// Something that a controller is to do. Units are those of [`AxisStatus`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(tag = "do", rename_all = "snake_case", deny_unknown_fields)]
pub enum Action {
    /// Motor power.
    Power {
        /// The axis.
        axis: String,
        /// On or off.
        on: bool,
    },
    /// Move on and on.
    Jog {
        /// The axis.
        axis: String,
        /// Which way.
        #[ts(type = "1 | -1")]
        #[schema(value_type = i8)]
        direction: Direction,
        /// The speed from now on; without it that of the axis' parameters.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        speed: Option<i32>,
        /// Whether it goes on only while the WebSocket `live` says so (`hold`), so that the axis stops when whoever
        /// began it is gone. The wire knows nothing of it: whoever passes the action on sees to it.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        #[ts(as = "Option<bool>", optional)]
        held: bool,
    },
    /// Move to targets; several axes along a line if the controller can.
    Move {
        /// The targets, by axis.
        targets: BTreeMap<String, i32>,
        /// Whether they count from where the axes stand.
        relative: bool,
    },
    /// Come to rest with the deceleration ramp.
    Stop {
        /// The axis; all of them without it.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        axis: Option<String>,
    },
    /// Stop at once.
    Abort {
        /// The axis; all of them without it.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        axis: Option<String>,
    },
    /// Look for the zero point.
    Home {
        /// The axis.
        axis: String,
        /// How: PMX-2ED-SA 0 to 4 in the order of its manual (`H`, `L`, `ZH`, `Z`, `HL`), CMD-4CR 0 to 12, PD42-1140 1
        /// to 8 and what may be added (axis parameter 193).
        mode: u8,
        /// Which way to begin. On the PD42-1140 it is the end whose switch counts, and the modes above 4 say it themselves.
        #[ts(type = "1 | -1")]
        #[schema(value_type = i8)]
        direction: Direction,
    },
    /// Say where the axis is.
    SetPosition {
        /// The axis.
        axis: String,
        /// The position.
        value: i32,
    },
    /// Say where the encoder is.
    SetEncoder {
        /// The axis.
        axis: String,
        /// The position.
        value: i32,
    },
    /// Forget what went wrong.
    ClearError {
        /// The axis.
        axis: String,
    },
    /// Another speed for a motion that is on.
    ChangeSpeed {
        /// The axis.
        axis: String,
        /// The speed.
        speed: i32,
        /// The acceleration from now on, in the unit of its parameter.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        acceleration: Option<i32>,
        /// The speed window from now on (`SSPDM`); it can only be set at rest.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        mode: Option<i32>,
    },
    /// Another target, an absolute one, for a move that is on.
    ChangeTarget {
        /// The axis.
        axis: String,
        /// The target.
        target: i32,
    },
    /// How targets are meant that do not say it.
    SetMode {
        /// As positions, or from where the axis stands.
        absolute: bool,
    },
    /// Set an output.
    Output {
        /// The name of its pin.
        name: String,
        /// Its level.
        value: Level,
    },
}

/// What a program is to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[serde(tag = "do", rename_all = "snake_case", deny_unknown_fields)]
pub enum ProgramAction {
    /// Start.
    Run {
        /// From this address; without it from its beginning.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        at: Option<u16>,
    },
    /// End.
    Stop,
    /// Wait where it is.
    Pause,
    /// Go on where it is.
    Continue,
    /// Execute one command (TMCL only).
    Step,
    /// End, and stand at the beginning again.
    Reset,
}

/// The value of a parameter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(untagged)]
pub enum Value {
    /// A whole number.
    Number(i32),
    /// One with digits after the point.
    Decimal(f64),
    /// Text.
    Text(String),
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Decimal(number) => write!(f, "{number}"),
            Self::Text(text) => f.write_str(text),
        }
    }
}

/// What comes of a line that somebody typed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, TS, ToSchema)]
pub struct Answer {
    /// The request, as people write it.
    pub request: String,
    /// The reply: the line of an ASCII controller, the value of a TMCL one.
    pub reply: String,
    /// What the reply means, if it does not say so itself.
    pub text: String,
    /// Whether it was done.
    pub ok: bool,
    /// The bytes that were sent, in hexadecimal.
    pub hex_request: String,
    /// The bytes that came.
    pub hex_reply: String,
}

/// A controller that answers on a wire.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, TS, ToSchema)]
pub struct Found {
    /// Its address on a bus.
    pub address: u8,
    /// Its model's name on a command line; `None` if it is one that we do not know.
    pub model: Option<String>,
    /// The version of its firmware, in its own words.
    pub version: String,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn actions_as_json() {
        let check = |text: &str, expected: Action| {
            let action: Action = serde_json::from_str(text).expect(text);
            assert_eq!(action, expected);
            assert_eq!(serde_json::to_string(&action).expect("JSON"), text);
        };
        check(r#"{"do":"power","axis":"X","on":true}"#, Action::Power { axis: "X".into(), on: true });
        check(
            r#"{"do":"jog","axis":"X","direction":-1}"#,
            Action::Jog { axis: "X".into(), direction: Direction::Negative, speed: None, held: false },
        );
        check(
            r#"{"do":"jog","axis":"X","direction":1,"speed":5,"held":true}"#,
            Action::Jog { axis: "X".into(), direction: Direction::Positive, speed: Some(5), held: true },
        );
        check(
            r#"{"do":"move","targets":{"X":5,"Y":-5},"relative":false}"#,
            Action::Move { targets: [("X".into(), 5), ("Y".into(), -5)].into(), relative: false },
        );
        check(r#"{"do":"stop"}"#, Action::Stop { axis: None });
        check(
            r#"{"do":"output","name":"DO1","value":true}"#,
            Action::Output { name: "DO1".into(), value: Level::Digital(true) },
        );
        check(
            r#"{"do":"output","name":"PWM1","value":50.0}"#,
            Action::Output { name: "PWM1".into(), value: Level::Analog(50.0) },
        );
        for wrong in [
            r#"{"do":"fly"}"#,
            r#"{"do":"stop","axes":"X"}"#,
            r#"{"do":"jog","axis":"X","direction":0}"#,
            r#"{"do":"home","axis":"X","mode":-1,"direction":1}"#,
        ] {
            assert!(serde_json::from_str::<Action>(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn values_as_json() {
        let check = |text: &str, expected: Value| {
            assert_eq!(serde_json::from_str::<Value>(text).expect(text), expected);
            assert_eq!(serde_json::to_string(&expected).expect("JSON"), text);
        };
        check("-5", Value::Number(-5));
        check("2.5", Value::Decimal(2.5));
        check("\"2ED05\"", Value::Text("2ED05".into()));
    }
}
