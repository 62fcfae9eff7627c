//! The bytes of a flash memory. Most of it is erased most of the time, and what is erased takes no room.

use std::{collections::BTreeMap, ops::Range};

/// Bytes that are kept together.
const ROW_BYTES: usize = 256;

/// What erased flash reads as.
pub(super) const ERASED: u8 = 0xFF;

/// Rows of bytes; those that are not there are erased.
#[derive(Debug)]
pub(super) struct Rows {
    length: usize,
    rows: BTreeMap<usize, Box<[u8; ROW_BYTES]>>,
}

impl Rows {
    /// So many erased bytes.
    pub fn erased(length: usize) -> Self {
        Self { length, rows: BTreeMap::new() }
    }

    /// How many bytes there are.
    pub const fn len(&self) -> usize {
        self.length
    }

    /// Fills `bytes` from an offset on.
    pub fn read(&self, offset: usize, bytes: &mut [u8]) {
        let mut rest = bytes;
        for (row, part) in parts(offset..offset + rest.len()) {
            let (here, behind) = rest.split_at_mut(part.len());
            match self.rows.get(&row) {
                Some(row) => here.copy_from_slice(&row[part]),
                None => here.fill(ERASED),
            }
            rest = behind;
        }
    }

    /// A copy of a range.
    pub fn copy(&self, range: Range<usize>) -> Vec<u8> {
        let mut bytes = vec![0; range.len()];
        self.read(range.start, &mut bytes);
        bytes
    }

    /// Whether a range is erased.
    pub fn is_erased(&self, range: Range<usize>) -> bool {
        parts(range).all(|(row, part)| {
            self.rows.get(&row).is_none_or(|row| row[part].iter().all(|byte| *byte == ERASED))
        })
    }

    /// Puts bytes at an offset.
    pub fn write(&mut self, offset: usize, mut bytes: &[u8]) {
        for (row, part) in parts(offset..offset + bytes.len()) {
            let (here, behind) = bytes.split_at(part.len());
            bytes = behind;
            let place = self.rows.entry(row).or_insert_with(|| Box::new([ERASED; ROW_BYTES]));
            place[part].copy_from_slice(here);
            if place.iter().all(|byte| *byte == ERASED) {
                self.rows.remove(&row);
            }
        }
    }

    /// Erases a range.
    pub fn erase(&mut self, range: Range<usize>) {
        for (row, part) in parts(range) {
            if part.len() == ROW_BYTES {
                self.rows.remove(&row);
            } else if let Some(place) = self.rows.get_mut(&row) {
                place[part].fill(ERASED);
            }
        }
    }
}

/// The rows of a range, each with its part of the range.
fn parts(range: Range<usize>) -> impl Iterator<Item = (usize, Range<usize>)> {
    let rows = range.start / ROW_BYTES..range.end.div_ceil(ROW_BYTES);
    rows.map(move |row| {
        let start = row * ROW_BYTES;
        (row, range.start.saturating_sub(start)..(range.end - start).min(ROW_BYTES))
    })
    .filter(|(_, part)| !part.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_as_good_as_bytes() {
        let length = 4 * ROW_BYTES;
        let (mut rows, mut bytes) = (Rows::erased(length), vec![ERASED; length]);
        let ranges = [3..3, 5..9, 250..260, 0..length, 256..512, 300..301, 511..1024, 200..800, 1024..1024];
        for (number, range) in (1_u8..).zip(ranges) {
            for erase in [false, true] {
                let value = if erase { ERASED } else { number };
                if erase && number % 3 != 0 {
                    rows.erase(range.clone());
                } else {
                    rows.write(range.start, &vec![value; range.len()]);
                }
                bytes[range.clone()].fill(value);
                assert_eq!(rows.copy(0..length), bytes, "{range:?}");
                for range in [0..length, range.clone(), 100..700] {
                    let erased = bytes[range.clone()].iter().all(|byte| *byte == ERASED);
                    assert_eq!(rows.is_erased(range.clone()), erased, "{range:?}");
                }
                if !erase && number % 2 == 0 {
                    break;
                }
            }
        }
        rows.write(0, &vec![ERASED; length]);
        assert!(rows.rows.is_empty(), "erased rows are not kept");
    }
}
