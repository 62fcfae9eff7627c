//! The CMD-4CR from wire to shaft: every command and every section of its manual, through its ports, on the
//! simulated machine.

#[path = "../ascii/mod.rs"]
mod ascii;
mod capture;
mod closed_loop;
mod controller;
mod errors;
mod exact;
mod examples;
mod following;
mod homing;
mod homing_clear;
mod homing_slowdown;
mod io;
mod motion;
mod paths;
mod programs;
mod safety;
mod sequences;
mod settings;
mod statements;
mod wire;

use ascii::rig;
