//! An axis: position counter, goal, limits, and the train that is on its way.
//!
//! Time moves by [`Axis::advance`]. Everything else happens at the end of the clock that was advanced to
//! last: pulses of that clock have happened, the next one is at least a clock away. A change of goal or
//! limits cuts the train on its way between two pulses, and the part of a pulse that was already made
//! counts.

use crate::foot::Feet;
use crate::mover::Mover;
use crate::plan::Limits;
use crate::speed::Speed;
use crate::train::{Direction, Ticks, Train};

/// What an axis wants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Goal {
    /// To stand at this position. Positions wrap at 32 bits, and the way is the shorter one.
    Position(i32),
    /// To move at this speed; 0 to stand still.
    Speed(Direction, Speed),
}

/// How an axis ends its motion into a blocked direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// At once.
    Hard,
    /// With the deceleration ramp.
    Soft,
}

/// A motion axis.
#[derive(Clone, Debug)]
pub struct Axis {
    mover: Mover,
    feet: Feet,
}

impl Axis {
    /// An axis at rest at position 0 at clock 0.
    pub const fn new(limits: Limits) -> Self {
        Self { mover: Mover::new(limits), feet: Feet::new(limits.scale) }
    }

    /// The limits in force.
    pub const fn limits(&self) -> Limits {
        self.mover.limits()
    }

    /// What the axis wants.
    pub fn goal(&self) -> Goal {
        self.mover.goal()
    }

    /// The position counter.
    pub fn position(&self) -> i32 {
        self.mover.position()
    }

    /// Net pulses since power-up; setting the position does not change it.
    pub fn odometer(&self) -> i64 {
        self.mover.odometer()
    }

    /// All pulses since power-up, both ways.
    pub fn steps(&self) -> u64 {
        self.mover.steps()
    }

    /// Whether pulses are on their way.
    pub fn is_moving(&self) -> bool {
        self.mover.is_moving()
    }

    /// The way the axis moves, or moved last.
    pub fn direction(&self) -> Direction {
        self.mover.direction()
    }

    /// The present speed; 0 at standstill.
    pub fn speed(&self) -> Speed {
        self.mover.speed()
    }

    /// Whether the speed is rising (1), falling (−1) or neither.
    pub fn acceleration(&self) -> i32 {
        self.mover.acceleration()
    }

    /// Overwrites the position counter. The axis need not stand still; a target stays where it is, and the
    /// way to it changes.
    pub fn set_position(&mut self, position: i32) {
        self.mover.set_position(position, &mut self.feet);
    }

    /// Gives the present place another number, and a target the one that is as far away as before: the motion
    /// goes on as if nothing had happened.
    pub fn renumber(&mut self, position: i32) {
        self.mover.renumber(position);
    }

    /// Changes what the axis wants.
    pub fn set_goal(&mut self, goal: Goal) {
        self.mover.set_goal(goal, &mut self.feet);
    }

    /// Changes the limits. A motion goes on at its speed, also when the scale changes.
    pub fn set_limits(&mut self, limits: Limits) {
        self.mover.set_limits(limits, &mut self.feet);
    }

    /// Blocks a direction or frees it. A motion into it ends as the stop says; one that was held goes on
    /// when the direction is freed and the goal still lies there.
    pub fn set_blocked(&mut self, direction: Direction, stop: Option<Stop>) {
        self.mover.set_blocked(direction, stop, &mut self.feet);
    }

    /// Stands still at once and wants nothing else.
    pub fn halt(&mut self) {
        self.mover.halt();
    }

    /// Nothing outside changes while the odometer is strictly between these; the axis wakes at them.
    pub fn set_window(&mut self, low: i64, high: i64) {
        self.mover.set_window(low, high);
    }

    /// Whether the odometer stands at an edge of the window, or beyond.
    pub fn at_window(&self) -> bool {
        self.mover.at_window()
    }

    /// The controller wants to look after something when the odometer arrives at one of these: the axis wakes
    /// there too, and goes on. A comparator is told its counter so at the very pulse.
    pub fn set_marks(&mut self, low: i64, high: i64) {
        self.mover.set_marks(low, high);
    }

    /// Pulses to the next edge of the window or mark; 0 beyond both.
    pub(crate) fn room(&self, direction: Direction) -> i64 {
        self.mover.room(direction)
    }

    /// Counts pulses that others made with an axis at rest. It wants to stay where they take it.
    pub(crate) fn carry(&mut self, direction: Direction, pulses: u32) {
        self.mover.carry(direction, pulses);
    }

    /// What it remembers of ramps, for others while it rests.
    pub(crate) const fn feet(&mut self) -> &mut Feet {
        &mut self.feet
    }

    /// The clock at which the axis must be advanced: the end of its train, or the pulse with which it
    /// reaches its window's edge. `None` at rest.
    pub fn wake(&self) -> Option<Ticks> {
        self.mover.wake()
    }

    /// The clock at which something may happen that others have to see: the axis comes to rest, or reaches an
    /// edge of its window or a mark. Later than [`wake`](Self::wake) where that is far away; what the speed does
    /// meanwhile is the axis' own business. `None` at rest.
    pub fn due(&self) -> Option<Ticks> {
        self.mover.due()
    }

    /// Lets time pass to the end of clock `now`; `emit` gets the trains of the pulses made until then.
    ///
    /// # Panics
    /// If `now` is earlier than the last time.
    pub fn advance(&mut self, now: Ticks, mut emit: impl FnMut(&Train)) {
        let Self { mover, feet } = self;
        mover.pass(now);
        while let Some(train) = mover.ready() {
            emit(train);
            mover.go_on(feet);
        }
        if let Some(train) = mover.cut() {
            emit(&train);
        }
    }
}
