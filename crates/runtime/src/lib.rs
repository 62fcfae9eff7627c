//! The part of a firmware image between a controller and a board.
//!
//! A controller acts in its own time and says afterwards which pulses it made; pins want each of them in its tick. So
//! the [main loop](main_loop) advances the controller a little ahead of time, [queues] keep what it gives
//! out, and the [player], in the interrupt of one timer, puts that on the pins. A board implements the traits of
//! [`hardware`], an image puts the three together:
//!
//! ```ignore
//! let (plan, player) = QUEUES.split();      // a static
//! // ... hand `player` to the timer's interrupt, which calls `player.play(&mut timer, &mut pins)` ...
//! runtime::run(&mut controller, hardware, plan)
//! ```
#![cfg_attr(not(test), no_std)]

mod clock;
pub mod fault;
pub mod figures;
pub mod hardware;
mod inputs;
pub mod main_loop;
mod outside;
pub mod pages;
pub mod player;
pub mod queues;
mod segment;
pub mod serial;

pub use figures::Figures;
pub use hardware::{Hardware, Pins, Serial, Timer};
pub use main_loop::{Loop, run};
pub use pages::Pages;
pub use player::{Player, Plays};
pub use queues::{Plan, Queues};
