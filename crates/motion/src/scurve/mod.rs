//! Jerk-limited ramps: the curve between two speeds, and the course of a motion made of two of them.
//!
//! On an S the acceleration rises evenly in time from 0 to its peak, may stay there, and falls evenly to
//! 0. What bounds it is the peak (the growth of the limits) and the jerk, which is given by the bend: the
//! span of speed over which the acceleration rises from 0 to the peak. A curve of less than two bends
//! keeps the jerk and never reaches the peak.
//!
//! An S depends on where it began, so unlike the other shapes it has a memory, the [`Course`]. The lead
//! takes the present speed to that of the cruise, the tail takes it to the stop speed and is fixed at
//! the target: it is the same curve read backward from there, so it ends on the pulse.
//!
//! A change on the way ends the course: the acceleration drops to 0 and a new S begins at the present
//! speed, which does not jump. It needs more room than going on would, so a target close ahead may be
//! passed and come back to. A change that leaves the course right does not disturb it: the other
//! direction is blocked, or another top speed comes when the tail has begun.
//!
//! Everything is a function of the way. A bend is a cubic in time; Newton's method inverts it in a few
//! multiplications. The times of all pulses are thus those of one curve, however it is cut into blocks.

mod course;
mod curve;
#[cfg(test)]
mod tests;

pub(crate) use course::{Course, entry};
