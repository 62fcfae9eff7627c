//! Timer 2, of 32 bits: it never stops, and interrupts where it is equal to the player's alarm.

use crate::chip::{self, chip, put};
use core::sync::atomic::{AtomicBool, Ordering};
use cortex_m::peripheral::{NVIC, SYST, syst::SystClkSource};
use cortex_m_rt::exception;
use runtime::hardware::{TICK_HZ, Timer, TimerTicks};
use stm32g4::stm32g474::Interrupt;

/// Clocks a tick: with 59 ns the timer wraps in four minutes.
const DIVIDER: u32 = 10;

/// The interrupt of channel 1, in the status word and in that of interrupts.
const ALARM: u32 = 1 << 1;

/// The timer as the player needs it.
#[derive(Clone, Copy, Debug)]
pub struct PlayerTimer;

/// Lets it count.
pub fn start() {
    let (rcc, timer) = (chip().RCC, chip().TIM2);
    rcc.apb1enr1().modify(|_, w| w.tim2en().set_bit());
    put(timer.psc(), DIVIDER - 1);
    put(timer.arr(), u32::MAX);
    // The divider is taken over.
    put(timer.egr(), 1);
    put(timer.sr(), 0);
    put(timer.cr1(), 1);
}

impl Timer for PlayerTimer {
    const HZ: u32 = chip::HZ / DIVIDER;

    #[inline]
    fn now(&self) -> TimerTicks {
        chip().TIM2.cnt().read().bits()
    }

    #[inline]
    fn set_alarm(&mut self, at: Option<TimerTicks>) {
        let timer = chip().TIM2;
        put(timer.dier(), 0);
        put(timer.sr(), !ALARM);
        let Some(at) = at else { return };
        put(timer.ccr1(), at);
        put(timer.dier(), ALARM);
        // It is only equal once.
        if self.now().wrapping_sub(at) as i32 >= 0 {
            NVIC::pend(Interrupt::TIM2);
        }
    }
}

/// The clock has ticked since the main loop asked last.
static TICKED: AtomicBool = AtomicBool::new(false);

/// Lets the clock interrupt come.
pub fn start_clock(clock: &mut SYST) {
    clock.set_clock_source(SystClkSource::Core);
    clock.set_reload(chip::HZ / TICK_HZ - 1);
    clock.clear_current();
    clock.enable_counter();
    clock.enable_interrupt();
}

/// Whether the clock has ticked since this was asked last.
pub fn ticked() -> bool {
    TICKED.swap(false, Ordering::Relaxed)
}

#[exception]
fn SysTick() {
    TICKED.store(true, Ordering::Relaxed);
}
