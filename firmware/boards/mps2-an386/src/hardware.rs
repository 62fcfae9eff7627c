//! What the main loop sees of the board.

use crate::bench::inputs::{Levels, Source, Wiring};
use crate::bench::page::{NOT_DRIVEN, set_long};
use crate::bench::{self, poke, stack::Gauge};
use crate::registers::PAGE;
use crate::serial::Serial;
use crate::timer::{self, PlayerTimer};
use crate::vectors::Interrupt;
use crate::{clock, watchdog};
use cortex_m::peripheral::NVIC;
use devices::{Pin, Port};
use runtime::Figures;
use runtime::hardware::{Hardware, Timer, TimerTicks};
use tock_registers::interfaces::{Readable, Writeable};

/// The board, for the main loop.
pub struct Mps2 {
    ports: [(Port, Serial); 2],
    pins: &'static [Pin],
    axes: usize,
    levels: Levels,
    wiring: Wiring,
    stack: Gauge,
}

impl Mps2 {
    pub(crate) fn new(pins: &'static [Pin], axes: usize) -> Self {
        let ports = [(Port::Usb, Serial::open(0)), (Port::Rs485, Serial::open(1))];
        Self { ports, pins, axes, levels: Levels::new(), wiring: Wiring::new(), stack: Gauge::new() }
    }
}

impl Hardware for Mps2 {
    type Serial = Serial;
    type Timer = PlayerTimer;

    fn now(&self) -> TimerTicks {
        PlayerTimer.now()
    }

    fn kick(&mut self) {
        NVIC::pend(Interrupt::TIMER0);
    }

    fn rest(&mut self) {
        clock::rest();
    }

    fn ticked(&mut self) -> bool {
        let ticked = clock::ticked();
        if ticked {
            self.levels.tick();
        }
        ticked
    }

    fn feed(&mut self) {
        watchdog::feed();
    }

    fn ports(&mut self) -> &mut [(Port, Serial)] {
        &mut self.ports
    }

    fn level(&mut self, pin: usize) -> bool {
        let driven = PAGE.driven[pin].get();
        if driven != NOT_DRIVEN {
            return driven != 0;
        }
        self.levels.level(pin, self.pins[pin].rest != 0)
    }

    fn analog(&mut self, pin: usize) -> i32 {
        match Source::of(pin) {
            Source::Value(value) => value,
            _ => self.pins[pin].rest,
        }
    }

    fn encoder(&mut self, channel: usize) -> i32 {
        bench::encoder(channel, self.axes)
    }

    fn load(&mut self, axis: usize) -> u16 {
        PAGE.load[axis].get() as u16
    }

    fn pulser(&mut self, axis: usize) -> i32 {
        PAGE.pulser[axis].get() as i32
    }

    fn report(&mut self, figures: &Figures) {
        timer::note();
        bench::figures(figures);
        set_long(&PAGE.time, timer::extended(PlayerTimer.now()));
        PAGE.stack_unused.set(self.stack.unused());
        self.wiring.refresh(self.pins.len());
        poke::take();
    }
}
