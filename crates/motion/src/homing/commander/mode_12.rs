//! Mode 12: mode 8 and forward to zero (appendix A.13).
//!
//! - A: from low speed up to high speed.
//! - B: at the limit the motor stops at once.
//! - C: back, up to high speed, in search of the index.
//! - D: at the last mark the counter becomes 0 and counts on while the motor brakes.
//! - E: to 0, up to high speed and down again.
//! - F: there the motor stops.
//! - G: ERC pulse.

use crate::homing::Pace::Fast;
use crate::homing::routine::Step::{self, Brake, Clear, Halt, Phase, Return, Run, Until, Zero};
use crate::homing::routine::{Event::Index, Event::Limit, Occasion, Way::Back, Way::Onward};

pub const STEPS: &[Step] = &[
    Phase('A'),
    Run(Onward, Fast),
    Until(Limit(true)),
    Phase('B'),
    Halt,
    Clear(Occasion::Stop),
    Phase('C'),
    Run(Back, Fast),
    Until(Index),
    Phase('D'),
    Zero,
    Brake,
    Phase('E'),
    Return,
    Phase('G'),
    Clear(Occasion::Home),
];
