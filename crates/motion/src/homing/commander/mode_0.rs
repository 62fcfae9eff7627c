//! Mode 0: the home input at high speed (appendix A.1).
//!
//! - A: from low speed up to high speed.
//! - B: at the home edge the counter becomes 0 and counts on while the motor brakes.
//! - C: the motor stops, off zero.
//! - D: ERC pulse.
//!
//! With a slowdown switch before the home switch the motor is down to low speed at the home edge and stops
//! there at once: it ends at zero.

use crate::homing::Pace::Fast;
use crate::homing::routine::Step::{self, Brake, Clear, Phase, Run, Until, Zero};
use crate::homing::routine::{Event::HomeEdge, Occasion, Way::Onward};

pub const STEPS: &[Step] = &[
    Phase('A'),
    Run(Onward, Fast),
    Until(HomeEdge),
    Phase('B'),
    Zero,
    Brake,
    Phase('D'),
    Clear(Occasion::Home),
];
