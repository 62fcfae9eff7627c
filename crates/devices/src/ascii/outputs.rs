//! Outputs as the board was told them last: it is told what changes, however often a device drives all of them.

use crate::board::Board;

/// Most pins of a device, in words of bits.
const WORDS: usize = 3;

/// The levels of a device's outputs.
#[derive(Clone, Copy, Debug)]
pub struct Outputs {
    /// Bits of the pins that are driven, and of those that are on.
    driven: [u32; WORDS],
    on: [u32; WORDS],
}

impl Outputs {
    /// No pin is driven.
    pub const fn new() -> Self {
        Self { driven: [0; WORDS], on: [0; WORDS] }
    }

    /// Drives a pin.
    ///
    /// # Panics
    /// If there are not so many pins.
    pub fn set(&mut self, pin: usize, on: bool, board: &mut dyn Board) {
        let (word, bit) = (pin / u32::BITS as usize, 1 << (pin % u32::BITS as usize));
        let level = if on { bit } else { 0 };
        if self.driven[word] & bit == 0 || self.on[word] & bit != level {
            self.driven[word] |= bit;
            self.on[word] = self.on[word] & !bit | level;
            board.output(pin, on);
        }
    }

    /// Lets go of a pin.
    ///
    /// # Panics
    /// If there are not so many pins.
    pub fn release(&mut self, pin: usize, board: &mut dyn Board) {
        self.driven[pin / u32::BITS as usize] &= !(1 << (pin % u32::BITS as usize));
        board.release(pin);
    }
}

impl Default for Outputs {
    fn default() -> Self {
        Self::new()
    }
}
