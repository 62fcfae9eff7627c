//! Which pin of a controller is which of the chip: those of the connectors CN7 and CN10 (user manual UM2505, 6.17).
//!
//! A chip of 64 pins has fewer than a CMD-4CR. What is not in the table is at rest and drives nothing.

use crate::gpio::Bank::{A, B, C, D};
use crate::gpio::Gpio;
use runtime::hardware::MAX_AXES;

/// Step pins: all of one port, so that those of several axes change at once.
pub const STEP: [Gpio; MAX_AXES] = [Gpio(C, 0), Gpio(C, 1), Gpio(C, 2), Gpio(C, 3)];

/// Direction pins: high is up.
pub const DIRECTION: [Gpio; MAX_AXES] = [Gpio(C, 4), Gpio(C, 5), Gpio(C, 6), Gpio(C, 7)];

/// Pins that switch the drivers on: low is on, as their makers have it.
pub const ENABLE: [Gpio; MAX_AXES] = [Gpio(C, 8), Gpio(C, 9), Gpio(C, 11), Gpio(C, 12)];

/// Phases of the encoders and the function that gives them to timers 3 and 4.
pub const ENCODERS: [[Gpio; 2]; 2] = [[Gpio(A, 6), Gpio(A, 7)], [Gpio(B, 6), Gpio(B, 7)]];
/// See [`ENCODERS`].
pub const ENCODER_FUNCTION: u32 = 2;

/// Sends and receives of USART 2, which ST-LINK makes a serial port of the host; those of USART 1 and the pin that
/// lets an RS-485 driver talk; what USART 3 sends, for people.
pub const USART2: [Gpio; 2] = [Gpio(A, 2), Gpio(A, 3)];
/// See [`USART2`].
pub const USART1: [Gpio; 3] = [Gpio(A, 9), Gpio(A, 10), Gpio(A, 12)];
/// See [`USART2`].
pub const USART3: [Gpio; 1] = [Gpio(C, 10)];
/// See [`USART2`].
pub const USART_FUNCTION: u32 = 7;

/// Pins by their names in the manuals of the controllers.
pub const PINS: &[(&str, Gpio)] = &[
    // PD42-1140.
    ("STOP_R", Gpio(B, 0)),
    ("STOP_L", Gpio(B, 1)),
    ("HOME", Gpio(B, 2)),
    ("ENC_N", Gpio(B, 10)),
    ("OUT0", Gpio(A, 11)),
    ("OUT1", Gpio(A, 15)),
    // PMX-2ED-SA and CMD-4CR.
    ("+LX", Gpio(B, 0)),
    ("-LX", Gpio(B, 1)),
    ("HX", Gpio(B, 2)),
    ("ZX", Gpio(B, 10)),
    ("+LY", Gpio(B, 11)),
    ("-LY", Gpio(B, 12)),
    ("HY", Gpio(B, 13)),
    ("ZY", Gpio(B, 14)),
    ("DI1", Gpio(B, 15)),
    ("DI2", Gpio(A, 8)),
    ("DO1", Gpio(A, 11)),
    ("DO2", Gpio(A, 15)),
    // CMD-4CR.
    ("+LZ", Gpio(A, 0)),
    ("-LZ", Gpio(A, 1)),
    ("HZ", Gpio(A, 4)),
    ("+LU", Gpio(B, 3)),
    ("-LU", Gpio(B, 4)),
    ("HU", Gpio(B, 5)),
    ("CSTA", Gpio(B, 9)),
    ("CEMG", Gpio(D, 2)),
];

/// The chip's pin for one of a controller's.
pub fn gpio(name: &str) -> Option<Gpio> {
    PINS.iter().find(|(other, _)| *other == name).map(|(_, gpio)| *gpio)
}
