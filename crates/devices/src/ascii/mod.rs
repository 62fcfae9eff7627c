//! The command language of Performax and Commander controllers: lines of ASCII such as `HSPDX=2000`.
//!
//! - [`command`]: what an entry of a device's table says, and the macro that makes tables.
//! - [`mod@parse`]: from a line to the entry that it means, with its axis, index, targets and value.
//! - [`cells`]: the numbers that commands remember; [`memory`]: they, programs and variables in flash.
//! - [`station`]: what an axis was told to do; [`encoder`]: its counter; [`speeds`]: how fast it goes.
//! - [`ports`]: whose commands are for the device; [`reply`]: parts of replies; [`threads`]: the standalone programs in time; [`clock`]: how time passes in a device.

pub mod cells;
pub mod clock;
pub mod command;
pub mod encoder;
#[cfg(feature = "std")]
pub mod inspect;
pub mod memory;
pub mod outputs;
pub mod parse;
pub mod ports;
pub mod reply;
pub mod speeds;
pub mod station;
pub mod threads;

pub use command::{Command, Form, Value};
pub use parse::{ParseError, Parsed, parse};
