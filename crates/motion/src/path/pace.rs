//! The pace of a path: slots instead of pulses.

use crate::plan::{Limits, Shape};
use crate::speed::{MAX_SPEED, Scale, Speed};
use crate::wide::quotient;

/// How many slots a path has for how many pulses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pace {
    /// 2³¹ at the most.
    pub slots: u64,
    /// The same or less, in 2⁻³² pulses; not 0.
    pub length: u64,
}

impl Pace {
    /// A slot for each pulse.
    pub const EVERY_PULSE: Self = Self { slots: 1, length: 1 << 32 };

    /// A speed in pulses, or what else grows with the slots, in slots.
    fn slots(self, pulses: u64) -> u128 {
        let (slots, length) = (u128::from(self.slots) << 32, u128::from(self.length));
        quotient(u128::from(pulses) * slots + length / 2, length)
    }

    /// The speed of an axis in pulses, for the speed of the slots and its share in 2⁻³².
    pub fn pulses(self, slots: u64, share: u64) -> Speed {
        let speed =
            quotient((u128::from(slots) << 8) * u128::from(self.length), u128::from(self.slots) << 32);
        ((speed * u128::from(share) + (1 << 39)) >> 40).min(MAX_SPEED.into()) as Speed
    }

    /// Limits of slots for limits of pulses. The scale is that of the limits, or coarser if that has no such
    /// speeds; no path goes faster than a slot in two clocks.
    pub fn limits(self, limits: Limits) -> Limits {
        let fastest = self.slots(limits.top.max(limits.start).max(limits.stop).into());
        let mut down = 0;
        while fastest >> down > MAX_SPEED.into() && limits.scale.bits() - down > 31 {
            down += 1;
        }
        let speed = |speed: Speed| (self.slots(speed.into()) >> down).min(MAX_SPEED.into()) as Speed;
        // A growth is a square of speeds by pulses.
        let growth = |growth| (self.slots(growth) >> (2 * down)).min(u64::MAX.into()) as u64;
        Limits {
            scale: Scale::new(limits.scale.bits() - down),
            top: speed(limits.top),
            start: speed(limits.start),
            stop: speed(limits.stop),
            growth: growth(limits.growth),
            fall: growth(limits.fall),
            shape: match limits.shape {
                Shape::SCurve { bend } => Shape::SCurve { bend: speed(bend) },
                shape => shape,
            },
        }
    }
}
