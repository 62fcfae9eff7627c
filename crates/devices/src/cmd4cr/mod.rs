//! Nippon Pulse CMD-4CR (Commander core) with firmware V126BL: four axes, and programs in A-SCRIPT.
//!
//! - [`table`]: the commands; [`refusal`]: why one is not done.
//! - [`memory`]: what is remembered, in RAM and flash.
//! - [`pins`], [`polarity`]: inputs and outputs, and the bits that invert them.

pub mod memory;
pub mod pins;
pub mod polarity;
pub mod refusal;
pub mod table;
