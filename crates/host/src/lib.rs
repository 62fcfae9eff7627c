//! The other end of the wire: what a host says to a controller, virtual or real, and what it hears of it.
//!
//! A [`Wire`] carries one request and one reply at a time; a [`Bus`] is a wire that several controllers may hang on. A
//! [`Controller`] puts into requests what people want of it, and into words what it answers. It knows what stands in the
//! manuals of the three controllers about their wires, and nothing about how they work inside.
//!
//! Over USB the PD42-1140 is a serial port. The other two are reached by serial ports, by TCP, or by whatever else is
//! made a [`Wire`]; not by USB yet.

mod ascii;
mod bits;
mod bus;
mod code;
mod controller;
mod error;
mod find;
mod key;
mod model;
mod pace;
mod stream;
mod tmcl;
mod traffic;
mod types;
mod wire;

#[cfg(test)]
mod babble;
#[cfg(test)]
mod scripted;

pub use bits::Bit;
pub use bus::{Bus, Wires};
pub use code::Code;
pub use controller::{Controller, Settings};
pub use error::{Error, Result};
pub use find::find;
pub use key::{Key, KeyError};
pub use model::Model;
pub use stream::{StreamWire, serial, serial_ports, tcp};
pub use traffic::{TRAFFIC_LENGTH, Traffic, TrafficLog, polling};
pub use types::{
    Action, Answer, AxisStatus, Direction, Found, Level, ProgramAction, ProgramState, ProgramStatus, Status,
    Value,
};
pub use wire::{End, MAX_REPLY_BYTES, Pending, Wire, WireError};
