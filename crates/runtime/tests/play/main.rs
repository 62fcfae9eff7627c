//! Controllers on a board that is not there: what they plan is what the pins show.

mod edges;
mod memory;
mod rig;
mod session;
mod tap;
