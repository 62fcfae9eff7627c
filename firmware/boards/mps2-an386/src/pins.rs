//! The pins, of which there are none: the player's doings end in the bench page.

use crate::bench::inputs::Window;
use crate::bench::log;
use crate::bench::page::NOT_DRIVEN;
use crate::registers::PAGE;
use devices::Drive;
use motion::Direction;
use runtime::Pins;
use runtime::hardware::{MAX_AXES, TimerTicks};
use tock_registers::interfaces::{Readable, Writeable};

/// What the player drives.
pub struct BenchPins {
    windows: [Window; MAX_AXES],
}

impl BenchPins {
    pub(crate) const fn new() -> Self {
        Self { windows: [const { Window::new() }; MAX_AXES] }
    }
}

impl Pins for BenchPins {
    fn direction(&mut self, _axis: usize, _direction: Direction) {}

    fn step(&mut self, _axes: u8) {}

    fn step_end(&mut self, _axes: u8) {}

    fn drive(&mut self, axis: usize, drive: Drive) {
        let [low, high] = drive.step.to_le_bytes();
        PAGE.drive[axis].set(u32::from_le_bytes([low, high, drive.parts, drive.current]));
    }

    fn output(&mut self, pin: usize, on: bool) {
        PAGE.driven[pin].set(on.into());
    }

    fn release(&mut self, pin: usize) {
        PAGE.driven[pin].set(NOT_DRIVEN);
    }

    fn output_analog(&mut self, pin: usize, value: i32) {
        PAGE.driven[pin].set(value as u32);
    }

    #[inline]
    fn played(&mut self, axis: usize, direction: Direction, due: TimerTicks, late: u32) {
        let page = &*PAGE;
        let odometer = page.odometer[axis].get().wrapping_add(direction.sign() as u32);
        page.odometer[axis].set(odometer);
        page.pulses[axis].set(page.pulses[axis].get().wrapping_add(1));
        log::edge(axis, direction, due, late);
        self.windows[axis].pass(axis, odometer as i32);
    }
}
