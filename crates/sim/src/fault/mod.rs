//! Faults on purpose: what is wrong with a machine, its supply or its wires, when it begins, and how long it
//! lasts.
//!
//! - [`kind`] is the table of all faults.
//! - [`trigger`] is what they wait for.
//! - [`entry`] is a fault as files and requests say it.
//! - [`scenario`] reads the file that plans the faults of a bench.
//!
//! A fault lies between the controller and the world, inside its [`VirtualDevice`](crate::VirtualDevice): what
//! happens is still a function of what the device is told, so tapes hold plans and not outcomes.

pub mod entry;
pub mod kind;
pub mod scenario;
#[cfg(test)]
mod tests;
pub mod trigger;
pub(crate) mod wire;

pub use entry::Entry;
pub use kind::{KINDS, Kind, KindRow, Line, Way};
pub use scenario::Scenario;
pub use trigger::{Place, TRIGGERS, Trigger, TriggerRow};

use crate::{config::DeviceConfig, flash::SharedFlash, machine::fitting::fitting};
use devices::{Controller, Language, Model, Pin};
use serde::{Serialize, Serializer};
use std::fmt;

/// Most faults that a device may have or wait for at a time.
pub const MAX_FAULTS: usize = 256;

/// Longest time that can be given for anything, in seconds.
pub const MAX_SECONDS: f64 = 1e9;

/// Something that is wrong, and for how long.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// What is wrong.
    pub kind: Kind,
    /// Seconds until it is over; `None` leaves it until it is cleared.
    pub duration_s: Option<f64>,
}

/// A fault with what it waits for.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    /// What begins it.
    pub trigger: Trigger,
    /// Seconds from there to its beginning.
    pub after_s: f64,
    /// What is wrong then.
    pub fault: Fault,
}

impl From<Fault> for Planned {
    /// A fault that begins at once.
    fn from(fault: Fault) -> Self {
        Self { trigger: Trigger::At(0.0), after_s: 0.0, fault }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let entry = Entry::from(self);
        f.write_str(&entry.kind)?;
        entry.given().try_for_each(|(key, value)| write!(f, " {key}={value}"))
    }
}

/// What is wrong with an entry: the key, and one line of text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{key}: {problem}")]
pub struct Wrong {
    /// The key at fault, or the one that is missing.
    pub key: &'static str,
    /// What is wrong with it.
    pub problem: String,
}

impl Wrong {
    fn new(key: &'static str, problem: impl Into<String>) -> Self {
        Self { key, problem: problem.into() }
    }
}

/// Why a device does not take a fault, or does not lose one.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FaultError {
    /// Something that it names is not there, or cannot be so.
    #[error(transparent)]
    Wrong(#[from] Wrong),
    /// The device has [`MAX_FAULTS`] already.
    #[error("a device has {MAX_FAULTS} faults at most")]
    TooMany,
    /// There is no fault of this number, or it is over.
    #[error("there is no fault {0}")]
    Unknown(u64),
}

/// A fault of a device, as it stands.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "openapi", derive(utoipa::ToSchema))]
pub struct FaultView {
    /// Its number, which no other fault of the device has.
    pub id: u64,
    /// Whether it has begun.
    #[serde(rename = "state", serialize_with = "state")]
    #[cfg_attr(feature = "openapi", schema(value_type = String, examples("waiting", "active")))]
    pub is_active: bool,
    /// What it is: the keys that it was given.
    #[serde(flatten)]
    // An `Entry` takes no key that it does not know, and so not the two above.
    #[cfg_attr(feature = "openapi", schema(value_type = Object))]
    pub entry: Entry,
}

fn state<S: Serializer>(is_active: &bool, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(if *is_active { "active" } else { "waiting" })
}

/// What an entry is checked against: what a device has.
#[derive(Clone, Copy)]
pub(crate) struct Parts {
    pub model: &'static Model,
    pub axes: &'static [&'static str],
    pub pins: &'static [Pin],
    /// The axes with an input for a hand wheel, as bits.
    pulsers: u64,
}

impl Parts {
    /// Those of a device to be. Only a controller knows them.
    pub fn of(config: &DeviceConfig) -> Self {
        let model = config.model;
        let controller = (model.build)(Box::new(SharedFlash::erased(model.flash_bytes)), 0);
        Self::of_controller(model, &*controller)
    }

    /// Those of a controller.
    pub fn of_controller(model: &'static Model, controller: &dyn Controller) -> Self {
        let axes = controller.axes();
        let with_pulser = (0..axes.len()).filter(|axis| controller.has_pulser(*axis));
        let pulsers = with_pulser.fold(0, |bits, axis| bits | 1 << axis);
        Self { model, axes, pins: controller.pins(), pulsers }
    }

    /// Whether an axis has an input for a hand wheel.
    pub fn has_pulser(&self, axis: usize) -> bool {
        self.pulsers >> axis & 1 != 0
    }

    /// The number of an axis.
    pub fn axis(&self, name: &str) -> Result<usize, Wrong> {
        let unknown =
            || Wrong::new("axis", format!("unknown axis `{name}`, known: {}", self.axes.join(", ")));
        self.axes.iter().position(|axis| *axis == name).ok_or_else(unknown)
    }

    /// The number of a pin.
    pub fn pin(&self, name: &str) -> Result<usize, Wrong> {
        crate::device::find_pin(self.pins, name).map_err(|error| Wrong::new("pin", error.to_string()))
    }

    /// How many encoders each axis has.
    pub fn encoders(&self) -> usize {
        fitting(self.model.name).encoders.len()
    }

    /// Whether messages at the ports of bytes have a fixed length.
    pub fn framing(&self) -> Framing {
        match self.model.language {
            Language::Tmcl => Framing::Tmcl,
            Language::Ascript(_) => Framing::Lines,
        }
    }
}

/// What a message is at a port of bytes. On CAN it is a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Framing {
    /// Nine bytes.
    Tmcl,
    /// Text up to a carriage return, line feed or NUL.
    Lines,
}
