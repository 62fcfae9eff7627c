//! `ZMOVE`: the index at high speed (section 2.2.5.1).
//!
//! - A: from low speed up to high speed.
//! - B: at the last mark the motor brakes; the counter stays what it is.

use crate::homing::Pace::Fast;
use crate::homing::routine::Step::{self, Brake, Phase, Run, Until};
use crate::homing::routine::{Event::Index, Way::Onward};

pub const STEPS: &[Step] = &[Phase('A'), Run(Onward, Fast), Until(Index), Phase('B'), Brake];
