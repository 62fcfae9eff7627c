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
        // Digit by digit, in base 2³²: on a chip the whole of it takes many times as long.
        let (dividend, speed) = (1u64 << self.bits, speed as u64);
        let (high, rest) = (dividend / speed, dividend % speed);
        (high << FRACTION_BITS) + (rest << FRACTION_BITS) / speed
    }

    /// The same to 31 bits, for ramps.
    #[inline]
    pub(crate) const fn quick_spacing(self, pace: Pace) -> SubTicks {
        pace.inverse << (self.bits + FRACTION_BITS - 63)
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

/// A speed with what takes long to find from it. A block begins with the pace with which the one before
/// ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Pace {
    pub speed: Speed,
    /// v² itself, of which `speed` may be the rounded root.
    pub squared: SpeedSquared,
    /// 2⁶³ / v; 0 for standstill, and on the way along a foot.
    inverse: u64,
}

impl Pace {
    /// Standstill.
    pub const STILL: Self = Self { speed: 0, squared: 0, inverse: 0 };

    /// The pace of a speed that is not 0.
    pub const fn of(speed: Speed) -> Self {
        Self { speed, squared: square(speed), inverse: (1 << 63) / speed as u64 }
    }

    /// A pace of which only speed and square are needed, unless the ramp goes on otherwise: then it has to be
    /// [completed](Self::complete).
    #[inline]
    pub const fn on_the_way(speed: Speed, squared: SpeedSquared) -> Self {
        Self { speed, squared, inverse: 0 }
    }

    /// The pace of a speed that is not 0, with all that belongs to it.
    #[inline]
    pub const fn complete(self) -> Self {
        if self.inverse == 0 { Self { inverse: (1 << 63) / self.speed as u64, ..self } } else { self }
    }

    /// 2⁶³ / v, 0 for standstill.
    #[inline]
    pub const fn inverse(self) -> u64 {
        self.inverse
    }

    /// The pace of a square that is not 0.
    pub fn of_square(squared: SpeedSquared) -> Self {
        Self { squared, ..Self::of(root(squared)) }
    }

    /// The pace of another square, quickly if it is near.
    #[inline]
    pub fn next(self, squared: SpeedSquared) -> Self {
        if squared == self.squared {
            return self;
        }
        if squared.abs_diff(self.squared) > self.squared >> 5 {
            return Self::of_square(squared);
        }
        // v + h − h²/2v with h = (v₁² − v²)/2v, then Newton's method with the reciprocal of the present
        // speed: every step leaves 1/64 of the error.
        let times_inverse = |value: i64| ((i128::from(value) * i128::from(self.inverse)) >> 64) as i64;
        let first = times_inverse(squared.wrapping_sub(square(self.speed)) as i64);
        let second = times_inverse(first * first);
        let mut speed = u64::from(self.speed).wrapping_add_signed(first - second);
        loop {
            let error = squared.wrapping_sub(speed * speed) as i64;
            if (0..=2 * speed as i64).contains(&error) {
                break;
            }
            let step = times_inverse(error);
            // Rounded down; from below the last step may be 0.
            speed = speed.wrapping_add_signed(if step == 0 { 1 } else { step });
        }
        Self { squared, ..Self::of(speed as Speed) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spacings_are_exact() {
        for bits in 31..=49 {
            let scale = Scale::new(bits);
            for speed in
                [scale.slowest(), scale.slowest() + 1, 1 << 20, 123_456_789, MAX_SPEED - 1, MAX_SPEED]
            {
                let exact = (1u128 << (bits + FRACTION_BITS)) / u128::from(speed);
                assert_eq!(u128::from(scale.spacing(speed)), exact, "{bits} {speed}");
            }
        }
    }

    #[test]
    fn quick_spacings_are_exact_to_31_bits() {
        for bits in [31, 36, 49] {
            let scale = Scale::new(bits);
            for speed in [scale.slowest(), 1 << 20, 123_456_789, MAX_SPEED] {
                let exact = scale.spacing(speed);
                let quick = scale.quick_spacing(Pace::of(speed));
                assert!(exact.abs_diff(quick) <= (exact >> 31) + 1, "{bits} {speed} {exact} {quick}");
                let mean = scale.mean_spacing(speed, speed);
                assert!(exact.abs_diff(mean) <= (exact >> 31) + 1, "{bits} {speed} {exact} {mean}");
            }
        }
    }

    #[test]
    fn the_next_pace_has_the_exact_root() {
        for speed in [2, 3, 100, 65_535, 1 << 20, 123_456_789, MAX_SPEED - 1, MAX_SPEED] {
            let pace = Pace::of(speed);
            let most = pace.squared >> 5;
            for part in 0..=1000u64 {
                let change = (u128::from(most) * u128::from(part) / 1000) as u64;
                for squared in [pace.squared - change, pace.squared + change, pace.squared / 7 + part] {
                    if squared != 0 {
                        assert_eq!(pace.next(squared), Pace::of_square(squared), "{speed} {squared}");
                    }
                }
            }
        }
    }
}
