//! Pins of the chip, by port and number.

use crate::chip::{chip, put};
use core::convert::Infallible;
use embedded_hal::digital::{ErrorType, InputPin, OutputPin};

/// A port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bank {
    /// Port A.
    A,
    /// Port B.
    B,
    /// Port C.
    C,
    /// Port D.
    D,
}

/// A pin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Gpio(pub Bank, pub u8);

/// What a pin does, in two bits.
mod mode {
    pub const INPUT: u32 = 0;
    pub const OUTPUT: u32 = 1;
    pub const ALTERNATE: u32 = 2;
}

/// Does something with the port of a pin, whose registers have different types.
macro_rules! on_port {
    ($pin:expr, $port:ident => $body:expr) => {
        match $pin.0 {
            Bank::A => {
                let $port = chip().GPIOA;
                $body
            }
            Bank::B => {
                let $port = chip().GPIOB;
                $body
            }
            Bank::C => {
                let $port = chip().GPIOC;
                $body
            }
            Bank::D => {
                let $port = chip().GPIOD;
                $body
            }
        }
    };
}

/// Gives the ports a clock.
pub fn start() {
    chip().RCC.ahb2enr().modify(|_, w| {
        w.gpioaen().set_bit();
        w.gpioben().set_bit();
        w.gpiocen().set_bit();
        w.gpioden().set_bit()
    });
}

/// Two bits of a pin in a word.
fn two_bits(word: u32, pin: u8, bits: u32) -> u32 {
    word & !(3 << (2 * pin)) | bits << (2 * pin)
}

impl Gpio {
    fn set_mode(self, mode: u32) {
        on_port!(self, port => put(port.moder(), two_bits(port.moder().read().bits(), self.1, mode)));
    }

    /// Makes it an input that is pulled to a level.
    pub fn make_input(self, rest: bool) {
        let pull = if rest { 1 } else { 2 };
        on_port!(self, port => put(port.pupdr(), two_bits(port.pupdr().read().bits(), self.1, pull)));
        self.set_mode(mode::INPUT);
    }

    /// Makes it an output.
    pub fn make_output(self) {
        self.set_mode(mode::OUTPUT);
    }

    /// Gives it to a peripheral.
    pub fn make_alternate(self, function: u32) {
        let at = 4 * u32::from(self.1 % 8);
        let with = |word: u32| word & !(0xF << at) | function << at;
        if self.1 < 8 {
            on_port!(self, port => put(port.afrl(), with(port.afrl().read().bits())));
        } else {
            on_port!(self, port => put(port.afrh(), with(port.afrh().read().bits())));
        }
        self.set_mode(mode::ALTERNATE);
    }
}

impl ErrorType for Gpio {
    type Error = Infallible;
}

impl OutputPin for Gpio {
    fn set_low(&mut self) -> Result<(), Infallible> {
        on_port!(self, port => put(port.bsrr(), 1 << (self.1 + 16)));
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        on_port!(self, port => put(port.bsrr(), 1 << self.1));
        Ok(())
    }
}

impl InputPin for Gpio {
    fn is_high(&mut self) -> Result<bool, Infallible> {
        Ok(on_port!(self, port => port.idr().read().bits()) >> self.1 & 1 != 0)
    }

    fn is_low(&mut self) -> Result<bool, Infallible> {
        self.is_high().map(|high| !high)
    }
}
