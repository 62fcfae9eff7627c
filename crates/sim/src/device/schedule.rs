//! Inputs that are to change later.

use super::pins::PinValue;
use motion::Ticks;
use std::{
    cmp::{Ordering, Reverse},
    collections::BinaryHeap,
    str::FromStr,
};

/// A change of an input.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// Name of the pin.
    pub pin: String,
    /// What to put on it; `None` gives it back to the machine.
    pub value: Option<PinValue>,
}

/// A change of an input with its time in seconds from the start: `TIME:PIN=VALUE`, where VALUE is `true`,
/// `false`, a number, or `release`.
#[derive(Clone, Debug, PartialEq)]
pub struct TimedInput {
    /// Seconds of device time.
    pub seconds: f64,
    /// What changes.
    pub input: Input,
}

/// Why a text is not a [`TimedInput`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TimedInputError {
    /// It has another form.
    #[error("`{0}` is not of the form TIME:PIN=VALUE")]
    Form(String),
    /// The time is no number of seconds from 0 up.
    #[error("`{0}` is not a time in seconds")]
    Time(String),
    /// The value is nothing that a pin can have.
    #[error("`{0}` is not a value: true, false, a number or release")]
    Value(String),
}

impl FromStr for TimedInput {
    type Err = TimedInputError;

    fn from_str(text: &str) -> Result<Self, TimedInputError> {
        let form = || TimedInputError::Form(text.into());
        let (time, rest) = text.split_once(':').ok_or_else(form)?;
        let (pin, value) = rest.split_once('=').ok_or_else(form)?;
        let seconds = time.parse().ok().filter(|seconds: &f64| seconds.is_finite() && *seconds >= 0.0);
        let seconds = seconds.ok_or_else(|| TimedInputError::Time(time.into()))?;
        let value = match value {
            "release" => None,
            _ => Some(value.parse().map_err(|_| TimedInputError::Value(value.into()))?),
        };
        Ok(Self { seconds, input: Input { pin: pin.into(), value } })
    }
}

/// A change of a pin that is due at some time; `None` releases it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Due {
    at: Ticks,
    sequence: u64,
    pub pin: usize,
    pub level: Option<i32>,
}

impl Ord for Due {
    fn cmp(&self, other: &Self) -> Ordering {
        (self.at, self.sequence).cmp(&(other.at, other.sequence))
    }
}

impl PartialOrd for Due {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// All changes to come, those of the same time in the order in which they were planned.
#[derive(Debug, Default)]
pub(super) struct Schedule {
    heap: BinaryHeap<Reverse<Due>>,
    sequence: u64,
}

impl Schedule {
    pub fn add(&mut self, at: Ticks, pin: usize, level: Option<i32>) {
        self.sequence += 1;
        self.heap.push(Reverse(Due { at, sequence: self.sequence, pin, level }));
    }

    pub fn next(&self) -> Ticks {
        self.heap.peek().map_or(Ticks::MAX, |due| due.0.at)
    }

    /// The next change if it is due at `now`.
    pub fn take(&mut self, now: Ticks) -> Option<Due> {
        if self.next() > now {
            return None;
        }
        self.heap.pop().map(|due| due.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(text: &str, expected: Result<(f64, &str, Option<PinValue>), &str>) {
        let got = text.parse::<TimedInput>().map(|timed| (timed.seconds, timed.input));
        let expected = expected.map(|(seconds, pin, value)| (seconds, Input { pin: pin.into(), value }));
        assert_eq!(got.map_err(|error| error.to_string()), expected.map_err(str::to_string));
    }

    #[test]
    fn timed_inputs_are_read() {
        check("0.5:STOP_L=true", Ok((0.5, "STOP_L", Some(PinValue::Level(true)))));
        check("2:AIN0=1.5", Ok((2.0, "AIN0", Some(PinValue::Number(1.5)))));
        check("1e-3:HOME=release", Ok((0.001, "HOME", None)));
        check("0.5", Err("`0.5` is not of the form TIME:PIN=VALUE"));
        check("0.5:HOME", Err("`0.5:HOME` is not of the form TIME:PIN=VALUE"));
        check("-1:HOME=true", Err("`-1` is not a time in seconds"));
        check("1:HOME=maybe", Err("`maybe` is not a value: true, false, a number or release"));
        check("1:HOME=NaN", Err("`NaN` is not a value: true, false, a number or release"));
    }

    #[test]
    fn changes_come_in_order() {
        let mut schedule = Schedule::default();
        for (at, pin) in [(5, 0), (3, 1), (5, 2), (3, 3)] {
            schedule.add(at, pin, None);
        }
        assert!(schedule.take(2).is_none());
        let order: Vec<_> = std::iter::from_fn(|| schedule.take(10)).map(|due| due.pin).collect();
        assert_eq!(order, [1, 3, 0, 2]);
        assert_eq!(schedule.next(), Ticks::MAX);
    }
}
