//! Virtual controllers as a host sees them: everything through the bytes of a TCP connection.

#[path = "../common/mod.rs"]
mod common;

mod commander;
mod performax;
mod stand;
mod trinamic;
mod wires;
