//! What the controllers with ASCII commands do alike, one test for all of them. Each includes this folder; what
//! differs is in its `controller.rs`.

mod closed_loop;
pub mod examples;
mod faults;
pub mod io;
pub mod joystick;
pub mod programs;
pub mod ramps;
pub mod rig;
pub mod settings;
