//! Flash pages of a chip as the memory in which a controller keeps its settings.

use devices::flash::{Flash, FlashError, PAGE_BYTES, WORD_BYTES};
use embedded_storage::nor_flash::{NorFlash, NorFlashError, NorFlashErrorKind};

/// Some pages of a flash memory. Its words and its pages may be smaller than a controller's.
#[derive(Debug)]
pub struct Pages<F> {
    flash: F,
    first: u32,
    bytes: u32,
}

impl<F: NorFlash> Pages<F> {
    /// So many bytes of a flash memory, from `first` on. The memory refuses what it does not have.
    ///
    /// # Panics
    /// If they are not whole pages of the memory.
    pub const fn new(flash: F, first: u32, bytes: u32) -> Self {
        const {
            assert!(F::READ_SIZE == 1, "bytes are read one by one");
            assert!((WORD_BYTES as usize).is_multiple_of(F::WRITE_SIZE), "words do not divide ours");
            assert!((PAGE_BYTES as usize).is_multiple_of(F::ERASE_SIZE), "pages do not divide ours");
        }
        let whole = first.is_multiple_of(F::ERASE_SIZE as u32) && bytes.is_multiple_of(PAGE_BYTES);
        assert!(whole && first.checked_add(bytes).is_some(), "there are no such pages");
        Self { flash, first, bytes }
    }

    /// The place of so many bytes in the memory, if they are ours.
    fn place(&self, offset: u32, bytes: usize) -> Result<u32, FlashError> {
        let room = self.bytes.checked_sub(offset).ok_or(FlashError::Range)?;
        if bytes > room as usize { Err(FlashError::Range) } else { Ok(self.first + offset) }
    }
}

impl<F: NorFlash> Flash for Pages<F> {
    fn capacity(&self) -> u32 {
        self.bytes
    }

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), FlashError> {
        let place = self.place(offset, bytes.len())?;
        self.flash.read(place, bytes).map_err(failure)
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), FlashError> {
        if !offset.is_multiple_of(WORD_BYTES) || !bytes.len().is_multiple_of(WORD_BYTES as usize) {
            return Err(FlashError::Range);
        }
        let place = self.place(offset, bytes.len())?;
        self.flash.write(place, bytes).map_err(failure)
    }

    fn erase(&mut self, from: u32, to: u32) -> Result<(), FlashError> {
        let bytes = to.checked_sub(from).ok_or(FlashError::Range)?;
        if !from.is_multiple_of(PAGE_BYTES) || !to.is_multiple_of(PAGE_BYTES) {
            return Err(FlashError::Range);
        }
        let place = self.place(from, bytes as usize)?;
        self.flash.erase(place, place + bytes).map_err(failure)
    }
}

/// A place that is right and does not take a word was not erased.
fn failure(error: impl NorFlashError) -> FlashError {
    match error.kind() {
        NorFlashErrorKind::NotAligned | NorFlashErrorKind::OutOfBounds => FlashError::Range,
        _ => FlashError::NotErased,
    }
}
