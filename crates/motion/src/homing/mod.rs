//! Homing: finding the zero point of an axis with its switches and the encoder's index.
//!
//! A mode is data: a list of steps in a file of its family. Two engines walk through lists, because two
//! makes of controllers home in two ways:
//!
//! - [`Search`], of TMCL modules ([`mod@reference`]): stands still at every switching point, looks at levels,
//!   ignores end switches that it does not seek, reckons the zero point at the end from the points that it
//!   has marked, and sets the counter when it stands there.
//! - [`Homing`], of the controllers with A-SCRIPT ([`performax`], [`commander`]): waits for edges at speed, sets the
//!   counter at the very pulse of an edge while the motor may be braking, counts index marks, and ends with
//!   an error at an end switch that it does not seek.

pub mod commander;
pub mod performax;
pub mod reference;
pub mod routine;
pub mod search;
#[cfg(test)]
mod testing;

pub use routine::Homing;
pub use search::{Found, Search, Switches};

/// The two speeds of homing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// For coming near.
    Fast,
    /// For the switching points.
    Slow,
}
