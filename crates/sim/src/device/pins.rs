//! Pins by name, and what can be put on them.

use devices::{Pin, PinKind};
use serde::{Deserialize, Serialize, Serializer};
use std::{fmt, str::FromStr};

/// What is on a pin.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
#[serde(untagged, expecting = "a pin takes true, false or a number")]
pub enum PinValue {
    /// A digital pin: whether it is on. A switch that is pressed is on.
    Level(bool),
    /// An analog pin, in its unit.
    Number(f64),
}

/// Why a pin cannot be read or driven.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PinError {
    /// The device has no such pin.
    #[error("there is no pin `{name}`, the device has: {known}")]
    Unknown {
        /// The name that was asked for.
        name: String,
        /// All names.
        known: String,
    },
    /// It is an output: only the controller drives it.
    #[error("`{0}` is an output, only the controller drives it")]
    Output(String),
    /// It is an output now: the controller drives it.
    #[error("`{0}` is an output now, the controller drives it")]
    Driven(String),
    /// A digital pin takes true and false.
    #[error("`{0}` is digital: true or false")]
    NeedsLevel(String),
    /// An analog pin takes a number.
    #[error("`{name}` is analog: a number in {unit}")]
    NeedsNumber {
        /// The pin.
        name: String,
        /// Its unit.
        unit: &'static str,
    },
    /// The number is not one that the pin can have.
    #[error("`{0}` cannot have this value")]
    Range(String),
}

/// The number of a pin.
pub(crate) fn find(pins: &[Pin], name: &str) -> Result<usize, PinError> {
    pins.iter().position(|pin| pin.name == name).ok_or_else(|| {
        let known: Vec<_> = pins.iter().map(|pin| pin.name).collect();
        PinError::Unknown { name: name.into(), known: known.join(", ") }
    })
}

/// The level or number to drive an input with.
pub(crate) fn to_drive(pin: &Pin, value: PinValue) -> Result<i32, PinError> {
    let name = || pin.name.to_owned();
    match (pin.kind, value) {
        (PinKind::Output | PinKind::AnalogOutput, _) => Err(PinError::Output(name())),
        (PinKind::Input | PinKind::Port | PinKind::Index(_), PinValue::Level(on)) => Ok(i32::from(on)),
        (PinKind::Input | PinKind::Port | PinKind::Index(_), PinValue::Number(_)) => {
            Err(PinError::NeedsLevel(name()))
        }
        (PinKind::Analog, PinValue::Level(_)) => Err(PinError::NeedsNumber { name: name(), unit: pin.unit }),
        (PinKind::Analog, PinValue::Number(number)) => {
            let rounded = (number * f64::from(pin.scale)).round();
            // NaN is in no range.
            let fits = (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&rounded);
            if fits { Ok(rounded as i32) } else { Err(PinError::Range(name())) }
        }
    }
}

/// What a level or number of a pin means.
pub(super) fn from_level(pin: &Pin, level: i32) -> PinValue {
    if pin.kind.is_analog() {
        PinValue::Number(f64::from(level) / f64::from(pin.scale))
    } else {
        PinValue::Level(level != 0)
    }
}

/// JSON `true`, `false` or a number.
impl Serialize for PinValue {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Level(on) => serializer.serialize_bool(*on),
            Self::Number(number) => serializer.serialize_f64(*number),
        }
    }
}

impl fmt::Display for PinValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Level(on) => on.fmt(f),
            Self::Number(number) => number.fmt(f),
        }
    }
}

/// A text is neither `true`, `false` nor a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a pin takes true, false or a number")]
pub struct ParsePinValueError;

impl FromStr for PinValue {
    type Err = ParsePinValueError;

    fn from_str(text: &str) -> Result<Self, ParsePinValueError> {
        match text {
            "true" | "on" => Ok(Self::Level(true)),
            "false" | "off" => Ok(Self::Level(false)),
            _ => text
                .parse()
                .ok()
                .filter(|number: &f64| number.is_finite())
                .map(Self::Number)
                .ok_or(ParsePinValueError),
        }
    }
}
