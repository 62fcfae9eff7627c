//! Flash of a chip in memory, with its own sizes of words and pages. The power can be cut in the middle.

use embedded_storage::nor_flash::{
    ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash, check_erase, check_read, check_write,
};

/// A flash memory with words of `WORD` bytes and pages of `PAGE`.
#[derive(Clone, Debug)]
pub struct Memory<const WORD: usize, const PAGE: usize> {
    pub bytes: Vec<u8>,
    /// Words that are still written and pages that are still erased before the power goes.
    pub left: usize,
    /// What the first bytes of the word or page then become; the others are as they were.
    pub torn: Option<u8>,
}

/// Why it did not do something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    Kind(NorFlashErrorKind),
    PowerLost,
    NotErased,
}

impl NorFlashError for Refusal {
    fn kind(&self) -> NorFlashErrorKind {
        match self {
            Self::Kind(kind) => *kind,
            _ => NorFlashErrorKind::Other,
        }
    }
}

impl<const WORD: usize, const PAGE: usize> Memory<WORD, PAGE> {
    pub fn new(bytes: u32) -> Self {
        Self { bytes: vec![0xFF; bytes as usize], left: usize::MAX, torn: None }
    }

    /// Does one operation on some bytes; the last one before the power goes breaks off in the middle.
    fn work(&mut self, place: usize, count: usize, change: impl Fn(&mut [u8])) -> Result<(), Refusal> {
        let bytes = &mut self.bytes[place..place + count];
        match self.left.checked_sub(1) {
            Some(left) => {
                self.left = left;
                change(bytes);
                Ok(())
            }
            None => {
                if let Some(torn) = self.torn.take() {
                    bytes[..count / 2].iter_mut().for_each(|byte| *byte &= torn);
                }
                Err(Refusal::PowerLost)
            }
        }
    }
}

impl<const WORD: usize, const PAGE: usize> ErrorType for Memory<WORD, PAGE> {
    type Error = Refusal;
}

impl<const WORD: usize, const PAGE: usize> ReadNorFlash for Memory<WORD, PAGE> {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Refusal> {
        check_read(self, offset, bytes.len()).map_err(Refusal::Kind)?;
        bytes.copy_from_slice(&self.bytes[offset as usize..][..bytes.len()]);
        Ok(())
    }

    fn capacity(&self) -> usize {
        self.bytes.len()
    }
}

impl<const WORD: usize, const PAGE: usize> NorFlash for Memory<WORD, PAGE> {
    const WRITE_SIZE: usize = WORD;
    const ERASE_SIZE: usize = PAGE;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), Refusal> {
        check_erase(self, from, to).map_err(Refusal::Kind)?;
        for page in (from as usize..to as usize).step_by(PAGE) {
            self.work(page, PAGE, |bytes| bytes.fill(0xFF))?;
        }
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Refusal> {
        check_write(self, offset, bytes.len()).map_err(Refusal::Kind)?;
        for (place, word) in (offset as usize..).step_by(WORD).zip(bytes.chunks(WORD)) {
            if self.bytes[place..place + WORD].iter().any(|byte| *byte != 0xFF) {
                return Err(Refusal::NotErased);
            }
            self.work(place, WORD, |bytes| bytes.copy_from_slice(word))?;
        }
        Ok(())
    }
}
