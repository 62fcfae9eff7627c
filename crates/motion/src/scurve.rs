//! Jerk-limited ramps: the curve between two speeds, and the course of a motion made of two of them.
//!
//! On an S the acceleration rises evenly in time from 0 to its peak, may stay there, and falls evenly to
//! 0. What bounds it is the peak (the growth of the limits) and the jerk, which is given by the bend: the
//! span of speed over which the acceleration rises from 0 to the peak. A curve of less than two bends
//! keeps the jerk and never reaches the peak, so a short move is gentler, not shorter of breath.
//!
//! An S depends on where it began, so unlike the other shapes it has a memory, the [`Course`]. The lead
//! takes the present speed to that of the cruise, the tail takes it to the stop speed and is fixed at
//! the target: it is the same curve read backward from there, so it ends on the pulse.
//!
//! Everything is a function of the way. A bend is a cubic in time; Newton's method inverts it in a few
//! multiplications. The times of all pulses are thus those of one curve, however it is cut into blocks.

use crate::block::block_length;
use crate::plan::{Kind, Limits, Now, Piece, Wish, longest_cruise};
use crate::speed::{Growth, Scale, Speed, root, square};
use crate::train::{FRACTION_BITS, SubTicks};

/// A way in 2⁻³² pulses.
type Way = u128;

/// A time in 2⁻²⁴ clocks: a curve takes up to 2³⁹ clocks.
type Fine = u64;

/// Fraction bits of [`Fine`] and of the speeds inside a bend.
const FINE_BITS: u32 = 24;

/// No curve takes longer than 2 to this many clocks; one that should is as steep as it needs to be.
const LONGEST_BITS: u32 = 39;

/// Fraction bits of the share of a bend's time.
const SHARE_BITS: u32 = 62;

/// No end in sight.
const ENDLESS: Way = Way::MAX;

/// A jerk-limited change between two speeds, seen from the slow end.
#[derive(Clone, Copy, Debug)]
struct Curve {
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
struct Point {
    /// From the slow end.
    time: Fine,
    speed: Speed,
}

impl Curve {
    /// From `low` to `high`; empty if there is nothing to climb.
    fn new(scale: Scale, growth: Growth, bend: Speed, low: Speed, high: Speed) -> Self {
        let high = high.max(low);
        let span = high - low;
        let bits = scale.bits();
        let steepness = ((u128::from(span) + 2 * u128::from(bend)) << (bits + 1)) >> LONGEST_BITS;
        let growth = growth.max(steepness as u64);
        let over_growth = |speed: u128| (speed << (bits + FINE_BITS + 1)) / u128::from(growth);
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
        let inverse = ((1u128 << 126) / u128::from(bend_time.max(1) << shift)) as u64;
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
            (u128::from(square(to) - square(from)) << FRACTION_BITS) / u128::from(growth)
        };
        curve.ways = [foot, straight, shoulder];
        curve
    }

    /// Speeds at the ends of the bends.
    fn straight_ends(&self) -> [Speed; 2] {
        let bend = (self.bend >> FINE_BITS) as Speed;
        [self.low + bend, self.high - bend]
    }

    /// The way that a mean speed makes in a time.
    #[inline]
    fn along(&self, time: Fine, mean: u128) -> Way {
        (u128::from(time) * mean) >> (self.scale.bits() + 2 * FINE_BITS - FRACTION_BITS)
    }

    fn way(&self) -> Way {
        self.ways.iter().sum()
    }

    fn time(&self) -> Fine {
        2 * self.bend_time + self.straight_time
    }

    /// The place at a way from the slow end.
    fn at(&self, way: Way) -> Point {
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
fn divide(dividend: u128, divisor: u64) -> u128 {
    match u64::try_from(dividend) {
        Ok(small) => u128::from(small / divisor),
        Err(_) => dividend / u128::from(divisor),
    }
}

/// A motion along S-curves, from the speed at which it was planned.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Course {
    limits: Limits,
    wish: Wish,
    /// From the first speed to that of the cruise.
    lead: Curve,
    /// Whether the lead slows down.
    falls: bool,
    cruise: Speed,
    /// From the speed of the cruise down to the stop speed.
    tail: Curve,
    /// Where the tail ends.
    end: Way,
    /// Where the next pulse is.
    next: Way,
    /// The place of the pulse before it.
    here: Place,
    /// What the last train was too short.
    carry: i64,
}

/// A place on a course: how much of each part lies behind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Place {
    way: Way,
    lead: Fine,
    cruised: Way,
    tail: Fine,
    speed: Speed,
}

impl Course {
    /// The course that fulfils a wish; `None` if the axis may stand still now. A target that is too near
    /// for the present speed is passed: the course brakes.
    pub(crate) fn new(limits: &Limits, bend: Speed, now: Now, wish: Wish) -> Option<Self> {
        match wish {
            Wish::To(pulses) => {
                Self::toward(limits, bend, now, pulses).or_else(|| Self::brake(limits, bend, now))
            }
            Wish::Speed(speed) => {
                let from = root(now.squared);
                Some(Self::of(limits, bend, wish, now, [from, speed, speed], ENDLESS))
            }
            Wish::Brake => Self::brake(limits, bend, now),
        }
    }

    fn toward(limits: &Limits, bend: Speed, now: Now, pulses: u64) -> Option<Self> {
        let from = root(now.squared);
        let end = (Way::from(pulses - 1) << FRACTION_BITS) + Way::from(now.rest);
        let way = |low, high| Curve::new(limits.scale, limits.growth, bend, low, high).way();
        if way(limits.stop, from) > end {
            return None;
        }
        let fits = |cruise: Speed| way(from.min(cruise), from.max(cruise)) + way(limits.stop, cruise) <= end;
        let cruise = if fits(limits.top) {
            limits.top
        } else if from > limits.top {
            // No room to slow down twice.
            from
        } else {
            highest(from, limits.top, fits)
        };
        Some(Self::of(limits, bend, Wish::To(pulses), now, [from, cruise, limits.stop.min(cruise)], end))
    }

    /// To standstill on the first pulse that is possible.
    fn brake(limits: &Limits, bend: Speed, now: Now) -> Option<Self> {
        let from = root(now.squared);
        if from <= limits.stop {
            return None;
        }
        let way = Curve::new(limits.scale, limits.growth, bend, limits.stop, from).way();
        let rest = Way::from(now.rest);
        let pulses = way.saturating_sub(rest).div_ceil(1 << FRACTION_BITS);
        let end = rest + (pulses << FRACTION_BITS);
        Some(Self::of(limits, bend, Wish::Brake, now, [from, from, limits.stop], end))
    }

    fn of(limits: &Limits, bend: Speed, wish: Wish, now: Now, speeds: [Speed; 3], end: Way) -> Self {
        let [from, cruise, last] = speeds;
        let curve = |low, high| Curve::new(limits.scale, limits.growth, bend, low, high);
        let falls = cruise < from;
        Self {
            limits: *limits,
            wish,
            lead: if falls { curve(cruise, from) } else { curve(from, cruise) },
            falls,
            cruise,
            tail: curve(last, cruise),
            end,
            next: Way::from(now.rest),
            here: Place { way: 0, lead: 0, cruised: 0, tail: 0, speed: from },
            carry: 0,
        }
    }

    /// Whether the course is also that of this wish within these limits, so that it may go on.
    pub(crate) fn serves(&self, limits: &Limits, bend: Speed, now: Now, wish: Wish) -> bool {
        let own = Limits { top: limits.top, start: limits.start, ..self.limits };
        own == *limits
            && match (self.wish, wish) {
                (Wish::Brake, Wish::Brake) => true,
                (Wish::Brake, Wish::To(pulses)) => Self::toward(limits, bend, now, pulses).is_none(),
                (Wish::Speed(own), Wish::Speed(other)) => own == other,
                (Wish::To(_), Wish::To(pulses)) => {
                    let slowing = self.next > self.end - self.tail.way();
                    self.end == self.next + (Way::from(pulses - 1) << FRACTION_BITS)
                        && (slowing || limits.top == self.limits.top)
                }
                _ => false,
            }
    }

    /// Pulses were made.
    pub(crate) fn pass(&mut self, pulses: u32) {
        self.next = self.next.saturating_add(Way::from(pulses) << FRACTION_BITS);
    }

    /// The speed at one of the pulses to come; 1 is the next.
    pub(crate) fn speed_at(&self, pulse: u32) -> Speed {
        self.place(self.ahead(pulse)).speed
    }

    /// The last train should have taken this longer.
    pub(crate) fn carry(&mut self, span: i64) {
        self.carry = span;
    }

    /// The next piece; `None` at the end.
    pub(crate) fn piece(&mut self, rest: u64) -> Option<Piece> {
        if self.next > self.end {
            return None;
        }
        let from = self.next - Way::from(rest);
        let whole = rest == 1 << FRACTION_BITS;
        let pulses_until = |way: Way| ((way - from) >> FRACTION_BITS).min(u32::MAX.into()) as u32;
        let [climbed, slowing] = [self.lead.way(), self.end - self.tail.way()];
        let count = if !whole {
            1
        } else if from < climbed {
            pulses_until(climbed).min(self.longest(from, self.falls))
        } else if from + (1 << FRACTION_BITS) <= slowing {
            let count = pulses_until(slowing).min(longest_cruise(self.limits.scale, self.cruise));
            return Some(Piece { count, end: square(self.cruise), kind: Kind::Cruise });
        } else if from >= slowing {
            pulses_until(self.end).min(self.longest(from, true))
        } else {
            1
        };
        let count = if count < 2 { 1 } else { 1 << count.ilog2() };
        let start = self.place(from);
        let end = self.place(self.ahead(count));
        self.here = end;
        let duration = self.between(&start, &end).saturating_add_signed(core::mem::take(&mut self.carry));
        Some(Piece { count, end: square(end.speed), kind: Kind::Curve(duration.max(1)) })
    }

    /// The longest block from here.
    fn longest(&self, from: Way, falls: bool) -> u32 {
        let squared = square(self.place(from).speed);
        let slow_end = if falls { squared - (squared >> 4) } else { squared };
        block_length(slow_end, self.limits.growth).min(longest_cruise(self.limits.scale, root(slow_end)))
    }

    fn ahead(&self, pulse: u32) -> Way {
        self.next.saturating_add(Way::from(pulse - 1) << FRACTION_BITS)
    }

    fn place(&self, way: Way) -> Place {
        if way == self.here.way {
            return self.here;
        }
        let [climbed, slowing] = [self.lead.way(), self.end - self.tail.way()];
        let mut place = Place {
            way,
            lead: self.lead.time(),
            cruised: way.clamp(climbed, slowing) - climbed,
            tail: 0,
            speed: self.cruise,
        };
        if way < climbed {
            let point = self.lead.at(if self.falls { climbed - way } else { way });
            place.lead = if self.falls { place.lead - point.time } else { point.time };
            place.speed = point.speed;
        } else if way > slowing {
            let point = self.tail.at(self.end.saturating_sub(way));
            place.tail = self.tail.time() - point.time;
            place.speed = point.speed;
        }
        place
    }

    fn between(&self, from: &Place, to: &Place) -> SubTicks {
        let curves = (to.lead - from.lead) + (to.tail - from.tail);
        let cruised = (to.cruised - from.cruised) << self.limits.scale.bits();
        (curves << (FRACTION_BITS - FINE_BITS)) + divide(cruised, self.cruise.into()) as u64
    }
}

/// The greatest speed, but for 1/1024, that fits, between one that does and one that does not.
fn highest(mut fits_at: Speed, mut too_fast: Speed, fits: impl Fn(Speed) -> bool) -> Speed {
    while too_fast - fits_at > 1 + (fits_at >> 10) {
        let middle = fits_at + (too_fast - fits_at) / 2;
        if fits(middle) { fits_at = middle } else { too_fast = middle }
    }
    fits_at
}

/// The speed at which a motion over so many pulses may begin: the start speed, unless the axis could not
/// stop from it in time.
pub(crate) fn entry(limits: &Limits, bend: Speed, pulses: u64) -> Speed {
    let start = limits.start.min(limits.top);
    let end = Way::from(pulses) << FRACTION_BITS;
    let fits = |speed| Curve::new(limits.scale, limits.growth, bend, limits.stop, speed).way() <= end;
    if start <= limits.stop || fits(start) { start } else { highest(limits.stop, start, fits) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::{Axis, Goal};
    use crate::plan::Shape;
    use crate::train::{Direction, Train};

    const CLOCK_HZ: f64 = 19_660_800.0;

    /// Limits of a ramp in pulses a second and a second.
    #[derive(Clone, Copy, Debug)]
    struct Ramp {
        start: f64,
        stop: f64,
        top: f64,
        acceleration: f64,
        bend: f64,
    }

    impl Ramp {
        /// Fraction bits that leave the top speed just below the largest.
        fn bits(self) -> u32 {
            (31 + (CLOCK_HZ / self.top).log2() as u32).min(49)
        }

        /// Kernel speed in a pulse a second.
        fn unit(self) -> f64 {
            2f64.powi(self.bits() as i32) / CLOCK_HZ
        }

        fn limits(self) -> Limits {
            let speed = |pps: f64| (pps * self.unit()) as Speed;
            Limits {
                scale: Scale::new(self.bits()),
                top: speed(self.top),
                start: speed(self.start),
                stop: speed(self.stop),
                growth: (2.0 * self.acceleration * self.unit().powi(2)) as Growth,
                shape: Shape::SCurve { bend: speed(self.bend) },
            }
        }

        fn jerk(self) -> f64 {
            self.acceleration * self.acceleration / (2.0 * self.bend)
        }

        /// Seconds from one speed to another.
        fn time(self, from: f64, to: f64) -> f64 {
            let span = (to - from).abs();
            if span >= 2.0 * self.bend {
                (span + 2.0 * self.bend) / self.acceleration
            } else {
                2.0 * (span / self.jerk()).sqrt()
            }
        }

        fn way(self, from: f64, to: f64) -> f64 {
            (from + to) / 2.0 * self.time(from, to)
        }

        /// Way made `t` seconds into the ramp from one speed to another, by the laws of motion.
        fn way_at(self, from: f64, to: f64, t: f64) -> f64 {
            let (sign, total, jerk) = ((to - from).signum(), self.time(from, to), self.jerk());
            let bend = (self.acceleration / jerk).min(total / 2.0);
            let peak = jerk * bend;
            let first = |t: f64| from * t + sign * jerk * t.powi(3) / 6.0;
            let second = |t: f64| {
                let v = from + sign * jerk * bend * bend / 2.0;
                first(bend) + v * (t - bend) + sign * peak * (t - bend).powi(2) / 2.0
            };
            if t < bend {
                first(t)
            } else if t < total - bend {
                second(t)
            } else {
                let left = total - t;
                self.way(from, to) - (to * left - sign * jerk * left.powi(3) / 6.0)
            }
        }

        /// Seconds from the beginning of a move to pulse `k`, with the top speed `peak`.
        fn pulse(self, distance: f64, peak: f64, k: f64) -> f64 {
            let [lead, tail] = [self.way(self.start, peak), self.way(peak, self.stop)];
            let lead_time = self.time(self.start, peak);
            let cruise_time = (distance - lead - tail) / peak;
            if k <= lead {
                solve(lead_time, k, |t| self.way_at(self.start, peak, t))
            } else if k <= distance - tail {
                lead_time + (k - lead) / peak
            } else {
                let tail_time = self.time(peak, self.stop);
                lead_time
                    + cruise_time
                    + solve(tail_time, k - (distance - tail), |t| self.way_at(peak, self.stop, t))
            }
        }
    }

    fn solve(longest: f64, wanted: f64, way: impl Fn(f64) -> f64) -> f64 {
        let (mut low, mut high) = (0.0, longest);
        for _ in 0..60 {
            let middle = (low + high) / 2.0;
            if way(middle) < wanted { low = middle } else { high = middle }
        }
        high
    }

    /// Lets an axis run to its end; gives the clocks of its pulses with their fractions and directions.
    fn finish(axis: &mut Axis) -> Vec<(f64, Direction)> {
        let mut pulses = Vec::new();
        let mut wakes = 0;
        while let Some(wake) = axis.wake() {
            axis.advance(wake, |train| collect(train, &mut pulses));
            wakes += 1;
            assert!(wakes < 100_000, "no end in sight");
        }
        pulses
    }

    fn collect(train: &Train, pulses: &mut Vec<(f64, Direction)>) {
        for k in 1..=train.count {
            let moment = train.moment(k);
            let clock = moment.ticks as f64 + f64::from(moment.fraction) / 2f64.powi(32);
            pulses.push((clock, train.direction));
        }
    }

    fn run(ramp: Ramp, target: i32) -> Vec<f64> {
        let mut axis = Axis::new(ramp.limits());
        axis.set_goal(Goal::Position(target));
        let pulses = finish(&mut axis);
        assert_eq!(axis.position(), target, "{ramp:?}");
        assert_eq!(pulses.len(), target.unsigned_abs() as usize, "{ramp:?} to {target}: no detours");
        pulses.into_iter().map(|(clock, _)| clock - 1.0).collect()
    }

    /// Every pulse against the laws of motion.
    fn check_full(ramp: Ramp, target: i32) {
        let pulses = run(ramp, target);
        let distance = f64::from(target.unsigned_abs());
        assert!(
            ramp.way(ramp.start, ramp.top) + ramp.way(ramp.top, ramp.stop) <= distance,
            "reaches its top"
        );
        let mut worst = 0f64;
        for (k, clock) in (1..).zip(&pulses) {
            let expected = ramp.pulse(distance, ramp.top, f64::from(k)) * CLOCK_HZ;
            worst = worst.max((clock - expected).abs());
        }
        println!("{ramp:?} {target}: {worst}");
        assert!(worst < 1.0, "{ramp:?} to {target}: off by {worst} clocks");
    }

    const TYPICAL: Ramp =
        Ramp { start: 200.0, stop: 100.0, top: 20_000.0, acceleration: 100_000.0, bend: 4000.0 };

    #[test]
    fn every_pulse_is_where_the_laws_of_motion_put_it() {
        check_full(TYPICAL, 20_000);
        check_full(TYPICAL, -12_345);
        check_full(Ramp { bend: 9900.0, ..TYPICAL }, 20_000);
        check_full(Ramp { bend: 30_000.0, ..TYPICAL }, 40_000);
        check_full(Ramp { top: 4_000_000.0, acceleration: 30e6, bend: 1e6, ..TYPICAL }, 2_000_000);
        check_full(Ramp { start: 1.0, stop: 1.0, top: 300.0, acceleration: 50.0, bend: 100.0 }, 4000);
        check_full(Ramp { start: 5000.0, stop: 5000.0, top: 5000.0, acceleration: 1e5, bend: 1e3 }, 5000);
    }
}
