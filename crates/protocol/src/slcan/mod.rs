//! SLCAN: a CAN adapter on a serial line, as LAWICEL's CANUSB speaks it.
//!
//! A command is a line of ASCII that ends with a carriage return. The adapter answers with a carriage
//! return, or with BELL if it refuses, and sends a line of its own for every frame on the bus.
//! [`Adapter`] is the adapter's side; a client uses [`Message::emit`] and [`Event::parse`].

mod adapter;
mod client;
mod lines;
mod message;

pub use adapter::{Adapter, Answer, Bitrate, Channel};
pub use client::Event;
pub use lines::{Line, Lines};
pub use message::{Identifier, MAX_EXTENDED_ID, Message, Payload};

/// Most characters in a line without its end: type, 8 of identifier, length, 16 of data, 4 of time.
pub const LINE_LENGTH: usize = 30;

/// A line with its end.
pub type Text = heapless::Vec<u8, { LINE_LENGTH + 1 }>;

/// Ends a line; alone, it says yes.
pub const CARRIAGE_RETURN: u8 = b'\r';

/// Says no.
pub const BELL: u8 = 0x07;
