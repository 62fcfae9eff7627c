//! Mode 1: the home input at high speed, then at low speed (appendix A.2).
//!
//! - A: from low speed up to high speed.
//! - B: at the home edge the motor brakes.
//! - C: back at low speed, to the home switch.
//! - D: where the switch has gone off again the motor turns and goes forward at low speed.
//! - E: at the home edge it stops at once, and there is zero.
//! - F: ERC pulse.
//!
//! In B the motor may come to rest on the switch or beyond it: C waits for the switch to be on, which it
//! may be already, and then off.

use crate::homing::Pace::{Fast, Slow};
use crate::homing::routine::Step::{self, Brake, Clear, Halt, Phase, Run, Until, Zero};
use crate::homing::routine::{Event::Home, Event::HomeEdge, Occasion, Way::Back, Way::Onward};

pub const STEPS: &[Step] = &[
    Phase('A'),
    Run(Onward, Fast),
    Until(HomeEdge),
    Phase('B'),
    Brake,
    Phase('C'),
    Run(Back, Slow),
    Until(Home(true)),
    Until(Home(false)),
    Phase('D'),
    Halt,
    Run(Onward, Slow),
    Until(HomeEdge),
    Phase('E'),
    Halt,
    Zero,
    Phase('F'),
    Clear(Occasion::Home),
];
