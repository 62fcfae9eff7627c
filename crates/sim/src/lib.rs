//! Virtual time, and the machine behind a controller's pins.
//!
//! A [`VirtualDevice`] is a controller with everything that it is soldered and bolted to: a shaft that
//! its pulse trains turn, switches and index marks that the shaft passes, encoders, a load, a supply, and
//! a flash memory that outlives the power. Time is an integer number of clocks of the controller and
//! passes only in [`VirtualDevice::advance`]: as fast as the computer can, or as slowly as somebody who
//! paces it wants. The same calls always give the same events.
//!
//! - [`config`] reads bench files: which devices, where they listen, what machine each one moves.
//! - [`flash`] is the memory, with power cuts in the middle of a write.
//! - [`machine`] follows the trains and says where the next input changes.
//! - [`device`] is the event loop.
//! - [`fault`] says what can be wrong with all that, and when.
//! - [`record`] writes what happened to files: one file a format.
//! - [`tape`] takes down what devices are told, and plays it again.
//! - [`mod@run`] runs a standalone program from its start to its end.
//!
//! Nothing here opens an endpoint, sleeps, or starts a thread.

pub mod config;
pub mod device;
pub mod fault;
pub mod flash;
pub mod machine;
pub mod record;
pub mod run;
pub mod tape;
#[cfg(test)]
mod testing;

pub use config::{AxisConfig, Bench, BenchError, Bus, DeviceConfig, Endpoint, PlaceError, buses};
pub use device::{DeviceState, Input, PinError, PinValue, Sent, TimedInput, VirtualDevice};
pub use fault::{Fault, FaultError, Scenario};
pub use flash::SharedFlash;
pub use run::{Program, RunOptions, RunResult, StopReason, run};
