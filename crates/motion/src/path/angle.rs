//! Angles as fractions of a turn, with their sine and cosine, in whole numbers.

use crate::wide::quotient;

/// An angle in 2⁻⁶⁴ of a turn, counter-clockwise: it wraps as angles do.
pub type Angle = u64;

/// A whole turn, which an [`Angle`] cannot hold.
pub const TURN: u128 = 1 << 64;

/// A quarter of a turn.
pub const QUARTER: Angle = 1 << 62;

/// Fraction bits of sines, cosines and radians.
pub const UNIT_BITS: u32 = 62;

/// Thousandths of a degree in a turn.
const MILLIDEGREES: i64 = 360_000;

/// π/2, which is also the radians of a turn in 2⁻⁶⁰, and 1/2π, both in 2⁻⁶².
const HALF_PI: i64 = 7_244_019_458_077_122_842;
const TURNS_PER_RADIAN: i64 = 733_972_625_820_500_307;

/// Terms of a series that are enough for an eighth of a turn.
const TERMS: usize = 10;

/// 1/(2k)! and 1/(2k + 1)! with alternating signs.
const COSINE: [i64; TERMS] = series(0);
const SINE: [i64; TERMS] = series(1);

const fn series(odd: i64) -> [i64; TERMS] {
    let mut terms = [1 << UNIT_BITS; TERMS];
    let mut k = 1;
    while k < TERMS {
        let below = 2 * k as i64 + odd;
        terms[k] = -terms[k - 1] / (below * (below - 1));
        k += 1;
    }
    terms
}

/// Product of two numbers, one of which has [`UNIT_BITS`].
#[inline]
pub const fn times(a: i64, b: i64) -> i64 {
    ((a as i128 * b as i128) >> UNIT_BITS) as i64
}

/// Cosine and sine, off by 2⁻⁵⁹ at the most; exact at quarters of a turn.
pub fn cosine_and_sine(angle: Angle) -> [i64; 2] {
    let from_middle = angle.wrapping_add(QUARTER / 2);
    // Between an eighth of a turn to either side of the axis of its quadrant.
    let rest = (from_middle % QUARTER) as i64 - (QUARTER / 2) as i64;
    let radians = times(rest, HALF_PI);
    let squared = times(radians, radians);
    let sum = |terms: [i64; TERMS]| terms.into_iter().rev().fold(0, |sum, term| term + times(squared, sum));
    let (cosine, sine) = (sum(COSINE), times(radians, sum(SINE)));
    match from_middle / QUARTER {
        0 => [cosine, sine],
        1 => [-sine, cosine],
        2 => [-cosine, -sine],
        _ => [sine, -cosine],
    }
}

/// The angle of a point other than the centre, with coordinates below 2²⁸, as seen from there.
pub fn of_point([x, y]: [i64; 2]) -> Angle {
    let radius = ((x * x + y * y) as u128) << 64;
    let radius = radius.isqrt() as i128;
    let mut angle = match (x.abs() >= y.abs(), x >= 0, y >= 0) {
        (true, true, _) => 0,
        (false, _, true) => QUARTER,
        (true, false, _) => 2 * QUARTER,
        (false, _, false) => 3 * QUARTER,
    };
    // The sine of what is missing is nearly that itself: from an eighth of a turn, four steps leave less
    // than the rounding.
    for _ in 0..4 {
        let [cosine, sine] = cosine_and_sine(angle);
        let across = i128::from(y) * i128::from(cosine) - i128::from(x) * i128::from(sine);
        let missing = (across << 32) / radius;
        // From radians in 2⁻⁶² to turns in 2⁻⁶⁴.
        let missing = (missing * i128::from(TURNS_PER_RADIAN)) >> (UNIT_BITS - 2);
        angle = angle.wrapping_add(missing as u64);
    }
    angle
}

/// An angle in thousandths of a degree.
pub fn of_millidegrees(angle: i32) -> Angle {
    let angle = i64::from(angle).rem_euclid(MILLIDEGREES) as u128;
    quotient(angle * TURN + MILLIDEGREES as u128 / 2, MILLIDEGREES as u128) as Angle
}

/// The length of an arc of a circle, in 2⁻³²: the square of the radius is below 2⁵⁶, and the angle a
/// turn at the most.
pub fn arc_length(radius_squared: u64, angle: u128) -> u64 {
    let radius = (u128::from(radius_squared) << 64).isqrt();
    let turns = (radius * angle) >> 64;
    ((turns * HALF_PI as u128) >> 60) as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: f64 = (1u64 << UNIT_BITS) as f64;

    #[test]
    fn quarters_are_exact() {
        let one = 1 << UNIT_BITS;
        for (quarter, expected) in (0..).zip([[one, 0], [0, one], [-one, 0], [0, -one]]) {
            assert_eq!(cosine_and_sine(quarter * QUARTER), expected);
            let point = expected.map(|part: i64| part.signum() * 134_216_773);
            assert_eq!(of_point(point), quarter * QUARTER);
            assert_eq!(of_millidegrees(90_000 * quarter as i32 - 720_000), quarter * QUARTER);
        }
    }

    #[test]
    fn sines_lie_on_the_unit_circle_and_are_the_floats() {
        for k in 0..10_000u64 {
            let angle = k.wrapping_mul(0x9E37_79B9_7F4A_7C15);
            let [cosine, sine] = cosine_and_sine(angle);
            let radians = angle as f64 / TURN as f64 * core::f64::consts::TAU;
            assert!((cosine as f64 / UNIT - radians.cos()).abs() < 4e-15, "cosine of {angle}");
            assert!((sine as f64 / UNIT - radians.sin()).abs() < 4e-15, "sine of {angle}");
            let squared = i128::from(cosine).pow(2) + i128::from(sine).pow(2);
            assert!((squared - (1 << (2 * UNIT_BITS))).abs() < 1 << (2 * UNIT_BITS - 58), "{angle}");
        }
    }

    #[test]
    fn the_angle_of_a_point_leads_back_to_it() {
        for k in 1..10_000i64 {
            let size = 1 << (k % 27 + 1);
            let [x, y] = [k.wrapping_mul(1_103_515_245), k.wrapping_mul(2_147_001_325)].map(|c| c % size);
            let [cosine, sine] = cosine_and_sine(of_point([x, y + i64::from([x, y] == [0, 0])]));
            let across = i128::from(y) * i128::from(cosine) - i128::from(x) * i128::from(sine);
            let ahead = i128::from(x) * i128::from(cosine) + i128::from(y) * i128::from(sine);
            assert!(across.abs() <= i128::from(size) << 4 && ahead >= 0, "{x} {y}");
        }
        assert_eq!(of_millidegrees(45_000), QUARTER / 2);
        assert!(of_point([1000, 1000]).abs_diff(QUARTER / 2) < 16);
    }

    #[test]
    fn arcs_have_their_length() {
        let check = |radius: u64, angle: u128, expected: f64| {
            let length = arc_length(radius * radius, angle) as f64 / (1u64 << 32) as f64;
            assert!((length - expected).abs() <= expected * 1e-9, "{length} {expected}");
        };
        check(1, TURN, core::f64::consts::TAU);
        check(134_216_773, TURN, core::f64::consts::TAU * 134_216_773.0);
        check(1000, TURN / 4, core::f64::consts::FRAC_PI_2 * 1000.0);
        check(1000, 0, 0.0);
    }
}
