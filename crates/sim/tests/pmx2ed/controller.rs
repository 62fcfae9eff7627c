//! What the tests that both controllers share have to know of this one.

use ascript::dialect::{Dialect, PERFORMAX_2};
use motion::Ticks;

pub const MODEL: &str = "pmx-2ed";
pub const DIALECT: &Dialect = &PERFORMAX_2;
pub const AXES: [&str; 2] = ["X", "Y"];

/// Clocks a second.
pub const HZ: Ticks = 20_000_000;

/// Clocks of a millisecond.
pub const MS: Ticks = HZ / 1000;

/// The command that controls a program.
pub const CONTROL: &str = "SR";

/// Lets ramps down have a setting of their own.
pub const USE_DECELERATION: &str = "EDEC=1";

/// Clears an error of StepNLoop.
pub const CLEAR_LOOP: &str = "CLRSX";

/// Ways to home, and the status of StepNLoop meanwhile.
pub const HOMING: &[(&str, i32)] = &[("HX+", 6), ("HLX+", 6), ("ZX+", 7), ("ZHX+", 7), ("LX+", 13)];

/// The refusal while the axis moves.
pub const MOVING: &str = "?Moving";
/// The refusal in a state that forbids it.
pub const STATE: &str = "?State Error";
/// The refusal of a value out of range.
pub const VALUE: &str = "?Invalid Answer";
/// The refusal of a number in a name out of range.
pub const INDEX: &str = "?Index out of Range";
/// The refusal because of the state of a program.
pub const PROGRAM: &str = "?State Error";
/// The refusal in an error of StepNLoop.
pub const LOOP_ERROR: &str = "?Clear SNL Error";

/// Joysticks: the voltage at one end, usual settings, and those of quick ones.
pub const FULL_SCALE_MV: f64 = 5000.0;
pub const JOYSTICKS: &str = "JV1=5000 JV2=4000 JV3=100 JV4=10 JV5=500 JV6=0";
pub const QUICK_JOYSTICKS: &str = "JV1=5000 JV2=5000 JV3=100 JV4=100";

/// What an axis that follows its joystick is refused, and how.
pub const WHILE_FOLLOWING: (&[&str], &str) = (&["X100", "JX+", "HX-", "I0:0", "SLX=1"], STATE);

/// The bits of the status: the positive limit, and its error.
pub const POSITIVE_LIMIT: i32 = 0x90;

/// The axes with a bit follow their joysticks.
pub fn follow(mask: u8) -> String {
    match mask {
        0 => "JF".into(),
        3 => "JO".into(),
        _ => format!("JO={mask}"),
    }
}

/// Sets a soft limit of the joysticks.
pub fn soft_limit(place: u8, limit: i32) -> String {
    format!("JL{place}={limit}")
}

/// Motions of X, alone and with Y.
pub const MOTIONS: &[&str] = &["X0", "JX+", "HX-", "X10Y10"];

/// The bits of the status: errors of limits.
pub const LIMIT_ERRORS: i32 = 0x180;

/// A line of X and Y.
pub fn line(x: i32, y: i32) -> String {
    format!("I{x}:{y}")
}

/// Its address on RS-485.
pub const ADDRESS: &str = "00";
