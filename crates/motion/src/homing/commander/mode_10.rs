//! Mode 10: mode 3 and back to zero (appendix A.11).
//!
//! - A: from low speed up to high speed.
//! - B: on at high speed from the home edge, in search of the index.
//! - C: at the last mark the counter becomes 0 and counts on while the motor brakes.
//! - D: to 0, up to high speed and down again.
//! - E: there the motor stops.
//! - F: ERC pulse.

use crate::homing::Pace::Fast;
use crate::homing::routine::Step::{self, Brake, Clear, Phase, Return, Run, Until, Zero};
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
    Phase('D'),
    Return,
    Phase('F'),
    Clear(Occasion::Home),
];
