//! The five homing routines of the PMX-2ED-SA (manual, section 7.10), a file each.
//!
//! | command | routine | seeks | ends |
//! |---|---|---|---|
//! | `H` | [`Routine::Home`] | home, fast | past zero, braking |
//! | `L` | [`Routine::Limit`] | limit, fast | `LCA` away from the limit, at zero |
//! | `ZH` | [`Routine::HomeIndex`] | home, fast; index, slowly | at zero |
//! | `Z` | [`Routine::Index`] | index, slowly | at zero |
//! | `HL` | [`Routine::HomeLow`] | home, fast; again from `HCA` before it, slowly | at zero |
//!
//! With return to zero (`RZ=1`) a routine that ends off zero then moves to 0, fast. Where the manual is
//! silent, this is so:
//!
//! - The home input and the index trigger when they come on. A routine started on the switch does not take
//!   it for found; it goes on, and if nothing follows ends at the limit, as that of the CMD-4CR does.
//! - `L` started on its limit is there: it moves away by the amount and is done.
//! - Any other limit on the way, also one behind, stops the motor at once and ends the routine.
//! - Index marks count after the motor is down to low speed.
//! - A limit and a trigger at the same pulse are a limit.
//! - Correction amounts are pulses and have no sign.

mod home;
mod home_index;
mod home_low;
mod index;
mod limit;
#[cfg(test)]
mod tests;

use super::routine::Step;

/// A homing routine. PMX-2ED-SA manual, section 7.10.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Routine {
    /// `H`, section 7.10.1: the home input at high speed.
    Home,
    /// `L`, section 7.10.2: the limit input.
    Limit,
    /// `ZH`, section 7.10.3: the home input, then the index.
    HomeIndex,
    /// `Z`, section 7.10.4: the index.
    Index,
    /// `HL`, section 7.10.5: the home input at high speed, then at low speed.
    HomeLow,
}

impl Routine {
    /// Its steps, for [`Homing::new`](super::Homing::new).
    pub const fn steps(self) -> &'static [Step] {
        match self {
            Self::Home => home::STEPS,
            Self::Limit => limit::STEPS,
            Self::HomeIndex => home_index::STEPS,
            Self::Index => index::STEPS,
            Self::HomeLow => home_low::STEPS,
        }
    }
}
