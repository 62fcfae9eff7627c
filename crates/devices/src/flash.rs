//! The flash memory that settings and programs live in, as a board offers it.
//!
//! Plain and object-safe: an image in memory, a file and a microcontroller's flash pages are the same to
//! a controller, which puts a power-safe store of settings on top.

/// Bytes of the smallest unit that can be written, once after an erase; writes start and end on multiples of it.
/// Flash of common chips has words of 8 bytes or parts of that.
pub const WORD_BYTES: u32 = 8;

/// Bytes of the smallest unit that can be erased. Erasing sets every bit; writing only clears bits.
pub const PAGE_BYTES: u32 = 4096;

/// Why a flash operation did not happen, or not to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FlashError {
    /// The address range is outside the memory or not aligned.
    Range,
    /// The memory lost its supply; part of the operation may have happened.
    PowerLost,
    /// A word was written that was not erased.
    NotErased,
}

/// Flash memory with erase pages of [`PAGE_BYTES`] and words of [`WORD_BYTES`].
pub trait Flash {
    /// Size in bytes, a multiple of [`PAGE_BYTES`].
    fn capacity(&self) -> u32;

    /// Fills `bytes` from `offset`.
    ///
    /// # Errors
    /// [`FlashError::Range`] and [`FlashError::PowerLost`].
    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), FlashError>;

    /// Writes `bytes` to erased words at `offset`.
    ///
    /// # Errors
    /// All of [`FlashError`].
    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), FlashError>;

    /// Erases the pages from `from` up to, not including, `to`.
    ///
    /// # Errors
    /// [`FlashError::Range`] and [`FlashError::PowerLost`].
    fn erase(&mut self, from: u32, to: u32) -> Result<(), FlashError>;
}

#[cfg(feature = "std")]
impl<F: Flash + ?Sized> Flash for alloc::boxed::Box<F> {
    fn capacity(&self) -> u32 {
        (**self).capacity()
    }

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), FlashError> {
        (**self).read(offset, bytes)
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), FlashError> {
        (**self).write(offset, bytes)
    }

    fn erase(&mut self, from: u32, to: u32) -> Result<(), FlashError> {
        (**self).erase(from, to)
    }
}
