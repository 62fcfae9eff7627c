//! The pins of the CMD-4CR (manual, 6.1.1.2).

use crate::{Pin, PinKind, Wiring};
use PinKind::{Analog, AnalogOutput, Index, Input, Output, Port};

/// Numbers of the pins in [`PINS`].
#[allow(missing_docs)] // They are the manual's names.
pub mod number {
    // Of an axis; those of Y follow those of X, and so on.
    pub const PLUS_LIMIT: usize = 0;
    pub const MINUS_LIMIT: usize = 1;
    pub const HOME: usize = 2;
    pub const INDEX: usize = 3;
    pub const SLOWDOWN: usize = 4;
    pub const ALARM: usize = 5;
    pub const IN_POSITION: usize = 6;
    pub const ENABLE: usize = 7;
    pub const ERROR_CLEAR: usize = 8;
    /// Pins of an axis.
    pub const AXIS: usize = 9;

    pub const CEMG: usize = 36;
    pub const CSTA: usize = 37;
    pub const DI1: usize = 38;
    pub const DO1: usize = 42;
    pub const IO1: usize = 46;
    pub const AI1: usize = 78;
    pub const PWM1: usize = 80;
}

/// High-speed digital inputs, and outputs.
pub const BITS: usize = 4;

/// Configurable inputs and outputs.
pub const PORTS: usize = 32;

/// The end of the analog inputs, in mV.
pub const MAX_MV: i32 = 3300;

/// The middle of the analog inputs, in mV, where a joystick rests.
pub const MIDDLE_MV: i32 = MAX_MV / 2;

const fn pin(name: &'static str, kind: PinKind, wiring: Wiring) -> Pin {
    Pin { name, kind, wiring, unit: "", scale: 1, rest: 0 }
}

const fn free(name: &'static str, kind: PinKind) -> Pin {
    pin(name, kind, Wiring::Free)
}

const fn analog(name: &'static str, axis: usize) -> Pin {
    Pin { unit: "mV", rest: MIDDLE_MV, ..pin(name, Analog, Wiring::Joystick(axis)) }
}

/// How much of its 500 Hz a PWM output is high.
const fn pwm(name: &'static str) -> Pin {
    Pin { unit: "%", ..free(name, AnalogOutput) }
}

/// The pins.
pub static PINS: &[Pin] = &[
    pin("+LX", Input, Wiring::PositiveLimit(0)),
    pin("-LX", Input, Wiring::NegativeLimit(0)),
    pin("HX", Input, Wiring::Home(0)),
    pin("ZX", Index(0), Wiring::Index(0)),
    pin("SDX", Input, Wiring::Slowdown(0)),
    free("ALMX", Input),
    pin("INPX", Input, Wiring::InPosition(0)),
    free("EO1", Output),
    free("ERCX", Output),
    pin("+LY", Input, Wiring::PositiveLimit(1)),
    pin("-LY", Input, Wiring::NegativeLimit(1)),
    pin("HY", Input, Wiring::Home(1)),
    pin("ZY", Index(1), Wiring::Index(1)),
    pin("SDY", Input, Wiring::Slowdown(1)),
    free("ALMY", Input),
    pin("INPY", Input, Wiring::InPosition(1)),
    free("EO2", Output),
    free("ERCY", Output),
    pin("+LZ", Input, Wiring::PositiveLimit(2)),
    pin("-LZ", Input, Wiring::NegativeLimit(2)),
    pin("HZ", Input, Wiring::Home(2)),
    pin("ZZ", Index(2), Wiring::Index(2)),
    pin("SDZ", Input, Wiring::Slowdown(2)),
    free("ALMZ", Input),
    pin("INPZ", Input, Wiring::InPosition(2)),
    free("EO3", Output),
    free("ERCZ", Output),
    pin("+LU", Input, Wiring::PositiveLimit(3)),
    pin("-LU", Input, Wiring::NegativeLimit(3)),
    pin("HU", Input, Wiring::Home(3)),
    pin("ZU", Index(3), Wiring::Index(3)),
    pin("SDU", Input, Wiring::Slowdown(3)),
    free("ALMU", Input),
    pin("INPU", Input, Wiring::InPosition(3)),
    free("EO4", Output),
    free("ERCU", Output),
    free("CEMG", Input),
    free("CSTA", Input),
    free("DI1", Input),
    free("DI2", Input),
    free("DI3", Input),
    free("DI4", Input),
    free("DO1", Output),
    free("DO2", Output),
    free("DO3", Output),
    free("DO4", Output),
    free("IO1", Port),
    free("IO2", Port),
    free("IO3", Port),
    free("IO4", Port),
    free("IO5", Port),
    free("IO6", Port),
    free("IO7", Port),
    free("IO8", Port),
    free("IO9", Port),
    free("IO10", Port),
    free("IO11", Port),
    free("IO12", Port),
    free("IO13", Port),
    free("IO14", Port),
    free("IO15", Port),
    free("IO16", Port),
    free("IO17", Port),
    free("IO18", Port),
    free("IO19", Port),
    free("IO20", Port),
    free("IO21", Port),
    free("IO22", Port),
    free("IO23", Port),
    free("IO24", Port),
    free("IO25", Port),
    free("IO26", Port),
    free("IO27", Port),
    free("IO28", Port),
    free("IO29", Port),
    free("IO30", Port),
    free("IO31", Port),
    free("IO32", Port),
    analog("AI1", 0),
    analog("AI2", 1),
    pwm("PWM1"),
    pwm("PWM2"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_names() {
        let check = |number: usize, name: &str| assert_eq!(PINS[number].name, name);
        for (axis, letter) in ["X", "Y", "Z", "U"].into_iter().enumerate() {
            let first = axis * number::AXIS;
            check(first + number::PLUS_LIMIT, &format!("+L{letter}"));
            check(first + number::MINUS_LIMIT, &format!("-L{letter}"));
            check(first + number::HOME, &format!("H{letter}"));
            check(first + number::INDEX, &format!("Z{letter}"));
            check(first + number::SLOWDOWN, &format!("SD{letter}"));
            check(first + number::ALARM, &format!("ALM{letter}"));
            check(first + number::IN_POSITION, &format!("INP{letter}"));
            check(first + number::ENABLE, &format!("EO{}", axis + 1));
            check(first + number::ERROR_CLEAR, &format!("ERC{letter}"));
        }
        check(number::CEMG, "CEMG");
        check(number::CSTA, "CSTA");
        for bit in 0..BITS {
            check(number::DI1 + bit, &format!("DI{}", bit + 1));
            check(number::DO1 + bit, &format!("DO{}", bit + 1));
        }
        for bit in 0..PORTS {
            check(number::IO1 + bit, &format!("IO{}", bit + 1));
        }
        check(number::AI1 + 1, "AI2");
        check(number::PWM1 + 1, "PWM2");
        assert_eq!(PINS.len(), number::PWM1 + 2);
    }
}
