//! The motion kernel: from a target and its limits to pulse trains.
//!
//! This room knows axes, ramps and pulses. It does not know bytes, commands, devices or the wall clock:
//! whoever holds an axis tells it the time. Everything is integer arithmetic, without allocation and
//! without `unsafe`, so that the same code steps a motor from a microcontroller's timer and a virtual
//! one at a thousand times real time. Only on a host, with the feature `std`, what an axis seldom needs is
//! allocated when it does.
#![cfg_attr(not(test), no_std)]

#[cfg(feature = "std")]
extern crate alloc;

pub mod axis;
mod block;
pub mod closed_loop;
pub mod compare;
pub mod encoder;
mod foot;
pub mod homing;
pub mod joystick;
pub mod merge;
mod mover;
pub mod path;
pub mod plan;
pub mod pps;
pub mod pulser;
mod room;
mod scurve;
pub mod speed;
pub mod sync;
pub mod tmc429;
pub mod train;
mod wide;

pub use axis::{Axis, Goal, Stop};
pub use path::{Arc, Move, Path};
pub use plan::{Limits, Shape};
pub use speed::{Growth, Scale, Speed};
pub use train::{Direction, Moment, SubTicks, Ticks, Train};
