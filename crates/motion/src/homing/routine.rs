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
    /// The encoder's index channel. Only looked at, with every edge told, while
    /// [`Homing::watches_index`]; but its level counts in every call.
    pub index: bool,
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
    /// The way of the motion that is wanted.
    heading: Direction,
    /// The speed that is wanted.
    speed: Speed,
    /// Where the present correction leads to.
    target: Option<i32>,
    /// Index marks that the present step has seen.
    marks: u8,
    /// The inputs at the last call.
    seen: Inputs,
    zeroed: bool,
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
            heading: way,
            speed: 0,
            target: None,
            marks: 0,
            // Whatever is on at the first call is no edge.
            seen: Inputs { home: true, limits: [true; 2], index: true },
            zeroed: false,
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

    /// Whether this limit is one that the routine seeks, so that it is no error.
    pub fn seeks_limit(&self, limit: Direction) -> bool {
        limit == self.way && self.steps.contains(&Step::Until(Event::Limit(true)))
    }

    /// Whether the counter was set to 0 since this was last asked: other counters may have to follow.
    pub fn take_zeroed(&mut self) -> bool {
        core::mem::take(&mut self.zeroed)
    }

    /// Takes notice of the inputs and of the axis; call it at the start, after every change of an input,
    /// when the axis stands at that pulse, and when the axis has come to rest. Limits may block their
    /// directions of the axis as ever.
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
                let over = !self.settings.return_to_zero || self.has_arrived(axis, 0);
                return if over { Some(Outcome::Found) } else { self.obstacle(axis, inputs) };
            };
            let done = match step {
                Step::Phase(letter) => {
                    self.phase = letter;
                    true
                }
                Step::Run(way, pace) => {
                    let Settings { limits, slow, .. } = self.settings;
                    self.heading = self.direction(way);
                    self.speed = if pace == Pace::Fast { limits.top } else { slow };
                    axis.set_limits(limits);
                    axis.set_goal(Goal::Speed(self.heading, self.speed));
                    true
                }
                Step::Until(event) => {
                    let sought = event == Event::Limit(true);
                    (sought || self.obstacle(axis, inputs).is_none()) && self.happens(event, axis, inputs)
                }
                Step::Zero => {
                    axis.set_position(0);
                    self.zeroed = true;
                    true
                }
                Step::Halt => {
                    axis.halt();
                    true
                }
                Step::Brake => {
                    self.heading = axis.direction();
                    axis.set_goal(Goal::Speed(self.heading, 0));
                    !axis.is_moving() && self.obstacle(axis, inputs).is_none()
                }
                Step::Correct(way) => {
                    let amount = i64::from(self.settings.correction.saturating_abs());
                    let amount = (self.direction(way).sign() * amount) as i32;
                    let target = *self.target.get_or_insert_with(|| axis.position().wrapping_add(amount));
                    self.has_arrived(axis, target)
                }
                Step::Return => self.has_arrived(axis, 0),
            };
            if !done {
                return self.obstacle(axis, inputs);
            }
            self.at += 1;
            self.target = None;
            self.marks = 0;
        }
    }

    /// Whether the event is there; once it is, its edge is used up.
    fn happens(&mut self, event: Event, axis: &Axis, inputs: Inputs) -> bool {
        let happened = match event {
            Event::HomeEdge => inputs.home && !self.seen.home,
            Event::Home(on) => inputs.home == on,
            Event::Limit(on) => inputs.limits[self.way as usize] == on,
            Event::Index => {
                if inputs.index && !self.seen.index && self.is_down(axis) {
                    self.marks += 1;
                }
                self.marks >= self.settings.index_marks.max(1)
            }
        };
        if happened {
            self.seen = inputs;
        }
        happened
    }

    /// Whether the axis has slowed down to the speed that is wanted.
    fn is_down(&self, axis: &Axis) -> bool {
        axis.speed() <= self.speed.max(axis.limits().scale.slowest())
    }

    /// Sends the axis to a position and says whether it stands there.
    fn has_arrived(&mut self, axis: &mut Axis, target: i32) -> bool {
        self.heading = Direction::of(target.wrapping_sub(axis.position()).into());
        axis.set_goal(Goal::Position(target));
        let arrived = !axis.is_moving() && axis.position() == target;
        if arrived {
            // It stays, also when the counter is set.
            axis.halt();
        }
        arrived
    }

    /// The limit that the motion has run into, or is about to.
    fn obstacle(&self, axis: &Axis, inputs: Inputs) -> Option<Outcome> {
        let way = if axis.is_moving() { axis.direction() } else { self.heading };
        inputs.limits[way as usize].then_some(Outcome::Limit(way))
    }

    fn direction(&self, way: Way) -> Direction {
        match way {
            Way::Onward => self.way,
            Way::Back => self.way.reversed(),
        }
    }
}
