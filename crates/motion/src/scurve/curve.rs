//! The curve between two speeds, as a function of the way from its slow end.

use crate::speed::{Growth, Pace, Scale, Speed, root, square};
use crate::train::FRACTION_BITS;
use crate::wide::quotient;

/// A way in 2⁻³² pulses.
pub type Way = u128;

/// A time in 2⁻²⁴ clocks: a curve takes up to 2³⁹ clocks.
pub type Fine = u64;

/// Fraction bits of [`Fine`] and of the speeds inside a bend.
pub const FINE_BITS: u32 = 24;

/// No curve takes longer than 2 to this many clocks; one that should is as steep as it needs to be.
const LONGEST_BITS: u32 = 39;

/// The most steps of Newton's method from a place nearby.
const STEPS: u32 = 5;

/// A step that is the last, 1/16 clock: nearby the next one would be less than 1/64 of it.
const LAST: Fine = 1 << (FINE_BITS - 4);

/// Fraction bits of the share of a bend's time.
const SHARE_BITS: u32 = 62;

/// A jerk-limited change between two speeds, seen from the slow end.
#[derive(Clone, Copy, Debug)]
pub struct Curve {
    scale: Scale,
    growth: Growth,
    low: Speed,
    high: Speed,
    /// Span of speed of one bend, with [`FINE_BITS`] of fraction.
    bend: u64,
    /// Time of one bend.
    bend_time: Fine,
    /// 2¹²⁶ divided by the time of a bend shifted to the top of its word, and the shift.
    inverse: (u64, u32),
    /// Time between the bends.
    straight_time: Fine,
    /// Ways of the slow bend, between, and of the fast bend.
    ways: [Way; 3],
}

/// A place on a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Point {
    /// From the slow end.
    pub time: Fine,
    pub speed: Speed,
}

impl Curve {
    /// From `low` to `high`; empty if there is nothing to climb.
    pub fn new(scale: Scale, growth: Growth, bend: Speed, low: Speed, high: Speed) -> Self {
        let high = high.max(low);
        let span = high - low;
        let bits = scale.bits();
        let steepness = ((u128::from(span) + 2 * u128::from(bend)) << (bits + 1)) >> LONGEST_BITS;
        let growth = growth.max(steepness as u64);
        let over_growth = |speed: u128| quotient(speed << (bits + FINE_BITS + 1), growth.into());
        let short = span / 2 < bend;
        let (bend, bend_time, straight_time) = if short {
            // The time of a bend goes with the root of its span.
            let mean = (u128::from(2 * u64::from(bend) * u64::from(span)) << 32).isqrt();
            (u64::from(span) << (FINE_BITS - 1), (over_growth(mean) >> 16) as u64, 0)
        } else {
            let straight = over_growth(u128::from(span - 2 * bend)) as u64;
            (u64::from(bend) << FINE_BITS, over_growth(2 * u128::from(bend)) as u64, straight)
        };
        let shift = bend_time.max(1).leading_zeros();
        let inverse = quotient(1 << 126, (bend_time.max(1) << shift).into()) as u64;
        let mut curve = Self {
            scale,
            growth,
            low,
            high,
            bend,
            bend_time,
            inverse: (inverse, shift),
            straight_time,
            ways: [0; 3],
        };
        let foot = curve.along(bend_time, u128::from(fine(low) + bend / 3));
        let shoulder = curve.along(bend_time, u128::from(fine(high) - bend / 3));
        let straight = if short {
            0
        } else {
            let [from, to] = curve.straight_ends();
            quotient(u128::from(square(to) - square(from)) << FRACTION_BITS, growth.into())
        };
        curve.ways = [foot, straight, shoulder];
        curve
    }

    /// Speeds at the ends of the bends.
    fn straight_ends(&self) -> [Speed; 2] {
        let bend = (self.bend >> FINE_BITS) as Speed;
        [self.low + bend, self.high - bend]
    }

    /// How far a speed is from the nearer end of the curve.
    pub fn bent_at(&self, speed: Speed) -> Speed {
        speed.saturating_sub(self.low).min(self.high.saturating_sub(speed))
    }

    /// The way that a mean speed makes in a time.
    #[inline]
    fn along(&self, time: Fine, mean: u128) -> Way {
        (u128::from(time) * mean) >> (self.scale.bits() + 2 * FINE_BITS - FRACTION_BITS)
    }

    pub fn way(&self) -> Way {
        self.ways.iter().sum()
    }

    pub fn time(&self) -> Fine {
        2 * self.bend_time + self.straight_time
    }

    /// Way and speed, with its fraction, at a time from the slow end.
    #[inline]
    fn after(&self, time: Fine) -> (Way, u64) {
        let [foot, straight, shoulder] = self.ways;
        if time <= self.bend_time {
            let (base, bent) = (fine(self.low), self.bent(time));
            return (self.along(time, u128::from(base + bent / 3)), base + bent);
        }
        let above = time - self.bend_time;
        if above < self.straight_time {
            let base = fine(self.straight_ends()[0]);
            let gained = ((u128::from(above) * u128::from(self.growth)) >> (self.scale.bits() + 1)) as u64;
            return (foot + self.along(above, u128::from(base + gained / 2)), base + gained);
        }
        let left = self.bend_time - (above - self.straight_time).min(self.bend_time);
        let (base, bent) = (fine(self.high), self.bent(left));
        let way = foot + straight + shoulder - self.along(left, u128::from(base - bent / 3)).min(shoulder);
        (way, base - bent)
    }

    /// The place at a way from the slow end.
    pub fn at(&self, way: Way) -> Point {
        let [foot, straight, shoulder] = self.ways;
        if way < foot {
            return self.on_foot(way);
        }
        let above = way - foot;
        if above < straight {
            return self.on_straight(above);
        }
        let left = shoulder.saturating_sub(above - straight);
        let Point { time, speed } = self.on_shoulder(left);
        Point { time: self.time() - time, speed }
    }

    /// The same, from a place nearby with its way and pace: Newton's method, also for the reciprocal of the
    /// speed, so that nothing is divided.
    #[inline]
    pub fn near(&self, way: Way, from: Way, time: Fine, pace: Pace) -> Point {
        let inverse = u128::from(pace.inverse());
        let shift = 63 + FRACTION_BITS - FINE_BITS - self.scale.bits();
        let time_for = |way: Way, inverse: u128| ((way as i64 as i128 * inverse as i128) >> shift) as i64;
        let mut time = time;
        let mut step = time_for(way.wrapping_sub(from), inverse);
        for _ in 0..STEPS {
            time = time.wrapping_add_signed(step);
            if time > self.time() {
                break;
            }
            let (reached, speed) = self.after(time);
            let ratio = (u128::from(speed) * inverse) >> FINE_BITS;
            // A speed that has changed by more than an eighth is not nearby.
            if ratio.abs_diff(1 << 63) > 1 << 60 {
                break;
            }
            step = time_for(way.wrapping_sub(reached), (inverse * ((1 << 64) - ratio)) >> 63);
            if step.unsigned_abs() <= LAST {
                return Point {
                    time: time.saturating_add_signed(step),
                    speed: (speed >> FINE_BITS) as Speed,
                };
            }
        }
        self.at(way)
    }

    /// The span of speed that a time takes from an end of the curve, with fraction.
    #[inline]
    fn bent(&self, time: Fine) -> u64 {
        let (inverse, shift) = self.inverse;
        let share = (u128::from(time << shift) * u128::from(inverse)) >> 64;
        ((u128::from(self.bend) * ((share * share) >> SHARE_BITS)) >> SHARE_BITS) as u64
    }

    /// The time for a way at a speed.
    #[inline]
    fn time_for(&self, way: Way, speed: u64) -> u128 {
        divide(way << (self.scale.bits() + FINE_BITS - FRACTION_BITS), speed)
    }

    /// The slow bend: way = time · (low + bent/3). Convex, so the method comes down from above the root.
    fn on_foot(&self, way: Way) -> Point {
        let base = fine(self.low);
        let mut time = self.time_for(way, self.low.into()).min(self.longest_foot(way)) as u64;
        loop {
            let bent = self.bent(time);
            let beyond = self.along(time, u128::from(base + bent / 3)).saturating_sub(way);
            let speed = (base + bent) >> FINE_BITS;
            let step = self.time_for(beyond, speed) as u64;
            time -= step.min(time);
            if step <= time >> FINE_BITS {
                return Point { time, speed: speed as Speed };
            }
        }
    }

    /// At least the time that a way takes on the slow bend, if it began at speed 0: a power of two.
    fn longest_foot(&self, way: Way) -> u128 {
        let bend_time = u128::from(self.bend_time);
        let log = |value: u128| value.checked_ilog2().unwrap_or(0) as i32;
        // time³ = 3 · way · bend_time² / bend
        let cube = log(3 * way) + self.scale.bits() as i32 + 2 * log(bend_time) - log(self.bend.into()) + 3;
        let cube = cube + 2 * FINE_BITS as i32 - FRACTION_BITS as i32;
        1u128.checked_shl(cube.max(0) as u32 / 3 + 1).map_or(bend_time, |time| time.min(bend_time))
    }

    /// Between the bends: v² grows evenly.
    fn on_straight(&self, way: Way) -> Point {
        let [from, _] = self.straight_ends();
        let squared = square(from) + ((u128::from(self.growth) * way) >> FRACTION_BITS) as u64;
        let speed = root(squared);
        // The fraction of the root, so that times do not jitter with small accelerations.
        let fraction = ((squared - square(speed)) << FINE_BITS) / (2 * u64::from(speed));
        let gained = fine(speed - from) + fraction;
        let time = divide(u128::from(gained) << (self.scale.bits() + 1), self.growth) as u64;
        Point { time: self.bend_time + time, speed }
    }

    /// The fast bend from its end: way = time · (high − bent/3). Concave: from below the root.
    fn on_shoulder(&self, way: Way) -> Point {
        let base = fine(self.high);
        let mut time = (self.time_for(way, self.high.into()) as u64).min(self.bend_time);
        loop {
            let bent = self.bent(time);
            let short = way.saturating_sub(self.along(time, u128::from(base - bent / 3)));
            let speed = (base - bent) >> FINE_BITS;
            let step = self.time_for(short, speed) as u64;
            let sum = (time + step).min(self.bend_time);
            if step <= time >> FINE_BITS || sum == time {
                return Point { time: sum, speed: speed as Speed };
            }
            time = sum;
        }
    }
}

/// A speed with [`FINE_BITS`] of fraction.
#[inline]
const fn fine(speed: Speed) -> u64 {
    (speed as u64) << FINE_BITS
}

/// Division that is quick where the dividend is small, which it nearly always is.
#[inline]
pub fn divide(dividend: u128, divisor: u64) -> u128 {
    match u64::try_from(dividend) {
        Ok(small) => u128::from(small / divisor),
        Err(_) => quotient(dividend, divisor.into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Shape;

    #[test]
    fn an_s_takes_as_long_as_the_straight_ramp() {
        for bend in [0, 1 << 20, 30 << 20, 49 << 20, 50 << 20, 90 << 20] {
            let [low, high] = [100 << 20, 200 << 20];
            let mean = 1 << 40;
            let scale = Scale::new(40);
            let growth = Shape::s_growth(mean, high - low, bend);
            let bend = bend.min((high - low) / 2);
            let straight = Curve::new(scale, mean, 0, low, high);
            let bent = Curve::new(scale, growth, bend, low, high);
            let duration = straight.time();
            assert!(bent.time().abs_diff(duration) < duration >> 30, "bend {bend}");
            assert!(bent.way().abs_diff(straight.way()) < straight.way() >> 30, "bend {bend}");
            if bend == 50 << 20 {
                assert_eq!(growth, 2 * mean);
            }
        }
    }

    #[test]
    fn the_parts_of_a_curve_meet() {
        for [growth, bend, low, high] in [
            [1 << 40, 20 << 20, 100 << 20, 200 << 20],
            [1 << 30, 1 << 30, 1 << 10, 1 << 30],
            [1, 5, 1 << 10, 1100],
        ] {
            let curve = Curve::new(Scale::new(40), growth, bend as Speed, low as Speed, high as Speed);
            let [foot, straight, _] = curve.ways;
            // The time of twice 2⁻³² pulses at the slow end: once for the step, once for rounding.
            let step = (2 << (40 + FINE_BITS - FRACTION_BITS)) / low + 2;
            for way in [0, foot, foot + straight, curve.way()] {
                let [before, at] = [way.saturating_sub(1), way].map(|way| curve.at(way));
                assert!(at.speed.abs_diff(before.speed) <= 2, "{curve:?} at {way}: {before:?} {at:?}");
                assert!(at.time >= before.time && at.time - before.time <= step, "{curve:?} at {way}");
            }
            assert_eq!(curve.at(0), Point { time: 0, speed: low as Speed });
            assert_eq!(curve.at(curve.way()), Point { time: curve.time(), speed: high as Speed });
        }
    }
}
