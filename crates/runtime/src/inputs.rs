//! What is known of the pins: what the controller was told last, and what it drives.

use crate::hardware::MAX_AXES;
use devices::{Pin, PinKind};

/// The most pins of a controller.
pub const MAX_PINS: usize = 128;

/// The most analog inputs.
pub const MAX_ANALOG: usize = 8;

/// A bit for each pin.
#[derive(Clone, Copy, Debug, Default)]
struct Bits([u32; MAX_PINS / u32::BITS as usize]);

impl Bits {
    fn has(&self, pin: usize) -> bool {
        self.0[pin / 32] >> (pin % 32) & 1 != 0
    }

    fn set(&mut self, pin: usize, on: bool) {
        let word = &mut self.0[pin / 32];
        *word = *word & !(1 << (pin % 32)) | u32::from(on) << (pin % 32);
    }
}

/// The pins as the controller knows them.
#[derive(Debug)]
pub(crate) struct Pins {
    /// The levels that it was told last.
    told: Bits,
    /// What it drives, and how.
    driven: Bits,
    levels: Bits,
    /// What its analog inputs were when it was told last.
    analog: [i32; MAX_ANALOG],
    /// What the decoders of its pulser inputs have counted.
    pub pulsers: [i32; MAX_AXES],
    /// A port that it let go of becomes an input at this tick.
    pub released_at: u64,
}

impl Pins {
    /// All at rest.
    ///
    /// # Panics
    /// If there are more than [`MAX_PINS`].
    pub fn new(pins: &[Pin]) -> Self {
        assert!(pins.len() <= MAX_PINS, "too many pins");
        let mut told = Bits::default();
        for (number, pin) in pins.iter().enumerate().filter(|(_, pin)| pin.kind.is_told()) {
            told.set(number, pin.rest != 0);
        }
        let mut analog = [0; MAX_ANALOG];
        for (index, (_, pin)) in analog_inputs(pins) {
            analog[index] = pin.rest;
        }
        Self {
            told,
            driven: Bits::default(),
            levels: Bits::default(),
            analog,
            pulsers: [0; MAX_AXES],
            released_at: 0,
        }
    }

    /// The controller drives a pin.
    pub fn drive(&mut self, pin: usize, on: bool) {
        self.driven.set(pin, true);
        self.levels.set(pin, on);
    }

    /// It does not any more.
    pub fn release(&mut self, pin: usize) {
        self.driven.set(pin, false);
    }

    /// The level that it drives.
    pub fn driven(&self, pin: usize) -> Option<bool> {
        self.driven.has(pin).then(|| self.levels.has(pin))
    }

    /// Whether it has to be told of this level; then it will have been.
    pub fn tell(&mut self, pin: usize, level: bool) -> bool {
        let news = self.told.has(pin) != level;
        self.told.set(pin, level);
        news
    }

    /// The same of an analog input.
    pub fn tell_analog(&mut self, index: usize, value: i32) -> bool {
        core::mem::replace(&mut self.analog[index], value) != value
    }
}

/// The analog inputs: how many there are before each, and their numbers.
pub(crate) fn analog_inputs(pins: &[Pin]) -> impl Iterator<Item = (usize, (usize, &Pin))> {
    pins.iter().enumerate().filter(|(_, pin)| pin.kind == PinKind::Analog).enumerate()
}

/// Whether a count lies strictly between two others, on the circle that it counts on.
pub(crate) fn is_between(count: i32, (low, high): (i32, i32)) -> bool {
    let (beyond, whole) = (count.wrapping_sub(low) as u32, high.wrapping_sub(low) as u32);
    beyond != 0 && (beyond < whole || whole == 0)
}
