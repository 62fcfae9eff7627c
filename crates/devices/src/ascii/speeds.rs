//! From the settings `HSPD`, `LSPD`, `ACC`, `DEC`, `SSPDM` and `SCV` to the limits of a motion (PMX-2ED-SA
//! manual, 7.1 and appendix A; CMD-4CR manual, 2.1.4 and appendix B).

use motion::pps::{self, Profile, Window};
use motion::speed::{MAX_GROWTH, MAX_SPEED, Scale, Speed};
use motion::{Limits, Shape};

/// The speeds that a family can have.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// Clocks a second.
    pub clock_hz: u32,
    /// The table of speeds.
    pub windows: &'static [Window],
}

/// Settings in force for a motion, in pulses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Speeds {
    /// High speed, in pulses a second.
    pub high_pps: u32,
    /// Low speed, in pulses a second.
    pub low_pps: u32,
    /// Time from low to high speed.
    pub acceleration_ms: u32,
    /// Time back.
    pub deceleration_ms: u32,
    /// Number of the speed window that was chosen for changes on the way, from 1.
    pub window: Option<u8>,
    /// Whether ramps are S-curves.
    pub s_curve: bool,
}

impl Speeds {
    /// What is out of the range of the table is brought into it. Also the fastest speed that the motion may
    /// be told to have on its way.
    fn profile(&self, family: &Family) -> (Profile, u32) {
        let chosen = self.window.and_then(|number| family.windows.get(usize::from(number).wrapping_sub(1)));
        let window = chosen.unwrap_or_else(|| pps::window(family.windows, self.high_pps));
        let high_pps = window.stepped(self.high_pps);
        let low_pps = window.stepped(self.low_pps.max(window.least_low_pps)).min(high_pps);
        let [acceleration_ms, deceleration_ms] =
            [self.acceleration_ms, self.deceleration_ms].map(|ms| window.clamp_ms(ms, [low_pps, high_pps]));
        // On-the-fly changes need the scale of the whole window.
        let fastest_pps = chosen.map_or(high_pps, |window| high_pps.max(window.to_pps));
        let s_curve = self.s_curve;
        (Profile { low_pps, high_pps, acceleration_ms, deceleration_ms, s_curve }, fastest_pps)
    }

    /// The limits of a motion without a target.
    pub fn limits(&self, family: &Family) -> Limits {
        let (profile, fastest_pps) = self.profile(family);
        profile.limits(pps::scale(fastest_pps, family.clock_hz), family.clock_hz)
    }

    /// The limits of a move over so many pulses (PMX-2ED-SA manual, A.2; CMD-4CR manual, B.2).
    pub fn limits_over(&self, pulses: u32, family: &Family) -> Limits {
        let (profile, fastest_pps) = self.profile(family);
        let ends = [profile.low_pps, profile.high_pps];
        let times = [profile.acceleration_ms, profile.deceleration_ms];
        let [acceleration_ms, deceleration_ms] = pps::positional(pulses, ends, times);
        let profile = Profile { acceleration_ms, deceleration_ms, ..profile };
        profile.limits(pps::scale(fastest_pps, family.clock_hz), family.clock_hz)
    }
}

/// Limits with another high speed, for a motion that is on. The scale must have room for it.
pub fn changed(limits: Limits, high_pps: u32, clock_hz: u32) -> Limits {
    let top = pps::speed(high_pps, limits.scale, clock_hz);
    Limits { top, start: limits.start.min(top), stop: limits.stop.min(top), ..limits }
}

/// Limits without ramps: a motion has this speed from its first pulse to its last.
pub const fn constant(speed: Speed, scale: Scale) -> Limits {
    let shape = Shape::Trapezoid;
    Limits { scale, top: speed, start: speed, stop: speed, growth: MAX_GROWTH, fall: MAX_GROWTH, shape }
}

/// Limits under which an axis takes every speed at once, up to this one: whoever gives the speeds makes the
/// ramp.
pub fn at_once(fastest_pps: u32, clock_hz: u32) -> Limits {
    constant(MAX_SPEED, pps::scale(fastest_pps.max(1), clock_hz))
}
