//! Mode 7: the limit, then back to the index at low speed (appendix A.8).
//!
//! - A: from low speed up to high speed.
//! - B: at the limit the motor stops at once.
//! - C: back at low speed, in search of the index.
//! - D: at the last mark the motor stops at once, and there is zero.
//! - E: ERC pulse.

use crate::homing::Pace::{Fast, Slow};
use crate::homing::routine::Step::{self, Clear, Halt, Phase, Run, Until, Zero};
use crate::homing::routine::{Event::Index, Event::Limit, Occasion, Way::Back, Way::Onward};

pub const STEPS: &[Step] = &[
    Phase('A'),
    Run(Onward, Fast),
    Until(Limit(true)),
    Phase('B'),
    Halt,
    Clear(Occasion::Stop),
    Phase('C'),
    Run(Back, Slow),
    Until(Index),
    Phase('D'),
    Halt,
    Zero,
    Phase('E'),
    Clear(Occasion::Home),
];
