//! The pins of the PD42-1140.

use crate::{Pin, PinKind, Wiring};

/// Numbers of the pins in [`PINS`].
#[allow(missing_docs)] // They are the manual's names.
pub mod number {
    pub const STOP_L: usize = 0;
    pub const STOP_R: usize = 1;
    pub const HOME: usize = 2;
    pub const AIN0: usize = 3;
    pub const SUPPLY: usize = 4;
    pub const TEMPERATURE: usize = 5;
    pub const ENC_N: usize = 6;
    pub const OUT0: usize = 7;
    pub const OUT1: usize = 8;
    pub const PULLUPS: usize = 9;
    pub const SHORT_A: usize = 10;
    // SHORT_B and OPEN_A lie between.
    pub const OPEN_B: usize = 13;
}

/// Encoder channels of the board.
pub mod encoder {
    /// The internal SensOstep: 1024 counts a turn.
    pub const INTERNAL: usize = 0;
    /// The external ABN encoder.
    pub const EXTERNAL: usize = 1;
}

const fn pin(name: &'static str, kind: PinKind, wiring: Wiring) -> Pin {
    Pin { name, kind, wiring, unit: "", scale: 1, rest: 0 }
}

/// The pins. Supply and temperature are what the module measures of itself, shorts and open loads what
/// its driver finds at the motor's coils.
pub static PINS: &[Pin] = &[
    pin("STOP_L", PinKind::Input, Wiring::NegativeLimit(0)),
    pin("STOP_R", PinKind::Input, Wiring::PositiveLimit(0)),
    pin("HOME", PinKind::Input, Wiring::Home(0)),
    // 12 bits of an ADC.
    pin("AIN0", PinKind::Analog, Wiring::Free),
    Pin { unit: "V", scale: 1000, rest: 24_000, ..pin("SUPPLY", PinKind::Analog, Wiring::Supply) },
    Pin { unit: "°C", scale: 10, rest: 250, ..pin("TEMPERATURE", PinKind::Analog, Wiring::Temperature) },
    pin("ENC_N", PinKind::Index(encoder::EXTERNAL), Wiring::Index(0)),
    pin("OUT0", PinKind::Output, Wiring::Free),
    pin("OUT1", PinKind::Output, Wiring::Free),
    Pin { rest: 1, ..pin("PULLUPS", PinKind::Output, Wiring::Free) },
    pin("SHORT_A", PinKind::Input, Wiring::Free),
    pin("SHORT_B", PinKind::Input, Wiring::Free),
    pin("OPEN_A", PinKind::Input, Wiring::Free),
    pin("OPEN_B", PinKind::Input, Wiring::Free),
];
