//! `ZH`: the home input, then the index (section 7.10.3).
//!
//! - A: from low speed up to high speed.
//! - B, C: at the home edge down to low speed, in search of the index; marks count once the motor is down.
//! - D: at the index the motor stops at once, and there is zero.

use crate::homing::Pace::{Fast, Slow};
use crate::homing::routine::Step::{self, Halt, Phase, Run, Until, Zero};
use crate::homing::routine::{Event::HomeEdge, Event::Index, Way::Onward};

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
];
