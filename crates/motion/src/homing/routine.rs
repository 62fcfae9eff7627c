//! Homing by edges, on the way: the engine of the controllers with A-SCRIPT.
//!
//! A routine is a list of [`Step`]s that reads like the manual's drawing: run, until something happens,
//! zero, brake. Most steps take no time; [`Step::Until`], [`Step::Brake`], [`Step::Correct`] and
//! [`Step::Return`] wait.
//!
//! - The home input and the index are edges: what is on when a routine starts, or a step, is no trigger
//!   before it has been off. A routine that starts on the home switch therefore runs off it and on. (The
//!   manual of the PMX-2ED-SA is silent; that of the CMD-4CR says so, appendix A.1, operation 2.)
//! - A limit is a level: a routine that seeks the limit and starts on it has found it without a pulse.
//! - A limit in the way of the motion that the routine does not seek ends it, also during the braking
//!   after the trigger. The counter keeps what it was set to; the axis stands still.
//! - Index marks count once the motor is down to the speed that the step asks for: a stop at once from a
//!   higher speed would lose pulses, and with them the zero point.
//! - The slowdown input is a level and a ceiling: while it is on, nothing is faster than low speed, whichever
//!   way the motor goes. Which step it is and what counts as found do not change.

use super::Pace;
use crate::axis::{Axis, Goal};
use crate::plan::Limits;
use crate::speed::Speed;
use crate::train::Direction;

/// A direction as the command gave it, or the other one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// The direction of the command.
    Onward,
    /// Against it.
    Back,
}

/// What a routine waits for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// The home input comes on.
    HomeEdge,
    /// The home input is on, or off.
    Home(bool),
    /// The limit onward is on, or off.
    Limit(bool),
    /// The index has come on [`Settings::index_marks`] times.
    Index,
}

/// An occasion to clear the deviation counter of a servo drive (CMD-4CR manual, section 2.1.6.1, `ERC`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Occasion {
    /// The motor was stopped at once at the limit that the routine seeks: bit 0 of `ERC`. Another limit is
    /// [`Outcome::Limit`], an error stop like any other.
    Stop,
    /// The zero point is found and the motor stands still: bit 1.
    Home,
}

/// A step of a routine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// What follows has this letter in the manual's drawing.
    Phase(char),
    /// Gets going, or goes on at this pace.
    Run(Way, Pace),
    /// Waits for an event.
    Until(Event),
    /// The counter becomes 0.
    Zero,
    /// Stands still at once.
    Halt,
    /// Comes to rest with the ramp.
    Brake,
    /// Moves by the correction amount, fast.
    Correct(Way),
    /// Moves to 0, fast.
    Return,
    /// The caller may have to clear the drive's deviation counter.
    Clear(Occasion),
}

/// What is set for a routine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Ramps; the top speed is the fast one.
    pub limits: Limits,
    /// The slow speed, in the scale of the limits.
    pub slow: Speed,
    /// The correction amount in pulses; its sign does not matter.
    pub correction: i32,
    /// How many index marks are counted where a routine seeks the index; 0 counts as 1.
    pub index_marks: u8,
    /// Whether a routine that ends off zero then moves to 0.
    pub return_to_zero: bool,
}

/// The inputs that homing looks at, as they are at this pulse; true is on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Inputs {
    /// The home input.
    pub home: bool,
    /// The limits at the negative and the positive end, by [`Direction`].
    pub limits: [bool; 2],
    /// The encoder's index channel. Its level counts in every call; its edges need be told only while
    /// [`Homing::watches_index`].
    pub index: bool,
    /// The slowdown input as it acts: enabled, and on or latched. The caller keeps the latch, because other
    /// motions obey it too.
    pub slowdown: bool,
}

/// How a routine has ended. The axis stands still.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// At its end: positions count from the zero point.
    Found,
    /// At this limit, which it does not seek.
    Limit(Direction),
}

/// A homing routine under way.
#[derive(Clone, Debug)]
pub struct Homing {
    steps: &'static [Step],
    way: Direction,
    settings: Settings,
    at: usize,
    phase: char,
    /// How the motor runs; `None` when it is to stand still or goes to a position.
    run: Option<(Way, Pace)>,
    /// Where the present correction leads to.
    target: Option<i32>,
    /// Index marks that the present step has seen.
    marks: u8,
    /// The inputs at the last call.
    seen: Inputs,
    zeroed: bool,
    clear: Option<Occasion>,
}

impl Homing {
    /// Gets ready for a routine in a direction. The axis is at rest.
    pub fn new(steps: &'static [Step], way: Direction, settings: Settings) -> Self {
        Self {
            steps,
            way,
            settings,
            at: 0,
            phase: 'A',
            run: None,
            target: None,
            marks: 0,
            // Whatever is on at the first call is no edge.
            seen: Inputs { home: true, limits: [true; 2], index: true, slowdown: true },
            zeroed: false,
            clear: None,
        }
    }

    /// The letter of the manual's drawing.
    pub fn phase(&self) -> char {
        self.phase
    }

    /// Whether edges of the index matter now.
    pub fn watches_index(&self) -> bool {
        self.steps.get(self.at) == Some(&Step::Until(Event::Index))
    }

    /// Whether the counter was set to 0 since this was last asked: other counters may have to follow.
    pub fn take_zeroed(&mut self) -> bool {
        core::mem::take(&mut self.zeroed)
    }

    /// The last occasion to clear the drive's deviation counter since this was asked.
    pub fn take_clear(&mut self) -> Option<Occasion> {
        self.clear.take()
    }

    /// Takes notice of the inputs and of the axis; call it at the start, after every change of an input,
    /// when the axis stands at that pulse, and when the axis has come to rest. No direction of the axis is
    /// blocked meanwhile: the routine stops at limits itself.
    pub fn poll(&mut self, axis: &mut Axis, inputs: Inputs) -> Option<Outcome> {
        let outcome = self.walk(axis, inputs);
        if matches!(outcome, Some(Outcome::Limit(_))) {
            axis.halt();
        }
        self.seen = inputs;
        outcome
    }

    /// As many steps as can be taken now.
    fn walk(&mut self, axis: &mut Axis, inputs: Inputs) -> Option<Outcome> {
        // Each turn of the loop is a step further, and the steps are few.
        loop {
            let Some(&step) = self.steps.get(self.at) else {
                let over = !self.settings.return_to_zero || self.has_arrived(axis, inputs, 0);
                return if over { Some(Outcome::Found) } else { self.obstacle(axis, inputs) };
            };
            let done = match step {
                Step::Phase(letter) => {
                    self.phase = letter;
                    true
                }
                Step::Run(way, pace) => {
                    self.run = Some((way, pace));
                    self.keep_running(axis, inputs);
                    true
                }
                Step::Until(event) => {
                    self.keep_running(axis, inputs);
                    let sought = event == Event::Limit(true);
                    (sought || self.obstacle(axis, inputs).is_none()) && self.happens(event, axis, inputs)
                }
                Step::Zero => {
                    axis.set_position(0);
                    self.zeroed = true;
                    true
                }
                Step::Halt => {
                    self.run = None;
                    axis.halt();
                    true
                }
                Step::Brake => {
                    self.run = None;
                    axis.set_goal(Goal::Speed(axis.direction(), 0));
                    !axis.is_moving() && self.obstacle(axis, inputs).is_none()
                }
                Step::Correct(way) => {
                    let amount = i64::from(self.settings.correction.saturating_abs());
                    let amount = (self.direction(way).sign() * amount) as i32;
                    let target = *self.target.get_or_insert_with(|| axis.position().wrapping_add(amount));
                    self.has_arrived(axis, inputs, target)
                }
                Step::Return => self.has_arrived(axis, inputs, 0),
                Step::Clear(occasion) => {
                    self.clear = Some(occasion);
                    true
                }
            };
            if !done {
                return self.obstacle(axis, inputs);
            }
            self.at += 1;
            // The edges of this moment are used up: the next step waits for others.
            self.seen = inputs;
            self.target = None;
            self.marks = 0;
        }
    }

    /// Whether the event is there.
    fn happens(&mut self, event: Event, axis: &Axis, inputs: Inputs) -> bool {
        match event {
            Event::HomeEdge => inputs.home && !self.seen.home,
            Event::Home(on) => inputs.home == on,
            Event::Limit(on) => inputs.limits[self.way as usize] == on,
            Event::Index => {
                if inputs.index && !self.seen.index && self.is_down(axis) {
                    self.marks += 1;
                }
                self.marks >= self.settings.index_marks.max(1)
            }
        }
    }

    /// Sets the axis going, and slows it down or lets it speed up again with the slowdown input.
    fn keep_running(&self, axis: &mut Axis, inputs: Inputs) {
        let Some((way, pace)) = self.run else { return };
        let limits = self.limits(inputs);
        axis.set_limits(limits);
        axis.set_goal(Goal::Speed(self.direction(way), self.speed(pace).min(limits.top)));
    }

    /// The limits that the slowdown input leaves.
    fn limits(&self, inputs: Inputs) -> Limits {
        let Settings { limits, slow, .. } = self.settings;
        if inputs.slowdown { Limits { top: limits.top.min(slow), ..limits } } else { limits }
    }

    fn speed(&self, pace: Pace) -> Speed {
        match pace {
            Pace::Fast => self.settings.limits.top,
            Pace::Slow => self.settings.slow,
        }
    }

    /// Whether the axis has slowed down to the pace that it is to have.
    fn is_down(&self, axis: &Axis) -> bool {
        let speed = self.run.map_or(0, |(_, pace)| self.speed(pace));
        axis.speed() <= speed.max(axis.limits().scale.slowest())
    }

    /// Sends the axis to a position and says whether it stands there.
    fn has_arrived(&mut self, axis: &mut Axis, inputs: Inputs, target: i32) -> bool {
        self.run = None;
        axis.set_limits(self.limits(inputs));
        axis.set_goal(Goal::Position(target));
        let arrived = !axis.is_moving() && axis.position() == target;
        if arrived {
            // It stays, also when the counter is set.
            axis.halt();
        }
        arrived
    }

    /// The limit that the motion has run into.
    fn obstacle(&self, axis: &Axis, inputs: Inputs) -> Option<Outcome> {
        let way = axis.direction();
        inputs.limits[way as usize].then_some(Outcome::Limit(way))
    }

    fn direction(&self, way: Way) -> Direction {
        match way {
            Way::Onward => self.way,
            Way::Back => self.way.reversed(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Event::{HomeEdge, Index, Limit};
    use super::Pace::{Fast, Slow};
    use super::Step::{Brake, Clear, Correct, Halt, Run, Until, Zero};
    use super::Way::{Back, Onward};
    use super::*;
    use crate::homing::testing::{STAGE, START, Stage, home, settings};

    #[track_caller]
    fn check(steps: &'static [Step], index_marks: u8, at: i64, position: i64) {
        let record = home(&STAGE, steps, 0, Settings { index_marks, ..settings() });
        assert_eq!((record.outcome, record.at, record.position), (Outcome::Found, at, position));
    }

    #[test]
    fn every_step_counts_for_itself() {
        const MARKS: &[Step] = &[Run(Onward, Slow), Until(Index), Zero, Until(Index), Halt];
        let record =
            home(&Stage { index: 100, ..STAGE }, MARKS, 0, Settings { index_marks: 2, ..settings() });
        assert_eq!((record.at, record.position), (400, 200));
        const AMOUNTS: &[Step] = &[Correct(Onward), Correct(Onward), Correct(Back), Zero];
        check(AMOUNTS, 1, 150, 0);
    }

    #[test]
    fn overshooting_into_a_limit() {
        const STEPS: &[Step] = &[Run(Back, Fast), Until(Index), Correct(Onward)];
        let record = home(&STAGE, STEPS, 0, settings());
        assert_eq!((record.outcome, record.at), (Outcome::Limit(Direction::Negative), -400));
    }

    #[test]
    fn an_empty_list_is_over_where_it_begins() {
        check(&[], 1, 0, START.into());
    }

    #[test]
    fn what_the_caller_has_to_know() {
        const STEPS: &[Step] =
            &[Run(Onward, Slow), Until(Index), Zero, Run(Onward, Fast), Until(Limit(true))];
        let mut axis = Axis::new(settings().limits);
        let mut homing = Homing::new(STEPS, Direction::Negative, settings());
        assert!(!homing.watches_index());
        let mut poll = |index| {
            let outcome = homing.poll(&mut axis, Inputs { index, ..Inputs::default() });
            (outcome, homing.watches_index(), homing.take_zeroed())
        };
        assert_eq!(poll(true), (None, true, false));
        assert_eq!(poll(false), (None, true, false));
        assert_eq!(poll(true), (None, false, true));
        assert_eq!(poll(true), (None, false, false));
    }

    #[test]
    fn a_step_begins_after_the_edges_of_its_moment() {
        // The home edge and a mark are one pulse, and the motor turns on a mark.
        const STEPS: &[Step] = &[
            Run(Onward, Fast),
            Until(HomeEdge),
            Until(Index),
            Brake,
            Run(Back, Slow),
            Until(Index),
            Halt,
            Zero,
            Clear(Occasion::Home),
        ];
        let record = home(&Stage { index: 100, ..STAGE }, STEPS, 0, settings());
        assert_eq!((record.at, record.position), (600, 0));
        assert_eq!(record.clears, [(Occasion::Home, 600)]);
    }
}
