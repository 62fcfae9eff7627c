//! USB HID, as the CMD-4CR speaks it (manual, 3.1): a command is one report of 64 bytes to the device, its
//! reply one report back. What stands in a report is a [`Packet`].
//!
//! - The device's end: [`Reports`] cuts a stream into reports, [`Packet::heard`] is what the controller is to
//!   hear of one, [`Packet::of_reply`] takes its reply. The device is found by its [`Name`].
//! - The host's end: [`frame`] and [`unframe`] put the report ID on and take it off, an [`Exchange`] knows
//!   what it waits for and how long, and [`ApiError`] says what went wrong in the numbers of the vendor's
//!   library.

mod error;
mod exchange;
mod name;
mod report;

pub use error::{ApiError, FAILED, SUCCEEDED};
pub use exchange::{Exchange, REPLY_TIME_OUT_MS};
pub use name::{MAX_NAME, Name};
pub use report::{FRAME_LENGTH, Reports, frame, unframe};

pub use crate::performax::Packet;
