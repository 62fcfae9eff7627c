//! A fault as a file or a request says it: one flat table, of which each kind takes its keys.

use super::{
    Fault, Kind, MAX_SECONDS, Parts, Planned, Trigger, Wrong,
    kind::{Line, MAX_BABBLE_BYTES, RANGES, Way},
    trigger::{On, Place},
};
use crate::{
    device::PinValue,
    tape::{PortName, hex, unhex},
};
use serde::{Deserialize, Serialize};

/// A fault with everything that can be said of one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct Entry {
    /// The device, by its name; in scenarios only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub device: Option<String>,
    /// Seconds until it begins.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<f64>,
    /// What it waits for instead.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on: Option<On>,
    /// Seconds from there to its beginning.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub after: Option<f64>,
    /// The name of its [kind](super::KINDS).
    pub kind: String,
    /// Seconds until it is over.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub duration: Option<f64>,
    /// A pin, by its name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pin: Option<String>,
    /// What is on the pin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<PinValue>,
    /// An axis, by its name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis: Option<String>,
    /// An encoder of the axis, from 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub encoder: Option<usize>,
    /// Pulses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pulses: Option<u64>,
    /// Counts of a hand wheel.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub counts: Option<i64>,
    /// Parts of the pull-out torque at full current.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load: Option<f64>,
    /// Volts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub volts: Option<f64>,
    /// A port.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub port: Option<PortName>,
    /// A direction on the wire.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub way: Option<Way>,
    /// A probability.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate: Option<f64>,
    /// Milliseconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ms: Option<u32>,
    /// Bytes, in hexadecimal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bytes: Option<String>,
}

impl Entry {
    /// What is said of the fault itself, with its text.
    pub(super) fn given(&self) -> impl Iterator<Item = (&'static str, String)> {
        fn text<T: ToString>(value: &Option<T>) -> Option<String> {
            value.as_ref().map(ToString::to_string)
        }
        let values = [
            ("pin", self.pin.clone()),
            ("value", text(&self.value)),
            ("axis", self.axis.clone()),
            ("encoder", text(&self.encoder)),
            ("pulses", text(&self.pulses)),
            ("counts", text(&self.counts)),
            ("load", text(&self.load)),
            ("volts", text(&self.volts)),
            ("port", self.port.map(|port| port.name().into())),
            ("way", self.way.map(|way| way.name().into())),
            ("rate", text(&self.rate)),
            ("ms", text(&self.ms)),
            ("bytes", self.bytes.clone()),
            ("duration", text(&self.duration)),
        ];
        values.into_iter().filter_map(|(key, value)| Some((key, value?)))
    }

    /// Whether its numbers and texts are what their keys take.
    pub(super) fn check_ranges(&self) -> Result<(), Wrong> {
        let number = |key: &str| match key {
            "pulses" => self.pulses.map(|pulses| pulses as f64),
            "counts" => self.counts.map(|counts| counts as f64),
            "load" => self.load,
            "volts" => self.volts,
            "ms" => self.ms.map(f64::from),
            "duration" => self.duration,
            "rate" => self.rate,
            _ => None,
        };
        for (key, low, high, unit) in RANGES {
            if let Some(value) = number(key).filter(|value| !(*low..=*high).contains(value)) {
                let problem = format!("{value} is outside {low} to {high} {unit}");
                return Err(Wrong::new(key, problem.trim_end()));
            }
        }
        let is_speech = |bytes: Vec<u8>| (1..=MAX_BABBLE_BYTES).contains(&bytes.len());
        if self.bytes.as_ref().is_some_and(|text| !unhex(text).is_some_and(is_speech)) {
            let problem = format!("write 1 to {MAX_BABBLE_BYTES} bytes as pairs of hexadecimal digits");
            return Err(Wrong::new("bytes", problem));
        }
        Ok(())
    }

    /// What it means at a device. `find` knows where a program has its lines and labels.
    pub(crate) fn parse(
        &self,
        parts: &Parts,
        find: &dyn Fn(&Place) -> Result<u32, String>,
    ) -> Result<Planned, Wrong> {
        for (key, value) in [("at", self.at), ("after", self.after)] {
            if let Some(value) = value.filter(|value| !(0.0..=MAX_SECONDS).contains(value)) {
                return Err(Wrong::new(key, format!("{value} is outside 0 to {MAX_SECONDS} s")));
            }
        }
        let trigger = match (self.at, &self.on) {
            (Some(_), Some(_)) => {
                return Err(Wrong::new("on", "it is `at` a time or `on` an event, not both"));
            }
            (at, None) => Trigger::At(at.unwrap_or(0.0)),
            (None, Some(on)) => Trigger::of(on, parts, find)?,
        };
        let fault = Fault { kind: Kind::of(self, parts)?, duration_s: self.duration };
        Ok(Planned { trigger, after_s: self.after.unwrap_or(0.0), fault })
    }
}

impl From<&Fault> for Entry {
    fn from(fault: &Fault) -> Self {
        let entry = Self { kind: fault.kind.name().into(), duration: fault.duration_s, ..Self::default() };
        let on_line = |line: &Line| Self { port: line.port, way: line.way, ..entry.clone() };
        match fault.kind.clone() {
            Kind::StuckSwitch { pin, value } => Self { pin: Some(pin), value, ..entry },
            Kind::BouncingSwitch { pin, ms } => Self { pin: Some(pin), ms: Some(ms), ..entry },
            Kind::BrokenEncoder { axis, encoder } => Self { axis: Some(axis), encoder, ..entry },
            Kind::Slip { axis, pulses } => Self { axis: Some(axis), pulses: Some(pulses), ..entry },
            Kind::HandWheel { axis, counts } => Self { axis: Some(axis), counts: Some(counts), ..entry },
            Kind::ExtraLoad { axis, load } => Self { axis: Some(axis), load: Some(load), ..entry },
            Kind::SupplyDip { volts } => Self { volts: Some(volts), ..entry },
            Kind::BrownOut | Kind::PowerCut => entry,
            Kind::Noise { line, rate } | Kind::Loss { line, rate } | Kind::Duplication { line, rate } => {
                Self { rate: Some(rate), ..on_line(&line) }
            }
            Kind::Delay { line, ms } => Self { ms: Some(ms), ..on_line(&line) },
            Kind::BabblingNode { port, ms, bytes } => {
                Self { port: Some(port), ms: Some(ms), bytes: bytes.map(|bytes| hex(&bytes)), ..entry }
            }
        }
    }
}

impl From<&Planned> for Entry {
    fn from(planned: &Planned) -> Self {
        let entry = Self::from(&planned.fault);
        let after = Some(planned.after_s).filter(|after| *after != 0.0);
        match &planned.trigger {
            Trigger::At(seconds) => Self { at: Some(*seconds).filter(|at| *at != 0.0), after, ..entry },
            event => Self { on: Some(On::from(event)), after, ..entry },
        }
    }
}
