//! From clocks of a controller to ticks of the board's timer, and back.
//!
//! The two meet at anchors: clocks in which both count whole numbers. From the anchor before, a span is scaled by one
//! multiplication, exact to far less than a tick, and as the anchors themselves are whole numbers nothing adds up.

use crate::segment::{Segment, Spacing};
use motion::train::{EVERY_SLOT, FRACTION_BITS};
use motion::{Moment, Ticks, Train};

/// Bits of fraction of [`Clock::rate`].
const RATE_BITS: u32 = 56;

/// A spacing of so many clocks or more makes a segment of its own, so that scaled ones fit.
const LONG: u64 = 1 << 24;

/// A controller's clock beside the board's timer.
#[derive(Clone, Debug)]
pub(crate) struct Clock {
    /// The shortest time that is a whole number of both.
    clocks: u32,
    ticks: u32,
    /// Ticks a clock, in 2⁻⁵⁶.
    rate: u64,
    anchor: Anchor,
}

/// A clock and the tick with which it begins.
#[derive(Clone, Copy, Debug)]
struct Anchor {
    clock: Ticks,
    tick: u64,
}

impl Clock {
    /// A clock of `clock_hz` that begins with a tick of a timer of `timer_hz`.
    ///
    /// # Panics
    /// If the timer is 256 times as fast or more, or the two have too little in common.
    pub fn new(clock_hz: u32, timer_hz: u32, start: u64) -> Self {
        let common = greatest_common_divisor(clock_hz, timer_hz);
        let (clocks, ticks) = (clock_hz / common, timer_hz / common);
        assert!(u64::from(ticks) < u64::from(clocks) << (u64::BITS - RATE_BITS), "the timer is too fast");
        assert!(clocks.checked_mul(ticks).is_some(), "the clocks meet too seldom");
        let doubled = (u128::from(ticks) << (RATE_BITS + 1)) / u128::from(clocks);
        let rate = doubled.div_ceil(2) as u64;
        Self { clocks, ticks, rate, anchor: Anchor { clock: 0, tick: start } }
    }

    /// The clock stands still for so many ticks.
    pub fn slip(&mut self, ticks: u64) {
        self.anchor.tick += ticks;
    }

    /// Nothing earlier than this clock is asked for any more.
    pub fn move_on(&mut self, clock: Ticks) {
        let gone = u32::try_from(clock - self.anchor.clock).unwrap_or(u32::MAX);
        let periods = u64::from(gone / self.clocks);
        self.anchor.clock += periods * u64::from(self.clocks);
        self.anchor.tick += periods * u64::from(self.ticks);
    }

    /// The clock that is on at a tick; an earlier one if that is very far away.
    pub fn at(&self, tick: u64) -> Ticks {
        let gone = u32::try_from(tick - self.anchor.tick).unwrap_or(u32::MAX);
        let (periods, rest) = (gone / self.ticks, gone % self.ticks);
        let whole = u64::from(periods) * u64::from(self.clocks);
        self.anchor.clock + whole + Ticks::from(rest * self.clocks / self.ticks)
    }

    /// The tick in which a clock begins.
    pub fn tick(&self, clock: Ticks) -> u64 {
        self.moment(Moment::at(clock)).0
    }

    /// The tick of a moment, and what of it has gone in 2⁻³².
    fn moment(&self, moment: Moment) -> (u64, u32) {
        let span =
            self.scale((moment.ticks - self.anchor.clock) << FRACTION_BITS | u64::from(moment.fraction));
        (self.anchor.tick + (span >> FRACTION_BITS), span as u32)
    }

    fn scale(&self, span: u64) -> u64 {
        ((u128::from(span) * u128::from(self.rate)) >> RATE_BITS) as u64
    }

    fn scale_signed(&self, span: i64) -> u64 {
        let scaled = self.scale(span.unsigned_abs());
        if span < 0 { scaled.wrapping_neg() } else { scaled }
    }

    /// The first segment of what is left of a train: all of it, unless there are very long spacings in it.
    pub fn next_segment(&self, left: &mut Option<Train>, order: u16) -> Option<Segment> {
        let train = left.take()?;
        let (first, rest) = if train.count > 1 {
            let (first, rest) = train.split(1);
            (first, Some(rest))
        } else {
            (train, None)
        };
        let (tick, fraction) = self.moment(first.moment(1));
        let at = tick << FRACTION_BITS | u64::from(fraction);
        let alone = Segment { at, order, direction: train.direction, ..Segment::NONE };
        match rest {
            Some(rest) if rest.interval < LONG << FRACTION_BITS => Some(Segment {
                spacing: match (rest.mask, rest.add, rest.jerk) {
                    (EVERY_SLOT, 0, 0) => Spacing::Even,
                    (EVERY_SLOT, ..) => Spacing::Changing,
                    _ => Spacing::Masked,
                },
                interval: self.scale(rest.interval),
                add: self.scale_signed(rest.add),
                jerk: self.scale_signed(rest.jerk),
                mask: rest.mask,
                more: rest.count,
                ..alone
            }),
            rest => {
                *left = rest;
                Some(alone)
            }
        }
    }
}

/// The greatest number that divides both.
const fn greatest_common_divisor(mut a: u32, mut b: u32) -> u32 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}
