//! Where a program stops, and why.

use crate::code::Place;
use sim::{PinValue, VirtualDevice};
use std::{fmt, str::FromStr};

/// Why the device stands.
#[derive(Clone, Debug, PartialEq)]
pub enum Stop {
    /// Nothing has been executed yet; going backwards ends here.
    Start,
    /// A step is done.
    Step,
    /// The breakpoint with this number.
    Breakpoint(u32),
    /// What the watch with this number looks at has changed.
    Watch {
        /// Its number.
        number: u32,
        /// Its name.
        name: String,
        /// The value that it had before.
        before: PinValue,
        /// The value that it has now.
        now: PinValue,
    },
    /// The time is up.
    Time,
    /// All programs have ended, and the axes stand.
    Ended,
    /// A program went into its error state.
    Failed(usize),
    /// Somebody wanted it to stop.
    Interrupted,
}

/// Where to stop.
#[derive(Clone, Debug, PartialEq)]
pub struct Breakpoint {
    /// Its number, from 1; watches are counted with them.
    pub number: u32,
    /// The line.
    pub place: Place,
    /// Where the line begins.
    pub addresses: Vec<u16>,
    /// Only where this holds.
    pub condition: Option<Condition>,
}

/// A value that is looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Watch {
    /// Its number.
    pub number: u32,
    /// What it looks at.
    pub name: String,
    /// What it has seen last.
    pub value: PinValue,
}

/// A comparison: `V1 >= 10`, `STOP_L = true`.
#[derive(Clone, Debug, PartialEq)]
pub struct Condition {
    left: Operand,
    comparison: Comparison,
    right: Operand,
}

#[derive(Clone, Debug, PartialEq)]
enum Operand {
    Value(PinValue),
    Name(String),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Comparison {
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
}

/// The signs of comparisons; a sign comes before those that it begins with.
const SIGNS: [(&str, Comparison); 8] = [
    ("<=", Comparison::LessEqual),
    (">=", Comparison::GreaterEqual),
    ("==", Comparison::Equal),
    ("!=", Comparison::NotEqual),
    ("<>", Comparison::NotEqual),
    ("<", Comparison::Less),
    (">", Comparison::Greater),
    ("=", Comparison::Equal),
];

/// Why a text is not a [`Condition`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is no comparison, as `V1 > 5`")]
pub struct ConditionError(String);

impl FromStr for Condition {
    type Err = ConditionError;

    fn from_str(text: &str) -> Result<Self, ConditionError> {
        let error = || ConditionError(text.into());
        let starts = (1..text.len()).filter(|&at| text.is_char_boundary(at));
        let mut found = starts.filter_map(|at| {
            let sign = SIGNS.iter().find(|(sign, _)| text[at..].starts_with(sign))?;
            Some((at, sign))
        });
        let (at, (sign, comparison)) = found.next().ok_or_else(error)?;
        let (left, right) = (text[..at].trim(), text[at + sign.len()..].trim());
        if left.is_empty() || right.is_empty() {
            return Err(error());
        }
        Ok(Self { left: Operand::of(left), comparison: *comparison, right: Operand::of(right) })
    }
}

impl Operand {
    fn of(text: &str) -> Self {
        text.parse().map_or_else(|_| Self::Name(text.into()), Self::Value)
    }

    fn value(&self, device: &mut VirtualDevice) -> Option<PinValue> {
        match self {
            Self::Value(value) => Some(*value),
            Self::Name(name) => value(device, name),
        }
    }
}

impl Condition {
    /// Whether it holds. A name that means nothing equals nothing.
    pub fn holds(&self, device: &mut VirtualDevice) -> bool {
        let number = |value: Option<PinValue>| match value {
            Some(PinValue::Number(number)) => number,
            Some(PinValue::Level(on)) => u8::from(on).into(),
            None => f64::NAN,
        };
        let [left, right] = [&self.left, &self.right].map(|operand| number(operand.value(device)));
        match self.comparison {
            Comparison::Less => left < right,
            Comparison::LessEqual => left <= right,
            Comparison::Greater => left > right,
            Comparison::GreaterEqual => left >= right,
            Comparison::Equal => left == right,
            Comparison::NotEqual => left != right,
        }
    }

    /// The names in it.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        [&self.left, &self.right].into_iter().filter_map(|operand| match operand {
            Operand::Name(name) => Some(name.as_str()),
            Operand::Value(_) => None,
        })
    }
}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = SIGNS.iter().find(|(_, comparison)| *comparison == self.comparison);
        write!(f, "{} {} {}", self.left, sign.map_or("", |(sign, _)| sign), self.right)
    }
}

impl fmt::Display for Operand {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Value(value) => f.write_str(&show(*value)),
            Self::Name(name) => f.write_str(name),
        }
    }
}

/// What a name has as a value: as it is written, or in upper case.
pub fn value(device: &mut VirtualDevice, name: &str) -> Option<PinValue> {
    device.value(name).or_else(|| device.value(&name.to_uppercase()))
}

/// A value as people read it.
pub fn show(value: PinValue) -> String {
    match value {
        PinValue::Level(on) => on.to_string(),
        PinValue::Number(number) => number.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sim::DeviceConfig;

    #[track_caller]
    fn check(text: &str, expected: Option<bool>) {
        let mut device =
            VirtualDevice::new(&DeviceConfig::new(devices::model("pmx-2ed").expect("a model")), 0);
        let condition = text.parse::<Condition>();
        assert_eq!(condition.ok().map(|condition| condition.holds(&mut device)), expected, "{text}");
    }

    #[test]
    fn conditions() {
        check("V1 = 0", Some(true));
        check("v1>=1", Some(false));
        check("5 <> V1", Some(true));
        check("PX <= PY", Some(true));
        check("+LX = false", Some(true));
        check("+LX == 1", Some(false));
        check("NONE != 3", Some(true));
        check("NONE = NONE", Some(false));
        check("V1", None);
        check("= 5", None);
        check("V1 <", None);
        check("", None);
    }
}
