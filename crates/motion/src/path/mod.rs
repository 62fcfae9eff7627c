//! Interpolation: axes that move together along a line, around a circle or on a helix.
//!
//! The path is an axis of its own. Its ramps are those of the limits, and its pulses are slots in which the
//! others step or do not, in the same clocks. Along a line the axis with the longest way steps in every slot;
//! around a circle a slot is a little less than a pulse of arc, and the speed of the limits is that along the
//! circle. Every point that the axes come to is within half a pulse of the line or circle, whatever the speed
//! does on the way, and the end is exact.

mod angle;
mod arc;
mod circle;
mod eighth;
mod pace;
mod places;
mod round;
mod steps;
mod straight;
mod window;

pub use arc::{Arc, ArcError, End, MAX_RADIUS, Turn};

use crate::axis::{Axis, Goal};
use crate::mover::Mover;
use crate::plan::{Limits, Shape};
use crate::speed::{Scale, Speed};
use crate::train::{Direction, Ticks, Train};
use pace::Pace;
use round::Round;
use straight::{Density, Straight};

/// The way of the path that leads to the end: the one in which a distance may be 2³¹.
const AHEAD: Direction = Direction::Negative;

/// Limits of a path that leads nowhere.
const IDLE: Limits =
    Limits { scale: Scale::new(31), top: 1, start: 1, stop: 1, growth: 1, fall: 1, shape: Shape::Trapezoid };

/// One interpolated move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Move<const N: usize> {
    /// Along a straight line: the way of each axis, 0 for those that take no part.
    Line([i32; N]),
    /// Around a circle, or on a helix.
    Arc(Arc),
}

impl<const N: usize> Move<N> {
    /// The way of each axis from start to end.
    ///
    /// # Panics
    /// If an axis of an arc is none of these.
    pub fn way(&self) -> [i32; N] {
        match self {
            Self::Line(way) => *way,
            Self::Arc(arc) => {
                let mut way = [0; N];
                for (axis, part) in arc.axes().into_iter().zip(arc.ends()).chain(arc.along()) {
                    way[axis] = part;
                }
                way
            }
        }
    }
}

/// A move of some of a controller's axes. They rest themselves meanwhile; it counts for them.
#[derive(Clone, Debug)]
pub struct Path<const N: usize> {
    /// The slots, as the pulses of an axis of its own.
    slots: Mover,
    /// Whose feet it goes on: those of an axis that takes part.
    lender: usize,
    /// How many of them since the start.
    slot: i64,
    pace: Pace,
    /// In pulses.
    limits: Limits,
    /// What each axis does that goes straight.
    straight: [Straight; N],
    /// What two axes do on a circle.
    round: Option<([usize; 2], Round)>,
}

impl<const N: usize> Path<N> {
    /// A path that leads nowhere: no axis takes part.
    pub const fn idle() -> Self {
        Self {
            slots: Mover::new(IDLE),
            lender: 0,
            slot: 0,
            pace: Pace::EVERY_PULSE,
            limits: IDLE,
            straight: [Straight::NONE; N],
            round: None,
        }
    }

    /// A path that [sets out](Self::set_out).
    ///
    /// # Panics
    /// If an axis that takes part is moving, or an axis of an arc is none of these.
    pub fn new(limits: Limits, moves: &Move<N>, now: Ticks, axes: &mut [Axis; N]) -> Self {
        let mut path = Self::idle();
        path.set_out(limits, moves, now, axes);
        path
    }

    /// Sets out at the end of clock `now`, whatever the path was before. The speeds of the limits are those of the
    /// axis with the longest way on a line, and those along the circle otherwise; an axis that goes along a circle
    /// on a longer way than that is the faster one, and no axis makes more than a pulse in two clocks. The axes that
    /// take part forget their goals: they stay where the path leaves them.
    ///
    /// # Panics
    /// If an axis that takes part is moving, or an axis of an arc is none of these.
    pub fn set_out(&mut self, limits: Limits, moves: &Move<N>, now: Ticks, axes: &mut [Axis; N]) {
        let mut way = moves.way();
        (self.round, self.pace) = (None, Pace::EVERY_PULSE);
        let mut slots = None;
        if let Move::Arc(arc) = moves
            && let Some(motion) = arc.round()
        {
            let [slots_of_arc, length] = motion.slots();
            self.pace = Pace { slots: slots_of_arc, length };
            slots = Some(slots_of_arc as u32);
            arc.axes().into_iter().for_each(|axis| way[axis] = 0);
            self.round = Some((arc.axes(), motion));
        }
        let longest = way.iter().map(|way| way.unsigned_abs()).max().unwrap_or(0);
        let slots = slots.unwrap_or(longest);
        (self.slot, self.limits) = (0, limits.clamped());
        for (straight, way) in self.straight.iter_mut().zip(way) {
            *straight = Straight::new(way, slots);
        }
        for (number, axis) in axes.iter_mut().enumerate().rev() {
            if self.involves(number) {
                axis.carry(axis.direction(), 0);
                self.lender = number;
            }
        }
        self.slots.restart(self.pace.limits(limits), now);
        self.slots.set_goal(Goal::Position(0i32.wrapping_sub_unsigned(slots)), axes[self.lender].feet());
    }

    /// Stands still at once and leads nowhere any more.
    pub fn clear(&mut self) {
        self.slots.halt();
        (self.straight, self.round) = ([Straight::NONE; N], None);
    }

    /// The number of an axis on the circle.
    fn on_circle(&self, axis: usize) -> Option<(usize, &Round)> {
        let (axes, round) = self.round.as_ref()?;
        axes.iter().position(|&other| other == axis).map(|number| (number, round))
    }

    fn goes_straight(&self, axis: usize) -> bool {
        self.straight[axis].density() != Density::None
    }

    /// Whether an axis takes part.
    pub fn involves(&self, axis: usize) -> bool {
        self.goes_straight(axis) || self.on_circle(axis).is_some()
    }

    /// Whether pulses are on their way.
    pub fn is_moving(&self) -> bool {
        self.slots.is_moving()
    }

    /// The limits in force.
    pub fn limits(&self) -> Limits {
        self.limits
    }

    /// Which way an axis goes at present; `None` if it takes no part.
    pub fn direction(&self, axis: usize) -> Option<Direction> {
        let ahead = self.slots.direction() == AHEAD;
        match self.on_circle(axis) {
            Some((number, round)) => Some(round.directions(self.slot, ahead)[number]),
            None => self.goes_straight(axis).then(|| self.straight[axis].direction(ahead)),
        }
    }

    /// Slows down along the path, and stands on one of its slots.
    pub fn stop(&mut self, axes: &mut [Axis; N]) {
        self.slots.set_goal(Goal::Speed(AHEAD, 0), axes[self.lender].feet());
    }

    /// Stands still at once.
    pub fn halt(&mut self) {
        self.slots.halt();
    }

    /// Changes the limits on the way.
    pub fn set_limits(&mut self, limits: Limits, axes: &mut [Axis; N]) {
        self.limits = limits.clamped();
        self.slots.set_limits(self.pace.limits(limits), axes[self.lender].feet());
    }

    /// The present speed of an axis, in the scale of the limits; 0 at standstill.
    pub fn speed(&self, axis: usize) -> Speed {
        let scale = self.slots.limits().scale.bits();
        let speed = u64::from(self.slots.speed()) << (self.limits.scale.bits() - scale);
        match self.on_circle(axis) {
            Some((number, round)) => self.pace.pulses(speed, round.shares(self.slot)[number]),
            None => self.straight[axis].speed(speed),
        }
    }

    /// Whether the speed is rising (1), falling (−1) or neither.
    pub fn acceleration(&self) -> i32 {
        self.slots.acceleration()
    }

    /// The clock at which the path must be advanced: the end of its trains, or the pulse with which an axis
    /// reaches its window's edge. `None` at rest.
    pub fn wake(&self, axes: &[Axis; N]) -> Option<Ticks> {
        let train = self.slots.train()?;
        let ahead = train.direction == AHEAD;
        let straight = self.straight.iter().zip(axes).filter_map(|(member, axis)| {
            member.slots_to(axis.room(member.direction(ahead)), self.slot, train.count, ahead)
        });
        let round = self.round.iter().flat_map(|(numbers, round)| {
            numbers.iter().enumerate().filter_map(move |(number, &axis)| {
                let rooms = [Direction::Negative, Direction::Positive].map(|way| axes[axis].room(way));
                round.slots_to(number, rooms, self.slot, train.count, ahead)
            })
        });
        match straight.chain(round).min() {
            Some(slot) if slot < train.count.into() => Some(train.edge(slot as u32)),
            _ => self.slots.wake(),
        }
    }

    /// The clock at which something may happen that others have to see: the path ends, or an axis reaches an
    /// edge of its window or a mark. Later than [`wake`](Self::wake) where that is far away. `None` at rest.
    pub fn due(&self, axes: &[Axis; N]) -> Option<Ticks> {
        let wake = self.wake(axes)?;
        // No axis makes more than a pulse a slot.
        let rooms = axes.iter().enumerate().filter(|(axis, _)| self.involves(*axis)).flat_map(|(_, axis)| {
            [Direction::Negative, Direction::Positive].map(|way| axis.room(way)).into_iter()
        });
        let room = rooms.filter(|room| *room > 0).min().unwrap_or(0) as u64;
        Some(wake.max(self.slots.before(room)))
    }

    /// The clock of the slot from which an axis on a circle goes the other way, or an earlier one: whoever keeps
    /// axes from going one way looks after them then. `None` at rest and on lines.
    pub fn turn(&self) -> Option<Ticks> {
        let (_, round) = self.round.as_ref()?;
        let train = self.slots.train()?;
        if train.direction != AHEAD {
            // Only a change of limits on the way takes a path back.
            return Some(train.first_slot());
        }
        let slots = round.turn_after(self.slot).abs_diff(self.slot);
        if slots < train.count.into() {
            return Some(train.edge(slots as u32));
        }
        Some(self.slots.wake()?.max(self.slots.before(slots)))
    }

    /// Lets time pass to the end of clock `now`, no further than [`Self::due`] says; `emit` gets the trains
    /// of the pulses made until then, with the number of their axis, and the axes count them.
    ///
    /// # Panics
    /// If `now` is earlier than the last time, or an axis that takes part moves by itself.
    pub fn advance(&mut self, now: Ticks, axes: &mut [Axis; N], mut emit: impl FnMut(usize, &Train)) {
        let Self { slots, lender, slot, straight, round, .. } = self;
        let mut follow = |path: &Train, axes: &mut [Axis; N]| {
            let ahead = path.direction == AHEAD;
            let mut pulses = |axis: usize, train: &Train| {
                axes[axis].carry(train.direction, train.count);
                emit(axis, train);
            };
            let mut masked = round.is_some();
            for (number, member) in straight.iter_mut().enumerate() {
                let path = || Train { direction: member.direction(ahead), ..*path };
                match member.density() {
                    Density::None => {}
                    Density::Few => member.follow(&path(), *slot, ahead, |train| pulses(number, train)),
                    Density::Some => masked = true,
                    Density::All => pulses(number, &path()),
                }
            }
            let (mut at, mut rest) = (*slot, Some(*path).filter(|_| masked));
            while let Some(train) = rest {
                let slots;
                (slots, rest) = train.first_slots();
                for (number, member) in straight.iter_mut().enumerate() {
                    if member.density() == Density::Some
                        && let Some(train) = slots.masked(member.mask(at, slots.count, ahead))
                    {
                        pulses(number, &Train { direction: member.direction(ahead), ..train });
                    }
                }
                if let Some((numbers, round)) = round {
                    for (number, steps) in numbers.iter().zip(round.steps(at, slots.count, ahead)) {
                        steps.emit(&slots, |train| pulses(*number, train));
                    }
                }
                at += if ahead { i64::from(slots.count) } else { -i64::from(slots.count) };
            }
            *slot += if ahead { i64::from(path.count) } else { -i64::from(path.count) };
        };
        slots.pass(now);
        while let Some(train) = slots.ready() {
            follow(train, axes);
            slots.go_on(axes[*lender].feet());
        }
        if let Some(train) = slots.cut() {
            follow(&train, axes);
        }
    }
}
