//! The controller for people (manual, chapters 6, 7 and 9).

use super::pins::{MAX_MV, PINS};
use super::table::{AXES, COMMANDS, Id};
use crate::guide::{BOTH, BitKind, Guide, HomingMode, Role, StatusBit, Topic, Units, VARIABLES, ascii};
use ::ascript::dialect::PERFORMAX_2;
use BitKind::{Error, State, Switch};

/// The controller.
pub static GUIDE: Guide = Guide {
    axes: NAMES,
    pins: PINS,
    analog: &[("AI1", 0.0, MAX_MV as f64), ("AI2", 0.0, MAX_MV as f64)],
    units: Units { position: "pulses", speed: "pps", encoder: "counts" },
    programs: PERFORMAX_2.threads,
    program_capacity: PERFORMAX_2.lines,
    speed_windows: &motion::pps::PERFORMAX,
    status_bits: &STATUS_BITS,
    homing: &HOMING,
    settings: || {
        ascii::settings(&ascii::Kind {
            table: COMMANDS,
            names: NAMES,
            lines: Id::ProgramLine,
            topics: TOPICS,
            roles: ROLES,
        })
    },
    commands: || ascii::commands(COMMANDS, AXES),
};

const NAMES: &[&str] = &["X", "Y"];

const fn bit(
    bit: u8,
    kind: BitKind,
    name: &'static str,
    text: &'static str,
    test: &'static str,
) -> StatusBit {
    StatusBit { bit, name, text, kind, test }
}

/// Table 7.2.
pub static STATUS_BITS: [StatusBit; 11] = [
    bit(0, State, "accelerates", "The axis gets faster.", "the_status_word"),
    bit(1, State, "decelerates", "The axis gets slower.", "the_status_word"),
    bit(2, State, "constant speed", "The axis moves evenly.", "the_status_word"),
    bit(4, Switch, "plus limit input", "The positive limit is on.", "limits_latch_errors"),
    bit(5, Switch, "minus limit input", "The negative limit is on.", "limits_latch_errors"),
    bit(6, Switch, "home input", "The home switch is on.", "the_status_word"),
    bit(7, Error, "plus limit error", "The positive limit has stopped a motion.", "limits_latch_errors"),
    bit(8, Error, "minus limit error", "The negative limit has stopped a motion.", "limits_latch_errors"),
    bit(9, Switch, "Z index", "The index of the encoder is on.", "the_status_word"),
    bit(10, State, "joystick control", "The joystick moves the axis.", "joystick_control"),
    bit(
        11,
        Error,
        "communication time-out",
        "No command came for longer than TOC.",
        "communication_time_out",
    ),
];

const fn mode(
    id: u8,
    section: &'static str,
    name: &'static str,
    text: &'static str,
    test: &'static str,
) -> HomingMode {
    HomingMode { id, name, text, directions: BOTH, section, test }
}

/// Section 7.10, in its order: `H`, `L`, `ZH`, `Z`, `HL`.
pub static HOMING: [HomingMode; 5] = [
    mode(
        0,
        "7.10.1",
        "home input, high speed",
        "H: zero is the edge of the home switch; the motor brakes behind it.",
        "homing_at_high_speed",
    ),
    mode(1, "7.10.2", "limit", "L: zero is LCA pulses away from the limit.", "homing_by_a_limit"),
    mode(
        2,
        "7.10.3",
        "home input and Z index",
        "ZH: to the home switch, then slowly to the index, which is zero.",
        "homing_by_home_and_index",
    ),
    mode(3, "7.10.4", "Z index", "Z: slowly to the index, which is zero.", "homing_by_the_index"),
    mode(
        4,
        "7.10.5",
        "home input, high and low speed",
        "HL: to the home switch, HCA pulses back, and slowly to it again.",
        "homing_high_and_low_speed",
    ),
];

const ROLES: &[(Id, Role)] = &[
    (Id::HighSpeed, Role::HighSpeed),
    (Id::LowSpeed, Role::LowSpeed),
    (Id::Acceleration, Role::Acceleration),
    (Id::Deceleration, Role::Deceleration),
    (Id::OwnDeceleration, Role::OwnDeceleration),
    (Id::SCurve, Role::SCurve),
    (Id::SpeedMode, Role::SpeedWindow),
    (Id::Loop, Role::ClosedLoop),
    (Id::LoopRatio, Role::ClosedLoopRatio),
];

const TOPICS: &[Topic] = &[
    ("6.2", "Communication"),
    ("6.3", "Communication"),
    ("7.1", "Speeds and ramps"),
    ("7.2", "Status"),
    ("7.3", "Speeds and ramps"),
    ("7.4", "Positions"),
    ("7.5", "Motor power"),
    ("7.10", "Homing and limits"),
    ("7.11", "Homing and limits"),
    ("8.1.11", "Homing and limits"),
    ("7.12", "Status"),
    ("7.13", "Inputs and outputs"),
    ("7.14", "Inputs and outputs"),
    ("7.15", "Joystick"),
    ("7.16", "Polarity"),
    ("7.17", "StepNLoop"),
    ("7.18", "Communication"),
    ("7.19", "Programs"),
    ("7.19.6", VARIABLES),
    ("7.8", "Status"),
    ("9.1", "Status"),
];
