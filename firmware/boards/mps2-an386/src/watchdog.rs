//! The watchdog: it stops the motors when it was not fed for half a second, and resets the board half a second later.

use crate::registers::{RESET_NOTE, WATCHDOG};
use crate::timer::HZ;
use cortex_m_rt::exception;
use tock_registers::interfaces::{Readable, Writeable};

/// Clocks until it stops the motors; as many again until it resets.
const PATIENCE: u32 = HZ / 2;

/// Opens the other registers.
const KEY: u32 = 0x1ACC_E551;

/// Bits of the control word.
const INTERRUPTS: u32 = 1;
const RESETS: u32 = 1 << 1;

/// [`RESET_NOTE`] when the watchdog resets the board.
const BARKED: u32 = 0x6F6F_6621;

/// Starts it, and gives whether it was what reset the board.
pub fn start() -> bool {
    let barked = RESET_NOTE.get() == BARKED;
    RESET_NOTE.set(0);
    WATCHDOG.lock.set(KEY);
    WATCHDOG.load.set(PATIENCE);
    WATCHDOG.control.set(INTERRUPTS | RESETS);
    barked
}

/// Feeds it.
#[inline]
pub fn feed() {
    WATCHDOG.feed.set(1);
}

/// The first time it runs out; nothing is lower than this, so that the second time comes.
#[exception]
#[allow(unsafe_code)]
// SAFETY: what it touches are registers and memory of volatile words.
unsafe fn NonMaskableInt() -> ! {
    RESET_NOTE.set(BARKED);
    crate::bench::stop();
    loop {
        cortex_m::asm::nop();
    }
}
