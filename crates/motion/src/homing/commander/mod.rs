//! The thirteen homing modes of the CMD-4CR (manual, appendix A) and its `ZMOVE`, a file each.
//!
//! | mode | seeks | zero | ends |
//! |---|---|---|---|
//! | 0 | home, fast | home edge | past zero, braking |
//! | 1 | home, fast; back off it and on again, slowly | home edge | at zero |
//! | 2 | home, fast; index, slowly | index | at zero |
//! | 3 | home, fast; index, fast | index | past zero, braking |
//! | 4 | home, fast; index on the way back, slowly | index | at zero |
//! | 5 | home, fast; index on the way back, fast | index | before zero, braking |
//! | 6 | limit, fast; back off it, slowly | where the limit goes off | at zero |
//! | 7 | limit, fast; index on the way back, slowly | index | at zero |
//! | 8 | limit, fast; index on the way back, fast | index | before zero, braking |
//! | 9 | as mode 0 | home edge | at zero, having returned fast |
//! | 10 | as mode 3 | index | at zero, having returned fast |
//! | 11 | as mode 5 | index | at zero, having returned fast |
//! | 12 | as mode 8 | index | at zero, having returned fast |
//! | `ZMOVE` | index, fast | none | past the index, braking |
//!
//! Fast is `HSPD`, slow is `LSPD`. Where the index is sought, `ZCNT` + 1 marks are counted
//! ([`Settings::index_marks`](super::routine::Settings::index_marks)).
//!
//! The manual's drawings of modes 0 to 5 and 9 to 11 have further operations: started on the home switch or
//! beyond it, the motor goes on to the limit, stops there at once, and the routine ends with an error. So it
//! does in all modes at a limit that the mode does not seek: onward in those, behind in modes 6, 7, 8 and 12,
//! also while the motor brakes after zero was set.
//!
//! The slowdown input ([`Inputs::slowdown`]) holds the motor at low speed in every mode and both ways. A
//! device that is to stop at it (`SDC=1`) stops the axis and drops the routine, as with any other motion.
//!
//! The ERC output may have to give a pulse at the limit that a mode seeks and at the end of every mode
//! ([`Homing::take_clear`]); `ZMOVE` has none. Such a pulse also clears the limit's error (section
//! 2.1.3.1.1.1), which is the device's matter.
//!
//! Where the manual is silent or contradicts itself, this is so:
//!
//! - The texts of the drawings count, where the tables beside them differ: mode 5 ends off zero, mode 6 leaves
//!   the limit at low speed.
//! - Started on the limit that it seeks, a mode has found it and goes back.
//! - Marks count from the step that seeks them: in modes 3 and 10 from the home edge, in modes 4, 5, 7, 8, 11
//!   and 12 from the turn. In mode 2 they count once the motor is down to low speed. A mark that is on at the
//!   beginning does not count.
//! - The ERC pulse is due when the motor stands still at the end.
//! - The return to zero goes by the pulse counter, which the manual wants equal to the encoder's.
//! - `ZMOVE` brakes after the last mark and leaves the counters alone.
//!
//! [`Inputs::slowdown`]: super::routine::Inputs::slowdown
//! [`Homing::take_clear`]: super::Homing::take_clear

mod mode_0;
mod mode_1;
mod mode_10;
mod mode_11;
mod mode_12;
mod mode_2;
mod mode_3;
mod mode_4;
mod mode_5;
mod mode_6;
mod mode_7;
mod mode_8;
mod mode_9;
#[cfg(test)]
mod tests;
mod z_move;

use super::routine::Step;

/// The steps of the homing modes by their number, for [`Homing::new`](super::Homing::new). CMD-4CR manual,
/// appendix A.
pub const MODES: [&[Step]; 13] = [
    mode_0::STEPS,
    mode_1::STEPS,
    mode_2::STEPS,
    mode_3::STEPS,
    mode_4::STEPS,
    mode_5::STEPS,
    mode_6::STEPS,
    mode_7::STEPS,
    mode_8::STEPS,
    mode_9::STEPS,
    mode_10::STEPS,
    mode_11::STEPS,
    mode_12::STEPS,
];

/// The steps of `ZMOVE`, for [`Homing::new`](super::Homing::new). CMD-4CR manual, section 2.2.5.1.
pub const Z_MOVE: &[Step] = z_move::STEPS;
