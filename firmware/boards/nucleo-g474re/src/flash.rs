//! Flash memory (RM0440, 3.3): the second bank for settings, so that the program goes on while it is written, and the
//! last pages of the first for the cause of a stop.

use crate::chip::{chip, put};
use crate::watchdog;
use devices::flash::PAGE_BYTES;
use embedded_storage::nor_flash::{
    ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash, check_erase, check_read, check_write,
};

/// Where the flash is, and each bank's bytes.
const START: u32 = 0x0800_0000;
const BANK_BYTES: u32 = 256 * 1024;

/// Bits of the control word.
const PROGRAM: u32 = 1;
const ERASE: u32 = 1 << 1;
const PAGE: u32 = 3;
const SECOND_BANK: u32 = 1 << 11;
const BEGIN: u32 = 1 << 16;
const LOCK: u32 = 1 << 31;

/// What opens it.
const KEYS: [u32; 2] = [0x4567_0123, 0xCDEF_89AB];

/// Bits of the status word.
const BUSY: u32 = 1 << 16;
const ERRORS: u32 = 0xC3FA;

/// The data cache, in the access control word: on, and emptied.
const CACHE: u32 = 1 << 10;
const CACHE_EMPTIED: u32 = 1 << 12;

/// A part of the memory.
pub struct Nor {
    /// From the start of the flash.
    from: u32,
    bytes: u32,
}

/// Why an operation did not happen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NorError {
    /// The range is outside or not aligned.
    Range(NorFlashErrorKind),
    /// The chip refused; the errors of its status word.
    Refused(u32),
}

impl NorFlashError for NorError {
    fn kind(&self) -> NorFlashErrorKind {
        match self {
            Self::Range(kind) => *kind,
            Self::Refused(_) => NorFlashErrorKind::Other,
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
        assert!(bytes <= BANK_BYTES, "the bank is too small");
        Self { from: BANK_BYTES, bytes }
    }

    /// The pages for the cause of a stop, which the linker leaves free.
    pub const fn causes() -> Self {
        Self { from: BANK_BYTES - PAGE_BYTES, bytes: PAGE_BYTES }
    }

    fn address(&self, offset: u32) -> u32 {
        START + self.from + offset
    }
}

/// Runs an operation between opening the flash and locking it.
fn operate(control: u32, operation: impl FnOnce()) -> Result<(), NorError> {
    let flash = chip().FLASH;
    while flash.sr().read().bits() & BUSY != 0 {}
    put(flash.sr(), ERRORS);
    if flash.cr().read().bits() & LOCK != 0 {
        KEYS.into_iter().for_each(|key| put(flash.keyr(), key));
    }
    put(flash.cr(), control);
    operation();
    while flash.sr().read().bits() & BUSY != 0 {}
    let errors = flash.sr().read().bits() & ERRORS;
    put(flash.cr(), LOCK);
    // A long row of operations has its end; each of them takes 25 ms at most.
    watchdog::feed();
    if errors == 0 { Ok(()) } else { Err(NorError::Refused(errors)) }
}

impl ErrorType for Nor {
    type Error = NorError;
}

impl ReadNorFlash for Nor {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), NorError> {
        check_read(self, offset, bytes.len())?;
        for (byte, place) in bytes.iter_mut().zip(self.address(offset)..) {
            // SAFETY: inside the flash, which is memory; volatile, since it changes by itself.
            #[allow(unsafe_code)]
            unsafe {
                *byte = (place as *const u8).read_volatile();
            }
        }
        Ok(())
    }

    fn capacity(&self) -> usize {
        self.bytes as usize
    }
}

impl NorFlash for Nor {
    const WRITE_SIZE: usize = 8;
    const ERASE_SIZE: usize = 2048;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), NorError> {
        check_erase(self, from, to)?;
        let flash = chip().FLASH;
        for offset in (from..to).step_by(Self::ERASE_SIZE) {
            let place = self.from + offset;
            let bank = if place < BANK_BYTES { 0 } else { SECOND_BANK };
            let page = place % BANK_BYTES / Self::ERASE_SIZE as u32;
            let control = ERASE | page << PAGE | bank;
            operate(control, || put(flash.cr(), control | BEGIN))?;
        }
        // What was there may still be in the cache.
        let control = flash.acr().read().bits() & !CACHE;
        put(flash.acr(), control);
        put(flash.acr(), control | CACHE_EMPTIED);
        put(flash.acr(), control | CACHE);
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), NorError> {
        check_write(self, offset, bytes.len())?;
        let places = (self.address(offset)..).step_by(Self::WRITE_SIZE);
        for (word, place) in bytes.chunks_exact(Self::WRITE_SIZE).zip(places) {
            let [a, b, c, d, e, f, g, h] = *word else { continue };
            let halves = [u32::from_le_bytes([a, b, c, d]), u32::from_le_bytes([e, f, g, h])];
            operate(PROGRAM, || {
                for (half, at) in halves.into_iter().zip((place..).step_by(4)) {
                    // SAFETY: inside this part of the flash, where no code or constant is, and aligned; the chip
                    // refuses what is not erased.
                    #[allow(unsafe_code)]
                    unsafe {
                        (at as *mut u32).write_volatile(half);
                    }
                }
            })?;
        }
        Ok(())
    }
}
