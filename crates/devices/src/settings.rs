//! The store of settings: numbered records in flash that survive a power cut at any operation.
//!
//! `sequential-storage` does the work: records are appended and never overwritten, so that a torn write
//! leaves the old one. What this adds are generations: forgetting all records of a kind is one record
//! too, the number of a new generation, and therefore either has happened or has not.

use crate::flash::{Flash, FlashError, PAGE_BYTES, WORD_BYTES};
use core::future::Future;
use core::pin::pin;
use core::task::{Context, Poll, Waker};
use embedded_storage_async::nor_flash::{
    ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash,
};
use heapless::Vec;
use sequential_storage::cache::{Cache, Uncached};
use sequential_storage::map::{MapConfig, MapStorage};

/// The longest value of a record, in bytes.
pub const MAX_VALUE_BYTES: usize = 96;

/// Bytes of a generation number in front of each value.
const GENERATION_BYTES: usize = 4;

/// Room for a key, a generation and a value, in whole words.
const BUFFER_BYTES: usize = 2 + GENERATION_BYTES + MAX_VALUE_BYTES + 2;

/// What a record is about. Kinds are forgotten together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A setting.
    Setting,
    /// A word of a program.
    Program,
}

/// The number of a record inside its kind: below 2¹⁵.
pub type Number = u16;

/// Programs have the upper half of the keys.
const PROGRAM_KEYS: u16 = 0x8000;

/// Records of a generation that was written as a whole have this bit when the generation is odd: those
/// of the one before stay readable until the new one holds.
const ODD: Number = 0x4000;

/// Where the generation of a kind is kept: the last number of its half.
const GENERATION_KEY: u16 = 0x7FFF;

impl Kind {
    const fn key(self, number: Number) -> u16 {
        match self {
            Self::Setting => number,
            Self::Program => PROGRAM_KEYS | number,
        }
    }

    const fn of(key: u16) -> (Self, Number) {
        if key & PROGRAM_KEYS == 0 { (Self::Setting, key) } else { (Self::Program, key & !PROGRAM_KEYS) }
    }
}

/// Why a record is not in flash.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StoreError {
    /// The flash lost its supply.
    PowerLost,
    /// Nothing more fits.
    Full,
    /// The flash does not behave as flash does.
    Broken,
}

type Storage<'a, F> = MapStorage<u16, &'a mut Adapter<F>, Cache<Uncached, Uncached, Uncached, u16>>;

/// The store.
pub struct Settings<F: Flash> {
    flash: Adapter<F>,
    /// It was read, and can be written.
    open: bool,
    /// The generation of each kind that counts.
    generations: [u32; 2],
    /// The newest one that any record has.
    newest: [u32; 2],
}

impl<F: Flash> Settings<F> {
    /// The store in a flash memory, which has to be [opened](Self::open).
    pub const fn new(flash: F) -> Self {
        Self { flash: Adapter(flash), open: false, generations: [0; 2], newest: [0; 2] }
    }

    /// Reads the flash memory, at power-up or again, and hands over every record, the newest of a number last.
    /// Memory that holds anything else is erased. A store that could not be opened cannot be written.
    ///
    /// # Errors
    /// [`StoreError::PowerLost`] and [`StoreError::Broken`].
    ///
    /// # Panics
    /// If the flash has less than two pages.
    pub fn open(&mut self, mut record: impl FnMut(Kind, Number, &[u8])) -> Result<(), StoreError> {
        (self.open, self.generations, self.newest) = (false, [0; 2], [0; 2]);
        if self.find_generations().is_err_and(|error| error != StoreError::PowerLost) {
            at_once(self.storage().erase_all()).map_err(store_error)?;
        }
        let generations = self.generations;
        self.each(|key, generation, value| {
            let (kind, number) = Kind::of(key);
            if number != GENERATION_KEY && generation == generations[kind as usize] {
                record(kind, number & !ODD, value);
            }
        })?;
        self.open = true;
        Ok(())
    }

    /// Whether the flash memory was read.
    pub const fn is_open(&self) -> bool {
        self.open
    }

    fn storage(&mut self) -> Storage<'_, F> {
        let config = MapConfig::new(0..self.flash.0.capacity());
        MapStorage::new(&mut self.flash, config, Cache::new_uncached())
    }

    /// Stores a record. When this returns, the new value is what the next start finds; if it fails, the
    /// next start finds the new value or the old one.
    ///
    /// # Errors
    /// All of [`StoreError`]; [`StoreError::PowerLost`] also if the store is not open.
    ///
    /// # Panics
    /// If the value is longer than [`MAX_VALUE_BYTES`] or the number is not below 2¹⁵ − 1.
    pub fn store(&mut self, kind: Kind, number: Number, value: &[u8]) -> Result<(), StoreError> {
        assert!(number < GENERATION_KEY, "record number out of range");
        let mut record = Vec::<u8, { GENERATION_BYTES + MAX_VALUE_BYTES }>::new();
        let generation = self.generations[kind as usize].to_le_bytes();
        let fits = record.extend_from_slice(&generation).and_then(|()| record.extend_from_slice(value));
        assert!(fits.is_ok(), "record too long");
        self.write(kind.key(number), &record)
    }

    /// Forgets all records of a kind, in one step.
    ///
    /// # Errors
    /// All of [`StoreError`].
    pub fn forget(&mut self, kind: Kind) -> Result<(), StoreError> {
        self.begin(kind, self.newest[kind as usize].wrapping_add(1))
    }

    /// Replaces all records of a kind by these, numbered from 0. When this returns, the next start finds
    /// them; if it fails, the next start finds all of them or all that were there before. A kind that is
    /// stored like this is not stored otherwise.
    ///
    /// # Errors
    /// All of [`StoreError`].
    ///
    /// # Panics
    /// If a value is longer than [`MAX_VALUE_BYTES`] or there are 2¹⁴ of them.
    pub fn replace<V: AsRef<[u8]>>(
        &mut self,
        kind: Kind,
        values: impl IntoIterator<Item = V>,
    ) -> Result<(), StoreError> {
        let before = self.generations[kind as usize];
        let next = self.newest[kind as usize].wrapping_add(1);
        // Of the two sets of keys the one that is not in use.
        let generation = if (next ^ before) & 1 == 0 { next.wrapping_add(1) } else { next };
        self.newest[kind as usize] = generation;
        self.generations[kind as usize] = generation;
        let odd = if generation & 1 == 0 { 0 } else { ODD };
        let stored = (0..).zip(values).try_for_each(|(number, value)| {
            assert!(number < ODD, "too many records");
            self.store(kind, number | odd, value.as_ref())
        });
        self.generations[kind as usize] = before;
        stored?;
        self.begin(kind, generation)
    }

    /// From here on the records of this generation are those that count.
    fn begin(&mut self, kind: Kind, generation: u32) -> Result<(), StoreError> {
        self.newest[kind as usize] = generation;
        self.write(kind.key(GENERATION_KEY), &generation.to_le_bytes())?;
        self.generations[kind as usize] = generation;
        Ok(())
    }

    /// Finds the generations in force, and the newest ones of all records: a store that failed has left
    /// behind records of a generation that was never begun, and never will be.
    fn find_generations(&mut self) -> Result<(), StoreError> {
        let (mut generations, mut newest) = ([0; 2], [0; 2]);
        self.each(|key, generation, _| {
            let (kind, number) = Kind::of(key);
            newest[kind as usize] = generation.max(newest[kind as usize]);
            if number == GENERATION_KEY {
                generations[kind as usize] = generation;
            }
        })?;
        (self.generations, self.newest) = (generations, newest);
        Ok(())
    }

    /// Every record with its key, generation and value.
    fn each(&mut self, mut record: impl FnMut(u16, u32, &[u8])) -> Result<(), StoreError> {
        let mut buffer = [0; BUFFER_BYTES];
        let all = async {
            let mut storage = self.storage();
            let mut records = storage.fetch_all_items(&mut buffer).await?;
            while let Some((key, bytes)) = records.next::<&[u8]>(&mut buffer).await? {
                if let Some((generation, value)) = bytes.split_first_chunk() {
                    record(key, u32::from_le_bytes(*generation), value);
                }
            }
            Ok(())
        };
        at_once(all).map_err(store_error)
    }

    fn write(&mut self, key: u16, record: &[u8]) -> Result<(), StoreError> {
        if !self.open {
            return Err(StoreError::PowerLost);
        }
        let mut buffer = [0; BUFFER_BYTES];
        at_once(self.storage().store_item(&mut buffer, &key, &record)).map_err(store_error)
    }
}

fn store_error(error: sequential_storage::Error<FlashError>) -> StoreError {
    match error {
        sequential_storage::Error::Storage { value: FlashError::PowerLost, .. } => StoreError::PowerLost,
        sequential_storage::Error::FullStorage => StoreError::Full,
        _ => StoreError::Broken,
    }
}

/// The store speaks of futures, but flash behind [`Flash`] never waits.
fn at_once<T>(future: impl Future<Output = T>) -> T {
    match pin!(future).poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(value) => value,
        Poll::Pending => unreachable!("flash operations end before they return"),
    }
}

/// A flash memory as `sequential-storage` wants it.
struct Adapter<F: Flash>(F);

impl NorFlashError for FlashError {
    fn kind(&self) -> NorFlashErrorKind {
        match self {
            Self::Range => NorFlashErrorKind::OutOfBounds,
            Self::PowerLost | Self::NotErased => NorFlashErrorKind::Other,
        }
    }
}

impl<F: Flash> ErrorType for Adapter<F> {
    type Error = FlashError;
}

impl<F: Flash> ReadNorFlash for Adapter<F> {
    const READ_SIZE: usize = 1;

    async fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), FlashError> {
        self.0.read(offset, bytes)
    }

    fn capacity(&self) -> usize {
        self.0.capacity() as usize
    }
}

impl<F: Flash> NorFlash for Adapter<F> {
    const WRITE_SIZE: usize = WORD_BYTES as usize;
    const ERASE_SIZE: usize = PAGE_BYTES as usize;

    async fn erase(&mut self, from: u32, to: u32) -> Result<(), FlashError> {
        self.0.erase(from, to)
    }

    async fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), FlashError> {
        self.0.write(offset, bytes)
    }
}
