//! What a bench file may say: one row a key. Its range is checked, and its schema written, from the row.

use super::{MAX_CAMS, MAX_DEVICES, MAX_IN_POSITION_MS, MAX_MPG_HZ, MAX_POINTS, MAX_PULSES};
use crate::machine::MAX_BOUNCE_MS;
use std::fmt::Display;
use toml::Value;

/// A key with its values.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Key {
    pub name: &'static str,
    pub form: Form,
    /// Of its numbers.
    pub unit: &'static str,
    /// What it says, in one line.
    pub about: &'static str,
    /// Whether it cannot be left out.
    pub is_needed: bool,
}

/// Which values a key may have.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Form {
    /// A name of a model.
    Model,
    /// Letters, digits and `.`, `_`, `-`.
    Name,
    /// Text that somebody else reads: an endpoint, an axis, a pin.
    Text,
    /// `true` or `false`.
    Switch,
    /// A whole number, from the first to the last.
    Whole([i64; 2]),
    /// A number, from the first to the last.
    Number([f64; 2]),
    /// A number whose size is from the first to the last.
    Ratio([f64; 2]),
    /// A position.
    Position,
    /// Two positions.
    Zone,
    /// One zone, or two.
    Zones,
    /// Points of a speed, up to the first of these, and a part, up to the second.
    Curve([f64; 2]),
    /// One of these words.
    Word(&'static [&'static str]),
    /// Some of these words.
    Words(&'static [&'static str]),
    /// Some texts.
    Texts,
    /// So many tables with these keys.
    Tables(usize, &'static [Key]),
    /// Tables with these keys, by the names of the axes.
    ByAxis(&'static [Key]),
}

const fn key(name: &'static str, form: Form, unit: &'static str, about: &'static str) -> Key {
    Key { name, form, unit, about, is_needed: false }
}

const fn needed(name: &'static str, form: Form, unit: &'static str, about: &'static str) -> Key {
    Key { is_needed: true, ..key(name, form, unit, about) }
}

/// The whole file.
pub(crate) const BENCH: &[Key] = &[needed("device", Form::Tables(MAX_DEVICES, DEVICE), "", "The devices.")];

pub(crate) const DEVICE: &[Key] = &[
    needed("model", Form::Model, "", "What it is."),
    key(
        "count",
        Form::Whole([1, MAX_DEVICES as i64]),
        "",
        "So many devices like this; `{n}` or `{4000+n}` in names and endpoints is the number of each, from 1.",
    ),
    key("name", Form::Name, "", "What it is called; by default like its model."),
    key("listen", Form::Texts, "", "Endpoints at which it can be reached."),
    key("supply", Form::Number([0.0, 1000.0]), "V", "Motor supply; 24 by default."),
    key(
        "temperature",
        Form::Number([-273.0, 1000.0]),
        "°C",
        "Temperature of its driver stage; 25 by default.",
    ),
    key("seed", Form::Whole([0, i64::MAX]), "", "What its random numbers start from."),
    key("axis", Form::ByAxis(AXIS), "", "What its axes move, by their names."),
];

const ANY_LENGTH: Form = Form::Whole([0, MAX_PULSES]);

/// An axis.
pub(crate) const AXIS: &[Key] = &[
    key("negative_limit", Form::Position, "pulses", "The switch at the negative end is on here and below."),
    key("positive_limit", Form::Position, "pulses", "The switch at the positive end is on here and above."),
    key("home", Form::Zone, "pulses", "The home switch is on from the first position to the second."),
    key("slowdown", Form::Zones, "pulses", "The slowdown switch is on in this zone, or these two."),
    key(
        "circumference",
        Form::Whole([2, MAX_PULSES]),
        "pulses",
        "The axis goes round: its switches, cams and marks come again after so many, and it has no ends.",
    ),
    key("switch_hysteresis", ANY_LENGTH, "pulses", "How far past its end a switch still stays on."),
    key(
        "bounce_ms",
        Form::Whole([0, MAX_BOUNCE_MS as i64]),
        "ms",
        "How long a switch bounces after a change.",
    ),
    key(
        "normally_closed",
        Form::Words(&["negative_limit", "positive_limit", "home", "slowdown"]),
        "",
        "Switches that are closed while nothing is on them.",
    ),
    key(
        "index_every",
        Form::Whole([1, MAX_PULSES]),
        "pulses",
        "From one index mark to the next; one is at 0.",
    ),
    key("encoder_ratio", Form::Ratio([1e-6, 1e6]), "counts a pulse", "Counts of the external encoder."),
    key(
        "encoder_at",
        Form::Word(&["motor", "load"]),
        "",
        "Where the external encoder sits; `load` by default.",
    ),
    key("backlash", ANY_LENGTH, "pulses", "Play between the motor and what it drives."),
    key("hard_stops", Form::Zone, "pulses", "Where the axis hits something that does not give way."),
    key("load", Form::Number([0.0, 1000.0]), "", "Load, in parts of the motor's torque at full current."),
    key(
        "friction",
        Form::Number([0.0, 1000.0]),
        "",
        "Load that grows with the speed: so much at 1,000 full steps a second.",
    ),
    key(
        "pull_out",
        Form::Curve([1e6, 1000.0]),
        "",
        "The torque that the motor has at each speed: full steps a second, and parts of that at full current.",
    ),
    key(
        "microsteps",
        Form::Whole([1, 256]),
        "",
        "Pulses that the driver takes for a full step; 1 by default.",
    ),
    key(
        "in_position_ms",
        Form::Whole([1, MAX_IN_POSITION_MS as i64]),
        "ms",
        "A servo driver is in position so long after its last pulse.",
    ),
    key("mpg_from", Form::Text, "", "The axis whose encoder is wired to the MPG input."),
    key("mpg_hz", Form::Whole([1, MAX_MPG_HZ as i64]), "counts a second", "How fast a hand wheel is turned."),
    key("joystick", Form::Number([-1.0, 1.0]), "", "How far the joystick of this axis is deflected."),
    key("cam", Form::Tables(MAX_CAMS, CAM), "", "Inputs of the device that this axis switches."),
];

const CAM: &[Key] = &[
    needed("pin", Form::Text, "", "The input, by its name in the manual."),
    needed("on", Form::Zone, "pulses", "It is on from the first position of this axis to the second."),
    key("normally_closed", Form::Switch, "", "Whether it is off there, and on elsewhere."),
];

/// The way to a value that is out of its range, and what is wrong with it.
pub(crate) struct Wrong {
    pub path: Vec<String>,
    pub problem: String,
}

impl From<String> for Wrong {
    fn from(problem: String) -> Self {
        Self { path: Vec::new(), problem }
    }
}

impl Wrong {
    fn inside(mut self, key: &str) -> Self {
        self.path.insert(0, key.into());
        self
    }
}

/// A number that may be written without a point.
fn number(value: &Value) -> f64 {
    // The types are right.
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64)).unwrap_or(f64::NAN)
}

fn pair(values: &[Value]) -> Result<(), Wrong> {
    if values.len() == 2 { Ok(()) } else { Err(format!("2 values, not {}", values.len()).into()) }
}

/// Whether all numbers of a table whose values have the right types are in their ranges.
///
/// # Errors
/// [`Wrong`] about the first that is not.
pub(crate) fn check(keys: &[Key], table: &toml::Table) -> Result<(), Wrong> {
    keys.iter().try_for_each(|key| match table.get(key.name) {
        Some(value) => key.check(value).map_err(|wrong| wrong.inside(key.name)),
        None => Ok(()),
    })
}

impl Key {
    fn check(&self, value: &Value) -> Result<(), Wrong> {
        match (self.form, value) {
            (Form::Whole(range), Value::Integer(number)) => self.within(*number, range),
            (Form::Number(range), value) => self.within(number(value), range),
            (Form::Ratio([least, most]), value) => {
                let number = number(value);
                let sign = if number < 0.0 { -1.0 } else { 1.0 };
                let [low, high] = [sign * least, sign * most];
                self.within(number, [low.min(high), low.max(high)])
            }
            (Form::Position | Form::Zone | Form::Zones, Value::Integer(position)) => {
                self.within(*position, [-MAX_PULSES, MAX_PULSES])
            }
            (Form::Zone | Form::Zones, Value::Array(values)) => {
                pair(values)?;
                values.iter().try_for_each(|value| self.check(value))
            }
            (Form::Curve(most), Value::Array(points)) => {
                if !(1..=MAX_POINTS).contains(&points.len()) {
                    return Err(format!("1 to {MAX_POINTS} points").into());
                }
                points.iter().filter_map(Value::as_array).try_for_each(|point| {
                    pair(point)?;
                    let mut numbers = point.iter().map(number).zip(most);
                    numbers.try_for_each(|(number, most)| self.within(number, [0.0, most]))
                })
            }
            (Form::Tables(most, keys), Value::Array(tables)) => {
                if tables.len() > most {
                    return Err(format!("{most} at most").into());
                }
                let mut tables = tables.iter().filter_map(Value::as_table).enumerate();
                tables.try_for_each(|(number, table)| {
                    check(keys, table).map_err(|wrong| wrong.inside(&number.to_string()))
                })
            }
            (Form::ByAxis(keys), Value::Table(axes)) => {
                let mut axes = axes.iter().filter_map(|(axis, table)| Some((axis, table.as_table()?)));
                axes.try_for_each(|(axis, table)| check(keys, table).map_err(|wrong| wrong.inside(axis)))
            }
            _ => Ok(()),
        }
    }

    fn within<T: PartialOrd + Display>(&self, number: T, [least, most]: [T; 2]) -> Result<(), Wrong> {
        // NaN is in no range.
        if least <= number && number <= most {
            return Ok(());
        }
        let space = if self.unit.is_empty() { "" } else { " " };
        Err(format!("{number} is outside {least} to {most}{space}{}", self.unit).into())
    }
}
