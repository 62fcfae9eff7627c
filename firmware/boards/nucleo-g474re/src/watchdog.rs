//! The independent watchdog, with a clock of its own: it resets the chip when it was not fed for a second.

use crate::chip::{chip, put};

/// Words for its key register.
const START: u16 = 0xCCCC;
const OPEN: u16 = 0x5555;
const FEED: u16 = 0xAAAA;

/// 32 kHz are divided by 32.
const DIVIDER: u16 = 3;
const PATIENCE_MS: u16 = 1000;

/// Starts it, and gives whether it was what reset the chip.
pub fn start() -> bool {
    let (rcc, dog) = (chip().RCC, chip().IWDG);
    let barked = rcc.csr().read().iwdgrstf().bit_is_set();
    rcc.csr().modify(|_, w| w.rmvf().set_bit());
    put(dog.kr(), START);
    put(dog.kr(), OPEN);
    put(dog.pr(), DIVIDER);
    put(dog.rlr(), PATIENCE_MS);
    while dog.sr().read().bits() != 0 {}
    feed();
    barked
}

/// Feeds it.
#[inline]
pub fn feed() {
    put(chip().IWDG.kr(), FEED);
}
