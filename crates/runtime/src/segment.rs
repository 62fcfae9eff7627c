//! A train as the player takes it: its first pulse, and the spacings after that, in timer ticks.

use motion::Direction;
use motion::train::EVERY_SLOT;

/// The pulses of a train. Two additions of 64 bits lead from one to the next, three where spacings change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Segment {
    /// When the first pulse is due: the tick in the upper half, which wraps, its fraction in the lower.
    pub at: u64,
    /// From there to the next slot, in 2⁻³² ticks.
    pub interval: u64,
    /// How much the spacing after that is longer; wraps.
    pub add: u64,
    /// How much `add` grows.
    pub jerk: u64,
    /// Which of the slots after the first pulse have one, or [`EVERY_SLOT`].
    pub mask: u64,
    /// Pulses after the first.
    pub more: u32,
    /// How many events were queued before it: they happen first.
    pub order: u16,
    /// Which way.
    pub direction: Direction,
}

impl Segment {
    /// No pulses.
    pub const NONE: Self = Self {
        at: 0,
        interval: 0,
        add: 0,
        jerk: 0,
        mask: EVERY_SLOT,
        more: 0,
        order: 0,
        direction: Direction::Positive,
    };

    /// The tick of the pulse that is next.
    #[inline]
    pub fn due(&self) -> u32 {
        (self.at >> 32) as u32
    }

    /// On to the pulse after it; false if there is none.
    #[inline]
    pub fn go_on(&mut self) -> bool {
        if self.more == 0 {
            return false;
        }
        self.more -= 1;
        self.slot();
        if self.mask != EVERY_SLOT {
            // The lowest bit belongs to the slot just reached. There is a pulse left, so there is a bit.
            while self.mask & 1 == 0 {
                self.mask >>= 1;
                self.slot();
            }
            self.mask >>= 1;
        }
        true
    }

    #[inline]
    fn slot(&mut self) {
        self.at = self.at.wrapping_add(self.interval);
        self.interval = self.interval.wrapping_add(self.add);
        self.add = self.add.wrapping_add(self.jerk);
    }
}
