//! What a fault waits for.

use super::{Framing, MAX_SECONDS, Parts, Wrong};
use crate::{config::MAX_PULSES, tape::PortName};
use devices::Port;
use serde::{Deserialize, Serialize};

/// How often a device looks, a second, for what nobody tells it of: pins that the controller drives, and axes that
/// start and stop. No command of a program takes less time than passes between two looks.
pub const LOOKS_PER_SECOND: u64 = 20_000;

/// What begins a fault. It happens once: the first time after the fault was planned.
#[derive(Clone, Debug, PartialEq)]
pub enum Trigger {
    /// So many seconds pass.
    At(f64),
    /// A digital pin changes.
    Pin {
        /// The pin.
        pin: String,
        /// To this level; `None` is any change.
        value: Option<bool>,
    },
    /// An axis arrives at a position or passes it.
    Position {
        /// The axis.
        axis: String,
        /// Where its driven side is then, in the unit of [`AxisConfig`](crate::AxisConfig).
        position: i64,
    },
    /// An axis starts or stops.
    Motion {
        /// The axis.
        axis: String,
        /// Which of both.
        motion: Motion,
    },
    /// A program comes to an address: it has not executed what is there.
    Address {
        /// The program; `None` is any.
        program: Option<u8>,
        /// The address of a TMCL command, the number of a compiled line of A-SCRIPT.
        address: u32,
    },
    /// A message begins to arrive at the controller: nine bytes of TMCL, a line of ASCII, a CAN frame.
    Message {
        /// Which one, from 1.
        number: u64,
        /// The port; `None` is any.
        port: Option<PortName>,
    },
}

/// What an axis does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Motion {
    /// It puts out pulses.
    Starts,
    /// It puts out no more.
    Stops,
}

/// A place in the source of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place<'a> {
    /// A line, from 1.
    Line(u32),
    /// A label.
    Label(&'a str),
}

/// An event as files and requests say it.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct On {
    /// A pin, by its name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pin: Option<String>,
    /// The level that it gets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<bool>,
    /// An axis, by its name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis: Option<String>,
    /// Where it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position: Option<i64>,
    /// What it does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<Motion>,
    /// A program, by its number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub program: Option<u8>,
    /// Where it is in the controller's memory.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub address: Option<u32>,
    /// Where it is in its source, from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line: Option<u32>,
    /// The same by a label.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// The number of a message, from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub message: Option<u64>,
    /// The port that it comes to.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub port: Option<PortName>,
}

/// What there is to know about a kind of events.
pub struct TriggerRow {
    /// The keys that it must have.
    pub needs: &'static [&'static str],
    /// The keys that it may have.
    pub may: &'static [&'static str],
    /// When it happens, for people.
    pub text: &'static str,
}

/// The kinds of events.
pub const TRIGGERS: &[TriggerRow] = &[
    TriggerRow {
        needs: &["pin"],
        may: &["value"],
        text: "The digital pin changes, to this level or to any.",
    },
    TriggerRow {
        needs: &["axis", "position"],
        may: &[],
        text: "The driven side of the axis arrives at the position, or passes it.",
    },
    TriggerRow { needs: &["axis", "motion"], may: &[], text: "The axis `starts` or `stops`." },
    TriggerRow {
        needs: &["address"],
        may: &["program"],
        text: "A program comes to the address of a TMCL command, or to the number of a compiled line: before it is executed.",
    },
    TriggerRow {
        needs: &["line"],
        may: &["program"],
        text: "It comes to the first command of a line of its source. Only where the source is known, in `run`.",
    },
    TriggerRow { needs: &["label"], may: &["program"], text: "It comes to a label. Only in `run`." },
    TriggerRow {
        needs: &["message"],
        may: &["port"],
        text: "The message of this number, from 1, begins to arrive: a frame of nine bytes, a line, a CAN frame.",
    },
];

impl On {
    fn given(&self) -> impl Iterator<Item = &'static str> {
        let keys = [
            ("pin", self.pin.is_some()),
            ("value", self.value.is_some()),
            ("axis", self.axis.is_some()),
            ("position", self.position.is_some()),
            ("motion", self.motion.is_some()),
            ("program", self.program.is_some()),
            ("address", self.address.is_some()),
            ("line", self.line.is_some()),
            ("label", self.label.is_some()),
            ("message", self.message.is_some()),
            ("port", self.port.is_some()),
        ];
        keys.into_iter().filter_map(|(key, given)| given.then_some(key))
    }

    /// Whether it says one thing, and what it could say if not.
    fn check(&self) -> Result<(), Wrong> {
        let given: Vec<_> = self.given().collect();
        let fits = |row: &&TriggerRow| {
            row.needs.iter().all(|key| given.contains(key))
                && given.iter().all(|key| row.needs.contains(key) || row.may.contains(key))
        };
        if TRIGGERS.iter().any(|row| fits(&row)) {
            return Ok(());
        }
        let forms: Vec<_> = TRIGGERS
            .iter()
            .map(|row| {
                let may: String = row.may.iter().map(|key| format!(" ({key})")).collect();
                row.needs.join(" and ") + &may
            })
            .collect();
        Err(Wrong::new("on", format!("an event is one of: {}", forms.join("; "))))
    }
}

impl Trigger {
    /// The event that is meant, at a device.
    pub(super) fn of(
        on: &On,
        parts: &Parts,
        find: &dyn Fn(&Place) -> Result<u32, String>,
    ) -> Result<Self, Wrong> {
        on.check()?;
        let inside = |problem: Wrong| Wrong::new("on", problem.to_string());
        if let Some(pin) = &on.pin {
            let number = parts.pin(pin).map_err(inside)?;
            if parts.pins[number].kind.is_analog() {
                return Err(Wrong::new("on", format!("pin: `{pin}` is analog, and changes all the time")));
            }
            return Ok(Self::Pin { pin: pin.clone(), value: on.value });
        }
        if let Some(number) = on.message {
            if number == 0 {
                return Err(Wrong::new("on", "message: the first one is 1"));
            }
            return Ok(Self::Message { number, port: on.port });
        }
        if let Some(axis) = &on.axis {
            parts.axis(axis).map_err(inside)?;
            return match (on.position, on.motion) {
                (Some(position), _) if !(-MAX_PULSES..=MAX_PULSES).contains(&position) => {
                    let range = format!("-{MAX_PULSES} to {MAX_PULSES} pulses");
                    Err(Wrong::new("on", format!("position: {position} is outside {range}")))
                }
                (Some(position), _) => Ok(Self::Position { axis: axis.clone(), position }),
                (None, motion) => {
                    let motion = motion.expect("an axis has a position or a motion");
                    Ok(Self::Motion { axis: axis.clone(), motion })
                }
            };
        }
        let place = on.line.map(Place::Line).or(on.label.as_deref().map(Place::Label));
        let found = place.map(|place| find(&place)).transpose();
        let address = found.map_err(|problem| Wrong::new("on", problem))?.or(on.address);
        Ok(Self::Address { program: on.program, address: address.expect("an event has one of its keys") })
    }
}

impl From<&Trigger> for On {
    fn from(trigger: &Trigger) -> Self {
        let on = Self::default();
        match trigger.clone() {
            Trigger::At(_) => on,
            Trigger::Pin { pin, value } => Self { pin: Some(pin), value, ..on },
            Trigger::Position { axis, position } => Self { axis: Some(axis), position: Some(position), ..on },
            Trigger::Motion { axis, motion } => Self { axis: Some(axis), motion: Some(motion), ..on },
            Trigger::Address { program, address } => Self { program, address: Some(address), ..on },
            Trigger::Message { number, port } => Self { message: Some(number), port, ..on },
        }
    }
}

/// Counts messages.
#[derive(Clone, Debug)]
pub(crate) struct Counter {
    framing: Framing,
    port: Option<Port>,
    left: u64,
    /// Bytes of the message that is on its way at each port.
    open: [u8; 3],
}

/// Bytes of a message of TMCL.
const TMCL_BYTES: u8 = 9;

impl Counter {
    pub fn new(framing: Framing, port: Option<Port>, number: u64) -> Self {
        Self { framing, port, left: number, open: [0; 3] }
    }

    /// A byte of a chunk comes. Whether the message that is counted for begins with it.
    pub fn hear(&mut self, port: Port, first_of_chunk: bool, byte: u8) -> bool {
        let open = &mut self.open[port as usize];
        let begins = match (port, self.framing) {
            (Port::Can, _) => first_of_chunk,
            (_, Framing::Tmcl) => {
                let begins = *open == 0;
                *open = (*open + 1) % TMCL_BYTES;
                begins
            }
            (_, Framing::Lines) => {
                let goes_on = !matches!(byte, b'\r' | b'\n' | 0);
                std::mem::replace(open, u8::from(goes_on)) == 0 && goes_on
            }
        };
        if !begins || self.port.is_some_and(|other| other != port) {
            return false;
        }
        self.left -= 1;
        self.left == 0
    }

    /// What was on its way is forgotten.
    pub fn hang_up(&mut self, port: Port) {
        self.open[port as usize] = 0;
    }
}

/// The clock of the next look after `now`.
pub(crate) fn next_look(now: u64, clock_hz: u32) -> u64 {
    let hz = u128::from(clock_hz);
    let looks = u128::from(LOOKS_PER_SECOND);
    let at = |look: u128| (look * hz / looks) as u64;
    let look = u128::from(now) * looks / hz;
    (look..).map(at).find(|clock| *clock > now).unwrap_or(u64::MAX)
}

/// Seconds as clocks, rounded to the nearest.
pub(crate) fn clocks(seconds: f64, clock_hz: u32) -> u64 {
    debug_assert!((0.0..=MAX_SECONDS).contains(&seconds));
    (seconds * f64::from(clock_hz)).round() as u64
}
