//! The PSRAM as flash memory, with the pace and the page of an STM32G4's (data sheet DS12288, 5.3.10): erasing sets
//! all bits and takes its time, writing clears bits of words that are erased.

use crate::registers::{Block, FLASH, FLASH_BYTES, Words};
use crate::timer::{HZ, PlayerTimer};
use crate::watchdog;
use devices::flash::{PAGE_BYTES, WORD_BYTES};
use embedded_storage::nor_flash::{
    ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash, check_erase, check_read, check_write,
};
use runtime::hardware::Timer;
use tock_registers::interfaces::{Readable, Writeable};
use tock_registers::registers::ReadWrite;

/// Erasing a page, in ticks: 22 ms for 2 KiB.
const ERASE_TICKS: u32 = HZ / 1000 * 44;

/// Writing a word of 8 bytes, in ticks: 82 µs.
const WRITE_TICKS: u32 = HZ / 1_000_000 * 82;

/// Bytes of the words that the memory is made of.
const CELL_BYTES: u32 = 4;

/// A part of the memory.
pub struct Nor {
    memory: Block<Words<{ FLASH_BYTES / 4 }>>,
    from: u32,
    bytes: u32,
}

/// Why an operation did not happen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NorError {
    /// The range is outside or not aligned.
    Range(NorFlashErrorKind),
    /// A word was not erased.
    NotErased,
}

impl NorFlashError for NorError {
    fn kind(&self) -> NorFlashErrorKind {
        match self {
            Self::Range(kind) => *kind,
            Self::NotErased => NorFlashErrorKind::Other,
        }
    }
}

impl From<NorFlashErrorKind> for NorError {
    fn from(kind: NorFlashErrorKind) -> Self {
        Self::Range(kind)
    }
}

impl Nor {
    /// The pages for settings.
    pub const fn settings(bytes: u32) -> Self {
        Self::part(0, bytes)
    }

    /// The page behind the settings, for the cause of a stop.
    pub const fn causes(settings_bytes: u32) -> Self {
        Self::part(settings_bytes, PAGE_BYTES)
    }

    const fn part(from: u32, bytes: u32) -> Self {
        assert!(from + bytes <= FLASH_BYTES as u32, "the flash is too small");
        Self { memory: FLASH, from, bytes }
    }

    /// As it comes from the factory.
    pub fn make_new(&mut self) {
        self.cells(0, self.bytes).iter().for_each(|cell| cell.set(u32::MAX));
    }

    fn cells(&self, offset: u32, bytes: u32) -> &[ReadWrite<u32>] {
        let first = ((self.from + offset) / CELL_BYTES) as usize;
        &self.memory[first..first + (bytes / CELL_BYTES) as usize]
    }
}

/// Waits for the flash.
fn wait(ticks: u32) {
    let start = PlayerTimer.now();
    while PlayerTimer.now().wrapping_sub(start) < ticks {
        // QEMU is much slower at reading a timer than at counting.
        cortex_m::asm::delay(100);
    }
    // An erasure of many pages takes longer than the watchdog waits. Each has its end.
    watchdog::feed();
}

impl ErrorType for Nor {
    type Error = NorError;
}

impl ReadNorFlash for Nor {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), NorError> {
        check_read(self, offset, bytes.len())?;
        for (byte, place) in bytes.iter_mut().zip(offset..) {
            let cell = self.cells(place / CELL_BYTES * CELL_BYTES, CELL_BYTES)[0].get();
            *byte = cell.to_le_bytes()[(place % CELL_BYTES) as usize];
        }
        Ok(())
    }

    fn capacity(&self) -> usize {
        self.bytes as usize
    }
}

impl NorFlash for Nor {
    const WRITE_SIZE: usize = WORD_BYTES as usize;
    const ERASE_SIZE: usize = PAGE_BYTES as usize;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), NorError> {
        check_erase(self, from, to)?;
        for page in (from..to).step_by(Self::ERASE_SIZE) {
            self.cells(page, PAGE_BYTES).iter().for_each(|cell| cell.set(u32::MAX));
            wait(ERASE_TICKS);
        }
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), NorError> {
        check_write(self, offset, bytes.len())?;
        for (word, place) in bytes.chunks_exact(Self::WRITE_SIZE).zip((offset..).step_by(Self::WRITE_SIZE)) {
            let cells = self.cells(place, WORD_BYTES);
            if cells.iter().any(|cell| cell.get() != u32::MAX) {
                return Err(NorError::NotErased);
            }
            for (cell, bytes) in cells.iter().zip(word.chunks_exact(CELL_BYTES as usize)) {
                cell.set(u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]));
            }
            wait(WRITE_TICKS);
        }
        Ok(())
    }
}
