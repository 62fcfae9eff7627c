//! Whole motions against the laws of motion in floating point.

use crate::axis::{Axis, Goal, Stop};
use crate::plan::{Limits, Shape};
use crate::speed::{Growth, MAX_SPEED, Scale, Speed};
use crate::train::{Direction, Train};

const CLOCK_HZ: f64 = 19_660_800.0;

/// Limits of a ramp in pulses a second and a second.
#[derive(Clone, Copy, Debug)]
struct Ramp {
    start: f64,
    stop: f64,
    top: f64,
    acceleration: f64,
    deceleration: f64,
    bend: f64,
}

impl Ramp {
    /// The most fraction bits with which all speeds fit.
    fn bits(self) -> u32 {
        (31 + (CLOCK_HZ / self.top.max(self.bend)).log2() as u32).min(49)
    }

    /// Kernel speed in a pulse a second.
    fn unit(self) -> f64 {
        2f64.powi(self.bits() as i32) / CLOCK_HZ
    }

    fn limits(self) -> Limits {
        let speed = |pps: f64| (pps * self.unit()) as Speed;
        let growth = |rate: f64| (2.0 * rate * self.unit().powi(2)) as Growth;
        Limits {
            scale: Scale::new(self.bits()),
            top: speed(self.top),
            start: speed(self.start),
            stop: speed(self.stop),
            growth: growth(self.acceleration),
            fall: growth(self.deceleration),
            shape: Shape::SCurve { bend: speed(self.bend) },
        }
    }

    /// The peak of the acceleration from one speed to another.
    fn rate(self, from: f64, to: f64) -> f64 {
        if to > from { self.acceleration } else { self.deceleration }
    }

    fn jerk(self, rate: f64) -> f64 {
        rate * rate / (2.0 * self.bend)
    }

    /// Seconds from one speed to another.
    fn time(self, from: f64, to: f64) -> f64 {
        let (span, rate) = ((to - from).abs(), self.rate(from, to));
        if span >= 2.0 * self.bend {
            (span + 2.0 * self.bend) / rate
        } else {
            2.0 * (span / self.jerk(rate)).sqrt()
        }
    }

    fn way(self, from: f64, to: f64) -> f64 {
        (from + to) / 2.0 * self.time(from, to)
    }

    /// Way made `t` seconds into the ramp from one speed to another, by the laws of motion.
    fn way_at(self, from: f64, to: f64, t: f64) -> f64 {
        let (sign, total, rate) = ((to - from).signum(), self.time(from, to), self.rate(from, to));
        let jerk = self.jerk(rate);
        let bend = (rate / jerk).min(total / 2.0);
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

/// A pulse's clock with its fraction, and its direction.
type Pulse = (f64, Direction);

/// When, in seconds, and what to do with an axis.
type Deed<'a> = (f64, &'a dyn Fn(&mut Axis));

/// Lets an axis run to its end; gives its pulses.
fn finish(axis: &mut Axis) -> Vec<Pulse> {
    let mut pulses = Vec::new();
    let mut wakes = 0;
    while let Some(wake) = axis.wake() {
        axis.advance(wake, |train| collect(train, &mut pulses));
        wakes += 1;
        assert!(wakes < 100_000, "no end in sight");
    }
    pulses
}

fn collect(train: &Train, pulses: &mut Vec<Pulse>) {
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

/// Every pulse against the laws of motion, to half a clock and 10⁻⁵ of a spacing.
fn check_full(ramp: Ramp, target: i32) {
    let pulses = run(ramp, target);
    let distance = f64::from(target.unsigned_abs());
    assert!(ramp.way(ramp.start, ramp.top) + ramp.way(ramp.top, ramp.stop) <= distance, "reaches its top");
    let mut before = 0.0;
    for (k, clock) in (1..).zip(&pulses) {
        let expected = ramp.pulse(distance, ramp.top, f64::from(k)) * CLOCK_HZ;
        let slack = 0.5 + (clock - before) * 1e-5;
        assert!((clock - expected).abs() < slack, "{ramp:?} to {target}, pulse {k}: {clock} for {expected}");
        before = *clock;
    }
    // With a pulse every few clocks, 2⁻³² clock in a train's jerk is no longer small. The edges do not show it:
    // they are a clock wide.
    if ramp.top < CLOCK_HZ / 100.0 {
        check_smooth(ramp, &pulses);
    }
}

const TYPICAL: Ramp = Ramp {
    start: 200.0,
    stop: 100.0,
    top: 20_000.0,
    acceleration: 100_000.0,
    deceleration: 100_000.0,
    bend: 4000.0,
};

/// [`TYPICAL`] with a deceleration of its own.
const UNEVEN: [Ramp; 2] =
    [Ramp { deceleration: 30_000.0, ..TYPICAL }, Ramp { deceleration: 500_000.0, ..TYPICAL }];

#[test]
fn every_pulse_is_where_the_laws_of_motion_put_it() {
    check_full(TYPICAL, 20_000);
    check_full(TYPICAL, -12_345);
    check_full(Ramp { bend: 9900.0, ..TYPICAL }, 20_000);
    check_full(
        Ramp { top: 190_000.0, acceleration: 2e6, deceleration: 2e6, bend: 50_000.0, ..TYPICAL },
        60_000,
    );
    check_full(Ramp { bend: 30_000.0, ..TYPICAL }, 40_000);
    check_full(Ramp { top: 4e6, acceleration: 30e6, deceleration: 30e6, bend: 1e6, ..TYPICAL }, 2_000_000);
    for uneven in UNEVEN {
        check_full(uneven, 20_000);
        check_full(Ramp { bend: 9900.0, ..uneven }, 20_000);
    }
    let slow =
        Ramp { start: 1.0, stop: 1.0, top: 300.0, acceleration: 50.0, deceleration: 50.0, bend: 100.0 };
    check_full(slow, 4000);
    check_full(Ramp { start: 5000.0, stop: 5000.0, top: 5000.0, bend: 1e3, ..TYPICAL }, 5000);
}

/// Times and mean accelerations from pulse to pulse, in seconds. A mean weighs with a triangle over two
/// spacings; its time is that of the triangle's centre.
fn accelerations(clocks: &[f64]) -> Vec<[f64; 2]> {
    clocks
        .windows(3)
        .map(|clocks| {
            let [a, b, c] = [clocks[0], clocks[1], clocks[2]].map(|clock| clock / CLOCK_HZ);
            [(a + b + c) / 3.0, (1.0 / (c - b) - 1.0 / (b - a)) / ((c - a) / 2.0)]
        })
        .collect()
}

/// No acceleration above its peak, and between any two pulses no more change of it than the jerk
/// makes; both but for half a percent of the peak, which the cubics of the blocks take.
fn check_smooth(ramp: Ramp, clocks: &[f64]) {
    let steepest = ramp.acceleration.max(ramp.deceleration);
    let (slack, jerk) = (steepest * 0.005, ramp.jerk(steepest));
    let mut bounds = [f64::INFINITY; 2];
    for [time, acceleration] in accelerations(clocks) {
        assert!(
            (-ramp.deceleration - slack..=ramp.acceleration + slack).contains(&acceleration),
            "{ramp:?}: acceleration {acceleration} at {time}"
        );
        for (bound, acceleration) in bounds.iter_mut().zip([acceleration, -acceleration]) {
            let beyond_jerk = acceleration - jerk * time;
            assert!(beyond_jerk <= *bound + slack, "{ramp:?}: jerk before {time}");
            *bound = bound.min(beyond_jerk);
        }
    }
}

/// Seconds of the quickest move; `None` if the axis could not stop from its start speed.
fn quickest(ramp: Ramp, distance: f64) -> Option<f64> {
    let way = |peak: f64| ramp.way(ramp.start, peak) + ramp.way(peak.max(ramp.stop), ramp.stop);
    let peak = match ramp.top {
        _ if way(ramp.start) > distance => return None,
        top if way(top) <= distance => top,
        top => ramp.start + solve(top - ramp.start, distance, |more| way(ramp.start + more)),
    };
    let ramps = ramp.time(ramp.start, peak) + ramp.time(peak.max(ramp.stop), ramp.stop);
    Some(ramps + (distance - way(peak)) / peak)
}

fn check_short(ramp: Ramp, target: i32) {
    let mut clocks = run(ramp, target);
    if let Some(quickest) = quickest(ramp, f64::from(target.unsigned_abs())) {
        let (quickest, duration) = (quickest * CLOCK_HZ, clocks[clocks.len() - 1]);
        let range = quickest - 1.0..quickest * 1.001 + 1.0;
        assert!(range.contains(&duration), "{ramp:?} to {target}: {duration} in place of {quickest}");
    }
    clocks.insert(0, 0.0);
    let fastest = clocks.windows(2).fold(0f64, |most, pair| most.max(CLOCK_HZ / (pair[1] - pair[0])));
    assert!(fastest <= ramp.top * 1.000_001, "{ramp:?} to {target}: speed {fastest}");
    check_smooth(ramp, &clocks);
}

#[test]
fn short_moves_keep_all_limits() {
    for target in (1..40).chain([50, 99, 100, 333, 1000, 2500, 3999, 4000, 4001, 4500, 5000]) {
        check_short(TYPICAL, target);
        check_short(Ramp { bend: 9900.0, ..TYPICAL }, -target);
        check_short(Ramp { bend: 50_000.0, ..TYPICAL }, target);
        check_short(Ramp { start: 1000.0, stop: 1000.0, bend: 9900.0, ..TYPICAL }, target);
        for uneven in UNEVEN {
            check_short(uneven, target);
            check_short(Ramp { bend: 50_000.0, ..uneven }, -target);
        }
    }
}

/// An axis that does things at given times; gives its pulses.
fn play(ramp: Ramp, deeds: &[Deed]) -> (Axis, Vec<Pulse>) {
    let mut axis = Axis::new(ramp.limits());
    let mut pulses = Vec::new();
    for (seconds, deed) in deeds {
        let clock = (seconds * CLOCK_HZ) as u64;
        while let Some(wake) = axis.wake().filter(|&wake| wake <= clock) {
            axis.advance(wake, |train| collect(train, &mut pulses));
        }
        axis.advance(clock, |train| collect(train, &mut pulses));
        deed(&mut axis);
    }
    (axis, pulses)
}

/// The speed is continuous: its change from pulse to pulse is what the acceleration makes. Stops and
/// starts are where the direction changes, or after a pause.
fn check_continuous(ramp: Ramp, pulses: &[Pulse]) {
    for run in pulses.chunk_by(|a, b| a.1 == b.1 && b.0 - a.0 < 1.2 * CLOCK_HZ / ramp.stop) {
        let clocks: Vec<_> = run.iter().map(|pulse| pulse.0).collect();
        for [time, acceleration] in accelerations(&clocks) {
            let room = -ramp.deceleration * 1.02..=ramp.acceleration * 1.02;
            assert!(room.contains(&acceleration), "{ramp:?}: acceleration {acceleration} at {time}");
        }
    }
}

const SMOOTH: Ramp = Ramp {
    start: 200.0,
    stop: 200.0,
    top: 10_000.0,
    acceleration: 50_000.0,
    deceleration: 50_000.0,
    bend: 3000.0,
};

/// A move that is given another target on its way.
fn check_retarget(seconds: f64, targets: [i32; 2]) {
    let go = |target| move |axis: &mut Axis| axis.set_goal(Goal::Position(target));
    let (mut axis, mut pulses) = play(SMOOTH, &[(0.0, &go(targets[0])), (seconds, &go(targets[1]))]);
    pulses.extend(finish(&mut axis));
    assert_eq!(axis.position(), targets[1], "{targets:?} after {seconds}");
    assert!(!axis.is_moving());
    check_continuous(SMOOTH, &pulses);
}

#[test]
fn targets_change_on_the_way() {
    for step in 1..60 {
        let seconds = f64::from(step) * 0.0213;
        check_retarget(seconds, [6000, 9000]);
        check_retarget(seconds, [6000, 5999]);
        check_retarget(seconds, [6000, 3000]);
        check_retarget(seconds, [-6000, 10]);
    }
}

#[test]
fn speeds_change_on_the_way() {
    let turn = |pps: f64| {
        move |axis: &mut Axis| {
            let speed = (pps.abs() * SMOOTH.unit()) as Speed;
            axis.set_goal(Goal::Speed(Direction::of(pps as i64), speed));
        }
    };
    for step in 1..40 {
        let seconds = f64::from(step) * 0.0113;
        let deeds: [Deed; 5] = [
            (0.0, &turn(9000.0)),
            (seconds, &turn(2000.0)),
            (seconds + 0.1, &turn(5000.0)),
            (2.0, &turn(-700.0)),
            (3.5, &|_| ()),
        ];
        let (mut axis, mut pulses) = play(SMOOTH, &deeds);
        assert_eq!((axis.speed() as f64 / SMOOTH.unit()).round(), 700.0);
        assert_eq!(axis.direction(), Direction::Negative);
        axis.set_goal(Goal::Speed(Direction::Positive, 0));
        pulses.extend(finish(&mut axis));
        assert!(!axis.is_moving());
        check_continuous(SMOOTH, &pulses);
    }
}

#[test]
fn a_soft_stop_is_an_s_that_ends_on_a_pulse() {
    for step in 1..40 {
        let seconds = f64::from(step) * 0.0157;
        let block = |axis: &mut Axis| {
            axis.set_blocked(Direction::Positive, Some(Stop::Soft));
            axis.set_blocked(Direction::Negative, Some(Stop::Soft));
        };
        let go = |axis: &mut Axis| axis.set_goal(Goal::Position(6000));
        let (mut axis, mut pulses) = play(SMOOTH, &[(0.0, &go), (seconds, &block)]);
        let way = i64::from(axis.position());
        let speed = f64::from(axis.speed()) / SMOOTH.unit();
        pulses.extend(finish(&mut axis));
        let braked = (i64::from(axis.position()) - way) as f64;
        let shortest = SMOOTH.way(speed, SMOOTH.stop);
        assert!((shortest - 0.1..shortest + 2.1).contains(&braked), "{braked} in place of {shortest}");
        check_continuous(SMOOTH, &pulses);
    }
}

#[test]
fn what_does_not_concern_a_course_does_not_disturb_it() {
    let go = |axis: &mut Axis| axis.set_goal(Goal::Position(6000));
    let (mut axis, mut undisturbed) = play(SMOOTH, &[(0.0, &go)]);
    undisturbed.extend(finish(&mut axis));
    let length = undisturbed[undisturbed.len() - 1].0 / CLOCK_HZ;
    for step in 1..50 {
        let seconds = length * f64::from(step) / 50.0;
        let block = |axis: &mut Axis| axis.set_blocked(Direction::Negative, Some(Stop::Hard));
        // In the tail the top speed is over.
        let slow = |axis: &mut Axis| {
            if seconds > length * 0.8 {
                axis.set_limits(Limits { top: axis.limits().top / 8, ..axis.limits() });
            }
        };
        let (mut axis, mut pulses) = play(SMOOTH, &[(0.0, &go), (seconds, &block), (seconds, &slow)]);
        pulses.extend(finish(&mut axis));
        assert_eq!(pulses, undisturbed, "after {seconds}");
    }
}

#[test]
fn a_new_top_speed_counts_from_the_cruise_on() {
    let go = |axis: &mut Axis| axis.set_goal(Goal::Position(12_000));
    for top in [4000.0, 9900.0, 10_000.0] {
        let slow = |axis: &mut Axis| {
            axis.set_limits(Limits { top: (top * SMOOTH.unit()) as Speed, ..axis.limits() });
        };
        let (mut axis, mut pulses) = play(SMOOTH, &[(0.0, &go), (0.6, &slow), (1.0, &|_| ())]);
        assert_eq!((f64::from(axis.speed()) / SMOOTH.unit()).round(), top);
        pulses.extend(finish(&mut axis));
        assert_eq!(pulses.len(), 12_000);
        check_continuous(SMOOTH, &pulses);
    }
}

/// A small generator of numbers that look random.
struct Dice(u64);

impl Dice {
    fn below(&mut self, end: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % end
    }

    fn deed(&mut self, axis: &mut Axis) {
        let direction = if self.below(2) == 0 { Direction::Negative } else { Direction::Positive };
        let speed = (self.below(10_000) as f64 * SMOOTH.unit()) as Speed;
        match self.below(6) {
            0 | 1 => axis.set_goal(Goal::Position(self.below(10_000) as i32 - 5000)),
            2 => axis.set_goal(Goal::Speed(direction, speed)),
            3 => axis.set_limits(Limits { top: speed, ..axis.limits() }),
            4 => axis.set_position(self.below(10_000) as i32 - 5000),
            _ => axis.set_blocked(direction, (self.below(2) == 0).then_some(Stop::Soft)),
        }
    }
}

#[test]
fn whatever_happens_the_speed_is_continuous_and_the_target_is_met() {
    for seed in 0..300 {
        let mut dice = Dice(seed);
        let mut axis = Axis::new(SMOOTH.limits());
        let mut pulses = Vec::new();
        let mut clock = 0;
        for _ in 0..12 {
            dice.deed(&mut axis);
            clock += dice.below(CLOCK_HZ as u64 / 3);
            while let Some(wake) = axis.wake().filter(|&wake| wake <= clock) {
                axis.advance(wake, |train| collect(train, &mut pulses));
            }
            axis.advance(clock, |train| collect(train, &mut pulses));
        }
        axis.set_limits(SMOOTH.limits());
        axis.set_blocked(Direction::Negative, None);
        axis.set_blocked(Direction::Positive, None);
        let target = dice.below(10_000) as i32 - 5000;
        axis.set_goal(Goal::Position(target));
        pulses.extend(finish(&mut axis));
        assert_eq!((axis.position(), axis.is_moving()), (target, false), "seed {seed}");
        check_continuous(SMOOTH, &pulses);
    }
}

#[test]
fn extreme_limits_neither_panic_nor_hang() {
    let extremes = [0, 1, 2, 1 << 16, 1 << 30, MAX_SPEED, Speed::MAX];
    for bits in [31, 40, 49] {
        for top in extremes {
            for start in extremes {
                for bend in extremes {
                    for growth in [0, 1, 1 << 31, 1 << 62, u64::MAX] {
                        let shape = Shape::SCurve { bend };
                        let scale = Scale::new(bits);
                        let limits = Limits { scale, top, start, stop: start, growth, fall: growth, shape };
                        let mut axis = Axis::new(limits);
                        axis.set_goal(Goal::Position(40));
                        assert_eq!(finish(&mut axis).len(), 40, "{limits:?}");
                        axis.set_goal(Goal::Speed(Direction::Negative, top));
                        let Some(wake) = axis.wake() else { continue };
                        axis.advance(wake, |_| ());
                        axis.set_goal(Goal::Position(i32::MIN));
                        axis.set_goal(Goal::Speed(Direction::Negative, 0));
                    }
                }
            }
        }
    }
}
