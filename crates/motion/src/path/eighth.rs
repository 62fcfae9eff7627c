//! Many ticks at once, on an eighth of the circle.
//!
//! Between an axis and a diagonal it is known which axis is the faster one and which way both go. All that is
//! left to find is whether the faster one has come to its next position, and whether the nearest position of
//! the other is then the next one, too. The points are the same as [`Circle::point`] finds one by one.

use super::circle::{Circle, Point, position};
use super::places::{Places, Spot};
use core::hint::select_unpredictable;

/// Where a motion along an eighth stands, each coordinate without its sign.
pub struct Eighth {
    /// The faster axis, and its sign and that of the other: −1 or 0.
    fast: usize,
    signs: [i64; 2],
    fast_at: i64,
    slow_at: i64,
    /// How much their squares miss that of the radius.
    missing: i64,
}

/// What was done: how many ticks, and in which of them the axes stepped, the first in the lowest bit.
#[derive(Default)]
pub struct Run {
    pub ticks: u32,
    pub bits: [u64; 2],
}

impl Eighth {
    /// The eighth in which a spot lies that has this point.
    #[inline]
    pub fn of(circle: &Circle, spot: &Spot, point: Point) -> Self {
        let fast = usize::from(circle.is_steep(spot.at));
        let signs = [fast, 1 - fast].map(|axis| spot.at[axis] >> 63);
        let [fast_at, slow_at] = [point[fast], point[1 - fast]].map(i64::abs);
        let missing = circle.squared() - fast_at * fast_at - slow_at * slow_at;
        Self { fast, signs, fast_at, slow_at, missing }
    }

    /// The point that was reached.
    #[inline]
    pub fn point(&self) -> Point {
        let [fast, slow] = [(self.fast_at, self.signs[0]), (self.slow_at, self.signs[1])];
        let [fast, slow] = [fast, slow].map(|(at, sign)| (at ^ sign) - sign);
        if self.fast == 0 { [fast, slow] } else { [slow, fast] }
    }

    /// Goes on for some ticks of a stride, 64 at the most, as far as they are in this eighth and not near the
    /// diagonal.
    #[inline]
    pub fn run(&mut self, circle: &Circle, places: &Places, spot: &mut Spot, most: u32) -> Run {
        // Counter-clockwise, the faster axis goes away from the other one in every second eighth.
        if (self.signs[0] == self.signs[1]) == (self.fast == 1) {
            self.run_toward::<true>(circle, places, spot, most)
        } else {
            self.run_toward::<false>(circle, places, spot, most)
        }
    }

    /// Toward the diagonal, where the faster coordinate rises and the other falls, or away from it.
    fn run_toward<const DIAGONAL: bool>(
        &mut self,
        circle: &Circle,
        places: &Places,
        spot: &mut Spot,
        most: u32,
    ) -> Run {
        let (fast, free, sign) = (self.fast, circle.free(), self.signs[0]);
        let Self { mut fast_at, mut slow_at, mut missing, .. } = *self;
        let [mut fast_bits, mut slow_bits] = [0u64; 2];
        let [mut a, mut b] = [spot.part(fast), spot.part(1 - fast)];
        let mut left = most;
        while left > 0 {
            let next = places.next_part(a);
            let from_axis = (next.0 ^ sign) - sign;
            if from_axis as u64 > free {
                break;
            }
            (a, b) = (next, places.next_part(b));
            let reached = position(from_axis);
            let step = reached != fast_at;
            let other;
            // Which way a step goes cannot be predicted.
            if DIAGONAL {
                missing -= select_unpredictable(step, 2 * fast_at + 1, 0);
                other = missing <= -slow_at;
                missing += select_unpredictable(other, 2 * slow_at - 1, 0);
                slow_at -= i64::from(other);
            } else {
                missing += select_unpredictable(step, 2 * fast_at - 1, 0);
                other = missing > slow_at;
                missing -= select_unpredictable(other, 2 * slow_at + 1, 0);
                slow_at += i64::from(other);
            }
            fast_at = reached;
            fast_bits = fast_bits << 1 | u64::from(step);
            slow_bits = slow_bits << 1 | u64::from(other);
            left -= 1;
        }
        (self.fast_at, self.slow_at, self.missing) = (fast_at, slow_at, missing);
        let ticks = most - left;
        if ticks == 0 {
            return Run::default();
        }
        *spot = if fast == 0 { Spot::of_parts([a, b]) } else { Spot::of_parts([b, a]) };
        let bits = if fast == 0 { [fast_bits, slow_bits] } else { [slow_bits, fast_bits] };
        Run { ticks, bits: bits.map(|bits| bits.reverse_bits() >> (u64::BITS - ticks)) }
    }
}
