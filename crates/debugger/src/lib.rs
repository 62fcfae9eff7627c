//! Standalone programs line by line, forwards and backwards, in virtual time.
//!
//! A run is a function of its input, and a line that is looked at does what it does when nobody looks
//! (`VirtualDevice::advance_to_line`). So going back is going forward from the start, as far as before: a
//! [`Debugger`] remembers what was done to the device and when, and nothing else of the past.
//!
//! - [`code`] is the program and where its lines come from.
//! - [`timeline`] has points in time, and takes a device to one.
//! - [`engine`] runs, steps and goes back; [`stop`] says where it stops and why.
//! - [`told`] is what can be done to a device on the way: registers set, pins driven, commands sent.
//! - [`console`] is the debugger that is typed at, [`dap`] the one that editors speak to, both on top of it.
//! - [`wire`] has the messages between an editor and a program that it started.

pub mod code;
pub mod console;
pub mod dap;
pub mod engine;
pub mod stop;
pub mod timeline;
pub mod told;
pub mod wire;

pub use code::Code;
pub use engine::{Debugger, Direction, Goal};
pub use stop::Stop;
pub use timeline::Target;
