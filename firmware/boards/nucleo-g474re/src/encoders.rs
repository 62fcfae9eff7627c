//! Encoders, counted by timers 3 and 4 (RM0440, 29.4.20). A PD42-1140's first channel is inside of its motor; here it
//! is what timer 3 counts.

use crate::chip::{chip, put};
use crate::wiring::{ENCODER_FUNCTION, ENCODERS};

/// Both phases count, up and down.
const MODE: u32 = 3;
/// Channels 1 and 2 are inputs of their pins, filtered over eight clocks.
const INPUTS: u32 = 0x3131;

/// Counters of 16 bits, made longer.
pub struct Encoders {
    counts: [i32; 2],
}

impl Encoders {
    /// Lets the timers count.
    pub fn start() -> Self {
        let (rcc, x, y) = (chip().RCC, chip().TIM3, chip().TIM4);
        rcc.apb1enr1().modify(|_, w| {
            w.tim3en().set_bit();
            w.tim4en().set_bit()
        });
        ENCODERS.as_flattened().iter().for_each(|pin| pin.make_alternate(ENCODER_FUNCTION));
        for timer in [&*x, &*y] {
            put(timer.ccmr1_input(), INPUTS);
            put(timer.smcr(), MODE);
            put(timer.cr1(), 1);
        }
        Self { counts: [0; 2] }
    }

    /// The count of a channel; 0 where there is none. Asked more often than half of the timer's range passes.
    pub fn count(&mut self, channel: usize) -> i32 {
        let now = match channel {
            0 => chip().TIM3.cnt().read().bits(),
            1 => chip().TIM4.cnt().read().bits(),
            _ => return 0,
        };
        let count = &mut self.counts[channel];
        *count = count.wrapping_add((now as i16).wrapping_sub(*count as i16).into());
        *count
    }

    /// Asks all of them.
    pub fn look(&mut self) {
        (0..self.counts.len()).for_each(|channel| {
            self.count(channel);
        });
    }
}
