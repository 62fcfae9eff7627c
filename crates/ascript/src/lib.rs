//! The A-SCRIPT language of the Performax and Commander controllers.
#![cfg_attr(not(test), no_std)]

pub mod dialect;

pub use dialect::Dialect;
