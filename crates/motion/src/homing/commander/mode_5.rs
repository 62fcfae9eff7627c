//! Mode 5: the home input, then back to the index at high speed (appendix A.6).
//!
//! - A: from low speed up to high speed.
//! - B: at the home edge the motor brakes.
//! - C: back, up to high speed, in search of the index.
//! - D: at the last mark the counter becomes 0 and counts on while the motor brakes.
//! - E: the motor stops, off zero.
//! - F: ERC pulse.

use crate::homing::Pace::Fast;
use crate::homing::routine::Step::{self, Brake, Clear, Phase, Run, Until, Zero};
use crate::homing::routine::{Event::HomeEdge, Event::Index, Occasion, Way::Back, Way::Onward};

pub const STEPS: &[Step] = &[
    Phase('A'),
    Run(Onward, Fast),
    Until(HomeEdge),
    Phase('B'),
    Brake,
    Phase('C'),
    Run(Back, Fast),
    Until(Index),
    Phase('D'),
    Zero,
    Brake,
    Phase('F'),
    Clear(Occasion::Home),
];
