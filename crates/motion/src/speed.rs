//! The units of speed and acceleration inside the kernel.
//!
//! A ramp with constant acceleration is not linear in time for whoever counts pulses, but the square of
//! its speed is: v² grows by 2a with every pulse. The kernel therefore keeps v² and adds. That is exact
//! in integers, needs no clock, and lets a braking ramp be a straight line through its target: it ends
//! there at the stop speed, to the pulse.

use crate::train::{FRACTION_BITS, SubTicks};

/// A speed: pulses a clock, times 2^[`Scale::bits`]. Below 2³¹.
pub type Speed = u32;

/// The square of a [`Speed`].
pub type SpeedSquared = u64;

/// The largest [`Speed`].
pub const MAX_SPEED: Speed = (1 << 31) - 1;

/// Acceleration, as the growth of [`SpeedSquared`] with each pulse (2a). Not 0; more than
/// [`MAX_GROWTH`] means the same as that: any speed within one pulse.
pub type Growth = u64;

/// The largest [`Growth`] that makes a difference.
pub const MAX_GROWTH: Growth = 1 << 62;

/// How many fraction bits a speed has: the same number means another speed in another scale.
///
/// Between 31 and 49: 31 is half a pulse a clock at the most, 49 a pulse in 2³⁰ clocks at a speed of 2¹⁹.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scale {
    bits: u32,
}

impl Scale {
    /// A scale with this many fraction bits.
    ///
    /// # Panics
    /// Outside 31 to 49.
    pub const fn new(bits: u32) -> Self {
        assert!(bits >= 31 && bits <= 49, "speed scale out of range");
        Self { bits }
    }

    /// The number of fraction bits.
    pub const fn bits(self) -> u32 {
        self.bits
    }

    /// The slowest speed whose spacing still fits a train.
    pub const fn slowest(self) -> Speed {
        if self.bits <= 30 { 1 } else { 1 << (self.bits - 30) }
    }

    /// The spacing of pulses at a speed, exact.
    pub const fn spacing(self, speed: Speed) -> SubTicks {
        ((1u128 << (self.bits + FRACTION_BITS)) / speed as u128) as u64
    }

    /// The same to 31 bits, for ramps, where it is needed once a block.
    #[inline]
    pub(crate) const fn quick_spacing(self, speed: Speed) -> SubTicks {
        ((1u64 << 63) / speed as u64) << (self.bits + FRACTION_BITS - 63)
    }

    /// Mean spacing of a stretch that begins and ends at these speeds with constant acceleration.
    #[inline]
    pub(crate) const fn mean_spacing(self, from: Speed, to: Speed) -> SubTicks {
        ((1u64 << 63) / (from as u64 + to as u64)) << (self.bits + FRACTION_BITS - 62)
    }

    /// A speed in thousandths of a pulse a second.
    pub const fn millipulses_per_second(self, speed: Speed, clock_hz: u32) -> u64 {
        ((speed as u128 * clock_hz as u128 * 1000) >> self.bits) as u64
    }
}

/// The square of a speed.
#[inline]
pub const fn square(speed: Speed) -> SpeedSquared {
    speed as u64 * speed as u64
}

/// The speed whose square it is, rounded down.
#[inline]
pub fn root(squared: SpeedSquared) -> Speed {
    squared.isqrt() as Speed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quick_spacings_are_exact_to_31_bits() {
        for bits in [31, 36, 49] {
            let scale = Scale::new(bits);
            for speed in [scale.slowest(), 1 << 20, 123_456_789, MAX_SPEED] {
                let exact = scale.spacing(speed);
                let quick = scale.quick_spacing(speed);
                assert!(exact.abs_diff(quick) <= (exact >> 31) + 1, "{bits} {speed} {exact} {quick}");
                let mean = scale.mean_spacing(speed, speed);
                assert!(exact.abs_diff(mean) <= (exact >> 31) + 1, "{bits} {speed} {exact} {mean}");
            }
        }
    }
}
