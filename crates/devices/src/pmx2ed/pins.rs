//! The pins of the PMX-2ED-SA (manual, table 4.5).

use crate::{Pin, PinKind, Wiring};

/// Numbers of the pins in [`PINS`]; those of the Y axis follow those of X.
#[allow(missing_docs)] // They are the manual's names.
pub mod number {
    pub const MINUS_LIMIT: usize = 1;
    pub const HOME: usize = 2;
    pub const INDEX: usize = 3;
    /// Pins of an axis.
    pub const AXIS: usize = 4;
    pub const DI1: usize = 8;
    pub const DO1: usize = 16;
    pub const AI1: usize = 24;
    pub const EO1: usize = 26;
}

/// Digital inputs, and digital outputs.
pub const PORT_BITS: usize = 8;

/// The middle of the analog inputs, in mV, where a joystick rests.
pub const MIDDLE_MV: i32 = 2500;

/// The end of the analog inputs, in mV.
pub const MAX_MV: i32 = 5000;

const fn pin(name: &'static str, kind: PinKind, wiring: Wiring) -> Pin {
    Pin { name, kind, wiring, unit: "", scale: 1, rest: 0 }
}

const fn input(name: &'static str) -> Pin {
    pin(name, PinKind::Input, Wiring::Free)
}

const fn output(name: &'static str) -> Pin {
    pin(name, PinKind::Output, Wiring::Free)
}

const fn analog(name: &'static str, axis: usize) -> Pin {
    Pin { unit: "mV", rest: MIDDLE_MV, ..pin(name, PinKind::Analog, Wiring::Joystick(axis)) }
}

/// The pins.
pub static PINS: &[Pin] = &[
    pin("+LX", PinKind::Input, Wiring::PositiveLimit(0)),
    pin("-LX", PinKind::Input, Wiring::NegativeLimit(0)),
    pin("HX", PinKind::Input, Wiring::Home(0)),
    pin("ZX", PinKind::Index(0), Wiring::Index(0)),
    pin("+LY", PinKind::Input, Wiring::PositiveLimit(1)),
    pin("-LY", PinKind::Input, Wiring::NegativeLimit(1)),
    pin("HY", PinKind::Input, Wiring::Home(1)),
    pin("ZY", PinKind::Index(1), Wiring::Index(1)),
    input("DI1"),
    input("DI2"),
    input("DI3"),
    input("DI4"),
    input("DI5"),
    input("DI6"),
    input("DI7"),
    input("DI8"),
    output("DO1"),
    output("DO2"),
    output("DO3"),
    output("DO4"),
    output("DO5"),
    output("DO6"),
    output("DO7"),
    output("DO8"),
    analog("AI1", 0),
    analog("AI2", 1),
    output("EO1"),
    output("EO2"),
];
