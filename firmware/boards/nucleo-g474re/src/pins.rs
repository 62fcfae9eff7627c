//! What the player drives.

use crate::chip::{self, chip, put};
use crate::gpio::Gpio;
use crate::wiring::{DIRECTION, ENABLE, STEP, gpio};
use devices::{Drive, Pin, PinKind};
use embedded_hal::digital::OutputPin as _;
use motion::Direction;

/// How long a step pin is high at least: usual drivers need 0.1 µs.
const PULSE_CLOCKS: u32 = chip::HZ / 10_000_000;

/// How long a direction is there before its first pulse: usual drivers need 20 ns.
const SETUP_CLOCKS: u32 = chip::HZ / 50_000_000;

/// All that are the controller's and the chip's.
pub struct Pins {
    pins: &'static [Pin],
}

impl Pins {
    /// Sets up the pins of a controller; the drivers are off.
    pub(crate) fn new(pins: &'static [Pin]) -> Self {
        quiet();
        for pin in STEP.into_iter().chain(DIRECTION).chain(ENABLE) {
            pin.make_output();
        }
        for pin in pins {
            let Some(chip) = gpio(pin.name) else { continue };
            if pin.kind == PinKind::Output {
                chip.make_output();
            } else {
                chip.make_input(pin.rest != 0);
            }
        }
        Self { pins }
    }

    fn gpio(&self, pin: usize) -> Option<Gpio> {
        gpio(self.pins[pin].name)
    }
}

/// No driver is on, and no step pin is high.
pub fn quiet() {
    for (mut step, mut enable) in STEP.into_iter().zip(ENABLE) {
        let (Ok(()), Ok(())) = (step.set_low(), enable.set_high());
    }
}

/// Lets go of every pin of a controller that has one.
pub fn release_all() {
    for (_, pin) in crate::wiring::PINS {
        pin.make_input(false);
    }
}

impl runtime::Pins for Pins {
    fn direction(&mut self, axis: usize, direction: Direction) {
        let Ok(()) = { DIRECTION[axis] }.set_state((direction == Direction::Positive).into());
        cortex_m::asm::delay(SETUP_CLOCKS);
    }

    #[inline]
    fn step(&mut self, axes: u8) {
        put(chip().GPIOC.bsrr(), axes.into());
    }

    #[inline]
    fn step_end(&mut self, axes: u8) {
        cortex_m::asm::delay(PULSE_CLOCKS);
        put(chip().GPIOC.bsrr(), u32::from(axes) << 16);
    }

    /// A driver with a step input has its current set by itself: this switches it on and off.
    fn drive(&mut self, axis: usize, drive: Drive) {
        let Ok(()) = { ENABLE[axis] }.set_state((drive.current == 0).into());
    }

    fn output(&mut self, pin: usize, on: bool) {
        if let Some(mut gpio) = self.gpio(pin) {
            let Ok(()) = gpio.set_state(on.into());
            gpio.make_output();
        }
    }

    fn release(&mut self, pin: usize) {
        if let Some(gpio) = self.gpio(pin) {
            gpio.make_input(self.pins[pin].rest != 0);
        }
    }

    /// The board has none.
    fn output_analog(&mut self, _pin: usize, _value: i32) {}
}
