//! The encoder counter of an axis (PMX-2ED-SA manual, 7.4 and table 7.7; CMD-4CR manual, 2.1.2.3).

/// A counter on top of a decoder that counts fourfold.
#[derive(Clone, Copy, Debug)]
pub struct Encoder {
    /// The decoder's count at which the counter was `offset`.
    base: i32,
    offset: i32,
    /// How much coarser the counter is, as a power of two.
    shift: u32,
}

impl Encoder {
    /// A counter that is 0 now.
    pub const fn new(decoder: i32, shift: u32) -> Self {
        Self { base: decoder, offset: 0, shift }
    }

    /// The counter.
    pub const fn position(&self, decoder: i32) -> i32 {
        self.offset.wrapping_add(decoder.wrapping_sub(self.base) >> self.shift)
    }

    /// Sets the counter.
    pub const fn set_position(&mut self, position: i32, decoder: i32) {
        self.offset = position;
        self.base = decoder;
    }

    /// Counts coarser or finer from here on.
    pub const fn set_decoding(&mut self, shift: u32, decoder: i32) {
        if shift != self.shift {
            self.set_position(self.position(decoder), decoder);
            self.shift = shift;
        }
    }
}
