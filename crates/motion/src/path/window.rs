//! Bits for the slots of a path, 64 at a time.
//!
//! What an axis does in a slot is a function of the slot's number. It is found for windows of 64 slots at once,
//! and remembered for the trains that lie in the same window.

use crate::train::MAX_SLOTS;

/// Slots a window.
pub const WINDOW: u32 = u64::BITS;

/// The bits of some slots after `slot`, 64 at the most, or before it going back: the one that comes first in
/// the lowest bit. `window` gives those of a window; the slot after slot 0 is the first of window 0.
#[inline]
pub fn bits<const M: usize>(
    slot: i64,
    count: u32,
    ahead: bool,
    mut window: impl FnMut(i64) -> [u64; M],
) -> [u64; M] {
    debug_assert!((1..=MAX_SLOTS).contains(&count));
    let first = if ahead { slot } else { slot - i64::from(count) };
    let (number, inside) = (first.div_euclid(WINDOW.into()), first.rem_euclid(WINDOW.into()) as u32);
    let mut bits = window(number).map(|bits| bits >> inside);
    if inside + count > WINDOW {
        let following = window(number + 1);
        for (bits, following) in bits.iter_mut().zip(following) {
            *bits |= following << (WINDOW - inside);
        }
    }
    // The first one highest, and then back where it belongs.
    let aligned = bits.map(|bits| bits << (WINDOW - count));
    if ahead { aligned.map(|bits| bits >> (WINDOW - count)) } else { aligned.map(u64::reverse_bits) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_come_from_windows() {
        let window = |number: i64| [(number + 2).pow(20) as u64];
        let bit = |slot: i64| window(slot.div_euclid(64))[0] >> slot.rem_euclid(64) & 1;
        for slot in -100..100 {
            for count in 1..=64 {
                let [ahead] = bits(slot, count, true, window);
                let [back] = bits(slot, count, false, window);
                let expected = |slot: &dyn Fn(i64) -> i64| {
                    (0..count.into()).fold(0, |all, k: i64| all | bit(slot(k)) << k)
                };
                assert_eq!(ahead, expected(&|k| slot + k), "{count} after {slot}");
                assert_eq!(back, expected(&|k| slot - 1 - k), "{count} before {slot}");
            }
        }
    }
}
