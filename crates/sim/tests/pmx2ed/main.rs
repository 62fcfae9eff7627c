//! The PMX-2ED-SA from wire to shaft: every command and every section of its manual, through its ports, on
//! the simulated machine.

#[path = "../ascii/mod.rs"]
mod ascii;
mod closed_loop;
mod controller;
mod errors;
mod examples;
mod homing;
mod io;
mod joystick;
mod motion;
mod programs;
mod settings;
mod speed;
mod wire;

use ascii::rig;
