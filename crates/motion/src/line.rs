//! Linear interpolation: axes that move together along a straight line.
//!
//! The axis with the longest way sets the pace: the line is a ramp of its pulses, like that of an axis
//! alone, and the others step in some of the same clocks, those in which the straight line comes nearest to
//! their next position (Bresenham's rule, in whole numbers). Every point is so within half a pulse of the line,
//! whatever the speed does on the way, and the end is exact.

use crate::axis::{Axis, Goal};
use crate::plan::Limits;
use crate::speed::Speed;
use crate::train::{Direction, MAX_SLOTS, Ticks, Train};
use core::hint::select_unpredictable;

/// The way of the path that leads to the target: the one in which a distance may be 2³¹.
const AHEAD: Direction = Direction::Negative;

/// A straight move of some of a controller's axes. They rest themselves meanwhile; it counts for them.
#[derive(Clone, Debug)]
pub struct Line<const N: usize> {
    /// The pulses of the longest axis, as those of an axis of its own.
    path: Axis,
    /// How many.
    longest: u32,
    members: [Member; N],
}

/// What an axis does on the way.
#[derive(Clone, Copy, Debug)]
struct Member {
    /// How many pulses, and which way.
    way: u32,
    direction: Direction,
    /// By how much the line is beyond the middle between the last pulse and the one before, in parts of a
    /// pulse: twice the longest way. 0 to one less than a pulse.
    beyond: u64,
}

impl<const N: usize> Line<N> {
    /// Sets out at the end of clock `now` on a way for each axis, 0 for those that take no part. The speeds
    /// of the limits are those of the longest. The axes that take part forget their goals: they stay where
    /// the line leaves them.
    ///
    /// # Panics
    /// If one that takes part is moving.
    pub fn new(limits: Limits, way: [i32; N], now: Ticks, axes: &mut [Axis; N]) -> Self {
        for (axis, _) in axes.iter_mut().zip(way).filter(|(_, way)| *way != 0) {
            axis.carry(axis.direction(), 0);
        }
        let longest = way.iter().map(|way| way.unsigned_abs()).max().unwrap_or(0);
        let mut path = Axis::new(limits);
        path.advance(now, |_| ());
        path.set_goal(Goal::Position(0i32.wrapping_sub_unsigned(longest)));
        let members = way.map(|way| Member {
            way: way.unsigned_abs(),
            direction: Direction::of(way.into()),
            beyond: longest.into(),
        });
        Self { path, longest, members }
    }

    /// Whether an axis takes part.
    pub fn involves(&self, axis: usize) -> bool {
        self.members[axis].way != 0
    }

    /// Whether pulses are on their way.
    pub fn is_moving(&self) -> bool {
        self.path.is_moving()
    }

    /// The limits in force, of the longest axis.
    pub fn limits(&self) -> Limits {
        self.path.limits()
    }

    /// Which way an axis goes; `None` if it takes no part.
    pub fn direction(&self, axis: usize) -> Option<Direction> {
        let member = &self.members[axis];
        let ahead = self.path.direction() == AHEAD;
        (member.way != 0).then(|| if ahead { member.direction } else { member.direction.reversed() })
    }

    /// Slows down along the line, and stands on a pulse of the longest axis.
    pub fn stop(&mut self) {
        self.path.set_goal(Goal::Speed(AHEAD, 0));
    }

    /// Stands still at once.
    pub fn halt(&mut self) {
        self.path.halt();
    }

    /// Changes the limits on the way.
    pub fn set_limits(&mut self, limits: Limits) {
        self.path.set_limits(limits);
    }

    /// The present speed of an axis; 0 at standstill.
    pub fn speed(&self, axis: usize) -> Speed {
        let (speed, longest) = (u64::from(self.path.speed()), u64::from(self.longest.max(1)));
        ((speed * u64::from(self.members[axis].way) + longest / 2) / longest) as Speed
    }

    /// Whether the speed is rising (1), falling (−1) or neither.
    pub fn acceleration(&self) -> i32 {
        self.path.acceleration()
    }

    /// The clock at which the line must be advanced: the end of its trains, or the pulse with which an axis
    /// reaches its window's edge. `None` at rest.
    pub fn wake(&self, axes: &[Axis; N]) -> Option<Ticks> {
        let train = self.path.train()?;
        let slots = self.members.iter().zip(axes).filter_map(|(member, axis)| {
            let room = u32::try_from(axis.room(member.direction(train))).ok().filter(|room| *room > 0)?;
            member.slots_to(room, train, self.longest)
        });
        Some(match slots.min() {
            Some(slot) if slot < train.count.into() => train.edge(slot as u32),
            _ => train.end(),
        })
    }

    /// Lets time pass to the end of clock `now`, no further than [`Self::wake`] says; `emit` gets the trains
    /// of the pulses made until then, with the number of their axis, and the axes count them.
    ///
    /// # Panics
    /// If `now` is earlier than the last time, or an axis that takes part moves by itself.
    pub fn advance(&mut self, now: Ticks, axes: &mut [Axis; N], mut emit: impl FnMut(usize, &Train)) {
        let Self { path, longest, members } = self;
        path.advance(now, |train| {
            for (number, (member, axis)) in members.iter_mut().zip(&mut *axes).enumerate() {
                member.follow(train, *longest, |train| {
                    axis.carry(train.direction, train.count);
                    emit(number, train);
                });
            }
        });
    }
}

impl Member {
    /// Which way the axis steps in a train of the path.
    fn direction(&self, path: &Train) -> Direction {
        if path.direction == AHEAD { self.direction } else { self.direction.reversed() }
    }

    /// Slots of the path to this pulse of the axis, from 1; `None` if it takes no part.
    fn slots_to(&self, pulse: u32, path: &Train, longest: u32) -> Option<u64> {
        let (whole, step) = (2 * u64::from(longest), 2 * u64::from(self.way));
        let beyond = self.mirrored(path, longest).beyond;
        (step > 0).then(|| (u64::from(pulse) * whole - beyond).div_ceil(step))
    }

    /// Backward on the path, the same rule holds from the other side.
    fn mirrored(self, path: &Train, longest: u32) -> Self {
        let whole = 2 * u64::from(longest);
        let beyond = if path.direction == AHEAD { self.beyond } else { whole - 1 - self.beyond };
        Self { beyond, ..self }
    }

    /// The trains of the axis in a train of the path.
    fn follow(&mut self, path: &Train, longest: u32, mut emit: impl FnMut(&Train)) {
        let train = Train { direction: self.direction(path), ..*path };
        if self.way == longest {
            return emit(&train);
        }
        if self.way == 0 {
            return;
        }
        *self = self.mirrored(path, longest);
        if self.way < longest / MAX_SLOTS {
            self.follow_rarely(train, longest, emit);
        } else {
            self.follow_often(train, longest, emit);
        }
        *self = self.mirrored(path, longest);
    }

    /// Pulses that are further apart than a mask is long, one by one.
    fn follow_rarely(&mut self, train: Train, longest: u32, mut emit: impl FnMut(&Train)) {
        let (whole, step) = (2 * u64::from(longest), 2 * u64::from(self.way));
        let mut left = u64::from(train.count);
        loop {
            let slots = (whole - self.beyond).div_ceil(step);
            if slots > left {
                self.beyond += left * step;
                break;
            }
            left -= slots;
            self.beyond = self.beyond + slots * step - whole;
            emit(&train.alone(train.count - left as u32));
        }
    }

    /// A mask for every few slots.
    fn follow_often(&mut self, train: Train, longest: u32, mut emit: impl FnMut(&Train)) {
        let (whole, step) = (2 * u64::from(longest), 2 * u64::from(self.way));
        let mut beyond = self.beyond;
        let mut rest = Some(train);
        while let Some(train) = rest {
            let slots;
            (slots, rest) = match train.count {
                ..=MAX_SLOTS => (train, None),
                _ => {
                    let (slots, rest) = train.split(MAX_SLOTS);
                    (slots, Some(rest))
                }
            };
            let mut mask = 0;
            for _ in 0..slots.count {
                let missed = beyond < whole - step;
                beyond = select_unpredictable(missed, beyond + step, beyond.wrapping_sub(whole - step));
                mask = mask << 1 | u64::from(!missed);
            }
            if let Some(train) = slots.masked(mask.reverse_bits() >> (u64::BITS - slots.count)) {
                emit(&train);
            }
        }
        self.beyond = beyond;
    }
}
