//! What the main loop sees of the board.

use crate::encoders::Encoders;
use crate::serial::{Serial, Which};
use crate::timer::{self, PlayerTimer};
use crate::watchdog;
use crate::wiring::gpio;
use cortex_m::peripheral::NVIC;
use devices::{Pin, Port};
use embedded_hal::digital::InputPin as _;
use runtime::hardware::{Timer as _, TimerTicks};
use stm32g4::stm32g474::Interrupt;

/// The board, for the main loop.
pub struct Hardware {
    ports: [(Port, Serial); 2],
    pins: &'static [Pin],
    encoders: Encoders,
}

impl Hardware {
    pub(crate) fn new(pins: &'static [Pin]) -> Self {
        let ports = [(Port::Usb, Serial::open(Which::Host)), (Port::Rs485, Serial::open(Which::Bus))];
        Self { ports, pins, encoders: Encoders::start() }
    }
}

impl runtime::Hardware for Hardware {
    type Serial = Serial;
    type Timer = PlayerTimer;

    fn now(&self) -> TimerTicks {
        PlayerTimer.now()
    }

    fn kick(&mut self) {
        NVIC::pend(Interrupt::TIM2);
    }

    /// An interrupt since the last time ends this at once.
    fn rest(&mut self) {
        cortex_m::asm::wfe();
    }

    fn ticked(&mut self) -> bool {
        timer::ticked()
    }

    fn feed(&mut self) {
        watchdog::feed();
        self.encoders.look();
    }

    fn ports(&mut self) -> &mut [(Port, Serial)] {
        &mut self.ports
    }

    fn level(&mut self, pin: usize) -> bool {
        let Pin { name, rest, .. } = self.pins[pin];
        match gpio(name) {
            Some(mut gpio) => {
                let Ok(level) = gpio.is_high();
                level
            }
            None => rest != 0,
        }
    }

    /// Nothing measures: what is there without anything.
    fn analog(&mut self, pin: usize) -> i32 {
        self.pins[pin].rest
    }

    fn encoder(&mut self, channel: usize) -> i32 {
        self.encoders.count(channel)
    }
}
