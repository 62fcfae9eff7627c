//! The part of a firmware image between a controller and a board.
//!
//! A board implements the traits of [`hardware`].
#![cfg_attr(not(test), no_std)]

pub mod figures;
pub mod hardware;

pub use figures::Figures;
pub use hardware::{Hardware, Pins, Serial, Timer};
