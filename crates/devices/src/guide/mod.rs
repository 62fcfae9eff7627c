//! What hosts show people of a controller: its parameters and commands one by one, its status bits, its ways of
//! homing. All of it comes from the tables by which the controller works.

extern crate alloc;

pub mod ascii;
pub mod tmcl;

use crate::Pin;
use alloc::{string::String, vec::Vec};
use motion::{Direction, pps::Window};

/// A controller for people.
#[derive(Clone, Copy, Debug)]
pub struct Guide {
    /// The names of its axes.
    pub axes: &'static [&'static str],
    /// Its pins.
    pub pins: &'static [Pin],
    /// From where to where the numbers of its analog pins go, by the pin's name, in the pin's unit.
    pub analog: &'static [(&'static str, f64, f64)],
    /// What it counts in.
    pub units: Units,
    /// How many standalone programs run side by side.
    pub programs: u8,
    /// How many commands or compiled lines its programs can have together.
    pub program_capacity: u16,
    /// Its table of speeds, if it counts in pulses a second.
    pub speed_windows: &'static [Window],
    /// The bits of the status of an axis.
    pub status_bits: &'static [StatusBit],
    /// The ways of homing.
    pub homing: &'static [HomingMode],
    /// Every parameter of every axis, in the order of the tables.
    pub settings: fn() -> Vec<Setting>,
    /// Every command that a host can send.
    pub commands: fn() -> Vec<Usage>,
}

impl Guide {
    /// Of a controller that is not for people.
    pub const NONE: Self = Self {
        axes: &[],
        pins: &[],
        analog: &[],
        units: Units { position: "", speed: "", encoder: "" },
        programs: 0,
        program_capacity: 0,
        speed_windows: &[],
        status_bits: &[],
        homing: &[],
        settings: Vec::new,
        commands: Vec::new,
    };
}

/// What a controller counts in.
#[derive(Clone, Copy, Debug)]
pub struct Units {
    /// Positions.
    pub position: &'static str,
    /// Speeds.
    pub speed: &'static str,
    /// Encoder positions.
    pub encoder: &'static str,
}

/// The group of the variables of programs.
pub const VARIABLES: &str = "Variables";

/// What a status bit says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BitKind {
    /// What the axis is doing.
    State,
    /// The level of an input or output.
    Switch,
    /// Something went wrong.
    Error,
}

/// A bit of the status of an axis.
#[derive(Clone, Copy, Debug)]
pub struct StatusBit {
    /// Which one, from 0.
    pub bit: u8,
    /// What it is called.
    pub name: &'static str,
    /// When it is 1, in a sentence.
    pub text: &'static str,
    /// What it says.
    pub kind: BitKind,
    /// The test that holds it.
    pub test: &'static str,
}

/// A way of homing.
#[derive(Clone, Copy, Debug)]
pub struct HomingMode {
    /// Its number; where the manual has none, its place in the manual, from 0.
    pub id: u8,
    /// What it is called.
    pub name: &'static str,
    /// What it does, in a sentence.
    pub text: &'static str,
    /// The directions in which it can be started.
    pub directions: &'static [Direction],
    /// The manual's section.
    pub section: &'static str,
    /// The test that holds it.
    pub test: &'static str,
}

/// Both directions, for [`HomingMode::directions`].
pub const BOTH: &[Direction] = &[Direction::Negative, Direction::Positive];

/// A parameter, register or variable, as a host names it.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// What hosts know it by, unique in its controller: `AP4.0`, `GP66`, `GP12.2`; `HSPDX`.
    pub id: String,
    /// What it has to do with, for lists.
    pub group: &'static str,
    /// The axis that it belongs to.
    pub axis: Option<&'static str>,
    /// Its name in words.
    pub name: String,
    /// Its name in programs.
    pub symbol: String,
    /// Unit of the value; empty for a plain number.
    pub unit: &'static str,
    /// What it does, in a sentence.
    pub text: &'static str,
    /// The manual's section.
    pub section: &'static str,
    /// From where to where it can be set, without the point if it has decimals; `None` if it cannot be, or is text.
    pub range: Option<(i64, i64)>,
    /// Its value from the factory, without the point; `None` if there is none.
    pub default: Option<i64>,
    /// Digits after the point.
    pub decimals: u8,
    /// Whether it can be read.
    pub readable: bool,
    /// Whether it can be set.
    pub writable: bool,
    /// Whether it can outlive the power.
    pub stored: bool,
    /// Whether it is stored whenever it is set.
    pub stores_itself: bool,
    /// Whether it is text.
    pub is_text: bool,
    /// Whether looking at it changes it.
    pub is_touchy: bool,
    /// What it is for, if hosts know it by that.
    pub role: Option<Role>,
    /// Whether it can be kept in a file and given back later: no position, output or timer, which would do something.
    pub is_setting: bool,
}

/// What a parameter is for, where hosts do something with it that other models have too, under other names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Role {
    /// The speed of motions.
    HighSpeed,
    /// The speed at which ramps begin and end.
    LowSpeed,
    /// The acceleration, or how long it takes.
    Acceleration,
    /// The deceleration likewise.
    Deceleration,
    /// Whether deceleration is as set, and not as acceleration.
    OwnDeceleration,
    /// Whether ramps are S-curves.
    SCurve,
    /// The window in which a speed can be changed on the way.
    SpeedWindow,
    /// Whether the closed loop is on.
    ClosedLoop,
    /// Pulses of the motor for a count of the encoder.
    ClosedLoopRatio,
    /// Whether the axis follows its hand wheel.
    PulserEnable,
    /// Microsteps in a full step, as a power of two.
    Microsteps,
    /// The exponent that scales speeds.
    PulseDivisor,
    /// The exponent that scales accelerations.
    RampDivisor,
}

/// A command and how it is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Usage {
    /// What it begins with.
    pub name: String,
    /// Its form.
    pub syntax: String,
    /// What it does, in a sentence.
    pub text: &'static str,
    /// A line of it.
    pub example: &'static str,
    /// The manual's section.
    pub section: &'static str,
    /// Unit of its value; empty for a plain number or none.
    pub unit: &'static str,
}

/// A part of a manual, and what to call it.
pub(crate) type Topic = (&'static str, &'static str);

/// The name of the part of a manual that a section belongs to: that of the longest entry which it begins with.
pub(crate) fn topic(topics: &[Topic], section: &str) -> &'static str {
    let inside =
        |part: &str| section.strip_prefix(part).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
    let found = topics.iter().filter(|(part, _)| inside(part)).max_by_key(|(part, _)| part.len());
    found.map_or("", |(_, name)| *name)
}

/// A row for each bit, with its number, name and test, for pages.
///
/// # Panics
/// At compile time, if the bits are not in order.
pub const fn rows<const COUNT: usize>(
    bits: &'static [StatusBit; COUNT],
) -> [(&'static str, &'static str, &'static str); COUNT] {
    const NUMBERS: [&str; 20] = [
        "0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "10", "11", "12", "13", "14", "15", "16", "17",
        "18", "19",
    ];
    let mut rows = [("", "", ""); COUNT];
    let mut at = 0;
    while at < COUNT {
        assert!(at == 0 || bits[at - 1].bit < bits[at].bit, "bits are in order");
        rows[at] = (NUMBERS[bits[at].bit as usize], bits[at].name, bits[at].test);
        at += 1;
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MODELS;
    use std::collections::BTreeSet;

    #[test]
    fn topics_are_whole_sections() {
        let topics = &[("2.1", "a"), ("2.1.4", "b"), ("7.1", "c")];
        let check = |section: &str, expected: &str| assert_eq!(topic(topics, section), expected, "{section}");
        check("2.1", "a");
        check("2.1.3.2", "a");
        check("2.1.4", "b");
        check("7.10.1", "");
        check("7.1.1", "c");
    }

    #[test]
    fn every_setting_is_complete_and_unique() {
        for model in MODELS {
            let settings = (model.guide.settings)();
            let ids: BTreeSet<_> = settings.iter().map(|it| it.id.as_str()).collect();
            assert_eq!(ids.len(), settings.len(), "{}", model.name);
            for it in &settings {
                let what = format!("{} {}", model.name, it.id);
                assert!(!it.group.is_empty(), "{what} is in no group");
                assert!(!it.name.is_empty() && !it.text.is_empty(), "{what} has no name or text");
                assert!(!it.section.is_empty(), "{what} has no section");
                assert!(it.readable || it.writable, "{what} is good for nothing");
                assert_eq!(it.range.is_some(), it.writable && !it.is_text, "{what}");
                assert!(it.range.is_none_or(|(low, high)| low <= high), "{what}");
                if let (Some((low, high)), Some(default)) = (it.range, it.default) {
                    assert!((low..=high).contains(&default), "{what}: {default}");
                }
                assert!(it.axis.is_none_or(|axis| model.guide.axes.contains(&axis)), "{what}");
            }
        }
    }

    #[test]
    fn every_list_is_in_order() {
        for model in MODELS {
            let guide = model.guide;
            assert!(guide.status_bits.is_sorted_by_key(|bit| bit.bit), "{}", model.name);
            assert!(guide.homing.is_sorted_by_key(|mode| mode.id), "{}", model.name);
            for (pin, low, high) in guide.analog {
                let found = guide.pins.iter().find(|it| it.name == *pin).expect(pin);
                let rest = f64::from(found.rest) / f64::from(found.scale);
                assert!(found.kind.is_analog() && (*low..=*high).contains(&rest), "{pin}");
            }
            for pin in guide.pins.iter().filter(|pin| pin.kind.is_analog()) {
                assert!(guide.analog.iter().any(|(name, ..)| *name == pin.name), "{}", pin.name);
            }
            let commands = (guide.commands)();
            assert!(commands.iter().all(|it| !it.syntax.is_empty() && !it.text.is_empty()), "{}", model.name);
        }
    }
}
