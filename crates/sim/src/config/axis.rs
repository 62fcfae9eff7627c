//! The entry of an axis in a bench file, and the machine that it describes.

use super::{AxisConfig, BenchError, Cam, EncoderPlace, MAX_CAMS, Switch};
use crate::machine::fitting::fitting;
use devices::{Controller, PinKind, Wiring};
use serde::{Deserialize, Serialize};

/// Its keys, as [`keys::AXIS`](super::keys::AXIS) describes them.
#[derive(Clone, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AxisEntry {
    negative_limit: Option<i64>,
    positive_limit: Option<i64>,
    home: Option<[i64; 2]>,
    slowdown: Option<SlowdownEntry>,
    circumference: Option<i64>,
    switch_hysteresis: Option<i64>,
    bounce_ms: Option<u32>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    normally_closed: Vec<Switch>,
    index_every: Option<i64>,
    encoder_ratio: Option<f64>,
    encoder_at: Option<EncoderPlace>,
    backlash: Option<i64>,
    hard_stops: Option<[i64; 2]>,
    load: Option<f64>,
    friction: Option<f64>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pull_out: Vec<[f64; 2]>,
    microsteps: Option<u32>,
    in_position_ms: Option<u32>,
    mpg_from: Option<String>,
    mpg_hz: Option<u32>,
    joystick: Option<f64>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    cam: Vec<CamEntry>,
}

/// An input that an axis switches.
#[derive(Clone, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct CamEntry {
    pin: String,
    on: [i64; 2],
    #[serde(default)]
    normally_closed: bool,
}

/// Where the slowdown switch is on.
#[derive(Clone, Copy, Deserialize, Serialize)]
#[serde(untagged, expecting = "expected one zone as `[0, 5]` or two as `[[0, 5], [10, 15]]`")]
enum SlowdownEntry {
    One([i64; 2]),
    Two([[i64; 2]; 2]),
}

type Wrong<'a> = &'a dyn Fn(&str, String) -> BenchError;

impl AxisEntry {
    /// What an axis has that others do not.
    pub fn of(config: &AxisConfig, usual: &AxisConfig, names: &[&str]) -> Self {
        fn unusual<T: PartialEq + Copy>(value: T, usual: T) -> Option<T> {
            (value != usual).then_some(value)
        }
        // What the others are by default depends on it.
        let usual = &usual.clone().with_circumference(config.circumference);
        Self {
            negative_limit: unusual(config.negative_limit, usual.negative_limit),
            positive_limit: unusual(config.positive_limit, usual.positive_limit),
            home: unusual(config.home, usual.home),
            slowdown: match config.slowdown {
                [Some(one), None] => Some(SlowdownEntry::One(one)),
                [Some(one), Some(two)] => Some(SlowdownEntry::Two([one, two])),
                _ => None,
            },
            circumference: config.circumference,
            switch_hysteresis: unusual(config.switch_hysteresis, usual.switch_hysteresis),
            bounce_ms: unusual(config.bounce_ms, usual.bounce_ms),
            normally_closed: config.normally_closed.clone(),
            index_every: unusual(config.index_every, usual.index_every),
            encoder_ratio: unusual(config.encoder_ratio, usual.encoder_ratio),
            encoder_at: unusual(config.encoder_at, usual.encoder_at),
            backlash: unusual(config.backlash, usual.backlash),
            hard_stops: config.hard_stops,
            load: unusual(config.load, usual.load),
            friction: unusual(config.friction, usual.friction),
            pull_out: config.pull_out.clone(),
            microsteps: unusual(config.microsteps, usual.microsteps),
            in_position_ms: config.in_position_ms,
            mpg_from: config.mpg_from.map(|axis| names[axis].into()),
            mpg_hz: unusual(config.mpg_hz, usual.mpg_hz),
            joystick: unusual(config.joystick, usual.joystick),
            cam: config.cams.iter().map(CamEntry::of).collect(),
        }
    }

    /// The machine that it describes at an axis of a controller of this model. Its numbers are in their
    /// ranges.
    pub fn config(
        self,
        model: &str,
        controller: &dyn Controller,
        axis: usize,
        wrong: Wrong<'_>,
    ) -> Result<AxisConfig, BenchError> {
        self.check_inputs(model, controller, axis, wrong)?;
        self.check_ends(wrong)?;
        let names = controller.axes();
        let mpg_from = match &self.mpg_from {
            None => None,
            Some(name) => match names.iter().position(|other| other == name) {
                None => {
                    let problem = format!("unknown axis `{name}`, known: {}", names.join(", "));
                    return Err(wrong("mpg_from", problem));
                }
                Some(other) if other == axis => {
                    return Err(wrong("mpg_from", "an axis does not follow itself".into()));
                }
                other => other,
            },
        };
        // Said only where it was given, so that the message points to a line that exists.
        let limit_key = if self.positive_limit.is_some() { "positive_limit" } else { "negative_limit" };
        let cams = self.cam.into_iter().enumerate();
        let cams = cams.map(|(number, cam)| {
            cam.cam(controller, &|key, problem| wrong(&format!("cam.{number}.{key}"), problem))
        });
        let usual = AxisConfig::of_model(model).with_circumference(self.circumference);
        let config = AxisConfig {
            negative_limit: self.negative_limit.unwrap_or(usual.negative_limit),
            positive_limit: self.positive_limit.unwrap_or(usual.positive_limit),
            home: self.home.unwrap_or(usual.home),
            slowdown: match self.slowdown {
                None => usual.slowdown,
                Some(SlowdownEntry::One(zone)) => [Some(zone), None],
                Some(SlowdownEntry::Two(zones)) => zones.map(Some),
            },
            circumference: self.circumference,
            switch_hysteresis: self.switch_hysteresis.unwrap_or(usual.switch_hysteresis),
            bounce_ms: self.bounce_ms.unwrap_or(usual.bounce_ms),
            normally_closed: self.normally_closed,
            index_every: self.index_every.unwrap_or(usual.index_every),
            encoder_ratio: self.encoder_ratio.unwrap_or(usual.encoder_ratio),
            encoder_at: self.encoder_at.unwrap_or(usual.encoder_at),
            backlash: self.backlash.unwrap_or(usual.backlash),
            hard_stops: self.hard_stops,
            load: self.load.unwrap_or(usual.load),
            friction: self.friction.unwrap_or(usual.friction),
            pull_out: self.pull_out,
            microsteps: self.microsteps.unwrap_or(usual.microsteps),
            in_position_ms: self.in_position_ms,
            mpg_from,
            mpg_hz: self.mpg_hz.unwrap_or(usual.mpg_hz),
            joystick: self.joystick.unwrap_or(usual.joystick),
            cams: cams.collect::<Result<_, _>>()?,
        };
        let [low, high] = [config.negative_limit, config.positive_limit];
        if low >= high {
            let problem = format!("the negative limit {low} must lie below the positive limit {high}");
            return Err(wrong(limit_key, problem));
        }
        Ok(config)
    }

    /// Nothing is wired to an input that the device does not have.
    fn check_inputs(
        &self,
        model: &str,
        controller: &dyn Controller,
        axis: usize,
        wrong: Wrong<'_>,
    ) -> Result<(), BenchError> {
        let has = |wiring: Wiring| controller.pins().iter().any(|pin| pin.wiring == wiring);
        let slowdown = self.slowdown.is_some() || self.normally_closed.contains(&Switch::Slowdown);
        let slowdown_key = if self.slowdown.is_some() { "slowdown" } else { "normally_closed" };
        let missing = [
            (slowdown_key, slowdown && !has(Wiring::Slowdown(axis)), "slowdown"),
            (
                "in_position_ms",
                self.in_position_ms.is_some() && !has(Wiring::InPosition(axis)),
                "in-position",
            ),
            ("mpg_from", self.mpg_from.is_some() && !controller.has_pulser(axis), "MPG"),
            ("mpg_hz", self.mpg_hz.is_some() && !controller.has_pulser(axis), "MPG"),
            ("joystick", self.joystick.is_some() && !has(Wiring::Joystick(axis)), "joystick"),
        ];
        if let Some((key, _, input)) = missing.into_iter().find(|(_, missing, _)| *missing) {
            return Err(wrong(key, format!("the device has no {input} input for this axis")));
        }
        if self.microsteps.is_some() && fitting(model).full_step.is_some() {
            return Err(wrong(
                "microsteps",
                "the device has its own driver, and a parameter for this".into(),
            ));
        }
        Ok(())
    }

    /// Zones begin before they end, and leave room between them.
    fn check_ends(&self, wrong: Wrong<'_>) -> Result<(), BenchError> {
        let ordered = |key: &str, [low, high]: [i64; 2]| match low > high {
            true => Err(wrong(key, format!("{low} must not lie above {high}"))),
            false => Ok(()),
        };
        if let Some(home) = self.home {
            ordered("home", home)?;
        }
        let zones = match self.slowdown {
            None => [None; 2],
            Some(SlowdownEntry::One(zone)) => [Some(zone), None],
            Some(SlowdownEntry::Two(zones)) => zones.map(Some),
        };
        let play = 2 * self.switch_hysteresis.unwrap_or(0);
        if let [Some([_, end]), Some([start, _])] = zones
            && end.saturating_add(1).saturating_add(play) >= start
        {
            return Err(wrong("slowdown", format!("the second zone must begin above {end}, with a gap")));
        }
        for zone in zones.into_iter().flatten() {
            ordered("slowdown", zone)?;
        }
        if let Some([low, high]) = self.hard_stops
            && (low > 0 || high < 0 || low == high)
        {
            return Err(wrong("hard_stops", "0, where the axis starts, must lie between the stops".into()));
        }
        self.check_circle(wrong)?;
        self.check_torque(wrong)
    }

    /// An axis that goes round has no ends, and its marks meet again.
    fn check_circle(&self, wrong: Wrong<'_>) -> Result<(), BenchError> {
        let Some(circumference) = self.circumference else { return Ok(()) };
        let closed = |switch| self.normally_closed.contains(&switch);
        let ends = [
            ("negative_limit", self.negative_limit.is_some()),
            ("positive_limit", self.positive_limit.is_some()),
            ("hard_stops", self.hard_stops.is_some()),
            ("normally_closed", closed(Switch::NegativeLimit) || closed(Switch::PositiveLimit)),
        ];
        if let Some((key, _)) = ends.into_iter().find(|(_, given)| *given) {
            return Err(wrong(key, "an axis that goes round has no ends".into()));
        }
        if matches!(self.slowdown, Some(SlowdownEntry::Two(_))) {
            return Err(wrong("slowdown", "one zone only on an axis that goes round".into()));
        }
        let every = self.index_every.unwrap_or(circumference);
        if self.encoder_at != Some(EncoderPlace::Motor) && circumference % every != 0 {
            return Err(wrong(
                "index_every",
                format!("{every} must divide the circumference {circumference}"),
            ));
        }
        Ok(())
    }

    /// A faster motor is not stronger: then there is one speed at which it stalls.
    fn check_torque(&self, wrong: Wrong<'_>) -> Result<(), BenchError> {
        let falls = |pair: &[[f64; 2]]| pair[0][0] < pair[1][0] && pair[0][1] >= pair[1][1];
        if !self.pull_out.windows(2).all(falls) {
            return Err(wrong(
                "pull_out",
                "speeds must rise from point to point, and torques must not".into(),
            ));
        }
        if self.pull_out.is_empty() && self.friction.is_some() {
            return Err(wrong("friction", "what is lost to the speed needs `pull_out`".into()));
        }
        Ok(())
    }
}

impl CamEntry {
    fn of(cam: &Cam) -> Self {
        Self { pin: cam.pin.clone(), on: cam.on, normally_closed: cam.normally_closed }
    }

    fn cam(self, controller: &dyn Controller, wrong: Wrong<'_>) -> Result<Cam, BenchError> {
        let pin = controller.pins().iter().find(|pin| pin.name == self.pin);
        let Self { pin: name, on, normally_closed } = self;
        match pin.map(|pin| pin.kind) {
            None => return Err(wrong("pin", format!("the device has no pin `{name}`"))),
            Some(PinKind::Input | PinKind::Port) => {}
            Some(_) => return Err(wrong("pin", format!("`{name}` is no digital input"))),
        }
        if on[0] > on[1] {
            return Err(wrong("on", format!("{} must not lie above {}", on[0], on[1])));
        }
        Ok(Cam { pin: name, on, normally_closed })
    }
}

/// The first pin of a device that two cams want, and how many cams there are in all.
pub(super) fn check_cams<'a>(axes: impl Iterator<Item = &'a AxisConfig>) -> Result<(), String> {
    let mut pins: Vec<_> = axes.flat_map(|axis| &axis.cams).map(|cam| cam.pin.as_str()).collect();
    pins.sort_unstable();
    if pins.len() > MAX_CAMS {
        return Err(format!("{MAX_CAMS} cams at most on a device"));
    }
    match pins.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => Err(format!("two cams on `{}`", pair[0])),
        None => Ok(()),
    }
}
