//! `Z`: the index (section 7.10.4).
//!
//! - A: at low speed.
//! - B: at the index the motor stops at once, and there is zero.

use crate::homing::Pace::Slow;
use crate::homing::routine::Step::{self, Halt, Phase, Run, Until, Zero};
use crate::homing::routine::{Event::Index, Way::Onward};

pub const STEPS: &[Step] = &[Phase('A'), Run(Onward, Slow), Until(Index), Phase('B'), Halt, Zero];
