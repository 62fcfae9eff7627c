//! Mode 4: the home input, then back to the index at low speed (appendix A.5).
//!
//! - A: from low speed up to high speed.
//! - B: at the home edge the motor brakes.
//! - C, D: back at low speed, in search of the index.
//! - E: at the last mark the motor stops at once, and there is zero.
//! - F: ERC pulse.

use crate::homing::Pace::{Fast, Slow};
use crate::homing::routine::Step::{self, Brake, Clear, Halt, Phase, Run, Until, Zero};
use crate::homing::routine::{Event::HomeEdge, Event::Index, Occasion, Way::Back, Way::Onward};

pub const STEPS: &[Step] = &[
    Phase('A'),
    Run(Onward, Fast),
    Until(HomeEdge),
    Phase('B'),
    Brake,
    Phase('D'),
    Run(Back, Slow),
    Until(Index),
    Phase('E'),
    Halt,
    Zero,
    Phase('F'),
    Clear(Occasion::Home),
];
