//! Mode 9: mode 0 and back to zero (appendix A.10).
//!
//! - A: from low speed up to high speed.
//! - B: at the home edge the counter becomes 0 and counts on while the motor brakes.
//! - C: to 0, up to high speed and down again.
//! - D: there the motor stops.
//! - E: ERC pulse.

use crate::homing::Pace::Fast;
use crate::homing::routine::Step::{self, Brake, Clear, Phase, Return, Run, Until, Zero};
use crate::homing::routine::{Event::HomeEdge, Occasion, Way::Onward};

pub const STEPS: &[Step] = &[
    Phase('A'),
    Run(Onward, Fast),
    Until(HomeEdge),
    Phase('B'),
    Zero,
    Brake,
    Phase('C'),
    Return,
    Phase('E'),
    Clear(Occasion::Home),
];
