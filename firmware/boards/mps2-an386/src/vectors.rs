//! The vectors of the interrupts that are used, by their numbers (application note AN386, 3.8).

use cortex_m::interrupt::InterruptNumber;
use cortex_m::peripheral::scb::SystemHandler;
use cortex_m::peripheral::{NVIC, SCB};

/// Interrupts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u16)]
pub enum Interrupt {
    /// A byte has come at UART 0.
    UART0RX = 0,
    /// A byte has come at UART 1.
    UART1RX = 2,
    /// The player's timer has run out.
    TIMER0 = 8,
}

/// How many vectors there are, those of interrupts that are not used among them.
const VECTORS: usize = 32;

/// Priorities: the lower number goes first. The player waits for nothing.
const PLAYER: u8 = 0x00;
const BYTES: u8 = 0x40;
const CLOCK: u8 = 0x80;

// SAFETY: every number is one of the chip's and below `VECTORS`.
#[allow(unsafe_code)]
unsafe impl InterruptNumber for Interrupt {
    fn number(self) -> u16 {
        self as u16
    }
}

#[allow(unsafe_code)]
// SAFETY: the image defines them with cortex-m-rt's attribute, or `device.x` says what they are.
unsafe extern "C" {
    fn UART0RX();
    fn UART1RX();
    fn TIMER0();
}

/// The table that cortex-m-rt puts behind the vectors of the core.
#[allow(unsafe_code)]
// SAFETY: section and name are those that cortex-m-rt asks for.
#[unsafe(link_section = ".vector_table.interrupts")]
#[unsafe(no_mangle)]
#[used]
pub static __INTERRUPTS: [Option<unsafe extern "C" fn()>; VECTORS] = {
    let mut table: [Option<unsafe extern "C" fn()>; VECTORS] = [None; VECTORS];
    table[Interrupt::UART0RX as usize] = Some(UART0RX);
    table[Interrupt::UART1RX as usize] = Some(UART1RX);
    table[Interrupt::TIMER0 as usize] = Some(TIMER0);
    table
};

/// Lets interrupts happen, by their priorities.
pub fn enable(nvic: &mut NVIC, scb: &mut SCB) {
    let all = [(Interrupt::TIMER0, PLAYER), (Interrupt::UART0RX, BYTES), (Interrupt::UART1RX, BYTES)];
    for (interrupt, priority) in all {
        // SAFETY: no critical section of ours is made of priorities; they mask all interrupts.
        #[allow(unsafe_code)]
        unsafe {
            nvic.set_priority(interrupt, priority);
            NVIC::unmask(interrupt);
        }
    }
    // SAFETY: as above.
    #[allow(unsafe_code)]
    unsafe {
        scb.set_priority(SystemHandler::SysTick, CLOCK);
    }
}
