//! The chain of points that stands for a circle, exactly.
//!
//! In each eighth of the circle one axis is the faster one: the chain has a point at each of its positions,
//! with the nearest position of the other axis (the midpoint circle algorithm). So every point is within half
//! a pulse of the circle, and from one to the next each axis moves by one pulse or none. Where two eighths
//! meet on a diagonal that misses a point, the point on the diagonal itself is one of the chain.

/// Fraction bits of a place on the ideal circle.
pub const PLACE_BITS: u32 = 34;

/// What makes no difference: far below a pulse, and far above the rounding of places (2⁻²⁰). Half a pulse
/// may be off by that and still goes away from the axis.
const SLACK: i64 = 1 << (PLACE_BITS - 20);

const HALF: i64 = 1 << (PLACE_BITS - 1);

/// A place near the ideal circle, from the centre, in 2⁻³⁴ pulses.
pub type Place = [i64; 2];

/// A point of the lattice, from the centre.
pub type Point = [i64; 2];

/// A circle about a point of the lattice, through another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Circle {
    /// The square of the radius.
    squared: i64,
    /// The last position of the faster axis before a diagonal.
    last: i64,
    /// From where on the faster axis the point on the diagonal is meant; never, where there is none.
    diagonal: i64,
    /// How far the chain goes to each side.
    reach: i64,
    /// As far as that on the faster axis, a place has nothing to do with the diagonal.
    free: i64,
}

impl Circle {
    /// The circle through a point.
    pub fn through([x, y]: Point) -> Self {
        let squared = x * x + y * y;
        let last = (squared / 2).isqrt();
        let gap = nearest_root(squared - last * last) - last;
        // Half an arc of a pulse, so that there is time for a step to the diagonal and one away from it.
        let corner = ((squared as u128) << (2 * PLACE_BITS - 1)).isqrt() as i64;
        let diagonal = if gap == 2 { corner - 3 * HALF / 4 } else { i64::MAX };
        // Where the last but one position ends, or well before the diagonal itself.
        let free = ((last << PLACE_BITS) + HALF - 2 * SLACK).min(corner - HALF / 2).min(diagonal - 2 * SLACK);
        Self { squared, last, diagonal, reach: nearest_root(squared), free }
    }

    /// The square of the radius.
    pub fn squared(&self) -> i64 {
        self.squared
    }

    /// How far the chain goes to each side.
    pub fn reach(&self) -> i64 {
        self.reach
    }

    /// As far as that on the faster axis, a place has nothing to do with the diagonal.
    pub fn free(&self) -> u64 {
        self.free as u64
    }

    /// Whether the second axis is the faster one at a place.
    #[inline]
    pub fn is_steep(&self, [x, y]: Place) -> bool {
        x.abs() > y.abs() + SLACK
    }

    /// The point of the chain for a place on the circle.
    #[inline]
    pub fn point(&self, [x, y]: Place) -> Point {
        let [across, up] = [x.abs(), y.abs()];
        let steep = self.is_steep([x, y]);
        let (fast, slow) = if steep { (up, across) } else { (across, up) };
        let mut fast_at = position(fast).min(self.last);
        // One off at the most.
        let mut slow_at = (slow + HALF) >> PLACE_BITS;
        let missing = self.squared - fast_at * fast_at - slow_at * slow_at;
        slow_at += i64::from(missing > slow_at) - i64::from(missing <= -slow_at);
        if fast + SLACK > self.diagonal {
            (fast_at, slow_at) = (self.last + 1, self.last + 1);
        }
        let [across, up] = if steep { [slow_at, fast_at] } else { [fast_at, slow_at] };
        [if x < 0 { -across } else { across }, if y < 0 { -up } else { up }]
    }
}

/// The nearest position, half a pulse going away from 0.
#[inline]
pub fn position(place: i64) -> i64 {
    (place + HALF + SLACK) >> PLACE_BITS
}

/// The whole number that is nearest to a square root.
fn nearest_root(squared: i64) -> i64 {
    let root = squared.isqrt();
    root + i64::from(squared > root * root + root)
}

#[cfg(test)]
impl Circle {
    /// Whether a point is within half a pulse: |√n − √r| ≤ ½ without roots, n and r the squares of its distance
    /// and the radius.
    pub fn is_near(&self, [x, y]: Point) -> bool {
        let (n, r) = (i128::from(x * x + y * y), i128::from(self.squared));
        let sum = 4 * (n + r) - 1;
        sum <= 0 || sum * sum <= 64 * n * r
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(circle: &Circle, count: u32) -> impl Iterator<Item = Place> {
        let radius = (circle.squared as f64).sqrt() * (1i64 << PLACE_BITS) as f64;
        (0..=count).map(move |k| {
            let angle = f64::from(k) / f64::from(count) * core::f64::consts::TAU;
            [angle.cos(), angle.sin()].map(|part| (radius * part) as i64)
        })
    }

    /// Every point that a circle has, in steps of an axis or both, and none too far away.
    #[test]
    fn small_circles_are_chains() {
        for x in 0..40 {
            for y in (0..=x).filter(|y| x + y > 0) {
                let circle = Circle::through([x, y]);
                let all: Vec<_> =
                    places(&circle, 64 * (x + y) as u32).map(|place| circle.point(place)).collect();
                for pair in all.windows(2) {
                    let way = [0, 1].map(|axis| (pair[1][axis] - pair[0][axis]).abs());
                    assert!(way <= [1, 1], "{x} {y}: {pair:?}");
                    assert!(circle.is_near(pair[0]), "{x} {y}: {pair:?}");
                }
                for start in [[x, y], [y, x], [-x, y], [y, -x]] {
                    assert_eq!(circle.point(start.map(|at| at << PLACE_BITS)), start);
                }
            }
        }
    }

    #[track_caller]
    fn check(start: Point, place: Place, expected: Point) {
        assert_eq!(Circle::through(start).point(place), expected);
    }

    #[test]
    fn points_of_a_circle() {
        let half = HALF;
        check([11, 0], [11 * 2 * half, 0], [11, 0]);
        check([11, 0], [11 * 2 * half, half - 2 * SLACK], [11, 0]);
        // Half a pulse, give or take what makes no difference, goes outward.
        check([11, 0], [11 * 2 * half, half - SLACK / 2], [11, 1]);
        check([11, 0], [11 * 2 * half, SLACK / 2 - half], [11, -1]);
        check([11, 0], [0, -11 * 2 * half], [0, -11]);
        // √2·6 is 8.49, √2·7 is 9.9: a diagonal without a point, with one step over it, and one with a point.
        check([9, 0], [12 * half, 13 * half], [6, 7]);
        check([10, 0], [14 * half, 14 * half], [7, 7]);
    }
}
