//! Mode 6: the limit, then back off it at low speed (appendix A.7).
//!
//! - A: from low speed up to high speed.
//! - B: at the limit the motor stops at once.
//! - C: back at low speed until the limit is off.
//! - D: there the motor stops at once, and there is zero.
//! - E: ERC pulse.

use crate::homing::Pace::{Fast, Slow};
use crate::homing::routine::Step::{self, Clear, Halt, Phase, Run, Until, Zero};
use crate::homing::routine::{Event::Limit, Occasion, Way::Back, Way::Onward};

pub const STEPS: &[Step] = &[
    Phase('A'),
    Run(Onward, Fast),
    Until(Limit(true)),
    Phase('B'),
    Halt,
    Clear(Occasion::Stop),
    Phase('C'),
    Run(Back, Slow),
    Until(Limit(false)),
    Phase('D'),
    Halt,
    Zero,
    Phase('E'),
    Clear(Occasion::Home),
];
