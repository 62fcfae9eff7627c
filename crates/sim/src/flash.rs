//! Flash memory as the chips have it: writing only clears bits, erasing takes pages, both take time, and
//! the power may go away in the middle.
//!
//! The image is shared: it outlives the controller that uses it, as flash outlives the power.

mod image;
mod rows;
#[cfg(test)]
mod tests;

pub use image::{ImageError, image_path};

use devices::flash::{Flash, FlashError, PAGE_BYTES, WORD_BYTES};
use motion::Ticks;
use rand_pcg::{Pcg32, rand_core::Rng as _};
use rows::Rows;
use std::{
    collections::VecDeque,
    ops::Range,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

/// What writing one word takes, in microseconds.
pub const WORD_WRITE_US: u64 = 50;

/// What erasing one page takes, in microseconds.
pub const PAGE_ERASE_US: u64 = 20_000;

/// How many operations can be unfinished at a time; the oldest ones count as finished past that.
pub const MAX_UNFINISHED: usize = 256;

/// A flash memory that several owners hold: the controller, and whoever keeps the image.
#[derive(Clone, Debug)]
pub struct SharedFlash(Arc<Mutex<Memory>>);

#[derive(Debug)]
struct Memory {
    bytes: Rows,
    now: Ticks,
    clock_hz: u32,
    unfinished: VecDeque<Unfinished>,
    operations: u64,
    cut_at: Option<u64>,
    dead: bool,
    random: Pcg32,
}

/// An operation that is still running, with what it overwrites.
#[derive(Debug)]
struct Unfinished {
    starts: Ticks,
    ends: Ticks,
    offset: u32,
    before: Vec<u8>,
}

impl SharedFlash {
    /// An erased memory.
    ///
    /// # Panics
    /// If `capacity` is not a multiple of the page.
    pub fn erased(capacity: u32) -> Self {
        Self::of(Rows::erased(capacity as usize))
    }

    /// A memory with this image.
    ///
    /// # Panics
    /// If its length is not a multiple of the page.
    pub fn from_bytes(bytes: Vec<u8>) -> Self {
        let mut rows = Rows::erased(bytes.len());
        rows.write(0, &bytes);
        Self::of(rows)
    }

    fn of(bytes: Rows) -> Self {
        assert!(bytes.len().is_multiple_of(PAGE_BYTES as usize), "a flash consists of pages");
        assert!(u32::try_from(bytes.len()).is_ok(), "a flash has 32-bit addresses");
        Self(Arc::new(Mutex::new(Memory {
            bytes,
            now: 0,
            clock_hz: 1_000_000,
            unfinished: VecDeque::new(),
            operations: 0,
            cut_at: None,
            dead: false,
            random: Pcg32::new(0, 0),
        })))
    }

    /// A copy of the image as the controller reads it now.
    pub fn to_bytes(&self) -> Vec<u8> {
        let memory = self.memory();
        memory.bytes.copy(0..memory.bytes.len())
    }

    /// Bytes of the memory.
    pub fn len(&self) -> u32 {
        self.memory().bytes.len() as u32
    }

    /// Whether it has no bytes at all.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// What torn operations take their random numbers from.
    pub fn set_seed(&self, seed: u64) {
        self.memory().random = Pcg32::new(seed, 0);
    }

    /// Writes and erases since the image was made.
    pub fn operations(&self) -> u64 {
        self.memory().operations
    }

    /// Takes the power away in the middle of the operation after the next `operations` ones: a part of
    /// its words is done, and everything fails with [`FlashError::PowerLost`] until
    /// [`restore_power`](Self::restore_power).
    pub fn cut_after(&self, operations: u64) {
        let mut memory = self.memory();
        memory.cut_at = Some(memory.operations + operations);
    }

    /// Whether the power is gone.
    pub fn is_cut(&self) -> bool {
        self.memory().dead
    }

    /// The power comes back; what was done stays done.
    pub fn restore_power(&self) {
        let mut memory = self.memory();
        memory.dead = false;
        memory.cut_at = None;
        memory.unfinished.clear();
    }

    /// Takes the power away now. Operations that were waiting never happened, and the one that was
    /// running is torn.
    pub fn cut_now(&self) {
        let mut memory = self.memory();
        let now = memory.now;
        while let Some(operation) = memory.unfinished.pop_back() {
            let words = operation.before.len() / WORD_BYTES as usize;
            let done = if operation.ends <= now {
                words
            } else if operation.starts < now {
                let share = u128::from(now - operation.starts) * words as u128;
                (share / u128::from(operation.ends - operation.starts)) as usize
            } else {
                0
            };
            let done = done * WORD_BYTES as usize;
            let start = operation.offset as usize;
            memory.bytes.write(start + done, &operation.before[done..]);
        }
        memory.dead = true;
    }

    /// Waits for what is running.
    pub fn finish(&self) {
        self.memory().unfinished.clear();
    }

    /// The time goes on to `now`, so that operations finish.
    pub(crate) fn set_time(&self, now: Ticks, clock_hz: u32) {
        let mut memory = self.memory();
        (memory.now, memory.clock_hz) = (now, clock_hz);
        while memory.unfinished.front().is_some_and(|operation| operation.ends <= now) {
            memory.unfinished.pop_front();
            if memory.unfinished.is_empty() {
                // It is short most of the time, and long while a program is stored.
                memory.unfinished = VecDeque::new();
            }
        }
    }

    fn memory(&self) -> MutexGuard<'_, Memory> {
        // The image is bytes: no panic elsewhere can leave it half-made.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Memory {
    fn range(&self, offset: u32, length: usize, unit: u32) -> Result<Range<usize>, FlashError> {
        let start = offset as usize;
        let end = start.checked_add(length).ok_or(FlashError::Range)?;
        let aligned = offset.is_multiple_of(unit) && length.is_multiple_of(unit as usize);
        if self.dead {
            Err(FlashError::PowerLost)
        } else if end > self.bytes.len() || !aligned {
            Err(FlashError::Range)
        } else {
            Ok(start..end)
        }
    }

    /// Counts an operation of `length` bytes and says how many of them happen.
    fn begin(&mut self, length: usize) -> usize {
        self.operations += 1;
        if self.cut_at.is_none_or(|last| self.operations <= last) {
            return length;
        }
        self.dead = true;
        let words = length / WORD_BYTES as usize;
        // Anything from none to all but one word.
        self.random.next_u32() as usize % words.max(1) * WORD_BYTES as usize
    }

    fn keep_for_undo(&mut self, range: Range<usize>, takes_us: u64) {
        let starts = self.unfinished.back().map_or(self.now, |last| last.ends.max(self.now));
        let takes = takes_us * u64::from(self.clock_hz) / 1_000_000;
        if self.unfinished.len() == MAX_UNFINISHED {
            self.unfinished.pop_front();
        }
        let (offset, before) = (range.start as u32, self.bytes.copy(range));
        self.unfinished.push_back(Unfinished { starts, ends: starts + takes, offset, before });
    }
}

impl Flash for SharedFlash {
    fn capacity(&self) -> u32 {
        self.len()
    }

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), FlashError> {
        let memory = self.memory();
        let range = memory.range(offset, bytes.len(), 1)?;
        memory.bytes.read(range.start, bytes);
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), FlashError> {
        let mut memory = self.memory();
        let range = memory.range(offset, bytes.len(), WORD_BYTES)?;
        if !memory.bytes.is_erased(range.clone()) {
            return Err(FlashError::NotErased);
        }
        if bytes.is_empty() {
            return Ok(());
        }
        let done = memory.begin(bytes.len());
        let words = (bytes.len() / WORD_BYTES as usize) as u64;
        memory.keep_for_undo(range.clone(), words * WORD_WRITE_US);
        memory.bytes.write(range.start, &bytes[..done]);
        if memory.dead { Err(FlashError::PowerLost) } else { Ok(()) }
    }

    fn erase(&mut self, from: u32, to: u32) -> Result<(), FlashError> {
        let mut memory = self.memory();
        let length = to.checked_sub(from).ok_or(FlashError::Range)? as usize;
        let range = memory.range(from, length, PAGE_BYTES)?;
        if length == 0 {
            return Ok(());
        }
        let done = memory.begin(length);
        memory.keep_for_undo(range.clone(), (length / PAGE_BYTES as usize) as u64 * PAGE_ERASE_US);
        memory.bytes.erase(range.start..range.start + done);
        if memory.dead { Err(FlashError::PowerLost) } else { Ok(()) }
    }
}
