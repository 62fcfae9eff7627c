//! Bytes to typed frames and back.
//!
//! Every protocol has two levels. The raw level owns bytes and knows lengths and checksums; the typed
//! level is a struct with `parse` and `emit`. Nothing here knows what a command does, reads a clock or
//! allocates: whoever owns the port feeds bytes in, with the time where a time-out matters, and gets
//! frames out.
//!
//! No parser panics, whatever the bytes; malformed input is a value of an error type.
#![cfg_attr(not(test), no_std)]

pub mod ascii;
pub mod can;
pub mod hid;
pub mod performax;
pub mod slcan;
pub mod tmcl;
