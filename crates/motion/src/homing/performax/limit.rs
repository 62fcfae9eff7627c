//! `L`: the limit input (section 7.10.2).
//!
//! - A: from low speed up to high speed.
//! - B: at the limit the motor stops at once.
//! - C: the other way by the limit correction amount, at high speed.
//! - D: there is zero.

use crate::homing::Pace::Fast;
use crate::homing::routine::Step::{self, Correct, Halt, Phase, Run, Until, Zero};
use crate::homing::routine::{Event::Limit, Way::Back, Way::Onward};

pub const STEPS: &[Step] = &[
    Phase('A'),
    Run(Onward, Fast),
    Until(Limit(true)),
    Phase('B'),
    Halt,
    Phase('C'),
    Correct(Back),
    Phase('D'),
    Zero,
];
