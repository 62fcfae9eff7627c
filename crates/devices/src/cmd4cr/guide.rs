//! The controller for people (manual, chapters 2 to 4 and appendix A).

use super::pins::{MAX_MV, PINS};
use super::table::{AXES, COMMANDS, Id};
use crate::guide::{BOTH, BitKind, Guide, HomingMode, Role, StatusBit, Topic, Units, VARIABLES, ascii};
use ::ascript::dialect::COMMANDER;
use BitKind::{Error, State, Switch};

/// The controller.
pub static GUIDE: Guide = Guide {
    axes: NAMES,
    pins: PINS,
    analog: &[
        ("AI1", 0.0, MAX_MV as f64),
        ("AI2", 0.0, MAX_MV as f64),
        ("PWM1", 0.0, 100.0),
        ("PWM2", 0.0, 100.0),
    ],
    units: Units { position: "pulses", speed: "pps", encoder: "counts" },
    programs: COMMANDER.threads,
    program_capacity: COMMANDER.lines,
    speed_windows: &motion::pps::COMMANDER,
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

const NAMES: &[&str] = &["X", "Y", "Z", "U"];

const fn bit(
    bit: u8,
    kind: BitKind,
    name: &'static str,
    text: &'static str,
    test: &'static str,
) -> StatusBit {
    StatusBit { bit, name, text, kind, test }
}

const CLEARED: &str = "errors_are_cleared_axis_by_axis";

/// Table 2-28.
pub static STATUS_BITS: [StatusBit; 20] = [
    bit(0, State, "accelerates", "The axis gets faster.", "the_status_word"),
    bit(1, State, "decelerates", "The axis gets slower.", "the_status_word"),
    bit(2, State, "constant speed", "The axis moves evenly.", "the_status_word"),
    bit(3, Switch, "alarm input", "The alarm of the driver is on.", "the_status_word"),
    bit(4, Switch, "positive limit input", "The positive limit is on.", "the_status_word"),
    bit(5, Switch, "negative limit input", "The negative limit is on.", "the_status_word"),
    bit(6, Switch, "home input", "The home switch is on.", "the_status_word"),
    bit(7, Switch, "slowdown input", "The slowdown switch is on.", "the_status_word"),
    bit(8, Error, "positive limit error", "The positive limit has stopped a motion.", CLEARED),
    bit(9, Error, "negative limit error", "The negative limit has stopped a motion.", CLEARED),
    bit(10, Error, "alarm error", "The alarm has stopped a motion.", CLEARED),
    bit(11, Switch, "in-position input", "The driver has followed all pulses.", "the_status_word"),
    bit(12, Switch, "error clear output", "The deflection counter is cleared.", "status_and_polarity"),
    bit(13, Switch, "Z index", "The index of the encoder is on.", "the_status_word"),
    bit(14, Switch, "external start input", "The input CSTA is on.", "the_status_word"),
    bit(15, Switch, "emergency stop input", "The input CEMG is on.", "the_status_word"),
    bit(16, Error, "emergency stop error", "An emergency stop has stopped the axis.", "emergency_stop"),
    bit(
        17,
        State,
        "stopped by the slowdown input",
        "The slowdown switch has stopped a motion.",
        "slowdown_inputs_that_stop",
    ),
    bit(18, State, "waits for the in-position input", "The driver has yet to follow.", "in_position_inputs"),
    bit(19, State, "waits for the external start", "A motion begins with CSTA.", "external_start"),
];

const fn mode(id: u8, section: &'static str, name: &'static str, text: &'static str) -> HomingMode {
    HomingMode { id, name, text, directions: BOTH, section, test: "homing_modes" }
}

/// The modes of appendix A.
pub static HOMING: [HomingMode; 13] = [
    mode(0, "A.1", "home; decelerates", "Zero is the edge of the home switch; the motor brakes behind it."),
    mode(
        1,
        "A.2",
        "home; back and again at low speed",
        "Brakes behind the home switch, goes back off it, and slowly on to its edge, which is zero.",
    ),
    mode(2, "A.3", "home, then index at low speed", "Brakes from the home switch on; zero is the index."),
    mode(
        3,
        "A.4",
        "home, then index at high speed",
        "Zero is the index behind the home switch; the motor brakes behind it.",
    ),
    mode(
        4,
        "A.5",
        "home, then index on the way back at low speed",
        "Turns at the home switch and goes slowly to the index, which is zero.",
    ),
    mode(
        5,
        "A.6",
        "home, then index on the way back at high speed",
        "Turns at the home switch; zero is the index, behind which the motor brakes.",
    ),
    mode(6, "A.7", "limit; off it at low speed", "Turns at the limit; zero is where that goes off."),
    mode(
        7,
        "A.8",
        "limit, then index on the way back at low speed",
        "Turns at the limit and goes slowly to the index, which is zero.",
    ),
    mode(
        8,
        "A.9",
        "limit, then index on the way back at high speed",
        "Turns at the limit; zero is the index, behind which the motor brakes.",
    ),
    mode(9, "A.10", "as 0, and back to zero", "As mode 0; then the motor goes fast to zero."),
    mode(10, "A.11", "as 3, and back to zero", "As mode 3; then the motor goes fast to zero."),
    mode(11, "A.12", "as 5, and back to zero", "As mode 5; then the motor goes fast to zero."),
    mode(12, "A.13", "as 8, and back to zero", "As mode 8; then the motor goes fast to zero."),
];

const ROLES: &[(Id, Role)] = &[
    (Id::HighSpeed, Role::HighSpeed),
    (Id::LowSpeed, Role::LowSpeed),
    (Id::Acceleration, Role::Acceleration),
    (Id::Deceleration, Role::Deceleration),
    (Id::PulserEnable, Role::PulserEnable),
    (Id::SCurve, Role::SCurve),
    (Id::SpeedMode, Role::SpeedWindow),
    (Id::Loop, Role::ClosedLoop),
    (Id::LoopRatio, Role::ClosedLoopRatio),
];

const TOPICS: &[Topic] = &[
    ("2.1.1", "Status"),
    ("2.1.3.1", "Safety and start"),
    ("2.1.3.2.1", "Inputs and latches"),
    ("2.1.3.2.2", "Outputs and synchronisation"),
    ("2.1.3.3", "Inputs and outputs"),
    ("2.1.4", "Speeds and ramps"),
    ("2.1.5", "Power-up"),
    ("2.1.6", "Drivers and polarity"),
    ("2.2.1", "Motor power"),
    ("2.2.4", "Status"),
    ("2.2.5", "Homing"),
    ("2.3", "Interpolation"),
    ("2.4", "Speeds and ramps"),
    ("2.5.1", "Joystick"),
    ("2.5.2", "Manual pulse generator"),
    ("2.5.3", "StepNLoop"),
    ("2.6.1", "Positions"),
    ("2.6.2", "Status"),
    ("2.7", "Programs"),
    ("2.7.6", VARIABLES),
    ("3.2", "Communication"),
    ("3.3", "Communication"),
];
