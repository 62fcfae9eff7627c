//! Controllers on a board that is not there: what they plan is what the pins show.

mod edges;
mod flash;
mod inputs;
mod memory;
mod order;
mod random;
mod rig;
mod script;
mod serial;
mod session;
mod sizes;
mod tap;
