//! Mode 11: mode 5 and forward to zero (appendix A.12).
//!
//! - A: from low speed up to high speed; at the home edge the motor brakes.
//! - B: back, up to high speed, in search of the index; at the last mark the counter becomes 0 and counts on
//!   while the motor brakes.
//! - C: to 0, up to high speed and down again; there the motor stops.
//! - D: ERC pulse.

use crate::homing::Pace::Fast;
use crate::homing::routine::Step::{self, Brake, Clear, Phase, Return, Run, Until, Zero};
use crate::homing::routine::{Event::HomeEdge, Event::Index, Occasion, Way::Back, Way::Onward};

pub const STEPS: &[Step] = &[
    Phase('A'),
    Run(Onward, Fast),
    Until(HomeEdge),
    Brake,
    Phase('B'),
    Run(Back, Fast),
    Until(Index),
    Zero,
    Brake,
    Phase('C'),
    Return,
    Phase('D'),
    Clear(Occasion::Home),
];
