//! Which devices there are, where they listen, and what machine each of them moves.

mod axis;
mod endpoint;
mod file;
mod fleet;
mod keys;
mod reference;
mod schema;
pub(crate) mod source;
#[cfg(test)]
mod tests;

pub use endpoint::{Endpoint, EndpointError, PlaceError};
pub use file::{is_name, text as bench_text};
pub use reference::reference;
pub use schema::schema;
pub use source::BenchError;
pub(crate) use source::{Source, read as read_text};

use crate::machine::fitting::fitting;
use devices::Model;
use serde::{Deserialize, Serialize};
use std::{
    collections::{BTreeMap, HashMap},
    fmt,
    path::Path,
};

/// Positions of switches and the like lie this many pulses from 0 at most.
pub const MAX_PULSES: i64 = 1 << 40;

/// Most devices of one bench file.
pub const MAX_DEVICES: usize = 10_000;

/// Motor supply where a bench file names none, in volts.
pub const DEFAULT_SUPPLY_V: f64 = 24.0;

/// Temperature of the driver stage where a bench file names none, in °C.
pub const DEFAULT_TEMPERATURE_C: f64 = 25.0;

/// Longest time that a servo driver may need to come into position.
pub const MAX_IN_POSITION_MS: u32 = 60_000;

/// Most counts a second of a hand wheel.
pub const MAX_MPG_HZ: u32 = 1_000_000;

/// Counts a second of a hand wheel where a bench file names none.
pub const DEFAULT_MPG_HZ: u32 = 10_000;

/// Most cams of a device.
pub const MAX_CAMS: usize = 16;

/// Most points of a torque curve.
pub const MAX_POINTS: usize = 64;

/// A bench file: all devices on the bench.
#[derive(Clone, Debug, PartialEq)]
pub struct Bench {
    /// In the order of the file.
    pub devices: Vec<DeviceConfig>,
}

impl Bench {
    /// Reads a bench file.
    ///
    /// # Errors
    /// [`BenchError`], with the line and key at fault.
    pub fn read(path: &Path) -> Result<Self, BenchError> {
        file::read(path)
    }

    /// Reads the text of a bench file; `file` is its name for messages.
    ///
    /// # Errors
    /// [`BenchError`], with the line and key at fault.
    pub fn parse(text: &str, file: &str) -> Result<Self, BenchError> {
        file::parse(text, file, devices::MODELS)
    }

    /// The same from somebody at another machine: its devices listen on TCP at this one, or nowhere.
    ///
    /// # Errors
    /// [`BenchError`], with the line and key at fault.
    pub fn parse_local(text: &str, file: &str) -> Result<Self, BenchError> {
        file::parse_where(text, file, devices::MODELS, Endpoint::check_local)
    }
}

/// One device.
#[derive(Clone)]
pub struct DeviceConfig {
    /// What it is.
    pub model: &'static Model,
    /// What it is called, by default like its model. Letters, digits and `.`, `_`, `-`.
    pub name: String,
    /// Where it listens.
    pub listen: Vec<Endpoint>,
    /// The machine, by the name of the axis.
    pub axes: BTreeMap<String, AxisConfig>,
    /// Motor supply in volts.
    pub supply_v: f64,
    /// Temperature of the driver stage in °C.
    pub temperature_c: f64,
    /// What its random numbers start from; `None` leaves it to whoever builds the device.
    pub seed: Option<u64>,
}

impl DeviceConfig {
    /// A device with everything at its default.
    pub fn new(model: &'static Model) -> Self {
        Self {
            model,
            name: model.name.into(),
            listen: Vec::new(),
            axes: BTreeMap::new(),
            supply_v: DEFAULT_SUPPLY_V,
            temperature_c: DEFAULT_TEMPERATURE_C,
            seed: None,
        }
    }

    /// Whether it can be at one of its endpoints, besides other devices.
    ///
    /// # Errors
    /// [`PlaceError`].
    pub fn fits(&self, endpoint: &Endpoint, others: &[Self]) -> Result<(), PlaceError> {
        if !endpoint.is_hid() {
            return Ok(());
        }
        if self.model.hid_product.is_none() {
            return Err(PlaceError::NotHid(self.model.name));
        }
        let there = |other: &&Self| endpoint.can_be_shared() && other.listen.contains(endpoint);
        others.iter().find(there).map_or(Ok(()), |other| Err(PlaceError::Taken(other.name.clone())))
    }

    /// The machine at this axis, which is the model's usual one where nothing else was said.
    pub fn axis(&self, name: &str) -> AxisConfig {
        self.axes.get(name).cloned().unwrap_or_else(|| AxisConfig::of_model(self.model.name))
    }
}

// A model is its name; the function that builds it has no sensible form in print or comparison.
impl fmt::Debug for DeviceConfig {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("DeviceConfig")
            .field("model", &self.model.name)
            .field("name", &self.name)
            .field("listen", &self.listen)
            .field("axes", &self.axes)
            .field("supply_v", &self.supply_v)
            .field("temperature_c", &self.temperature_c)
            .field("seed", &self.seed)
            .finish()
    }
}

impl PartialEq for DeviceConfig {
    fn eq(&self, other: &Self) -> bool {
        self.model.name == other.model.name
            && self.name == other.name
            && self.listen == other.listen
            && self.axes == other.axes
            && self.supply_v == other.supply_v
            && self.temperature_c == other.temperature_c
            && self.seed == other.seed
    }
}

/// The machine at one axis. Positions are pulses at full resolution (1/256 of a full step for a driver
/// with microsteps) from where the axis stands when it is switched on for the first time.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisConfig {
    /// The switch at the negative end is on here and below.
    pub negative_limit: i64,
    /// The switch at the positive end is on here and above.
    pub positive_limit: i64,
    /// The home switch is on from the first to the second position, both included.
    pub home: [i64; 2],
    /// The slowdown switch is on from the first to the second position, both included; where a second zone
    /// is given, it lies above.
    pub slowdown: [Option<[i64; 2]>; 2],
    /// After so many pulses an axis that goes round is where it was; its limits do not count.
    pub circumference: Option<i64>,
    /// A switch that is on stays so until its shaft is this far past the end of its zone.
    pub switch_hysteresis: i64,
    /// How long a switch bounces after a change, in milliseconds.
    pub bounce_ms: u32,
    /// Switches that are closed while nothing is on them.
    pub normally_closed: Vec<Switch>,
    /// Pulses from one index mark of the external encoder to the next; one is at 0.
    pub index_every: i64,
    /// Counts of the external encoder a pulse, after decoding; a built-in encoder has its own resolution
    /// times this. Negative if it counts backwards.
    pub encoder_ratio: f64,
    /// Where the external encoder sits.
    pub encoder_at: EncoderPlace,
    /// Play between the motor and what it drives, in pulses.
    pub backlash: i64,
    /// Where the axis hits something that does not give way, if anywhere: it stalls there.
    pub hard_stops: Option<[i64; 2]>,
    /// Load as a part of the motor's pull-out torque at full current; above 1 it stalls.
    pub load: f64,
    /// Load that grows with the speed: so much at 1,000 full steps a second.
    pub friction: f64,
    /// The torque that the motor has at each speed: full steps a second, rising, and parts of the torque
    /// that `load` is measured in, not rising. Without a point the torque does not depend on the speed, and
    /// the motor loses single pulses; with them it falls behind by whole electrical cycles.
    pub pull_out: Vec<[f64; 2]>,
    /// Pulses that the driver takes for a full step, at full resolution.
    pub microsteps: u32,
    /// How long after a pulse that no other follows a servo driver says that it is in position; without it
    /// there is none that does.
    pub in_position_ms: Option<u32>,
    /// The axis, by its number, whose encoder is wired to the MPG input of this one.
    pub mpg_from: Option<usize>,
    /// Counts a second that a hand wheel at the MPG input gives.
    pub mpg_hz: u32,
    /// How far the joystick of this axis is deflected, from -1 to 1.
    pub joystick: f64,
    /// Inputs of the device that this axis switches.
    pub cams: Vec<Cam>,
}

/// A switch of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Switch {
    /// At its negative end.
    NegativeLimit,
    /// At its positive end.
    PositiveLimit,
    /// Home.
    Home,
    /// Where it should slow down.
    Slowdown,
}

/// Where an encoder sits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum EncoderPlace {
    /// On the motor's shaft.
    Motor,
    /// Behind the play, on what it drives.
    Load,
}

/// An input that an axis switches as it passes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cam {
    /// The input.
    pub pin: String,
    /// It is on from the first to the second position of the axis, both included.
    pub on: [i64; 2],
    /// Whether it is off there instead, and on elsewhere.
    pub normally_closed: bool,
}

impl AxisConfig {
    /// What a model's axis has unless a bench file says otherwise.
    pub fn of_model(model: &str) -> Self {
        let fitting = fitting(model);
        Self {
            negative_limit: -fitting.limit,
            positive_limit: fitting.limit,
            home: [-200, 0],
            slowdown: [None; 2],
            circumference: None,
            switch_hysteresis: 0,
            bounce_ms: 0,
            normally_closed: Vec::new(),
            index_every: 4000,
            encoder_ratio: 1.0,
            encoder_at: EncoderPlace::Load,
            backlash: 0,
            hard_stops: None,
            load: 0.0,
            friction: 0.0,
            pull_out: Vec::new(),
            microsteps: fitting.full_step.unwrap_or(1),
            in_position_ms: None,
            mpg_from: None,
            mpg_hz: DEFAULT_MPG_HZ,
            joystick: 0.0,
            cams: Vec::new(),
        }
    }

    /// The same, going round: with one index mark a turn.
    fn with_circumference(self, circumference: Option<i64>) -> Self {
        Self { circumference, index_every: circumference.unwrap_or(self.index_every), ..self }
    }
}

/// An endpoint with the devices behind it; more than one make a shared RS-485 bus.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bus {
    /// Where it is.
    pub endpoint: Endpoint,
    /// Indices of the devices.
    pub members: Vec<usize>,
}

impl Bus {
    /// Whether several devices share it, so that addresses count.
    pub fn is_shared(&self) -> bool {
        self.members.len() > 1
    }
}

/// All endpoints of some devices, in the order in which they are first named. The same endpoint is one
/// bus, except that a port 0 is an endpoint of its own each time.
pub fn buses(devices: &[DeviceConfig]) -> Vec<Bus> {
    let mut buses: Vec<Bus> = Vec::new();
    let mut shared = HashMap::new();
    for (index, device) in devices.iter().enumerate() {
        for endpoint in &device.listen {
            let next = buses.len();
            let place = if endpoint.can_be_shared() { *shared.entry(endpoint).or_insert(next) } else { next };
            if place == next {
                buses.push(Bus { endpoint: endpoint.clone(), members: Vec::new() });
            }
            buses[place].members.push(index);
        }
    }
    buses
}
