//! Joystick: an analog input says how fast the axis moves (PMX-2ED-SA manual, section 7.15; CMD-4CR,
//! 2.5.1).
//!
//! The middle of the input's range is standstill, its ends are full speed either way, and around the middle
//! lies a zone without motion. Soft limits slow the axis down on its way out: from the inner limit the
//! speed falls evenly with the position, at the outer limit it is 0. The way in is always free.
//!
//! Where the manuals are silent:
//!
//! - The speed rises evenly from 0 at the edge of the zone.
//! - The speed change is in pulses a second, each millisecond; at least 1, so that the axis can stop.
//! - Beyond the inner limit the soft limit is stronger than the speed change: the axis does not go faster
//!   than the line from full speed at the inner limit to 0 at the outer one.
//! - With all soft limits 0, as the factory sets them, there are none.

/// Soft limits in pulses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SoftLimits {
    /// Where negative motion ends.
    pub negative_outer: i32,
    /// Where negative motion begins to slow down.
    pub negative_inner: i32,
    /// Where positive motion begins to slow down.
    pub positive_inner: i32,
    /// Where positive motion ends.
    pub positive_outer: i32,
}

/// What is set for a joystick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// The analog value of full negative speed, in millivolts. May be the larger one of the two.
    pub negative_mv: i32,
    /// The analog value of full positive speed, in millivolts.
    pub positive_mv: i32,
    /// How far from the middle nothing moves, in millivolts.
    pub tolerance_mv: i32,
    /// Full speed.
    pub speed_pps: u32,
    /// The largest change of speed a millisecond.
    pub change_pps: u32,
    /// The soft limits; all 0 for none.
    pub limits: SoftLimits,
}

/// The speed that an axis under a joystick has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Joystick {
    speed_pps: i32,
}

impl Joystick {
    /// A joystick that begins at rest.
    pub const fn new() -> Self {
        Self { speed_pps: 0 }
    }

    /// The speed, negative for negative motion.
    pub const fn speed_pps(&self) -> i32 {
        self.speed_pps
    }

    /// The next millisecond: the speed to have now, from the analog value and the position.
    pub fn tick(&mut self, settings: &Settings, analog_mv: i32, position: i32) -> i32 {
        let wish = settings.slowed(settings.speed_at(analog_mv), position);
        let change = i64::from(settings.change_pps.max(1));
        let present = i64::from(self.speed_pps);
        let next = wish.clamp(present - change, present + change);
        let most = settings.slowed(settings.full() * next.signum(), position);
        self.speed_pps = if next.abs() > most.abs() { most as i32 } else { next as i32 };
        self.speed_pps
    }
}

impl Settings {
    /// The speed that the analog value asks for.
    fn speed_at(&self, analog_mv: i32) -> i64 {
        let [negative, positive, analog, tolerance] =
            [self.negative_mv, self.positive_mv, analog_mv, self.tolerance_mv].map(i64::from);
        let middle = (positive - negative) / 2 + negative;
        let (end, sign) =
            if (analog > middle) == (positive > middle) { (positive, 1) } else { (negative, -1) };
        let tolerance = tolerance.max(0);
        let reach = (end - middle).abs() - tolerance;
        let way = ((analog - middle).abs() - tolerance).clamp(0, reach.max(0));
        if way == 0 { 0 } else { sign * self.full() * way / reach }
    }

    /// A speed that the soft limits allow at a position, rounded up, so that the outer limit is reached.
    fn slowed(&self, speed: i64, position: i32) -> i64 {
        let limits = &self.limits;
        if *limits == SoftLimits::default() {
            return speed;
        }
        let (outer, inner) = match speed {
            0 => return 0,
            ..0 => (limits.negative_outer, limits.negative_inner),
            1.. => (limits.positive_outer, limits.positive_inner),
        };
        let sign = speed.signum();
        let room = (sign * (i64::from(outer) - i64::from(position))).max(0);
        let width = sign * (i64::from(outer) - i64::from(inner));
        if room == 0 {
            return 0;
        }
        if room >= width {
            return speed;
        }
        // Less than 2³¹ by less than 2³².
        sign * ((speed.abs() * room + width - 1) / width)
    }

    fn full(&self) -> i64 {
        self.speed_pps.min(i32::MAX as u32).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PMX: Settings = Settings {
        negative_mv: 0,
        positive_mv: 5000,
        tolerance_mv: 500,
        speed_pps: 2000,
        change_pps: 100,
        limits: SoftLimits { negative_outer: 0, negative_inner: 0, positive_inner: 0, positive_outer: 0 },
    };

    const LIMITS: SoftLimits = SoftLimits {
        negative_outer: -2000,
        negative_inner: -1000,
        positive_inner: 3000,
        positive_outer: 5000,
    };

    #[track_caller]
    fn check_speed(settings: Settings, analog_mv: i32, position: i32, speed_pps: i32) {
        let mut joystick = Joystick::new();
        let settings = Settings { change_pps: u32::MAX, ..settings };
        assert_eq!(joystick.tick(&settings, analog_mv, position), speed_pps);
    }

    #[test]
    fn the_analog_value_says_the_speed() {
        for (analog, speed) in [
            (2500, 0),
            (2000, 0),
            (3000, 0),
            (3001, 1),
            (4000, 1000),
            (5000, 2000),
            (6000, 2000),
            (1999, -1),
            (1000, -1000),
            (0, -2000),
            (-1, -2000),
        ] {
            check_speed(PMX, analog, 0, speed);
        }
    }

    #[test]
    fn a_zone_as_wide_as_the_range_leaves_no_motion() {
        for tolerance_mv in [2500, 5000, i32::MAX] {
            check_speed(Settings { tolerance_mv, ..PMX }, 5000, 0, 0);
        }
        check_speed(Settings { tolerance_mv: 2499, ..PMX }, 5000, 0, 2000);
        check_speed(Settings { tolerance_mv: 0, ..PMX }, 2501, 0, 0);
        check_speed(Settings { tolerance_mv: -9, ..PMX }, 2505, 0, 4);
    }

    /// The example of the CMD-4CR, section 2.5.1.1: nothing moves from 1580 to 1680 mV.
    #[test]
    fn another_range_and_a_reversed_one() {
        let cmd = Settings { negative_mv: 10, positive_mv: 3250, tolerance_mv: 50, ..PMX };
        for (analog, speed) in [(1580, 0), (1680, 0), (1682, 2), (1578, -2), (3250, 2000), (10, -2000)] {
            check_speed(cmd, analog, 0, speed);
            let reversed = Settings { negative_mv: 3250, positive_mv: 10, ..cmd };
            check_speed(reversed, analog, 0, -speed);
        }
        check_speed(Settings { negative_mv: 700, positive_mv: 700, ..PMX }, 5000, 0, 0);
    }

    #[test]
    fn soft_limits_slow_the_way_out() {
        let limited = Settings { limits: LIMITS, ..PMX };
        for (position, out, back) in [
            (0, 2000, -2000),
            (3000, 2000, -2000),
            (3001, 1999, -2000),
            (4000, 1000, -2000),
            (4999, 1, -2000),
            (5000, 0, -2000),
            (i32::MAX, 0, -2000),
            (-1000, 2000, -2000),
            (-1001, 2000, -1998),
            (-1500, 2000, -1000),
            (-1999, 2000, -2),
            (-2000, 2000, 0),
            (i32::MIN, 2000, 0),
        ] {
            check_speed(limited, 5000, position, out);
            check_speed(limited, 0, position, back);
        }
        // Half way out the half speed is halved too.
        check_speed(limited, 4000, 4000, 500);
    }

    #[test]
    fn limits_without_a_ramp_and_without_room() {
        let steep = SoftLimits { positive_inner: 7000, ..LIMITS };
        check_speed(Settings { limits: steep, ..PMX }, 5000, 4999, 2000);
        check_speed(Settings { limits: steep, ..PMX }, 5000, 5000, 0);
        let crossed = SoftLimits { negative_outer: 100, positive_outer: -100, ..LIMITS };
        check_speed(Settings { limits: crossed, ..PMX }, 5000, 0, 0);
        check_speed(Settings { limits: crossed, ..PMX }, 0, 0, 0);
        let widest = SoftLimits {
            negative_outer: i32::MIN,
            negative_inner: i32::MAX,
            positive_inner: i32::MIN,
            positive_outer: i32::MAX,
        };
        let fastest = Settings { speed_pps: u32::MAX, limits: widest, ..PMX };
        check_speed(fastest, 5000, i32::MIN, i32::MAX);
        check_speed(fastest, 5000, i32::MIN + 1, i32::MAX);
        check_speed(fastest, 0, i32::MIN + 1, -1);
    }

    #[track_caller]
    fn check_ticks(settings: Settings, ticks: &[(i32, i32)], speeds: &[i32]) {
        let mut joystick = Joystick::new();
        let got: Vec<_> = ticks.iter().map(|&(mv, at)| joystick.tick(&settings, mv, at)).collect();
        assert_eq!(got, speeds);
    }

    #[test]
    fn the_speed_changes_by_so_much_a_millisecond() {
        let there_and_back = [(5000, 0), (5000, 0), (3250, 0), (0, 0), (0, 0), (0, 0), (2500, 0)];
        check_ticks(PMX, &there_and_back, &[100, 200, 250, 150, 50, -50, 0]);
        let none = Settings { change_pps: 0, ..PMX };
        check_ticks(none, &[(5000, 0), (5000, 0), (2500, 0), (2500, 0)], &[1, 2, 1, 0]);
    }

    #[test]
    fn a_soft_limit_is_stronger_than_the_speed_change() {
        let limited = Settings { limits: LIMITS, change_pps: 1000, ..PMX };
        let out = [(5000, 0), (5000, 2900), (5000, 4500), (5000, 5001), (0, 5001)];
        check_ticks(limited, &out, &[1000, 2000, 500, 0, -1000]);
    }
}
