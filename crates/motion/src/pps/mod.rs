//! The units of Arcus and Nippon Pulse controllers: pulses a second, and milliseconds from one speed to
//! another.
//!
//! A ramp leads from the low speed to the high speed in the time given, and a move begins and ends at the
//! low speed. (PMX-2ED-SA manual, section 7.1 and appendix A; CMD-4CR manual, appendix B.)

mod windows;

pub use windows::{COMMANDER, PERFORMAX, Window, positional, window};

use crate::plan::{Limits, Shape};
use crate::speed::{Growth, MAX_GROWTH, MAX_SPEED, Scale, Speed};
use crate::wide::quotient;

/// Clock of the Performax, in which its times are counted.
pub const CLOCK_HZ: u32 = 20_000_000;

/// The finest scale in which a speed in pulses a second still has a value. An axis that is to change its
/// speed on the way needs the scale of its fastest.
pub const fn scale(fastest_pps: u32, clock_hz: u32) -> Scale {
    let mut bits = 49;
    while bits > 31 && wide(fastest_pps, Scale::new(bits), clock_hz) > MAX_SPEED as u128 {
        bits -= 1;
    }
    Scale::new(bits)
}

/// Pulses a second as a kernel speed, to the nearest; never more than the scale has.
pub const fn speed(pps: u32, scale: Scale, clock_hz: u32) -> Speed {
    let wide = wide(pps, scale, clock_hz);
    if wide > MAX_SPEED as u128 { MAX_SPEED } else { wide as Speed }
}

const fn wide(pps: u32, scale: Scale, clock_hz: u32) -> u128 {
    let clock_hz = clock_hz as u128;
    quotient(((pps as u128) << scale.bits()) + clock_hz / 2, clock_hz)
}

/// A kernel speed in pulses a second, to the nearest.
pub const fn pps(speed: Speed, scale: Scale, clock_hz: u32) -> u32 {
    ((speed as u128 * clock_hz as u128 + (1 << (scale.bits() - 1))) >> scale.bits()) as u32
}

/// The growth with which an axis goes from one kernel speed to another in some milliseconds.
///
/// No time, and no speed to gain, is any speed within a pulse.
pub const fn growth([low, high]: [Speed; 2], ms: u32, scale: Scale, clock_hz: u32) -> Growth {
    // 2a = 2 · speed / time, with the time in clocks.
    let gained = (high.saturating_sub(low) as u128 * 2000) << scale.bits();
    let thousandths = ms as u128 * clock_hz as u128;
    if gained == 0 || thousandths == 0 {
        return MAX_GROWTH;
    }
    let growth = quotient(gained + thousandths / 2, thousandths);
    if growth > MAX_GROWTH as u128 {
        MAX_GROWTH
    } else if growth == 0 {
        1
    } else {
        growth as Growth
    }
}

/// How a move goes: the settings HSPD, LSPD, ACC, DEC and SCV.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Profile {
    /// Speed with which a move begins and ends.
    pub low_pps: u32,
    /// Speed of the cruise.
    pub high_pps: u32,
    /// From the low speed to the high.
    pub acceleration_ms: u32,
    /// And back.
    pub deceleration_ms: u32,
    /// Whether both ramps are S-curves, without a straight part.
    pub s_curve: bool,
}

impl Profile {
    /// The limits of an axis that moves so. An S takes as long as the straight ramp.
    pub const fn limits(&self, scale: Scale, clock_hz: u32) -> Limits {
        let top = speed(self.high_pps, scale, clock_hz);
        let low = speed(self.low_pps, scale, clock_hz);
        let ends = [low, top];
        let mut growth = growth(ends, self.acceleration_ms, scale, clock_hz);
        let mut fall = self::growth(ends, self.deceleration_ms, scale, clock_hz);
        let mut shape = Shape::Trapezoid;
        if self.s_curve {
            let span = top.saturating_sub(low);
            let bend = span.div_ceil(2);
            growth = Shape::s_growth(growth, span, bend);
            fall = Shape::s_growth(fall, span, bend);
            shape = Shape::SCurve { bend };
        }
        Limits { scale, top, start: low, stop: low, growth, fall, shape }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::{Axis, Goal};
    use crate::train::Direction;

    /// The highest speed of both controllers.
    const FASTEST: u32 = 6_553_500;

    #[test]
    fn speeds_come_back_as_they_went_in() {
        for clock_hz in [CLOCK_HZ, 19_660_800] {
            for fastest in [1, 50, 16_000, 325_000, 6_000_000, FASTEST] {
                let scale = scale(fastest, clock_hz);
                for asked in [1, 2, 7, 99, 1000, 15_999, 123_457, FASTEST - 1, FASTEST] {
                    let asked = asked.min(fastest);
                    let speed = speed(asked, scale, clock_hz);
                    assert!((scale.slowest()..=MAX_SPEED).contains(&speed));
                    assert_eq!(pps(speed, scale, clock_hz), asked, "{fastest} {scale:?}");
                }
                let highest = speed(fastest, scale, clock_hz);
                assert!(highest > MAX_SPEED / 2 || scale.bits() == 49, "the scale is the finest");
            }
        }
    }

    #[test]
    fn a_speed_beyond_the_scale_is_its_fastest() {
        let scale = scale(1000, CLOCK_HZ);
        assert_eq!(speed(u32::MAX, scale, CLOCK_HZ), MAX_SPEED);
        assert_eq!(speed(u32::MAX, Scale::new(31), 1), MAX_SPEED);
    }

    /// Jogs until the high speed is reached and then stops: clocks of both ramps.
    fn ramps(profile: Profile) -> [u64; 2] {
        let scale = scale(profile.high_pps, CLOCK_HZ);
        let mut axis = Axis::new(profile.limits(scale, CLOCK_HZ));
        let high = axis.limits().top;
        axis.set_goal(Goal::Speed(Direction::Positive, high));
        let mut now = 0;
        while axis.speed() < high {
            now = axis.wake().unwrap();
            axis.advance(now, |_| ());
        }
        let up = now;
        axis.set_goal(Goal::Speed(Direction::Positive, 0));
        while let Some(wake) = axis.wake() {
            now = wake;
            axis.advance(now, |_| ());
        }
        [up, now - up]
    }

    #[track_caller]
    fn check(low_pps: u32, high_pps: u32, acceleration_ms: u32, deceleration_ms: u32) {
        for s_curve in [false, true] {
            let profile = Profile { low_pps, high_pps, acceleration_ms, deceleration_ms, s_curve };
            let clocks = ramps(profile);
            for (clocks, ms) in clocks.into_iter().zip([acceleration_ms, deceleration_ms]) {
                // Ramps end on a pulse: at most one more at either end.
                let expected = u64::from(ms) * u64::from(CLOCK_HZ / 1000);
                let room = u64::from(CLOCK_HZ / low_pps + CLOCK_HZ / high_pps) + expected / 1000;
                assert!(clocks.abs_diff(expected) <= room, "{profile:?}: {clocks} clocks for {expected}");
            }
        }
    }

    #[test]
    fn ramps_take_the_time_that_was_asked_for() {
        check(100, 10_000, 300, 300);
        check(10, 1000, 500, 200);
        check(1000, 20_000, 12_903, 1);
        check(9000, 900_000, 100, 500);
        check(400, FASTEST, 1, 20);
        check(1, 2, 3000, 5000);
    }

    #[test]
    fn extreme_times_and_speeds_have_a_growth() {
        for bits in [31, 40, 49] {
            for [low, high] in [[0, 0], [0, 1], [0, MAX_SPEED], [MAX_SPEED - 1, MAX_SPEED], [5, 3]] {
                for ms in [0, 1, 1000, u32::MAX] {
                    for clock_hz in [1, CLOCK_HZ, u32::MAX] {
                        let growth = growth([low, high], ms, Scale::new(bits), clock_hz);
                        assert!((1..=MAX_GROWTH).contains(&growth));
                    }
                }
            }
        }
    }
}
