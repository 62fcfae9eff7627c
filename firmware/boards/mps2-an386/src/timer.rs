//! The timers: one never stops and is the time, one runs out when the player is due.

use crate::registers::{TIMER0, TIMER1};
use crate::vectors::Interrupt;
use core::sync::atomic::{AtomicU32, Ordering};
use cortex_m::peripheral::NVIC;
use runtime::hardware::{Timer, TimerTicks};
use tock_registers::interfaces::{Readable, Writeable};

/// The board's clock, which all timers count.
pub const HZ: u32 = 25_000_000;

/// Bits of the timers' control words.
const COUNTS: u32 = 1;
const INTERRUPTS: u32 = 1 << 3;

/// [`extended`] keeps the time in units of so many bits of ticks, so that it fits a word.
const COARSE_BITS: u32 = 16;

/// The time as [`note`] has seen it last, in units of 2^[`COARSE_BITS`] ticks.
static COARSE: AtomicU32 = AtomicU32::new(0);

/// The timers as the player needs them.
#[derive(Clone, Copy, Debug)]
pub struct PlayerTimer;

/// Lets both count.
pub fn start() {
    TIMER1.reload.set(u32::MAX);
    TIMER1.value.set(u32::MAX);
    TIMER1.control.set(COUNTS);
    // Without a reload it stops at 0; the first alarm is the player's, which finds nothing to do.
    TIMER0.reload.set(0);
    TIMER0.value.set(1);
    TIMER0.control.set(COUNTS | INTERRUPTS);
}

impl Timer for PlayerTimer {
    const HZ: u32 = HZ;

    #[inline]
    fn now(&self) -> TimerTicks {
        !TIMER1.value.get()
    }

    #[inline]
    fn set_alarm(&mut self, at: Option<TimerTicks>) {
        TIMER0.interrupt.set(1);
        let Some(at) = at else { return TIMER0.value.set(0) };
        let left = at.wrapping_sub(self.now());
        if left.wrapping_sub(1) < i32::MAX as u32 {
            TIMER0.value.set(left);
        } else {
            NVIC::pend(Interrupt::TIMER0);
        }
    }
}

/// Notes the time, often enough that no half of the timer's range passes in between. From the main loop.
pub fn note() {
    let coarse = COARSE.load(Ordering::Relaxed);
    let now = PlayerTimer.now() >> COARSE_BITS;
    let passed = now.wrapping_sub(coarse) & (u32::MAX >> COARSE_BITS);
    COARSE.store(coarse.wrapping_add(passed), Ordering::Relaxed);
}

/// A moment near now, in ticks since the start.
pub fn extended(ticks: TimerTicks) -> u64 {
    let near = u64::from(COARSE.load(Ordering::Relaxed)) << COARSE_BITS;
    near.wrapping_add_signed(i64::from(ticks.wrapping_sub(near as u32) as i32))
}
