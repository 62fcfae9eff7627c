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
}
