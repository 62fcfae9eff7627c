//! The controllers: command and parameter tables, status words, settings, and the glue between the
//! wire, the programs and the axes.
//!
//! A controller is a state machine ([`Controller`]) that acts through a [`Board`]. It does not know
//! sockets, files, threads, or the machine behind its pins.
#![cfg_attr(not(test), no_std)]

#[cfg(feature = "std")]
extern crate alloc;

pub mod ascii;
pub mod board;
pub mod cmd4cr;
pub mod controller;
pub mod flash;
pub mod gate;
#[cfg(feature = "std")]
pub mod guide;
#[cfg(feature = "std")]
pub mod inspect;
#[cfg(feature = "std")]
pub mod models;
pub mod parameter;
pub mod pd42;
pub mod pmx2ed;
#[cfg(feature = "std")]
mod rounds;
pub mod settings;
#[cfg(test)]
mod sizes;

pub use board::{Board, Drive, Port};
pub use controller::{AxisState, Controller, Notice, Pin, PinKind, ProgramRun, ProgramState, Wiring};
pub use gate::{Gate, Lines};
#[cfg(feature = "std")]
pub use inspect::Inspect;
#[cfg(feature = "std")]
pub use models::{Language, MODELS, Model, model};
pub use parameter::{Access, Parameter, Table};
