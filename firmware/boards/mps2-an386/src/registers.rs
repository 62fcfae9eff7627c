//! The registers of the board, and memory that others look at (application note AN386, 3 and 4; Cortex-M System
//! Design Kit, 4).
//!
//! A block is a place in memory with a type; that is all that is unsafe about it. What a register means is said
//! where it is used.

use crate::bench::page::Page;
use core::{marker::PhantomData, ops::Deref};
use tock_registers::register_structs;
use tock_registers::registers::{ReadOnly, ReadWrite, WriteOnly};

/// A block of registers at an address that never changes. All access is volatile, so that copies may be used
/// from the main loop and from interrupts alike.
pub struct Block<T> {
    address: usize,
    registers: PhantomData<fn() -> T>,
}

impl<T> Block<T> {
    /// Only in this file, where all addresses are.
    const fn at(address: usize) -> Self {
        Self { address, registers: PhantomData }
    }
}

impl<T> Clone for Block<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Block<T> {}

impl<T> Deref for Block<T> {
    type Target = T;

    #[inline]
    fn deref(&self) -> &T {
        // SAFETY: every block below is aligned, there for good, large enough for its type and used by nothing
        // else; its type has cells only, which are read and written with volatile accesses.
        #[allow(unsafe_code)]
        unsafe {
            &*(self.address as *const T)
        }
    }
}

register_structs! {
    /// A serial port.
    pub Uart {
        (0x00 => pub data: ReadWrite<u32>),
        /// Bit 0: nothing more can be sent now; bit 1: a byte is there.
        (0x04 => pub state: ReadWrite<u32>),
        /// Bits 0 and 1: sends, receives; bits 2 and 3: their interrupts.
        (0x08 => pub control: ReadWrite<u32>),
        /// Written ones clear interrupts: bit 0 sent, bit 1 received.
        (0x0C => pub interrupts: ReadWrite<u32>),
        /// Clocks a bit.
        (0x10 => pub divider: ReadWrite<u32>),
        (0x14 => @END),
    },

    /// A timer that counts down to 0.
    pub Timer {
        /// Bit 0: counts; bit 3: interrupts.
        (0x00 => pub control: ReadWrite<u32>),
        (0x04 => pub value: ReadWrite<u32>),
        /// Where it goes on after 0; 0: nowhere.
        (0x08 => pub reload: ReadWrite<u32>),
        /// A written 1 clears the interrupt.
        (0x0C => pub interrupt: ReadWrite<u32>),
        (0x10 => @END),
    },

    /// The watchdog.
    pub Watchdog {
        (0x000 => pub load: ReadWrite<u32>),
        (0x004 => pub value: ReadOnly<u32>),
        /// Bit 0: counts and interrupts; bit 1: resets the second time.
        (0x008 => pub control: ReadWrite<u32>),
        /// Written: the interrupt is cleared, the count starts anew.
        (0x00C => pub feed: WriteOnly<u32>),
        (0x010 => _reserved),
        /// Writing the key here lets the others be written.
        (0xC00 => pub lock: WriteOnly<u32>),
        (0xC04 => @END),
    }
}

/// Words of memory.
pub type Words<const N: usize> = [ReadWrite<u32>; N];

/// Bytes of PSRAM that stand for flash memory.
pub const FLASH_BYTES: usize = 0x10_0000;

/// The player's timer.
pub const TIMER0: Block<Timer> = Block::at(0x4000_0000);
/// The timer that never stops.
pub const TIMER1: Block<Timer> = Block::at(0x4000_1000);
/// Serial port 0.
pub const UART0: Block<Uart> = Block::at(0x4000_4000);
/// Serial port 1.
pub const UART1: Block<Uart> = Block::at(0x4000_5000);
/// Serial port 2.
pub const UART2: Block<Uart> = Block::at(0x4000_6000);
/// The watchdog.
pub const WATCHDOG: Block<Watchdog> = Block::at(0x4000_8000);
/// The last word of the SRAM, which the linker does not know: it outlives a reset, but not a power cut.
pub const RESET_NOTE: Block<ReadWrite<u32>> = Block::at(0x203F_FFFC);
/// The beginning of the PSRAM: what stands for flash memory.
pub const FLASH: Block<Words<{ FLASH_BYTES / 4 }>> = Block::at(0x2100_0000);
/// The bench page.
pub const PAGE: Block<Page> = Block::at(0x2110_0000);
/// Where nothing is: an access is a bus fault.
pub const NOWHERE: Block<ReadWrite<u32>> = Block::at(0x3000_0000);
