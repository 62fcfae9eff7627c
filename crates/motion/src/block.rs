//! From a piece of a speed profile to a train.
//!
//! A block is a run of pulses over which the profile changes little: the cubic with the profile's duration
//! and its speeds at both ends. With at most 1/64 of the square of the speed changing over a block, it
//! stays within 0.04 % of the acceleration, a unit of the largest that a register holds.

use crate::speed::{Growth, Pace, Scale, SpeedSquared};
use crate::train::{Direction, EVERY_SLOT, FRACTION_BITS, Moment, SubTicks, Train};

/// The longest block of a ramp, so that rounding of the cubic's terms stays below 1/64 clock.
pub const MAX_BLOCK: u32 = 512;

/// The longest block, as a power of two, at about this v².
///
/// The cubic term is a whole number of 2⁻³² clocks. Rounding it bends a block the more, the longer the
/// block and the shorter its spacings: with n² ≤ spacing / 2²⁴, by 0.04 % of the acceleration at most.
/// And no train lasts too long.
#[inline]
pub fn longest(scale: Scale, squared: SpeedSquared) -> u32 {
    let spacing_bits = scale.bits() + FRACTION_BITS - squared.checked_ilog2().unwrap_or(0) / 2 - 1;
    let bits = (spacing_bits.saturating_sub(24) / 2).min(61u32.saturating_sub(spacing_bits));
    MAX_BLOCK.min(1 << bits)
}

/// The largest share of v² that changes over a block of more than one pulse, as a power of two.
pub const SHARE_BITS: u32 = 6;

/// Largest power of two of pulses, up to [`MAX_BLOCK`], over which v² changes by at most 1/64, seen from
/// its smaller end.
#[inline]
pub fn block_length(slow_end: SpeedSquared, growth: Growth) -> u32 {
    let mut length = MAX_BLOCK;
    // growth·length ≤ v²/64, found from the logarithms first.
    let room = (slow_end >> SHARE_BITS).checked_ilog2().unwrap_or(0);
    let need = growth.ilog2();
    if room < need {
        return 1;
    }
    length = length.min(1u32.checked_shl(room - need).unwrap_or(length));
    while length > 1 && growth.saturating_mul(u64::from(length)) > slow_end >> SHARE_BITS {
        length /= 2;
    }
    length
}

/// `count` pulses (a power of two) from one speed to another, in `count·mean` clocks.
#[inline]
pub fn cubic(start: Moment, direction: Direction, count: u32, [first, mean, last]: [SubTicks; 3]) -> Train {
    debug_assert!(count.is_power_of_two());
    let bits = count.trailing_zeros();
    let (first, mean, last) = (first as i64, mean as i64, last as i64);
    // T(n) = first·n + c2·n² + c3·n³ with T(count) = count·mean and T'(count) = last. The last spacing
    // takes precedence over the duration in rounding: a step of it would be a kick, the duration is off
    // by less than 1/64 clock.
    let c3 = rounded((first - mean) + (last - mean), 2 * bits);
    let c2 = rounded((last - first) - ((3 * c3) << (2 * bits)), bits + 1);
    let interval = (first + c2 + c3) as u64;
    Train { start, interval, add: 2 * c2 + 6 * c3, jerk: 6 * c3, count, direction, mask: EVERY_SLOT }
}

/// Divides by a power of two, to the nearest.
const fn rounded(value: i64, bits: u32) -> i64 {
    (value + ((1 << bits) >> 1)) >> bits
}

/// A block of constant acceleration between two squared speeds.
#[inline]
pub(crate) fn ramp(scale: Scale, start: Moment, direction: Direction, count: u32, ends: [Pace; 2]) -> Train {
    let [from, to] = ends;
    let mean = scale.mean_spacing(from.speed, to.speed);
    if count == 1 {
        return single(start, direction, mean);
    }
    cubic(start, direction, count, [scale.quick_spacing(from), mean, scale.quick_spacing(to)])
}

/// A block over which the speed itself, not its square, changes evenly with the pulses.
#[inline]
pub(crate) fn glide(scale: Scale, start: Moment, direction: Direction, count: u32, ends: [Pace; 2]) -> Train {
    let [from, to] = ends;
    let first = scale.quick_spacing(from);
    let last = scale.quick_spacing(to);
    // The time is the integral of the spacing: Simpson's rule, off by 10⁻⁹ at most over such a block.
    let middle = scale.mean_spacing(from.speed, to.speed);
    let mean = first / 6 + 2 * (middle / 3) + last / 6;
    if count == 1 {
        return single(start, direction, mean);
    }
    cubic(start, direction, count, [first, mean, last])
}

/// A block of known duration between two speeds.
#[inline]
pub(crate) fn curve(
    scale: Scale,
    start: Moment,
    direction: Direction,
    count: u32,
    ends: [Pace; 2],
    duration: SubTicks,
) -> Train {
    if count == 1 {
        return single(start, direction, duration);
    }
    let [first, last] = ends.map(|pace| scale.quick_spacing(pace));
    cubic(start, direction, count, [first, duration >> count.trailing_zeros(), last])
}

/// One pulse.
#[inline]
pub const fn single(start: Moment, direction: Direction, interval: SubTicks) -> Train {
    Train { start, interval, add: 0, jerk: 0, count: 1, direction, mask: EVERY_SLOT }
}
