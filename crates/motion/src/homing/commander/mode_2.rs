//! Mode 2: the home input, then the index at low speed (appendix A.3).
//!
//! - A: from low speed up to high speed.
//! - B, C: at the home edge down to low speed, in search of the index; marks count once the motor is down.
//! - D: at the last mark the motor stops at once, and there is zero.
//! - E: ERC pulse.

use crate::homing::Pace::{Fast, Slow};
use crate::homing::routine::Step::{self, Clear, Halt, Phase, Run, Until, Zero};
use crate::homing::routine::{Event::HomeEdge, Event::Index, Occasion, Way::Onward};

pub const STEPS: &[Step] = &[
    Phase('A'),
    Run(Onward, Fast),
    Until(HomeEdge),
    Phase('C'),
    Run(Onward, Slow),
    Until(Index),
    Phase('D'),
    Halt,
    Zero,
    Phase('E'),
    Clear(Occasion::Home),
];
