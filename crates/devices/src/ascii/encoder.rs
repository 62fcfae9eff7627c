//! The encoder counter of an axis (PMX-2ED-SA manual, 7.4 and table 7.7; CMD-4CR manual, 2.1.2.3).

/// A counter on top of a decoder that counts fourfold.
#[derive(Clone, Copy, Debug)]
pub struct Encoder {
    /// The decoder's count at which the counter was `offset`.
    base: i32,
    offset: i32,
    /// How much coarser the counter is, as a power of two.
    shift: u32,
    /// It counts down where the decoder counts up.
    reversed: bool,
}

impl Encoder {
    /// A counter that is 0 now.
    pub const fn new(decoder: i32, shift: u32) -> Self {
        Self { base: decoder, offset: 0, shift, reversed: false }
    }

    /// The counter.
    pub const fn position(&self, decoder: i32) -> i32 {
        let counted = decoder.wrapping_sub(self.base);
        let counted = if self.reversed { counted.wrapping_neg() } else { counted };
        self.offset.wrapping_add(counted >> self.shift)
    }

    /// The decoder's counts, below and above its present one, at which the counter has come so far down or
    /// up. Where they are too far away for a decoder that wraps, it is told earlier.
    pub fn window(&self, [down, up]: [u32; 2], decoder: i32) -> (i32, i32) {
        let counted = i64::from(decoder.wrapping_sub(self.base)) * if self.reversed { -1 } else { 1 };
        let steps = counted >> self.shift;
        let falls = counted - (((steps - i64::from(down) + 1) << self.shift) - 1);
        let rises = ((steps + i64::from(up)) << self.shift) - counted;
        let [falls, rises] = [falls, rises].map(|way| way.min(i32::MAX.into()) as i32);
        let (below, above) = if self.reversed { (rises, falls) } else { (falls, rises) };
        (decoder.wrapping_sub(below), decoder.wrapping_add(above))
    }

    /// Sets the counter.
    pub const fn set_position(&mut self, position: i32, decoder: i32) {
        self.offset = position;
        self.base = decoder;
    }

    /// Counts coarser or finer from here on.
    pub const fn set_decoding(&mut self, shift: u32, decoder: i32) {
        self.set_counting(shift, self.reversed, decoder);
    }

    /// Counts so coarse and in this direction from here on.
    pub const fn set_counting(&mut self, shift: u32, reversed: bool, decoder: i32) {
        if shift != self.shift || reversed != self.reversed {
            self.set_position(self.position(decoder), decoder);
            self.shift = shift;
            self.reversed = reversed;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counting_goes_on_from_where_it_is() {
        let mut encoder = Encoder::new(100, 0);
        let mut check = |shift, reversed, from, [decoder, position]: [i32; 2]| {
            encoder.set_counting(shift, reversed, from);
            assert_eq!(encoder.position(decoder), position);
        };
        check(0, false, 100, [110, 10]);
        check(2, false, 110, [131, 15]);
        check(0, true, 130, [137, 8]);
        check(1, true, 137, [137, 8]);
        check(1, true, 137, [127, 13]);
        check(0, false, 127, [100, -14]);
    }
    #[test]
    fn windows_end_where_the_counter_has_come_so_far() {
        for (shift, reversed) in [(0, false), (0, true), (1, false), (2, false), (2, true)] {
            let mut encoder = Encoder::new(7, shift);
            encoder.set_counting(shift, reversed, 7);
            encoder.set_position(-3, 7);
            for decoder in -40..40 {
                for room in [[1, 1], [2, 5], [9, 1]] {
                    let now = encoder.position(decoder);
                    let reached = |other: &i32| {
                        let moved = encoder.position(*other) - now;
                        moved >= room[1] as i32 || moved <= -(room[0] as i32)
                    };
                    let below = (-200..decoder).rev().find(reached).unwrap();
                    let above = (decoder + 1..200).find(reached).unwrap();
                    let window = encoder.window(room, decoder);
                    assert_eq!(window, (below, above), "{encoder:?} at {decoder}, {room:?}");
                }
            }
        }
        let far = Encoder::new(0, 2).window([u32::MAX, 1 << 29], 5);
        assert_eq!(far, (5_i32.wrapping_sub(i32::MAX), 5_i32.wrapping_add(i32::MAX)));
    }
}
