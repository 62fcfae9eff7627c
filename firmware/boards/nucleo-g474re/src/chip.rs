//! The chip's registers, and its clock (reference manual RM0440).

use cortex_m::peripheral::{NVIC, SCB, scb::SystemHandler};
use stm32g4::stm32g474::{Interrupt, Peripherals};
use stm32g4::{Reg, Resettable, Writable};

/// Clocks a second of the core and of all buses.
pub const HZ: u32 = 170_000_000;

/// The registers. Each part of the board uses its own; where the main loop and an interrupt use the same peripheral,
/// they write different registers, or ones where writing zeros changes nothing.
#[inline]
pub fn chip() -> Peripherals {
    // SAFETY: what can be done with a register is a volatile access; see above for who does which.
    #[allow(unsafe_code)]
    unsafe {
        Peripherals::steal()
    }
}

/// Writes a whole register.
#[inline]
pub fn put<R: Writable + Resettable>(register: &Reg<R>, bits: R::Ux) {
    register.write(|word| {
        // SAFETY: no register of those that are used here can break memory; the DMA controllers are off.
        #[allow(unsafe_code)]
        unsafe {
            word.bits(bits)
        }
    });
}

/// 170 MHz from the internal oscillator of 16 MHz: 16 / 4 · 85 / 2 (RM0440, 7.2.4). The last step is made in two, as
/// the voltage regulator asks for (5.1.5).
pub fn start_clock() {
    let Peripherals { RCC: rcc, PWR: pwr, FLASH: flash, .. } = chip();
    rcc.apb1enr1().modify(|_, w| w.pwren().set_bit());
    // The regulator's boost, and four wait states of the flash, with both caches.
    pwr.cr5().modify(|_, w| w.r1mode().clear_bit());
    put(flash.acr(), 1 << 10 | 1 << 9 | 1 << 8 | 4);
    while flash.acr().read().bits() & 0xF != 4 {}
    const HSI: u32 = 2;
    put(rcc.pllcfgr(), 1 << 24 | 85 << 8 | (4 - 1) << 4 | HSI);
    rcc.cr().modify(|_, w| w.pllon().set_bit());
    while rcc.cr().read().pllrdy().bit_is_clear() {}
    const PLL: u32 = 3;
    const HALF: u32 = 8 << 4;
    put(rcc.cfgr(), HALF | PLL);
    while rcc.cfgr().read().bits() >> 2 & 3 != PLL {}
    // A microsecond at half of the speed.
    cortex_m::asm::delay(HZ / 2 / 1_000_000);
    put(rcc.cfgr(), PLL);
}

/// Priorities, in the upper four bits: the player waits for nothing.
const PLAYER: u8 = 0x00;
const BYTES: u8 = 0x40;
const CLOCK: u8 = 0x80;

/// Lets interrupts happen.
pub fn enable_interrupts(nvic: &mut NVIC, scb: &mut SCB) {
    let all = [(Interrupt::TIM2, PLAYER), (Interrupt::USART1, BYTES), (Interrupt::USART2, BYTES)];
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
