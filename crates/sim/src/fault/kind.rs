//! All kinds of faults: one row each.

use super::{Entry, Parts, Wrong};
use crate::{
    config::MAX_PULSES,
    device::{MAX_COUNTS, PinValue, level_for},
    machine::MAX_BOUNCE_MS,
    tape::PortName,
};
use devices::Wiring;
use serde::{Deserialize, Serialize};

/// Longest time that bytes are late, or a neighbour is quiet.
pub const MAX_MS: u32 = 60_000;

/// Most bytes that a babbling node says at a time.
pub const MAX_BABBLE_BYTES: usize = 64;

/// What is wrong.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// An input stays at a level whatever is done to it.
    StuckSwitch {
        /// The input.
        pin: String,
        /// Its level; `None` is the one that it has when the fault begins.
        value: Option<PinValue>,
    },
    /// A switch bounces whenever it changes.
    BouncingSwitch {
        /// The input.
        pin: String,
        /// For so many milliseconds.
        ms: u32,
    },
    /// An encoder counts no more.
    BrokenEncoder {
        /// The axis.
        axis: String,
        /// Which of its encoders, from 0; `None` is all of them.
        encoder: Option<usize>,
    },
    /// A motor does not follow its next pulses.
    Slip {
        /// The axis.
        axis: String,
        /// So many of them.
        pulses: u64,
    },
    /// The hand wheel at the MPG input of an axis is turned.
    HandWheel {
        /// The axis.
        axis: String,
        /// By so many edges of its phases, after those that are still to come.
        counts: i64,
    },
    /// An axis is loaded more.
    ExtraLoad {
        /// The axis.
        axis: String,
        /// By so many parts of the motor's pull-out torque at full current.
        load: f64,
    },
    /// The motor supply has another voltage.
    SupplyDip {
        /// In volts.
        volts: f64,
    },
    /// The supply is too low for the controller, which stands still and starts again afterwards. What flash had
    /// begun comes to its end.
    BrownOut,
    /// The supply is gone. What flash had not finished is lost or torn.
    PowerCut,
    /// Bits are turned over; a CAN frame with a wrong bit is dropped by its checksum.
    Noise {
        /// Where.
        line: Line,
        /// How probable that is for each bit.
        rate: f64,
    },
    /// Bytes, on CAN frames, are lost.
    Loss {
        /// Where.
        line: Line,
        /// How probable that is for each.
        rate: f64,
    },
    /// Bytes, on CAN frames, come twice.
    Duplication {
        /// Where.
        line: Line,
        /// How probable that is for each.
        rate: f64,
    },
    /// Bytes are late.
    Delay {
        /// Where.
        line: Line,
        /// By so many milliseconds.
        ms: u32,
    },
    /// A neighbour on the bus talks out of turn: the controller and its host hear what nobody asked for.
    BabblingNode {
        /// Where.
        port: PortName,
        /// How often on average, in milliseconds; the pauses are half as long to half as long again.
        ms: u32,
        /// What it says; `None` is one to eight random bytes, on CAN a random frame.
        bytes: Option<Vec<u8>>,
    },
}

/// A wire, or all of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Line {
    /// The port that it ends at; `None` is all.
    pub port: Option<PortName>,
    /// The direction; `None` is both.
    pub way: Option<Way>,
}

/// A direction on a wire.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Way {
    /// To the controller.
    In,
    /// From the controller.
    Out,
}

impl Way {
    /// Its name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::In => "in",
            Self::Out => "out",
        }
    }
}

/// What there is to know about a kind of faults.
pub struct KindRow {
    /// Its name in files.
    pub name: &'static str,
    /// The keys that it must have, beside those of every fault.
    pub needs: &'static [&'static str],
    /// The keys that it may have.
    pub may: &'static [&'static str],
    /// Whether it lasts, so that it can have a `duration`.
    pub lasts: bool,
    /// What it does, for people.
    pub text: &'static str,
    /// The test that holds it.
    pub test: &'static str,
    make: fn(&Entry) -> Kind,
}

/// The kinds.
pub const KINDS: &[KindRow] = &[
    KindRow {
        name: "stuck_switch",
        needs: &["pin"],
        may: &["value"],
        lasts: true,
        text: "The input stays at `value`, or as it is.",
        test: "stuck_switches",
        make: |entry| Kind::StuckSwitch { pin: text(&entry.pin), value: entry.value },
    },
    KindRow {
        name: "bouncing_switch",
        needs: &["pin", "ms"],
        may: &[],
        lasts: true,
        text: "The switch bounces for up to `ms` milliseconds whenever it changes.",
        test: "bouncing_switches",
        make: |entry| Kind::BouncingSwitch { pin: text(&entry.pin), ms: number(entry.ms) },
    },
    KindRow {
        name: "broken_encoder",
        needs: &["axis"],
        may: &["encoder"],
        lasts: true,
        text: "The axis' encoders, or the one with this number from 0, keep their counts.",
        test: "broken_encoders",
        make: |entry| Kind::BrokenEncoder { axis: text(&entry.axis), encoder: entry.encoder },
    },
    KindRow {
        name: "slip",
        needs: &["axis", "pulses"],
        may: &[],
        lasts: false,
        text: "The motor does not follow its next `pulses` pulses.",
        test: "slips",
        make: |entry| Kind::Slip { axis: text(&entry.axis), pulses: number(entry.pulses) },
    },
    KindRow {
        name: "hand_wheel",
        needs: &["axis", "counts"],
        may: &[],
        lasts: false,
        text: "The hand wheel at the axis' MPG input is turned by `counts`, edges of both its phases, up or down.",
        test: "hand_wheels",
        make: |entry| Kind::HandWheel { axis: text(&entry.axis), counts: number(entry.counts) },
    },
    KindRow {
        name: "extra_load",
        needs: &["axis", "load"],
        may: &[],
        lasts: true,
        text: "So much more load, in parts of the pull-out torque at full current.",
        test: "extra_loads",
        make: |entry| Kind::ExtraLoad { axis: text(&entry.axis), load: number(entry.load) },
    },
    KindRow {
        name: "supply_dip",
        needs: &["volts"],
        may: &[],
        lasts: true,
        text: "The motor supply has `volts` volts: too few or too many.",
        test: "supply_dips",
        make: |entry| Kind::SupplyDip { volts: number(entry.volts) },
    },
    KindRow {
        name: "brown_out",
        needs: &[],
        may: &[],
        lasts: true,
        text: "Too little voltage for the controller: it stands still, and starts again when it is over. \
               What flash had begun comes to its end.",
        test: "brown_outs",
        make: |_| Kind::BrownOut,
    },
    KindRow {
        name: "power_cut",
        needs: &[],
        may: &[],
        lasts: true,
        text: "No voltage at all: what flash had not finished is lost or torn.",
        test: "power_cuts",
        make: |_| Kind::PowerCut,
    },
    KindRow {
        name: "noise",
        needs: &["rate"],
        may: &["port", "way"],
        lasts: true,
        text: "Each bit is turned over with this probability; a CAN frame with a wrong bit is dropped.",
        test: "noise",
        make: |entry| Kind::Noise { line: line(entry), rate: number(entry.rate) },
    },
    KindRow {
        name: "loss",
        needs: &["rate"],
        may: &["port", "way"],
        lasts: true,
        text: "Each byte, or CAN frame, is lost with this probability.",
        test: "loss",
        make: |entry| Kind::Loss { line: line(entry), rate: number(entry.rate) },
    },
    KindRow {
        name: "duplication",
        needs: &["rate"],
        may: &["port", "way"],
        lasts: true,
        text: "Each byte, or CAN frame, comes twice with this probability.",
        test: "duplication",
        make: |entry| Kind::Duplication { line: line(entry), rate: number(entry.rate) },
    },
    KindRow {
        name: "delay",
        needs: &["ms"],
        may: &["port", "way"],
        lasts: true,
        text: "What is sent comes so many milliseconds later.",
        test: "delay",
        make: |entry| Kind::Delay { line: line(entry), ms: number(entry.ms) },
    },
    KindRow {
        name: "babbling_node",
        needs: &["port", "ms"],
        may: &["bytes"],
        lasts: true,
        text: "A neighbour on the bus says `bytes` (hexadecimal) or random ones about every `ms` milliseconds; the \
               controller and its host hear it.",
        test: "babbling_nodes",
        make: |entry| Kind::BabblingNode {
            port: entry.port.unwrap_or(PortName::Rs485),
            ms: number(entry.ms),
            bytes: entry.bytes.as_deref().and_then(crate::tape::unhex),
        },
    },
];

fn text(value: &Option<String>) -> String {
    value.clone().unwrap_or_default()
}

fn number<T: Default>(value: Option<T>) -> T {
    value.unwrap_or_default()
}

fn line(entry: &Entry) -> Line {
    Line { port: entry.port, way: entry.way }
}

impl Kind {
    /// The kind that an entry means, with everything that it names.
    pub(super) fn of(entry: &Entry, parts: &Parts) -> Result<Self, Wrong> {
        let row = KINDS.iter().find(|row| row.name == entry.kind).ok_or_else(|| {
            let known: Vec<_> = KINDS.iter().map(|row| row.name).collect();
            Wrong::new("kind", format!("unknown kind `{}`, known: {}", entry.kind, known.join(", ")))
        })?;
        let given: Vec<_> = entry.given().map(|(key, _)| key).collect();
        if let Some(key) = row.needs.iter().find(|key| !given.contains(key)) {
            return Err(Wrong::new("kind", format!("{} needs `{key}`", row.name)));
        }
        let lasting: &[&str] = if row.lasts { &["duration"] } else { &[] };
        let fits = |key: &&str| [row.needs, row.may, lasting].iter().any(|keys| keys.contains(key));
        if let Some(key) = given.iter().find(|key| !fits(key)) {
            return Err(Wrong::new(key, format!("{} has no `{key}`", row.name)));
        }
        entry.check_ranges()?;
        let kind = (row.make)(entry);
        kind.check(parts)?;
        Ok(kind)
    }

    /// Whether the device has what the fault is at.
    fn check(&self, parts: &Parts) -> Result<(), Wrong> {
        match self {
            Self::StuckSwitch { pin, value } => {
                let pin = &parts.pins[input(parts, pin)?];
                let level = value.map(|value| level_for(pin, value)).transpose();
                level.map_err(|error| Wrong::new("value", error.to_string()))?;
            }
            Self::BouncingSwitch { pin, ms } => {
                if *ms > MAX_BOUNCE_MS {
                    return Err(Wrong::new("ms", format!("{ms} is outside 1 to {MAX_BOUNCE_MS} ms")));
                }
                let number = input(parts, pin)?;
                let pin = &parts.pins[number];
                if matches!(pin.wiring, Wiring::Free | Wiring::Index(_)) || pin.kind.is_analog() {
                    return Err(Wrong::new("pin", format!("no switch is at `{}`", pin.name)));
                }
            }
            Self::BrokenEncoder { axis, encoder } => {
                parts.axis(axis)?;
                if encoder.is_some_and(|encoder| encoder >= parts.encoders()) {
                    let problem = format!("the axis has {} of them, from 0", parts.encoders());
                    return Err(Wrong::new("encoder", problem));
                }
            }
            Self::Slip { axis, .. } | Self::ExtraLoad { axis, .. } => {
                parts.axis(axis)?;
            }
            Self::HandWheel { axis: name, .. } => {
                if !parts.has_pulser(parts.axis(name)?) {
                    return Err(Wrong::new("axis", format!("axis `{name}` has no MPG input")));
                }
            }
            Self::SupplyDip { .. } => {
                if !parts.pins.iter().any(|pin| pin.wiring == Wiring::Supply) {
                    let problem = format!("a {} has no pin that measures its supply", parts.model.name);
                    return Err(Wrong::new("kind", problem));
                }
            }
            Self::BrownOut
            | Self::PowerCut
            | Self::Noise { .. }
            | Self::Loss { .. }
            | Self::Duplication { .. }
            | Self::Delay { .. }
            | Self::BabblingNode { .. } => {}
        }
        Ok(())
    }

    /// Its name in files.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::StuckSwitch { .. } => "stuck_switch",
            Self::BouncingSwitch { .. } => "bouncing_switch",
            Self::BrokenEncoder { .. } => "broken_encoder",
            Self::Slip { .. } => "slip",
            Self::HandWheel { .. } => "hand_wheel",
            Self::ExtraLoad { .. } => "extra_load",
            Self::SupplyDip { .. } => "supply_dip",
            Self::BrownOut => "brown_out",
            Self::PowerCut => "power_cut",
            Self::Noise { .. } => "noise",
            Self::Loss { .. } => "loss",
            Self::Duplication { .. } => "duplication",
            Self::Delay { .. } => "delay",
            Self::BabblingNode { .. } => "babbling_node",
        }
    }

    /// Whether it lies on a wire.
    pub(crate) const fn is_on_wire(&self) -> bool {
        matches!(
            self,
            Self::Noise { .. }
                | Self::Loss { .. }
                | Self::Duplication { .. }
                | Self::Delay { .. }
                | Self::BabblingNode { .. }
        )
    }
}

/// The number of an input.
fn input(parts: &Parts, name: &str) -> Result<usize, Wrong> {
    let pin = parts.pin(name)?;
    if parts.pins[pin].kind.is_output() {
        return Err(Wrong::new("pin", format!("`{name}` is an output, only the controller drives it")));
    }
    Ok(pin)
}

/// The ranges of numbers, by key.
pub(super) const RANGES: &[(&str, f64, f64, &str)] = &[
    ("pulses", 1.0, MAX_PULSES as f64, "pulses"),
    ("counts", -(MAX_COUNTS as f64), MAX_COUNTS as f64, "counts"),
    ("load", 0.0, 1000.0, "of the pull-out torque"),
    ("volts", 0.0, 1000.0, "V"),
    ("ms", 1.0, MAX_MS as f64, "ms"),
    ("duration", 0.0, super::MAX_SECONDS, "s"),
    ("rate", 0.0, 1.0, ""),
];
