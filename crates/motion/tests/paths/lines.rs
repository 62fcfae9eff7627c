//! Random lines, every point of which is held against the line in exact arithmetic.

use crate::random::Random;
use crate::{AXES, limits, play_all, set_windows};
use motion::pps::{self, CLOCK_HZ, Profile};
use motion::{Axis, Moment, Move, Path, Train};

/// Pulses after which a line is stopped.
const MOST_PULSES: u32 = 2000;

/// A point of the path: where the axes stand after a moment's pulses.
struct Track {
    way: [i32; AXES],
    longest: i128,
    /// Pulses that came, by axis.
    events: Vec<(Moment, usize, i64)>,
    at: [i64; AXES],
    since: Moment,
    /// Whether a change of limits may have brought the line beyond its end.
    swings: bool,
}

impl Track {
    fn new(way: [i32; AXES]) -> Self {
        let longest = way.iter().map(|way| way.unsigned_abs()).max().unwrap().into();
        Self { way, longest, events: Vec::new(), at: [0; AXES], since: Moment::at(0), swings: false }
    }

    fn train(&mut self, axis: usize, train: &Train) {
        let mut edges = train.edges();
        for k in 1..=train.count {
            let moment = train.moment(k);
            assert_eq!(edges.next(), Some(moment.ticks));
            self.events.push((moment, axis, train.direction.sign()));
        }
        assert_eq!(edges.next(), None);
        assert_eq!(edges.len(), 0);
    }

    /// Goes through the points that came since the last time, up to the end of clock `now`.
    fn walk(&mut self, now: u64) {
        self.events.sort_by_key(|event| event.0);
        let events = std::mem::take(&mut self.events);
        for point in events.chunk_by(|a, b| a.0 == b.0) {
            assert!(point[0].0 > self.since, "time moves forward");
            self.since = point[0].0;
            for &(_, axis, sign) in point {
                assert!(self.swings || sign == i64::from(self.way[axis].signum()), "axis {axis} goes back");
                self.at[axis] += sign;
            }
            self.check();
        }
        assert!(self.since.ticks <= now);
    }

    fn check(&self) {
        let (k, _) = self
            .at
            .iter()
            .zip(&self.way)
            .find(|(_, way)| i128::from(way.unsigned_abs()) == self.longest)
            .unwrap();
        for (at, way) in self.at.iter().zip(self.way) {
            // at − k·way/longest, in parts of a pulse, with k positive ahead.
            let sign =
                self.way.iter().find(|way| i128::from(way.unsigned_abs()) == self.longest).unwrap().signum();
            let off = i128::from(*at) * self.longest - i128::from(*k) * i128::from(sign) * i128::from(way);
            assert!(2 * off.abs() <= self.longest, "{:?} is off the line to {:?}", self.at, self.way);
        }
    }
}

fn way(random: &mut Random) -> [i32; AXES] {
    let longest = match random.below(10) {
        0 => 1 << 31,
        1 => random.spread(u32::MAX >> 1),
        2..6 => random.spread(1 << 11),
        _ => random.spread(200),
    };
    let mut way = [0; AXES];
    for (number, way) in way.iter_mut().enumerate() {
        let pulses = match random.below(8) {
            _ if number == 0 => longest,
            0 => 0,
            1 => longest,
            2 => longest - 1,
            3 => longest / 2,
            4 => random.spread(longest),
            _ => random.below(longest),
        };
        *way = if random.chance(50) {
            0i32.wrapping_add_unsigned(pulses)
        } else {
            0i32.wrapping_sub_unsigned(pulses)
        };
    }
    way.swap(0, random.below(AXES as u32) as usize);
    way
}

fn play(seed: u64) {
    let random = &mut Random::new(seed);
    let way = way(random);
    let mut now = u64::from(random.below(1000));
    let limits_at_first = limits(random);
    let mut axes = [(); AXES].map(|()| Axis::new(limits_at_first));
    let mut line = Path::new(limits_at_first, &Move::Line(way), now, &mut axes);
    for (axis, way) in way.iter().enumerate() {
        assert_eq!(line.involves(axis), *way != 0);
    }
    let mut track = Track::new(way);
    let (disturbed, mut stopped) = (random.chance(40), false);
    let mut positions = [0i32; AXES];
    let mut windows = set_windows(&mut axes, random);
    while let Some(wake) = line.wake(&axes) {
        assert!(wake > now && line.is_moving());
        let looked = random.chance(15);
        let then = if looked { now + (wake - now) * u64::from(random.below(256)) / 256 } else { wake };
        line.advance(then, &mut axes, |axis, train| track.train(axis, train));
        now = then;
        track.walk(now);
        for ((axis, at), [low, high]) in axes.iter().zip(track.at).zip(windows) {
            assert_eq!(axis.odometer(), at);
            assert!((low..=high).contains(&at), "beyond the window");
        }
        let ended = axes.iter().map(|axis| axis.steps()).max().unwrap();
        if axes.iter().any(Axis::at_window) {
            windows = set_windows(&mut axes, random);
        } else if looked && then < wake {
            assert_eq!(line.wake(&axes), Some(wake), "looking changes nothing");
        }
        if disturbed {
            match random.below(100) {
                0 => {
                    line.set_limits(limits(random), &mut axes);
                    track.swings = true;
                }
                1 | 2 => {
                    line.stop(&mut axes);
                    stopped = true;
                }
                3 => {
                    let axis = (random.below(AXES as u32)..)
                        .map(|n| n as usize % AXES)
                        .find(|n| way[*n] != 0)
                        .unwrap();
                    let position = random.below(1000) as i32;
                    positions[axis] =
                        positions[axis].wrapping_add(position.wrapping_sub(axes[axis].position()));
                    axes[axis].set_position(position);
                }
                _ => {}
            }
        }
        if ended > MOST_PULSES.into() && !stopped {
            line.stop(&mut axes);
            stopped = true;
        }
        if ended > u64::from(MOST_PULSES) * 20 {
            line.halt();
            stopped = true;
            assert!(!line.is_moving());
        }
    }
    track.check();
    if !stopped {
        assert_eq!(track.at, way.map(i64::from), "the end");
    }
    for axis in 0..AXES {
        let position = (track.at[axis] as i32).wrapping_add(positions[axis]);
        assert_eq!(axes[axis].position(), position);
        assert_eq!((line.speed(axis), axes[axis].is_moving(), axes[axis].wake()), (0, false, None));
    }
}

#[test]
fn lines_are_straight() {
    play_all(play);
}

/// Too long to look at every pulse: the points between trains, and the end.
#[test]
fn a_long_line_ends_where_it_should() {
    let way = [-(1 << 27), (1 << 27) - 1, 12_345, 0];
    let profile = Profile {
        low_pps: 1000,
        high_pps: 6_000_000,
        acceleration_ms: 300,
        deceleration_ms: 200,
        s_curve: true,
    };
    let limits = profile.limits(pps::scale(profile.high_pps, CLOCK_HZ), CLOCK_HZ);
    let mut axes = [(); AXES].map(|()| Axis::new(limits));
    let mut line = Path::new(limits, &Move::Line(way), 0, &mut axes);
    let mut track = Track::new(way);
    while let Some(wake) = line.wake(&axes) {
        line.advance(wake, &mut axes, |axis, train| {
            track.at[axis] += train.direction.sign() * i64::from(train.count);
        });
        track.check();
    }
    assert_eq!(track.at, way.map(i64::from));
    assert_eq!(axes.map(|axis| axis.position()), way);
}
