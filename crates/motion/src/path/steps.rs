//! What an axis does on a circle in up to 64 slots.

use crate::train::{Direction, Train};

/// A bit for each slot: whether the axis steps, and which way.
#[derive(Clone, Copy, Debug, Default)]
pub struct Steps {
    pub some: u64,
    pub negative: u64,
}

impl Steps {
    /// Adds a step of −1, 0 or 1.
    #[inline]
    pub fn step(&mut self, bit: u32, way: i64) {
        assert!((-1..=1).contains(&way), "a step is a pulse or none");
        self.some |= (way as u64 & 1) << bit;
        self.negative |= (way as u64 >> 63) << bit;
    }

    /// The same steps the other way.
    pub fn reversed(self) -> Self {
        Self { negative: self.some & !self.negative, ..self }
    }

    /// The trains of these slots: more than one where the axis turns back.
    pub fn emit(self, slots: &Train, mut emit: impl FnMut(&Train)) {
        let (mut slots, Self { mut some, mut negative }) = (*slots, self);
        while some != 0 {
            let back = negative >> some.trailing_zeros() & 1 == 1;
            let direction = if back { Direction::Negative } else { Direction::Positive };
            let turn = (if back { some & !negative } else { some & negative }).trailing_zeros();
            let part = Train { direction, ..slots };
            if turn == u64::BITS {
                return part.masked(some).iter().for_each(emit);
            }
            let (before, after) = part.split(turn);
            before.masked(some & ((1 << turn) - 1)).iter().for_each(&mut emit);
            (slots, some, negative) = (after, some >> turn, negative >> turn);
        }
    }
}
