//! One program for all tests of the server: each of its own would be linked with the whole server again.

mod access;
mod common;
mod control;
mod debug;
mod desk;
mod endpoints;
mod hid;
mod host;
mod http;
mod openapi;
mod patience;
mod performax;
mod state;
