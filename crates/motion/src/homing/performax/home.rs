//! `H`: the home input at high speed (section 7.10.1).
//!
//! - A: from low speed up to high speed.
//! - B: at the home edge the counter becomes 0 and counts on while the motor brakes.
//! - C: at low speed the motor stops, off zero.

use crate::homing::Pace::Fast;
use crate::homing::routine::Step::{self, Brake, Phase, Run, Until, Zero};
use crate::homing::routine::{Event::HomeEdge, Way::Onward};

pub const STEPS: &[Step] =
    &[Phase('A'), Run(Onward, Fast), Until(HomeEdge), Phase('B'), Zero, Brake, Phase('C')];
