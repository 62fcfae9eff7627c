//! Virtual controllers as a host sees them: everything through the bytes of a TCP connection.

mod commander;
mod performax;
mod stand;
mod trinamic;
mod wires;
