//! Where the ticks of an arc lie on the ideal circle.
//!
//! The angle grows evenly with the ticks. Every 64 of them the place is found from the angle. In between a
//! place is the last one and a step, and the step turns toward the centre by as much as the place is away from
//! it: two products a tick. So a place is a function of the number of its tick alone, and can be asked for
//! ahead and backward.

use super::angle::{self, Angle, UNIT_BITS};
use super::circle::{PLACE_BITS, Place, Point};
use crate::wide::quotient;

/// Ticks from one place that is found from the angle to the next.
pub const STRIDE: i64 = 64;

/// The ticks of an arc, counter-clockwise about the centre.
#[derive(Clone, Copy, Debug)]
pub struct Places {
    pub start: Point,
    /// From start to end in 2⁻⁶⁴ of a turn, a whole turn at the most, and how many ticks that is.
    pub travel: u128,
    pub ticks: u64,
    /// Cosine and sine of the angle of a tick.
    turn: [i64; 2],
    /// Twice what is missing from that cosine to 1, in 2⁻⁶³.
    bend: i64,
}

/// A tick on its way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spot {
    /// Where it lies.
    pub at: Place,
    /// From there to the next, if that is of the same stride.
    step: Place,
}

/// One coordinate of a spot and of the step from it.
pub type Part = (i64, i64);

impl Spot {
    /// The coordinate of an axis.
    #[inline]
    pub fn part(&self, axis: usize) -> Part {
        (self.at[axis], self.step[axis])
    }

    /// From both coordinates.
    #[inline]
    pub fn of_parts(parts: [Part; 2]) -> Self {
        Self { at: parts.map(|part| part.0), step: parts.map(|part| part.1) }
    }
}

impl Places {
    /// An arc of a turn at the most, in ticks of less than a radian.
    pub fn new(start: Point, travel: u128, ticks: u64) -> Self {
        let angle = quotient(travel, ticks.into()) as Angle;
        // As 4·sin², which has all its digits at small angles.
        let [_, half] = angle::cosine_and_sine(angle / 2).map(i128::from);
        let bend = ((half * half) >> (2 * UNIT_BITS - 65)) as i64;
        Self { start, travel, ticks, turn: angle::cosine_and_sine(angle), bend }
    }

    /// The angle from the start to a tick.
    pub fn angle_of(&self, tick: i64) -> Angle {
        (self.travel as i128 * i128::from(tick)).div_euclid(self.ticks.into()) as Angle
    }

    /// Any tick.
    pub fn of(&self, tick: i64) -> Spot {
        let first = tick & -STRIDE;
        (first..tick).fold(self.of_stride(first), |spot, _| self.next(spot))
    }

    /// A tick that begins a stride.
    pub fn of_stride(&self, tick: i64) -> Spot {
        let at = turned(self.start, angle::cosine_and_sine(self.angle_of(tick)), UNIT_BITS - PLACE_BITS);
        let next = turned(at, self.turn, UNIT_BITS);
        Spot { at, step: [next[0] - at[0], next[1] - at[1]] }
    }

    /// The tick after another of the same stride.
    #[inline]
    pub fn next(&self, spot: Spot) -> Spot {
        Spot::of_parts([0, 1].map(|axis| self.next_part(spot.part(axis))))
    }

    /// One coordinate of it.
    #[inline]
    pub fn next_part(&self, (at, step): Part) -> Part {
        let at = at + step;
        (at, step - ((i128::from(2 * at) * i128::from(self.bend)) >> 64) as i64)
    }

    /// The tick after `tick`, which lies at a spot.
    pub fn after(&self, tick: i64, spot: Spot) -> Spot {
        if (tick + 1) % STRIDE == 0 { self.of_stride(tick + 1) } else { self.next(spot) }
    }
}

/// Turned by the angle of a cosine and a sine, and shifted down.
fn turned([x, y]: [i64; 2], turn: [i64; 2], bits: u32) -> [i64; 2] {
    let [[x, y], [cosine, sine]] = [[x, y], turn].map(|pair| pair.map(i128::from));
    [x * cosine - y * sine, x * sine + y * cosine].map(|part| (part >> bits) as i64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::path::MAX_RADIUS;
    use crate::path::angle::TURN;

    /// Within 2⁻²² of a pulse of the place that is found from the angle.
    #[test]
    fn places_are_where_their_angles_are() {
        let check = |start: Point, ticks| {
            let places = Places::new(start, TURN, ticks);
            for first in (0..8).map(|part| (ticks / 8 * part) as i64 & -STRIDE) {
                for tick in first..first + STRIDE {
                    let [spot, exact] = [places.of(tick), places.of_stride(tick)].map(|spot| spot.at);
                    for (a, b) in spot.iter().zip(exact) {
                        assert!(
                            a.abs_diff(b) < 1 << (PLACE_BITS - 22),
                            "{start:?} {tick}: {spot:?} {exact:?}"
                        );
                    }
                }
            }
        };
        check([1, 0], 7);
        check([1, 1], 9);
        check([100, -3], 629);
        check([-4000, 3000], 31_417);
        check([0, MAX_RADIUS.into()], 843_315_000);
        check([-94_905_590, 94_905_590], 843_315_000);
    }
}
