//! What axes do, at even distances of time, for charts.

use devices::guide::Guide;
use serde::Serialize;
use sim::{PinValue, VirtualDevice};
use std::collections::BTreeMap;
use ts_rs::TS;
use utoipa::ToSchema;

/// Samples a second of wall clock.
pub(crate) const RATE_HZ: f64 = 100.0;

/// Most samples that wait to be taken; later ones are left out.
const MAX_WAITING: usize = 1000;

/// What axes did, a column a quantity.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS, ToSchema)]
pub(crate) struct Samples {
    /// The time of each sample, in seconds of device time; of real controllers since the wire was opened.
    pub seconds: Vec<f64>,
    /// The axes by name.
    pub axes: BTreeMap<&'static str, AxisSamples>,
}

/// What an axis did, in the units of its status.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS, ToSchema)]
pub(crate) struct AxisSamples {
    /// Positions.
    pub position: Vec<f64>,
    /// Positions as the encoder says.
    pub encoder: Vec<f64>,
    /// Speeds.
    pub speed: Vec<f64>,
    /// Load values, if the controller measures them.
    pub load: Option<Vec<f64>>,
    /// How far the encoder is from where it should be, if the controller compares.
    pub delta: Option<Vec<f64>>,
}

/// Takes samples of a device.
pub(crate) struct Sampler {
    guide: &'static Guide,
    /// How many clocks lie between.
    period: u64,
    next: u64,
    samples: Samples,
}

/// What the controllers call these quantities, apart from the axis.
const LOAD: &str = "APActualLoadValue";
const SPEED: &str = "APActualSpeed";
const DELTA: &str = "D";

impl Sampler {
    /// Samples from now on, `RATE_HZ` a second of wall clock at this speed.
    pub fn new(device: &VirtualDevice, speed: f64) -> Self {
        let period = device.ticks(speed / RATE_HZ).max(1);
        let guide = device.config().model.guide;
        Self { guide, period, next: device.now(), samples: Samples::default() }
    }

    /// When the next sample is due.
    pub const fn next(&self) -> u64 {
        self.next
    }

    /// Takes one, if there is still room.
    pub fn take(&mut self, device: &mut VirtualDevice) {
        self.next = device.now() + self.period;
        let samples = &mut self.samples;
        if samples.seconds.len() >= MAX_WAITING {
            return;
        }
        samples.seconds.push(device.seconds());
        for (number, name) in device.axes().iter().enumerate() {
            let state = device.axis(number);
            let axis = samples.axes.entry(*name).or_default();
            axis.position.push(state.position.into());
            axis.encoder.push(state.encoder.into());
            // In the unit of the controller's own register, where that is not pulses a second.
            let speed = number_of(device, SPEED);
            axis.speed.push(speed.unwrap_or(state.speed_mpps as f64 / 1000.0));
            if let Some(load) = number_of(device, LOAD) {
                axis.load.get_or_insert_default().push(load);
            }
            if self.guide.axes.len() > 1
                && let Some(delta) = number_of(device, &format!("{DELTA}{name}"))
            {
                axis.delta.get_or_insert_default().push(delta);
            }
        }
    }

    /// What was taken since the last time.
    pub fn drain(&mut self) -> Samples {
        std::mem::take(&mut self.samples)
    }
}

fn number_of(device: &mut VirtualDevice, name: &str) -> Option<f64> {
    match device.value(name)? {
        PinValue::Number(number) => Some(number),
        PinValue::Level(_) => None,
    }
}
