//! The clock interrupt, and sleeping until one of the board's interrupts.

use crate::registers::PAGE;
use crate::timer::HZ;
use core::sync::atomic::{AtomicBool, Ordering};
use cortex_m::peripheral::{SYST, syst::SystClkSource};
use cortex_m_rt::exception;
use runtime::hardware::TICK_HZ;
use tock_registers::interfaces::Readable;

/// There has been an interrupt since the main loop slept last.
static AWAKE: AtomicBool = AtomicBool::new(false);

/// The clock has ticked since the main loop asked last.
static TICKED: AtomicBool = AtomicBool::new(false);

/// Lets the clock interrupt come.
pub fn start(clock: &mut SYST) {
    clock.set_clock_source(SystClkSource::Core);
    clock.set_reload(HZ / TICK_HZ - 1);
    clock.clear_current();
    clock.enable_counter();
    clock.enable_interrupt();
}

/// The main loop has something to look at.
#[inline]
pub fn wake() {
    AWAKE.store(true, Ordering::Relaxed);
}

/// Whether the clock has ticked since this was asked last.
pub fn ticked() -> bool {
    TICKED.swap(false, Ordering::Relaxed)
}

/// Sleeps until an interrupt, unless there has been one since the last time. (WFE would be that in one; QEMU does
/// not sleep then.)
pub fn rest() {
    while PAGE.spin.get() != 0 {
        if AWAKE.swap(false, Ordering::Relaxed) {
            return;
        }
    }
    cortex_m::interrupt::free(|_| {
        if !AWAKE.swap(false, Ordering::Relaxed) {
            cortex_m::asm::wfi();
        }
    });
}

#[exception]
fn SysTick() {
    TICKED.store(true, Ordering::Relaxed);
    wake();
}
