//! The PD42-1140 from wire to shaft: every command and parameter of its manual, through its ports, on the
//! simulated machine.

mod axis_parameters;
mod commands;
mod control;
mod driver;
mod faults;
mod global_parameters;
mod power;
mod programs;
mod reference_search;
mod rig;
mod settings;
mod wire;
