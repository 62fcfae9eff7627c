//! Random arcs, circles and helices. Whether a point is near enough to the circle is decided in whole numbers;
//! how far along it the point lies, in floats, is compared with an axis that goes straight.

use crate::random::Random;
use crate::{AXES, limits, play_all, set_windows};
use motion::path::{Arc, End, MAX_RADIUS, Turn};
use motion::pps::{self, CLOCK_HZ, Profile};
use motion::{Axis, Goal, Limits, Moment, Move, Path, Shape, Train};
use std::f64::consts::{PI, TAU};

/// How far a point may be ahead of or behind its ideal place: half a pulse of the faster axis and one of the
/// other, at 45°.
const STEADY: f64 = 1.07;

/// The same compared with the axis that goes straight, which stands on one pulse as long as it takes to the
/// next, and whose ramps begin and end with whole ones, however steep.
const TANGENTIAL: f64 = STEADY + 3.0;

/// Pulses after which most arcs are stopped.
const MOST_PULSES: u32 = 300;

/// An arc as the oracle knows it.
#[derive(Clone, Copy, Debug)]
struct Wish {
    axes: [usize; 2],
    start: [i64; 2],
    clockwise: bool,
    end: End,
    along: Option<(usize, i32)>,
}

impl Wish {
    fn random(random: &mut Random) -> Self {
        let mut axes: Vec<_> = (0..AXES).collect();
        axes.swap(0, random.below(4) as usize);
        axes.swap(1, 1 + random.below(3) as usize);
        axes.swap(2, 2 + random.below(2) as usize);
        let radius = f64::from(random.spread(MAX_RADIUS));
        let millidegrees = random.below(720_000) as i32 - 360_000;
        let angle = match random.below(6) {
            0 => f64::from(random.below(8)) * PI / 4.0,
            // Near the angle where it ends, or beyond it.
            1 | 2 => {
                f64::from(millidegrees).to_radians() / 1000.0
                    + f64::from(random.below(2000)) / (radius + 300.0)
                    - f64::from(random.below(1000)) / (radius + 300.0)
            }
            _ => f64::from(random.below(1 << 30)) / f64::from(1 << 30) * TAU,
        };
        let start = [angle.cos(), angle.sin()].map(|part| (part * radius).trunc() as i64);
        let start = if start == [0, 0] { [-1, 0] } else { start };
        let end = match random.below(4) {
            0 => End::Circle,
            1 => End::Angle(millidegrees / 45_000 * 45_000),
            _ => End::Angle(millidegrees),
        };
        let along = random.chance(40).then(|| {
            let most = if random.chance(10) { u32::MAX >> 1 } else { 3000 };
            let way = random.spread(most) as i32;
            (axes[2], if random.chance(50) { way } else { -way })
        });
        Self { axes: [axes[0], axes[1]], start, clockwise: random.chance(50), end, along }
    }

    fn arc(&self) -> Arc {
        let turn = if self.clockwise { Turn::Clockwise } else { Turn::CounterClockwise };
        Arc::new(self.axes, self.start.map(|part| -part as i32), turn, self.end, self.along).unwrap()
    }

    fn squared(&self) -> i64 {
        self.start.iter().map(|part| part * part).sum()
    }

    fn radius(&self) -> f64 {
        (self.squared() as f64).sqrt()
    }

    /// From an angle to another the way it turns, 0 to a turn.
    fn turned(&self, from: f64, to: f64) -> f64 {
        let way = if self.clockwise { from - to } else { to - from };
        way.rem_euclid(TAU)
    }

    /// Within half a pulse of the circle: |√n − √r| ≤ ½.
    fn is_near(&self, point: [i64; 2]) -> bool {
        let n = point.iter().map(|part| i128::from(part * part)).sum::<i128>();
        let r = i128::from(self.squared());
        let sum = 4 * (n + r) - 1;
        sum <= 0 || sum * sum <= 64 * n * r
    }

    /// The ideal length, and whether a point may be the end.
    fn travel(&self) -> f64 {
        match self.end {
            End::Circle => TAU,
            End::Angle(end) => {
                let [x, y] = self.start.map(|part| part as f64);
                self.turned(y.atan2(x), f64::from(end).to_radians() / 1000.0)
            }
        }
    }

    /// Whether a point is where the arc ends: on the faster axis the nearest position, on the other the one
    /// that is nearest to the circle then.
    fn is_end(&self, point: [i64; 2]) -> bool {
        let End::Angle(end) = self.end else { return point == self.start };
        let end = f64::from(end).to_radians() / 1000.0;
        let ideal = [end.cos(), end.sin()].map(|part| part * self.radius());
        let off = (point[0] as f64 - ideal[0]).hypot(point[1] as f64 - ideal[1]);
        if (ideal[0].abs() - ideal[1].abs()).abs() < 2.0 {
            return self.is_near(point) && off < 1.2;
        }
        let fast = usize::from(ideal[0].abs() > ideal[1].abs());
        let slow = point[1 - fast].abs();
        let missing = self.squared() - point[fast] * point[fast];
        (point[fast] as f64 - ideal[fast]).abs() < 0.500_001
            && (slow * slow - slow < missing && missing <= slow * slow + slow)
            && (slow == 0 || (point[1 - fast] > 0) == (ideal[1 - fast] > 0.0))
    }
}

/// The axis that goes straight, with the limits of the arc.
struct Straight {
    axis: Axis,
    moments: Vec<Moment>,
    passed: usize,
}

impl Straight {
    fn new(limits: Limits, length: f64, now: u64) -> Self {
        let mut axis = Axis::new(limits);
        axis.advance(now, |_| ());
        axis.set_goal(Goal::Position(length.round() as i32));
        Self { axis, moments: Vec::new(), passed: 0 }
    }

    fn advance(&mut self, now: u64) {
        self.axis.advance(now, |train| {
            self.moments.extend((1..=train.count).map(|k| train.moment(k)));
        });
    }

    /// How far it has come at a moment that is not before the one of the last time.
    fn at(&mut self, moment: Moment) -> f64 {
        self.advance(moment.ticks.max(self.moments.last().map_or(0, |last| last.ticks)));
        while self.moments.get(self.passed).is_some_and(|pulse| *pulse <= moment) {
            self.passed += 1;
        }
        self.passed as f64
    }
}

struct Track {
    wish: Wish,
    way: [i32; AXES],
    events: Vec<(Moment, usize, i64)>,
    at: [i64; AXES],
    since: Moment,
    /// How far along the circle, and at what angle.
    along: f64,
    angle: f64,
    straight: Option<Straight>,
    /// At what speed it goes if that is always the same, and since when.
    steady: Option<(Moment, f64)>,
    least_speed: f64,
}

impl Track {
    fn train(&mut self, axis: usize, train: &Train) {
        let mut edges = train.edges();
        for k in 1..=train.count {
            let moment = train.moment(k);
            assert_eq!(edges.next(), Some(moment.ticks));
            self.events.push((moment, axis, train.direction.sign()));
        }
    }

    fn point(&self) -> [i64; 2] {
        [0, 1].map(|number| self.wish.start[number] + self.at[self.wish.axes[number]])
    }

    fn walk(&mut self, now: u64) {
        self.events.sort_by_key(|event| event.0);
        let events = std::mem::take(&mut self.events);
        for point in events.chunk_by(|a, b| a.0 == b.0) {
            assert!(point[0].0 > self.since, "time moves forward");
            self.since = point[0].0;
            for &(_, axis, sign) in point {
                self.at[axis] += sign;
            }
            let all = point.iter().map(|event| 1 << event.1);
            assert_eq!(all.clone().sum::<i32>(), all.fold(0, |a, b| a | b), "an axis steps once a clock");
            self.check(point.iter().any(|event| self.wish.axes.contains(&event.1)));
        }
        assert!(self.since.ticks <= now);
    }

    fn check(&mut self, steps: bool) {
        let point = self.point();
        assert!(self.wish.is_near(point), "{point:?} is off the circle");
        let [x, y] = point.map(|part| part as f64);
        let angle = y.atan2(x);
        let turned = self.wish.turned(self.angle, angle);
        // Less than half a turn at a time, so this way or that.
        let turned = if turned > PI { turned - TAU } else { turned };
        self.along += turned * self.wish.radius();
        self.angle = angle;
        assert!(turned >= 0.0 || self.straight.is_none(), "the circle is gone round one way");
        let (expected, tangential) = match (&mut self.straight, self.steady) {
            (None, _) => return,
            (Some(_), Some((begin, speed))) => {
                let fraction = f64::from(self.since.fraction) / f64::from(1 << 16) / f64::from(1 << 16);
                let span = (self.since.ticks - begin.ticks) as f64 + fraction;
                // Speeds are whole numbers.
                (span * speed, STEADY + span * self.least_speed)
            }
            (Some(straight), None) => (straight.at(self.since), TANGENTIAL),
        };
        // Between its ticks a helix has steps of the third axis.
        let late = if steps { 0.0 } else { 1.0 };
        assert!((self.along - expected).abs() < tangential + late, "{} along, not {expected}", self.along);
        if let Some((axis, way)) = self.wish.along {
            let per_pulse = f64::from(way) / (self.wish.travel() * self.wish.radius());
            let off = (self.at[axis] as f64 - expected * per_pulse).abs();
            let timing =
                if self.steady.is_some() { tangential - STEADY } else { tangential } * per_pulse.abs();
            assert!(
                off < 0.501 + timing,
                "the third axis is {off} off {:?} {:?} {expected} {per_pulse} {:?}",
                self.wish,
                self.at,
                self.steady
            );
        }
    }
}

fn steady(limits: Limits) -> Limits {
    Limits { start: limits.top, stop: limits.top, shape: Shape::Trapezoid, ..limits }
}

fn play(seed: u64) {
    let random = &mut Random::new(seed);
    let wish = Wish::random(random);
    let arc = wish.arc();
    let moves = Move::<AXES>::Arc(arc);
    let way = moves.way();
    let mut now = u64::from(random.below(1000));
    let begin = Moment::at(now + 1);
    let limits_at_first = match limits(random) {
        limits if random.chance(40) => steady(limits),
        limits => limits,
    };
    let mut axes = [(); AXES].map(|()| Axis::new(limits_at_first));
    let mut path = Path::new(limits_at_first, &moves, now, &mut axes);
    let length = wish.travel() * wish.radius();
    let goes = wish.end == End::Circle || arc.ends() != [0, 0];
    for (axis, way) in way.iter().enumerate() {
        let round = goes && wish.axes.contains(&axis);
        assert_eq!(path.involves(axis), round || *way != 0);
    }
    let [x, y] = wish.start.map(|part| part as f64);
    // The third axis may have to go faster than an axis can.
    let fastest = f64::from(limits_at_first.top) / 2f64.powi(limits_at_first.scale.bits() as i32);
    let steady = (limits_at_first == steady(limits_at_first)).then_some((begin, fastest));
    let third = wish.along.map_or(0.0, |(_, way)| f64::from(way).abs() / length * fastest);
    // Ramps of a few pulses are coarser than those of finer slots.
    let smooth = steady.is_some() || length > 200.0;
    let straight = (goes && smooth && third < 0.45).then(|| Straight::new(limits_at_first, length, now));
    let mut track = Track {
        wish,
        way,
        events: Vec::new(),
        at: [0; AXES],
        since: Moment::at(0),
        along: 0.0,
        angle: y.atan2(x),
        straight,
        steady,
        least_speed: 2f64.powi(-(limits_at_first.scale.bits() as i32)),
    };
    let (disturbed, mut stopped) = (random.chance(40), false);
    let most = if random.chance(10) { 10 * MOST_PULSES } else { MOST_PULSES };
    let mut windows = set_windows(&mut axes, random);
    while let Some(wake) = path.wake(&axes) {
        assert!(wake > now && path.is_moving());
        let looked = random.chance(15);
        let then = if looked { now + (wake - now) * u64::from(random.below(256)) / 256 } else { wake };
        path.advance(then, &mut axes, |axis, train| track.train(axis, train));
        now = then;
        track.walk(now);
        for ((axis, at), [low, high]) in axes.iter().zip(track.at).zip(windows) {
            assert_eq!(axis.odometer(), at);
            assert!((low..=high).contains(&at), "beyond the window");
        }
        let ended = axes.iter().map(|axis| axis.steps()).max().unwrap();
        if axes.iter().any(Axis::at_window) {
            windows = set_windows(&mut axes, random);
        } else if looked && then < wake && track.straight.is_some() {
            assert_eq!(path.wake(&axes), Some(wake), "looking changes nothing");
        }
        let mut stop = ended > most.into();
        if disturbed {
            match random.below(100) {
                0 => {
                    path.set_limits(limits(random), &mut axes);
                    track.straight = None;
                }
                1 | 2 => stop = true,
                _ => {}
            }
        }
        if stop && !stopped {
            path.stop(&mut axes);
            // The other one would need a pulse more or less for it.
            track.straight.take_if(|_| track.steady.is_none());
            stopped = true;
        }
        if ended > u64::from(most) * 20 {
            path.halt();
            stopped = true;
            assert!(!path.is_moving());
        }
        if let (Some(straight), true, false) = (&track.straight, path.is_moving(), stopped) {
            let [a, b] = wish.axes.map(|axis| f64::from(path.speed(axis)));
            let (speed, expected) = (a.hypot(b), f64::from(straight.axis.speed()));
            if track.steady.is_some() {
                assert!((speed - expected).abs() < 2.0 + expected * 1e-8, "{speed} for {expected}");
            }
        }
    }
    assert!(goes || track.at[wish.axes[0]] == 0);
    if !stopped {
        assert_eq!(track.at, track.way.map(i64::from), "the end");
        assert!(wish.is_end(track.point()), "the end {:?}", track.point());
    }
    for (number, axis) in axes.iter().enumerate() {
        assert_eq!(axis.position(), track.at[number] as i32);
        assert_eq!((path.speed(number), axis.is_moving(), axis.wake()), (0, false, None));
    }
}

#[test]
fn arcs_are_round() {
    play_all(play);
}

/// What a circle of a million slots comes to, too many to look at each: the points between trains, and the end.
#[test]
fn a_long_helix_ends_where_it_should() {
    let profile = Profile {
        low_pps: 1000,
        high_pps: 3_000_000,
        acceleration_ms: 300,
        deceleration_ms: 200,
        s_curve: true,
    };
    let limits = profile.limits(pps::scale(6_000_000, CLOCK_HZ), CLOCK_HZ);
    for way in [-12_345, 4_000_000] {
        let wish = Wish {
            axes: [2, 0],
            start: [-160_000, 41],
            clockwise: true,
            end: End::Circle,
            along: Some((1, way)),
        };
        let mut axes = [(); AXES].map(|()| Axis::new(limits));
        let mut path = Path::new(limits, &Move::Arc(wish.arc()), 0, &mut axes);
        let mut now = 0;
        while let Some(wake) = path.wake(&axes) {
            now = wake;
            path.advance(now, &mut axes, |_, _| ());
            let [x, y] = wish.axes.map(|axis| axes[axis].odometer());
            assert!(wish.is_near([wish.start[0] + x, wish.start[1] + y]));
        }
        assert_eq!(axes.map(|axis| axis.position()), [0, way, 0, 0]);
        // As long as the speed in the plane asks for, unless the third axis cannot follow.
        let length = wish.travel() * wish.radius();
        let seconds = now as f64 / f64::from(CLOCK_HZ);
        let expected = length / 3e6 + 0.25;
        assert!((seconds - expected).abs() < expected * 0.002, "{seconds} s, not {expected}");
    }
}
