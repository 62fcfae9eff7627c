//! The CMD-4CR from wire to shaft: every command and every section of its manual, through its ports, on the
//! simulated machine.

mod capture;
mod closed_loop;
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
mod rig;
mod safety;
mod sequences;
mod settings;
mod statements;
mod wire;
