//! What a model can do, as data for the page. Everything in it comes from the tables of the device.

use super::role::Role;
use devices::{
    Language, Model, Pin, PinKind, Wiring,
    guide::{self, BitKind, Setting, Usage},
};
use motion::{Direction, pps::Window};
use serde::Serialize;
use ts_rs::TS;
use utoipa::ToSchema;

/// A model.
#[derive(Debug, Serialize, TS, ToSchema)]
pub(crate) struct Catalog {
    /// Its name.
    pub model: &'static str,
    /// Its maker's name and what it is.
    pub title: &'static str,
    /// What its programs are written in.
    #[ts(type = "\"tmcl\" | \"a-script\"")]
    pub language: &'static str,
    /// The names of its axes.
    pub axes: &'static [&'static str],
    /// What it counts in.
    pub units: Units,
    /// How many standalone programs run at once.
    pub programs: u8,
    /// How many lines or commands its programs can have together.
    pub program_capacity: u16,
    /// Its table of speeds; empty if it does not count in pulses a second.
    pub speed_windows: Vec<SpeedWindow>,
    /// The ways of homing.
    pub homing: Vec<HomingMode>,
    /// The bits of an axis' status.
    pub status_bits: Vec<StatusBit>,
    /// The kinds of actions that it knows.
    pub actions: &'static [&'static str],
    /// Its parameters, one an axis or index.
    pub parameters: Vec<ParameterInfo>,
    /// Its commands.
    pub commands: Vec<CommandInfo>,
    /// Its pins.
    pub pins: Vec<PinInfo>,
}

/// What a model counts in.
#[derive(Debug, Serialize, TS, ToSchema)]
pub(crate) struct Units {
    /// Positions.
    pub position: &'static str,
    /// Speeds.
    pub speed: &'static str,
    /// Encoder positions.
    pub encoder: &'static str,
}

/// A row of a table of speeds.
#[derive(Debug, Serialize, TS, ToSchema)]
pub(crate) struct SpeedWindow {
    /// Its number in SSPDM.
    pub number: u8,
    /// The lowest high speed, in pulses a second.
    pub from_pps: u32,
    /// The highest one.
    pub to_pps: u32,
    /// The least low speed.
    pub least_low_pps: u32,
    /// Speeds are multiples of this.
    pub step_pps: u32,
    /// The shortest ramp, in milliseconds.
    pub least_ms: u32,
    /// The gentlest acceleration, in pulses a second each second.
    pub delta: u32,
}

/// A way of homing.
#[derive(Debug, Serialize, TS, ToSchema)]
pub(crate) struct HomingMode {
    /// Its number, for the action `home`.
    pub id: u8,
    /// What it is called.
    pub name: &'static str,
    /// What it does.
    pub text: &'static str,
    /// The directions in which it can be started.
    #[ts(type = "(\"+\" | \"-\")[]")]
    pub directions: Vec<&'static str>,
    /// The manual's section.
    pub section: &'static str,
}

/// A bit of an axis' status.
#[derive(Debug, Serialize, TS, ToSchema)]
pub(crate) struct StatusBit {
    /// Which one, from 0.
    pub bit: u8,
    /// What it is called.
    pub name: &'static str,
    /// When it is 1.
    pub text: &'static str,
    /// What it says.
    #[ts(type = "\"state\" | \"switch\" | \"error\"")]
    pub kind: &'static str,
}

/// A parameter.
#[derive(Debug, Serialize, TS, ToSchema)]
pub(crate) struct ParameterInfo {
    /// What the calls know it by.
    pub id: String,
    /// What it has to do with.
    pub group: &'static str,
    /// The axis that it belongs to.
    pub axis: Option<&'static str>,
    /// Its name in words.
    pub name: String,
    /// Its name in programs.
    pub symbol: String,
    /// Unit of its value.
    pub unit: &'static str,
    /// What it does.
    pub text: &'static str,
    /// The manual's section.
    pub section: &'static str,
    /// The least value that can be set.
    pub low: Option<f64>,
    /// The greatest one.
    pub high: Option<f64>,
    /// From the factory.
    pub default: Option<f64>,
    /// Digits after the point.
    pub decimals: u8,
    /// Whether it can be read.
    pub readable: bool,
    /// Whether it can be set.
    pub writable: bool,
    /// Whether it can outlive the power.
    pub stored: bool,
    /// Whether it is text.
    pub is_text: bool,
    /// What it is for, where other models have the same under other names.
    pub role: Option<Role>,
    /// Whether it can be kept in a file and given back later: no position, output or timer, which would do something.
    pub is_setting: bool,
}

/// A command.
#[derive(Debug, Serialize, TS, ToSchema)]
pub(crate) struct CommandInfo {
    /// What it begins with.
    pub name: String,
    /// Its form.
    pub syntax: String,
    /// What it does.
    pub text: &'static str,
    /// A line of it.
    pub example: &'static str,
    /// The manual's section.
    pub section: &'static str,
    /// Unit of its value.
    pub unit: &'static str,
}

/// A pin.
#[derive(Debug, Serialize, TS, ToSchema)]
pub(crate) struct PinInfo {
    /// Its name.
    pub name: &'static str,
    /// Direction and kind.
    #[ts(type = "\"input\" | \"output\" | \"port\" | \"analog\" | \"analog_output\" | \"index\"")]
    pub kind: &'static str,
    /// The axis that it belongs to.
    pub axis: Option<&'static str>,
    /// What usually hangs on it; empty for nothing in particular.
    pub role: &'static str,
    /// What its number means.
    pub unit: &'static str,
    /// The least number on it.
    pub low: Option<f64>,
    /// The greatest one.
    pub high: Option<f64>,
}

impl Catalog {
    /// Of a model.
    pub fn of(model: &'static Model) -> Self {
        let guide = model.guide;
        let units = guide.units;
        Self {
            model: model.name,
            title: model.title,
            language: match model.language {
                Language::Tmcl => "tmcl",
                Language::Ascript(_) => "a-script",
            },
            axes: guide.axes,
            units: Units { position: units.position, speed: units.speed, encoder: units.encoder },
            programs: guide.programs,
            program_capacity: guide.program_capacity,
            speed_windows: guide.speed_windows.iter().map(Into::into).collect(),
            homing: guide.homing.iter().map(Into::into).collect(),
            status_bits: guide.status_bits.iter().map(Into::into).collect(),
            actions: model.name.parse().map(host::Model::actions).unwrap_or_default(),
            parameters: (guide.settings)().into_iter().map(Into::into).collect(),
            commands: (guide.commands)().into_iter().map(Into::into).collect(),
            pins: guide.pins.iter().map(|pin| PinInfo::of(pin, guide)).collect(),
        }
    }
}

impl From<&Window> for SpeedWindow {
    fn from(window: &Window) -> Self {
        let Window { number, from_pps, to_pps, least_low_pps, step_pps, least_ms, delta } = *window;
        Self { number, from_pps, to_pps, least_low_pps, step_pps, least_ms, delta }
    }
}

impl From<&guide::HomingMode> for HomingMode {
    fn from(mode: &guide::HomingMode) -> Self {
        let sign = |way: &Direction| if *way == Direction::Positive { "+" } else { "-" };
        Self {
            id: mode.id,
            name: mode.name,
            text: mode.text,
            directions: mode.directions.iter().map(sign).collect(),
            section: mode.section,
        }
    }
}

impl From<&guide::StatusBit> for StatusBit {
    fn from(bit: &guide::StatusBit) -> Self {
        let kind = match bit.kind {
            BitKind::State => "state",
            BitKind::Switch => "switch",
            BitKind::Error => "error",
        };
        Self { bit: bit.bit, name: bit.name, text: bit.text, kind }
    }
}

impl From<Setting> for ParameterInfo {
    fn from(it: Setting) -> Self {
        // The tables count without the point.
        let with_point = |number: i64| number as f64 / 10_f64.powi(it.decimals.into());
        Self {
            group: it.group,
            axis: it.axis,
            unit: it.unit,
            text: it.text,
            section: it.section,
            low: it.range.map(|(low, _)| with_point(low)),
            high: it.range.map(|(_, high)| with_point(high)),
            default: it.default.map(with_point),
            decimals: it.decimals,
            readable: it.readable,
            writable: it.writable,
            stored: it.stored,
            is_text: it.is_text,
            role: it.role.map(Into::into),
            is_setting: it.is_setting,
            id: it.id,
            name: it.name,
            symbol: it.symbol,
        }
    }
}

impl From<Usage> for CommandInfo {
    fn from(it: Usage) -> Self {
        let Usage { name, syntax, text, example, section, unit } = it;
        Self { name, syntax, text, example, section, unit }
    }
}

impl PinInfo {
    fn of(pin: &Pin, guide: &guide::Guide) -> Self {
        let kind = match pin.kind {
            PinKind::Input => "input",
            PinKind::Output => "output",
            PinKind::Port => "port",
            PinKind::Analog => "analog",
            PinKind::AnalogOutput => "analog_output",
            PinKind::Index(_) => "index",
        };
        let (role, axis) = match pin.wiring {
            Wiring::Free => ("", None),
            Wiring::NegativeLimit(axis) => ("negative limit", Some(axis)),
            Wiring::PositiveLimit(axis) => ("positive limit", Some(axis)),
            Wiring::Home(axis) => ("home", Some(axis)),
            Wiring::Index(axis) => ("index", Some(axis)),
            Wiring::Slowdown(axis) => ("slowdown", Some(axis)),
            Wiring::Joystick(axis) => ("joystick", Some(axis)),
            Wiring::InPosition(axis) => ("in position", Some(axis)),
            Wiring::Supply => ("supply", None),
            Wiring::Temperature => ("temperature", None),
        };
        let range = guide.analog.iter().find(|(name, ..)| *name == pin.name);
        Self {
            name: pin.name,
            kind,
            axis: axis.and_then(|axis| guide.axes.get(axis).copied()),
            role,
            unit: pin.unit,
            low: range.map(|(_, low, _)| *low),
            high: range.map(|(.., high)| *high),
        }
    }
}
