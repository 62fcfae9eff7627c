//! A train as the player takes it: its first pulse, and the spacings after that, in timer ticks.

use motion::Direction;

/// How the pulses of a segment are found, so that no more is added up than has to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Spacing {
    /// All spacings are the same.
    Even,
    /// They change.
    Changing,
    /// They change, and not every slot has a pulse.
    Masked,
}

/// The pulses of a train. One addition of 64 bits leads from one to the next, three where spacings change.
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
    /// Which of the slots after the first pulse have one, if not all do.
    pub mask: u64,
    /// Pulses after the first.
    pub more: u32,
    /// How many events were queued before it: they happen first.
    pub order: u16,
    /// Which way.
    pub direction: Direction,
    /// What of the above counts.
    pub spacing: Spacing,
}

impl Segment {
    /// No pulses.
    pub const NONE: Self = Self {
        at: 0,
        interval: 0,
        add: 0,
        jerk: 0,
        mask: 0,
        more: 0,
        order: 0,
        direction: Direction::Positive,
        spacing: Spacing::Even,
    };

    /// The tick of the pulse that is next.
    #[inline]
    pub fn due(&self) -> u32 {
        (self.at >> 32) as u32
    }

    /// On to the pulse after it; false if there is none.
    #[inline]
    pub fn go_on(&mut self) -> bool {
        let Some(more) = self.more.checked_sub(1) else { return false };
        self.more = more;
        self.at = self.at.wrapping_add(self.interval);
        match self.spacing {
            Spacing::Even => {}
            Spacing::Changing => self.change(),
            Spacing::Masked => self.skip(),
        }
        true
    }

    /// What a slot does to the spacings.
    #[inline]
    fn change(&mut self) {
        self.interval = self.interval.wrapping_add(self.add);
        self.add = self.add.wrapping_add(self.jerk);
    }

    /// The same, and on over slots without a pulse. The lowest bit of the mask belongs to the slot that was reached.
    #[inline(never)]
    fn skip(&mut self) {
        assert!(self.mask != 0, "there is a pulse left, so there is a bit");
        self.change();
        while self.mask & 1 == 0 {
            self.mask >>= 1;
            self.at = self.at.wrapping_add(self.interval);
            self.change();
        }
        self.mask >>= 1;
    }
}
