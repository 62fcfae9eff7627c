//! `HL`: the home input at high speed, then at low speed (section 7.10.5).
//!
//! - A: from low speed up to high speed.
//! - B: at the home edge the counter becomes 0 and the motor brakes.
//! - C: back, up to high speed, to the home switch.
//! - D: once the switch has gone off again, on by the home correction amount.
//! - E: forward at low speed.
//! - F: at the home edge the motor stops at once, and there is zero.
//!
//! In B the motor may come to rest on the switch or beyond it: C waits for the switch to be on, which it
//! may be already, and then off.

use crate::homing::Pace::{Fast, Slow};
use crate::homing::routine::Step::{self, Brake, Correct, Halt, Phase, Run, Until, Zero};
use crate::homing::routine::{Event::Home, Event::HomeEdge, Way::Back, Way::Onward};

pub const STEPS: &[Step] = &[
    Phase('A'),
    Run(Onward, Fast),
    Until(HomeEdge),
    Phase('B'),
    Zero,
    Brake,
    Phase('C'),
    Run(Back, Fast),
    Until(Home(true)),
    Until(Home(false)),
    Phase('D'),
    Correct(Back),
    Phase('E'),
    Run(Onward, Slow),
    Until(HomeEdge),
    Phase('F'),
    Halt,
    Zero,
];
