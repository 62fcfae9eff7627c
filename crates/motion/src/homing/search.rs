//! The reference search: which switch to seek in which direction, at which speed, what to remember and
//! where to go in the end, as a list of steps. This file walks through them; [`reference`] has the lists.
//!
//! [`reference`]: super::reference

use super::Pace;
use crate::axis::{Axis, Goal};
use crate::plan::Limits;
use crate::speed::Speed;
use crate::train::Direction;

/// The switches of an axis; true is pressed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Switches {
    /// At the negative end.
    pub negative: bool,
    /// At the positive end.
    pub positive: bool,
    /// In between.
    pub home: bool,
}

/// One of the [`Switches`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Switch {
    /// At the negative end.
    Negative,
    /// At the positive end.
    Positive,
    /// In between.
    Home,
}

impl Switches {
    const fn get(self, switch: Switch) -> bool {
        match switch {
            Switch::Negative => self.negative,
            Switch::Positive => self.positive,
            Switch::Home => self.home,
        }
    }
}

/// A position worth remembering.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A switching point.
    A,
    /// Another one.
    B,
    /// The far end switch.
    Far,
}

/// Where the zero point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Zero {
    /// At mark A.
    AtA,
    /// In the middle of marks A and B, rounded down.
    Middle,
}

/// A step of a homing mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Move until a switch has a level.
    Seek {
        /// Which way.
        way: Direction,
        /// How fast.
        pace: Pace,
        /// Which switch.
        switch: Switch,
        /// Pressed or released.
        pressed: bool,
        /// What to remember then.
        mark: Option<Mark>,
        /// Go on at this step instead when the end switch on the way is pressed.
        turn: Option<usize>,
    },
    /// Go to the zero point and end.
    Finish(Zero),
}

/// What a finished search has found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Found {
    /// Where the zero point was in the old positions.
    pub zero: i32,
    /// From the zero point to the far end switch, if the mode visits it.
    pub distance: Option<i32>,
}

/// A search under way.
#[derive(Clone, Debug)]
pub struct Search {
    steps: &'static [Step],
    at: usize,
    mirrored: bool,
    home_inverted: bool,
    marks: [Option<i32>; 3],
    speeds: [Speed; 2],
    limits: Limits,
}

impl Search {
    /// Gets ready to search; `speeds` are the fast and the slow one. Mirrored, every direction and end
    /// switch is the other one.
    pub fn new(
        steps: &'static [Step],
        mirrored: bool,
        home_inverted: bool,
        speeds: [Speed; 2],
        limits: Limits,
    ) -> Self {
        Self { steps, at: 0, mirrored, home_inverted, marks: [None; 3], speeds, limits }
    }

    /// The number of the present step, from 1.
    pub fn step(&self) -> usize {
        self.at + 1
    }

    /// Takes notice of the switches and of the axis; call it at the start, after every change of a switch
    /// and when the axis has come to rest. Leaves the axis at rest at the zero point, its position not
    /// yet set.
    pub fn poll(&mut self, axis: &mut Axis, switches: Switches) -> Option<Found> {
        // Each turn of the loop is a step further, and the steps are few.
        loop {
            match self.steps[self.at] {
                Step::Seek { way, pace, switch, pressed, mark, turn } => {
                    let way = if self.mirrored { way.reversed() } else { way };
                    if self.get(switches, switch) == pressed {
                        if let Some(mark) = mark {
                            self.marks[mark as usize] = Some(axis.position());
                        }
                        axis.halt();
                        self.at += 1;
                        continue;
                    }
                    if let Some(turn) = turn
                        && switches.get(end_switch(way))
                    {
                        axis.halt();
                        self.at = turn;
                        continue;
                    }
                    axis.set_goal(Goal::Speed(way, self.speeds[pace as usize]));
                    return None;
                }
                Step::Finish(zero) => {
                    let zero = self.zero(zero)?;
                    if axis.position() == zero && !axis.is_moving() {
                        let far = self.marks[Mark::Far as usize];
                        return Some(Found { zero, distance: far.map(|far| far.wrapping_sub(zero)) });
                    }
                    axis.set_limits(Limits { top: self.speeds[Pace::Slow as usize], ..self.limits });
                    axis.set_goal(Goal::Position(zero));
                    return None;
                }
            }
        }
    }

    fn get(&self, switches: Switches, switch: Switch) -> bool {
        match switch {
            Switch::Home => switches.home != self.home_inverted,
            Switch::Negative if self.mirrored => switches.positive,
            Switch::Positive if self.mirrored => switches.negative,
            _ => switches.get(switch),
        }
    }

    fn zero(&self, zero: Zero) -> Option<i32> {
        let [a, b, _] = self.marks;
        match zero {
            Zero::AtA => a,
            Zero::Middle => Some(a?.wrapping_add(b?.wrapping_sub(a?).div_euclid(2))),
        }
    }
}

/// The end switch that a motion runs into.
const fn end_switch(way: Direction) -> Switch {
    match way {
        Direction::Negative => Switch::Negative,
        Direction::Positive => Switch::Positive,
    }
}
