//! The torque that a motor has at each speed, and what it has to move.

use devices::Drive;
use motion::SubTicks;

/// Largest coil current of a [`Drive`].
pub(crate) const FULL_CURRENT: u8 = 32;

/// Full steps a second at which the friction is what its key says.
const FRICTION_SPEED: f64 = 1000.0;

/// A motor's pull-out torque against its speed, and the friction that grows with it. Torques are parts of the
/// pull-out torque at full current, speeds full steps a second.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Torque {
    /// Speeds rise, torques do not. Before the first point and after the last the torque stays what it is there.
    points: Vec<[f64; 2]>,
    friction: f64,
    /// Positions of a full step.
    full_step: f64,
    clock_hz: f64,
    /// The supply as a part of that at which the points were found: a current rises as fast as the voltage is
    /// high, so the same torque is left at this part of the speed.
    supply: f64,
}

impl Torque {
    /// `None` without a point.
    pub fn new(points: &[[f64; 2]], friction: f64, full_step: u32, clock_hz: u32) -> Option<Self> {
        let torque = Self {
            points: points.into(),
            friction,
            full_step: full_step.into(),
            clock_hz: clock_hz.into(),
            supply: 1.0,
        };
        (!points.is_empty()).then_some(torque)
    }

    /// The supply is this part of what it should be.
    pub fn set_supply(&mut self, part: f64) {
        self.supply = part;
    }

    /// The shortest time between two pulses at which the motor follows with this load; `None` if it follows at
    /// no speed.
    pub fn shortest_interval(&self, load: f64, drive: Drive) -> Option<SubTicks> {
        let current = f64::from(drive.current.min(FULL_CURRENT)) / f64::from(FULL_CURRENT);
        let limit = self.limit(load, current);
        if limit <= 0.0 {
            return None;
        }
        let step = f64::from(drive.step.unsigned_abs()) / self.full_step;
        // Infinity gives 0, and what is too long for the integer its largest.
        Some((self.clock_hz * step / limit * SUBTICKS).ceil() as SubTicks)
    }

    /// What part of the torque at full current is needed at the speed of pulses so far apart.
    pub fn share(&self, load: f64, interval: SubTicks, drive: Drive) -> f64 {
        let step = f64::from(drive.step.unsigned_abs()) / self.full_step;
        let speed = self.clock_hz * step * SUBTICKS / interval.max(1) as f64;
        let (torque, needed) = (self.at(speed), load + self.lost_at(speed));
        if needed <= 0.0 { 0.0 } else { needed / torque }
    }

    /// The highest speed at which the torque of this part of the current is enough.
    fn limit(&self, load: f64, current: f64) -> f64 {
        let spare = |speed: f64, torque: f64| torque * current - load - self.lost_at(speed);
        let Some(&[_, first]) = self.points.first() else { return f64::INFINITY };
        let (mut speed, mut left) = (0.0, spare(0.0, first));
        if left < 0.0 || current <= 0.0 {
            return 0.0;
        }
        // It falls in a straight line from point to point.
        for [next, torque] in self.points() {
            let there = spare(next, torque);
            if there < 0.0 {
                return speed + (next - speed) * left / (left - there);
            }
            (speed, left) = (next, there);
        }
        // What is left is lost to friction sooner or later, or never.
        if left > 0.0 { speed + left / (self.friction / FRICTION_SPEED) } else { speed }
    }

    fn at(&self, speed: f64) -> f64 {
        let mut before: Option<[f64; 2]> = None;
        for [next, torque] in self.points() {
            if speed <= next {
                return match before {
                    None => torque,
                    Some([last, more]) => torque + (more - torque) * (next - speed) / (next - last),
                };
            }
            before = Some([next, torque]);
        }
        before.map_or(0.0, |[_, torque]| torque)
    }

    fn lost_at(&self, speed: f64) -> f64 {
        self.friction * speed / FRICTION_SPEED
    }

    fn points(&self) -> impl Iterator<Item = [f64; 2]> {
        self.points.iter().map(|[speed, torque]| [speed * self.supply, *torque])
    }
}

/// In a clock.
const SUBTICKS: f64 = (1_u64 << motion::train::FRACTION_BITS) as f64;

#[cfg(test)]
mod tests {
    use super::*;

    const CURVE: &[[f64; 2]] = &[[1000.0, 1.0], [3000.0, 0.4], [4000.0, 0.0]];

    fn drive(step: i16, current: u8) -> Drive {
        Drive { step, parts: 1, current }
    }

    /// The limit in full steps a second, and in clocks of 1 MHz between full steps.
    #[track_caller]
    fn check(load: f64, friction: f64, current: u8, expected: f64) {
        let torque = Torque::new(CURVE, friction, 1, 1_000_000).unwrap();
        let limit = torque.limit(load, f64::from(current) / 32.0);
        assert!(
            (limit - expected).abs() < 1e-6,
            "load {load}, friction {friction}, current {current}: {limit}"
        );
        let interval = torque.shortest_interval(load, drive(1, current));
        let clocks = interval.map(|interval| interval as f64 / SUBTICKS);
        match expected {
            0.0 => assert_eq!(interval, None),
            _ => assert!((clocks.unwrap() - 1e6 / expected).abs() < 1e-6, "{clocks:?}"),
        }
    }

    #[test]
    fn a_motor_follows_as_fast_as_its_torque_allows() {
        check(0.0, 0.0, 32, 4000.0);
        check(0.4, 0.0, 32, 3000.0);
        check(0.7, 0.0, 32, 2000.0);
        check(0.2, 0.0, 32, 3500.0);
        check(1.01, 0.0, 32, 0.0);
        // Half the current has half the torque at every speed.
        check(0.35, 0.0, 16, 2000.0);
        check(0.6, 0.0, 16, 0.0);
        check(0.0, 0.0, 0, 0.0);
        // 1 - 0.3 (v - 1) = 0.1 + 0.2 v, in thousands.
        check(0.1, 0.2, 32, 2400.0);
    }

    #[test]
    fn beyond_the_last_point_only_friction_ends_it() {
        let torque = |friction| Torque::new(&[[0.0, 1.0]], friction, 1, 1_000_000).unwrap();
        assert_eq!(torque(0.0).limit(0.5, 1.0), f64::INFINITY);
        assert_eq!(torque(0.0).shortest_interval(0.5, drive(1, 32)), Some(0));
        assert_eq!(torque(0.1).limit(0.5, 1.0), 5000.0);
    }

    #[test]
    fn half_the_supply_has_half_the_speed() {
        let mut torque = Torque::new(CURVE, 0.0, 1, 1_000_000).unwrap();
        torque.set_supply(0.5);
        let is =
            |value: f64, expected: f64| assert!((value - expected).abs() < 1e-6, "{value}, not {expected}");
        is(torque.limit(0.7, 1.0), 1000.0);
        is(torque.at(1000.0), 0.7);
    }

    #[test]
    fn microsteps_come_faster() {
        let torque = Torque::new(CURVE, 0.0, 256, 16_000_000).unwrap();
        let limit = |step| torque.shortest_interval(0.7, drive(step, 32)).unwrap() as f64 / SUBTICKS;
        assert_eq!((limit(256), limit(-1)), (8000.0, 31.25));
    }

    #[test]
    fn the_share_of_the_load_grows_with_the_speed() {
        let torque = Torque::new(CURVE, 0.1, 1, 1_000_000).unwrap();
        let share = |speed: f64| torque.share(0.2, (1e6 / speed * SUBTICKS) as SubTicks, drive(1, 32));
        for (speed, part) in [(100.0, 0.21), (1000.0, 0.3), (2000.0, 0.4 / 0.7), (3000.0, 0.5 / 0.4)] {
            assert!((share(speed) - part).abs() < 1e-6, "{speed}: {}", share(speed));
        }
        assert!(share(4000.0) > 1e9);
    }
}
