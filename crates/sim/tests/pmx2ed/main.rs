//! The PMX-2ED-SA from wire to shaft: every command and every section of its manual, through its ports, on
//! the simulated machine.

mod closed_loop;
mod errors;
mod examples;
mod homing;
mod io;
mod joystick;
mod motion;
mod programs;
mod rig;
mod settings;
mod speed;
mod wire;
