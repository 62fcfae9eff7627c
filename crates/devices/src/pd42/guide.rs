//! The module for people (manual, chapters 3 to 5 and 7).

extern crate alloc;

use super::pins::PINS;
use super::{ap, global_parameters as gp};
use crate::guide::tmcl::{self, Kind, Ranges};
use crate::guide::{self, BitKind, Guide, HomingMode, Role, Setting, StatusBit, Units};
use ::tmcl::isa::{PROGRAM_LENGTH, VARIABLES};
use BitKind::{Error, State, Switch};
use alloc::{format, vec::Vec};
use motion::Direction::{self, Negative, Positive};

/// The module.
pub static GUIDE: Guide = Guide {
    axes: AXES,
    pins: PINS,
    analog: &[("AIN0", 0.0, 4095.0), ("SUPPLY", 0.0, 60.0), ("TEMPERATURE", -40.0, 150.0)],
    units: Units { position: "µsteps", speed: "int", encoder: "µsteps" },
    programs: 1,
    program_capacity: PROGRAM_LENGTH as u16,
    speed_windows: &[],
    status_bits: &STATUS_BITS,
    homing: HOMING,
    settings,
    commands: tmcl::commands,
};

/// The names of the axes.
pub const AXES: &[&str] = &["0"];

const fn bit(
    bit: u8,
    kind: BitKind,
    name: &'static str,
    text: &'static str,
    test: &'static str,
) -> StatusBit {
    StatusBit { bit, name, text, kind, test }
}

/// The module has no status word on the wire: these are parameters 3, 8 to 11 and 207, and the reference search.
pub static STATUS_BITS: [StatusBit; 8] = [
    bit(0, State, "moving", "The motor turns.", "rotating_left_and_right"),
    bit(1, State, "target reached", "Actual and target position are equal.", "ap_8_position_reached"),
    bit(2, Switch, "left stop switch", "The left stop switch is on.", "ap_10_and_11_stop_switches"),
    bit(3, Switch, "right stop switch", "The right stop switch is on.", "ap_10_and_11_stop_switches"),
    bit(4, Switch, "home switch", "The home switch is on.", "ap_9_home_switch"),
    bit(5, Error, "stall", "A stall has stopped the motor.", "ap_207_extended_errors"),
    bit(6, Error, "deviation", "The encoder deviated too far.", "ap_207_extended_errors"),
    bit(7, State, "reference search", "A reference search runs.", "reference_search_commands"),
];

const fn mode(
    id: u8,
    section: &'static str,
    directions: &'static [Direction],
    name: &'static str,
    text: &'static str,
) -> HomingMode {
    HomingMode { id, name, text, directions, section, test: "ap_193_reference_search_modes" }
}

/// The end switch that counts is at the end of the direction.
const EITHER: &[Direction] = guide::BOTH;
const LEFT: &[Direction] = &[Negative];
const RIGHT: &[Direction] = &[Positive];

/// The modes of parameter 193. Modes 1 to 4 have 64 more in positive direction; those from 133 on are 5 to 8 with
/// an inverted home switch.
const HOMING: &[HomingMode] = &[
    mode(1, "7.1.1", EITHER, "end switch", "Zero is where the end switch comes on."),
    mode(
        2,
        "7.1.2",
        EITHER,
        "other end switch, then end switch",
        "Measures the way between the end switches.",
    ),
    mode(
        3,
        "7.1.3",
        EITHER,
        "other end switch, then both sides of end switch",
        "Measures the way, too; zero is the middle of where the end switch comes on and goes off.",
    ),
    mode(
        4,
        "7.1.4",
        EITHER,
        "both sides of end switch",
        "Zero is the middle of where it comes on and goes off.",
    ),
    mode(5, "7.1.5", LEFT, "home switch, turning at the left end", "Zero is the middle of the home switch."),
    mode(
        6,
        "7.1.6",
        RIGHT,
        "home switch, turning at the right end",
        "Zero is the middle of the home switch.",
    ),
    mode(7, "7.1.7", LEFT, "home switch", "Passes end switches; zero is the middle of the home switch."),
    mode(8, "7.1.8", RIGHT, "home switch", "Passes end switches; zero is the middle of the home switch."),
    mode(133, "7.1.5", LEFT, "inverted home switch, turning at the left end", "As mode 5."),
    mode(134, "7.1.6", RIGHT, "inverted home switch, turning at the right end", "As mode 6."),
    mode(135, "7.1.7", LEFT, "inverted home switch", "As mode 7."),
    mode(136, "7.1.8", RIGHT, "inverted home switch", "As mode 8."),
];

const AXIS_GROUPS: Ranges = &[
    (11, "Motion"),
    (13, "Ramps and switches"),
    (135, "Motion"),
    (154, "Ramps and switches"),
    (167, "Driver"),
    (174, "CoolStep and StallGuard"),
    (180, "Driver"),
    (183, "CoolStep and StallGuard"),
    (184, "Driver"),
    (197, "Reference search"),
    (200, "Driver"),
    (204, "Encoders and errors"),
    (u8::MAX, "Encoders and errors"),
];

const MODULE_GROUPS: Ranges = &[
    (76, "Interfaces"),
    (77, "Program"),
    (79, "Machine"),
    (81, "Program"),
    (83, "Interfaces"),
    (85, "Program"),
    (87, "Interfaces"),
    (90, "Machine"),
    (133, "Program"),
    (u8::MAX, "Interfaces"),
];

fn settings() -> Vec<Setting> {
    let axes = Kind {
        table: ap::TABLE,
        groups: AXIS_GROUPS,
        section: "4",
        axis: Some(AXES[0]),
        id: &|number| format!("AP{number}.0"),
        touchy: &[ap::EXTENDED_ERRORS],
        states: &[
            ap::TARGET_POSITION,
            ap::ACTUAL_POSITION,
            ap::TARGET_SPEED,
            ap::RAMP_MODE,
            ap::ENCODER_POSITION,
            ap::EXTERNAL_ENCODER,
        ],
        roles: &[
            (ap::MAX_SPEED, Role::HighSpeed),
            (ap::MAX_ACCELERATION, Role::Acceleration),
            (ap::MICROSTEPS, Role::Microsteps),
            (ap::RAMP_DIVISOR, Role::RampDivisor),
            (ap::PULSE_DIVISOR, Role::PulseDivisor),
        ],
    };
    let module = Kind {
        table: gp::module::TABLE,
        groups: MODULE_GROUPS,
        section: "5.1",
        axis: None,
        id: &|number| format!("GP{number}"),
        touchy: &[gp::module::RANDOM],
        states: &[gp::module::TICK_TIMER],
        roles: &[],
    };
    let interrupts = Kind {
        table: gp::interrupts::TABLE,
        groups: &[(u8::MAX, "Interrupts")],
        section: "5.4",
        id: &|number| format!("GP{number}.3"),
        touchy: &[],
        states: &[],
        ..module
    };
    let variables = (0..VARIABLES).map(variable);
    [axes, module, interrupts].iter().flat_map(tmcl::settings).chain(variables).collect()
}

/// A user variable (manual, table 19).
fn variable(number: usize) -> Setting {
    Setting {
        id: format!("GP{number}.2"),
        group: guide::VARIABLES,
        axis: None,
        name: format!("User variable {number}"),
        symbol: format!("V{number}"),
        unit: "",
        text: "Variable of programs.",
        section: "5.3",
        range: Some((i32::MIN.into(), i32::MAX.into())),
        default: Some(0),
        decimals: 0,
        readable: true,
        writable: true,
        stored: number < gp::STORABLE_VARIABLES.into(),
        stores_itself: false,
        is_text: false,
        is_touchy: false,
        role: None,
        is_setting: true,
    }
}
