//! What the tests that both controllers share have to know of this one.

use ascript::dialect::{COMMANDER, Dialect};
use motion::Ticks;

pub const MODEL: &str = "cmd-4cr";
pub const DIALECT: &Dialect = &COMMANDER;
pub const AXES: [&str; 4] = ["X", "Y", "Z", "U"];

/// Clocks a second.
pub const HZ: Ticks = 19_660_800;

/// The command that controls a program.
pub const CONTROL: &str = "SACTRL";

/// Ramps down have a setting of their own.
pub const USE_DECELERATION: &str = "";

/// Clears an error of StepNLoop.
pub const CLEAR_LOOP: &str = "CLRX";

/// Ways to home, by the home switch, the index and a limit, and the status of StepNLoop meanwhile.
pub const HOMING: &[(&str, i32)] = &[
    ("HX+0", 6),
    ("HX+1", 6),
    ("HX+9", 6),
    ("HX-2", 7),
    ("HX-3", 7),
    ("HX-4", 7),
    ("HX-5", 7),
    ("HX-10", 7),
    ("HX-11", 7),
    ("ZMOVEX+", 7),
    ("HX-6", 13),
    ("HX-7", 13),
    ("HX-8", 13),
    ("HX-12", 13),
];

/// The refusal while the axis moves.
pub const MOVING: &str = "?Error Moving";
/// The refusal in a state that forbids it.
pub const STATE: &str = "?Error Moving";
/// The refusal of a value out of range.
pub const VALUE: &str = "?Invalid Index";
/// The refusal of a number in a name out of range.
pub const INDEX: &str = "?Invalid Index";
/// The refusal because of the state of a program.
pub const PROGRAM: &str = "?Program Error";
/// The refusal in an error of StepNLoop.
pub const LOOP_ERROR: &str = "?Error SNL";

/// Joysticks: the voltage at one end, usual settings, and those of quick ones.
pub const FULL_SCALE_MV: f64 = 3300.0;
pub const JOYSTICKS: &str = "JSPDX=5000 JSPDY=4000 JDELX=100 JDELY=10 JTOLX=330 JTOLY=0";
pub const QUICK_JOYSTICKS: &str = "JSPDX=5000 JSPDY=5000 JDELX=100 JDELY=100";

/// What an axis that follows its joystick is refused, and how. Stops do not count (manual, 2.5.1.3).
pub const WHILE_FOLLOWING: (&[&str], &str) =
    (&["X100", "JX+", "HX-0", "X1Y1", "SLX=1", "STOPY", "ABORTX", "BO", "MPEX=1"], MOVING);

/// The bits of the status: the positive limit, and its error.
pub const POSITIVE_LIMIT: i32 = 0x110;

/// The axes with a bit follow their joysticks.
pub fn follow(mask: u8) -> String {
    format!("JENA={mask}")
}

/// Sets a soft limit of the joysticks.
pub fn soft_limit(place: u8, limit: i32) -> String {
    format!("JLIM{place}={limit}")
}

/// Motions of X, alone and with Y.
pub const MOTIONS: &[&str] = &["X0", "JX+", "HX-0", "X10Y10", "CIRXYP5:5"];

/// The bits of the status: errors of limits.
pub const LIMIT_ERRORS: i32 = 0x300;

/// A line of X and Y.
pub fn line(x: i32, y: i32) -> String {
    format!("X{x}Y{y}")
}

/// Its address on RS-485.
pub const ADDRESS: &str = "01";
