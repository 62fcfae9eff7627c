//! Mode 3: the home input, then the index, both at high speed (appendix A.4).
//!
//! - A: from low speed up to high speed.
//! - B: on at high speed from the home edge, in search of the index.
//! - C: at the last mark the counter becomes 0 and counts on while the motor brakes.
//! - D: the motor stops, off zero.
//! - E: ERC pulse.

use crate::homing::Pace::Fast;
use crate::homing::routine::Step::{self, Brake, Clear, Phase, Run, Until, Zero};
use crate::homing::routine::{Event::HomeEdge, Event::Index, Occasion, Way::Onward};

pub const STEPS: &[Step] = &[
    Phase('A'),
    Run(Onward, Fast),
    Until(HomeEdge),
    Phase('B'),
    Until(Index),
    Phase('C'),
    Zero,
    Brake,
    Phase('E'),
    Clear(Occasion::Home),
];
