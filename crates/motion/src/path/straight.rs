//! An axis that goes evenly with the slots of its path.
//!
//! It steps in those slots in which its ideal position comes nearest to the next one (Bresenham's rule, in
//! whole numbers).

use crate::speed::{MAX_SPEED, Speed};
use crate::train::{Direction, MAX_SLOTS, Train};
use core::hint::select_unpredictable;

/// What the axis does on the way.
#[derive(Clone, Copy, Debug)]
pub struct Straight {
    /// How many pulses, in how many slots, and which way.
    way: u32,
    slots: u32,
    direction: Direction,
    /// By how much the ideal position is beyond the middle between the last pulse and the one before, in parts
    /// of a pulse: twice the slots. 0 to one less than a pulse.
    beyond: u64,
}

impl Straight {
    /// A way that takes so many slots: as many as pulses, or more.
    pub fn new(way: i32, slots: u32) -> Self {
        let direction = Direction::of(way.into());
        Self { way: way.unsigned_abs(), slots, direction, beyond: slots.into() }
    }

    /// Whether the axis moves at all.
    pub fn moves(&self) -> bool {
        self.way != 0
    }

    /// Which way, forward on the path or backward.
    pub fn direction(&self, ahead: bool) -> Direction {
        if ahead { self.direction } else { self.direction.reversed() }
    }

    /// The speed of the axis, for the speed of the slots.
    pub fn speed(&self, slots: u64) -> Speed {
        let all = u64::from(self.slots.max(1));
        let speed = (u128::from(slots) * u128::from(self.way) + u128::from(all / 2)) / u128::from(all);
        speed.min(MAX_SPEED.into()) as Speed
    }

    /// A pulse, and what a slot adds to it.
    fn parts(&self) -> [u64; 2] {
        [self.slots, self.way].map(|parts| 2 * u64::from(parts))
    }

    /// Slots of the path to this pulse of the axis, from 1; `None` if it takes no part.
    pub fn slots_to(&self, pulse: u32, ahead: bool) -> Option<u64> {
        let [whole, step] = self.parts();
        let beyond = self.mirrored(ahead).beyond;
        (step > 0).then(|| (u64::from(pulse) * whole - beyond).div_ceil(step))
    }

    /// Backward on the path, the same rule holds from the other side.
    fn mirrored(self, ahead: bool) -> Self {
        let [whole, _] = self.parts();
        let beyond = if ahead { self.beyond } else { whole - 1 - self.beyond };
        Self { beyond, ..self }
    }

    /// The trains of the axis in a train of the path.
    pub fn follow(&mut self, path: &Train, ahead: bool, mut emit: impl FnMut(&Train)) {
        let train = Train { direction: self.direction(ahead), ..*path };
        if self.way == 0 {
            return;
        }
        if self.way == self.slots {
            return emit(&train);
        }
        *self = self.mirrored(ahead);
        if self.way < self.slots / MAX_SLOTS {
            self.follow_rarely(train, emit);
        } else {
            self.follow_often(train, emit);
        }
        *self = self.mirrored(ahead);
    }

    /// Pulses that are further apart than a mask is long, one by one.
    fn follow_rarely(&mut self, train: Train, mut emit: impl FnMut(&Train)) {
        let [whole, step] = self.parts();
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
    fn follow_often(&mut self, train: Train, mut emit: impl FnMut(&Train)) {
        let [whole, step] = self.parts();
        let mut beyond = self.beyond;
        let mut rest = Some(train);
        while let Some(train) = rest {
            let slots;
            (slots, rest) = train.first_slots();
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
