//! The numbers that commands remember, one cell each, and how they go to flash.

use super::command::{Command, Form, Id, Value};
use crate::settings::MAX_VALUE_BYTES;
use heapless::Vec;

/// The cells of a table; `COUNT` is [`count`] of it.
#[derive(Clone, Debug)]
pub struct Cells<I: 'static, const COUNT: usize> {
    table: &'static [Command<I>],
    axes: usize,
    /// The first cell of each entry, and behind the last one where its cells end.
    firsts: &'static [u16],
    values: [i32; COUNT],
}

/// Bytes of a cell in flash: the entry's position in the table, the place, the value.
const CELL_BYTES: usize = 6;

/// The longest record of cells; a byte of a record stays for whoever tells kinds of records apart.
pub const RECORD_BYTES: usize = (MAX_VALUE_BYTES - 1) / CELL_BYTES * CELL_BYTES;

/// Cells in a record.
const CELLS_A_RECORD: usize = RECORD_BYTES / CELL_BYTES;

/// How many cells a table has on a device with so many axes.
pub const fn count<I>(table: &[Command<I>], axes: usize) -> usize {
    let (mut cells, mut entry) = (0, 0);
    while entry < table.len() {
        cells += table[entry].places(axes);
        entry += 1;
    }
    cells
}

/// The first cell of each entry of a table on a device with so many axes, and where those of the last one end.
pub const fn firsts<I, const BOUNDS: usize>(table: &[Command<I>], axes: usize) -> [u16; BOUNDS] {
    assert!(table.len() + 1 == BOUNDS, "a first cell for each entry, and an end");
    let (mut firsts, mut entry) = ([0; BOUNDS], 0);
    while entry < table.len() {
        firsts[entry + 1] = firsts[entry] + table[entry].places(axes) as u16;
        entry += 1;
    }
    firsts
}

impl<I: Id, const COUNT: usize> Cells<I, COUNT> {
    /// All cells with their defaults. `firsts` is [`firsts`] of the table.
    ///
    /// # Panics
    /// If `COUNT` is not the table's.
    pub const fn new(table: &'static [Command<I>], firsts: &'static [u16], axes: usize) -> Self {
        assert!(count(table, axes) == COUNT && firsts.len() == table.len() + 1, "a cell for each number");
        let mut cells = Self { table, axes, firsts, values: [0; COUNT] };
        let mut entry = 0;
        while entry < table.len() {
            let mut place = 0;
            while place < table[entry].places(axes) {
                cells.values[firsts[entry] as usize + place] = default(&table[entry], place);
                place += 1;
            }
            entry += 1;
        }
        cells
    }

    /// The value of a command for all axes, or its only one.
    pub fn get(&self, id: I) -> i32 {
        self.values[self.find(id, 0)]
    }

    /// The value of a command at a place: an axis, or what its index is above the least.
    pub fn at(&self, id: I, place: usize) -> i32 {
        self.values[self.find(id, self.place(id, place))]
    }

    /// Sets the value of a command for all axes, or its only one.
    pub fn set(&mut self, id: I, value: i32) {
        let cell = self.find(id, 0);
        self.values[cell] = value;
    }

    /// Sets the value of a command at a place.
    pub fn set_at(&mut self, id: I, place: usize, value: i32) {
        let cell = self.find(id, self.place(id, place));
        self.values[cell] = value;
    }

    /// An axis' own value if it has one that is not 0, else that of all axes.
    pub fn of_axis(&self, id: I, axis: usize) -> i32 {
        match self.at(id, axis) {
            0 => self.get(id),
            own => own,
        }
    }

    /// The global value of a command stands before those of its axes.
    fn place(&self, id: I, place: usize) -> usize {
        place + usize::from(self.table[id.position()].form == Form::MaybeAxis)
    }

    #[inline]
    fn find(&self, id: I, place: usize) -> usize {
        let entry = id.position();
        let cell = usize::from(self.firsts[entry]) + place;
        assert!(cell < usize::from(self.firsts[entry + 1]), "a place of the command");
        cell
    }

    /// Records of all stored cells that have not their default.
    pub fn records(&self) -> impl Iterator<Item = Vec<u8, RECORD_BYTES>> + '_ {
        let mut cells = self.stored().filter(|&(cell, .., default)| self.values[cell] != default);
        core::iter::from_fn(move || {
            let mut record = Vec::new();
            for (cell, entry, place, _) in cells.by_ref().take(CELLS_A_RECORD) {
                let [a, b, c, d] = self.values[cell].to_le_bytes();
                let fits = record.extend_from_slice(&[entry, place, a, b, c, d]);
                assert!(fits.is_ok(), "room for each cell");
            }
            (!record.is_empty()).then_some(record)
        })
    }

    /// Takes a record; cells that another firmware may have written are left out.
    pub fn take(&mut self, record: &[u8]) {
        for bytes in record.as_chunks::<CELL_BYTES>().0 {
            let [entry, place, value @ ..] = *bytes;
            let value = i32::from_le_bytes(value);
            let known = self.stored().find(|&(_, e, p, _)| (e, p) == (entry, place));
            let range = self.table.get(usize::from(entry)).and_then(|entry| entry.value.range());
            if let (Some((cell, ..)), Some((from, to))) = (known, range)
                && (from..=to).contains(&value)
            {
                self.values[cell] = value;
            }
        }
    }

    /// Every stored cell: its number, its entry's position, its place, its default.
    fn stored(&self) -> impl Iterator<Item = (usize, u8, u8, i32)> + use<I, COUNT> {
        let (axes, mut first) = (self.axes, 0);
        (0..).zip(self.table).flat_map(move |(entry, command)| {
            let places = command.places(axes);
            let from = first;
            first += places;
            let stored = matches!(command.value, Value::Kept { stored: true, .. });
            (0..if stored { places } else { 0 })
                .map(move |place| (from + place, entry, place as u8, default(command, place)))
        })
    }
}

/// The value of a cell from the factory. Axes have none of their own where there is a global one.
const fn default<I>(command: &Command<I>, place: usize) -> i32 {
    match (command.value, command.form) {
        (Value::Kept { .. }, Form::MaybeAxis) if place > 0 => 0,
        (Value::Kept { default, .. }, _) => default,
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ascii::command::commands;

    const KEPT: Value = Value::Kept { decimals: 0, low: -9, high: 9, default: 3, stored: true };
    const LOST: Value = Value::Kept { decimals: 0, low: 0, high: 9, default: 1, stored: false };

    commands! {
        /// A table.
        TABLE: Id {
            Acts "A" Form::Bare, Value::None; "" "" "" "Text." none;
            Global "G" Form::MaybeAxis, KEPT; "" "" "" "Text." none;
            Lost "L" Form::Axis, LOST; "" "" "" "Text." none;
            Several "S" Form::Index(1, 40), KEPT; "" "" "" "Text." none;
        }
    }

    type Small = Cells<Id, { count(TABLE, 2) }>;

    static FIRSTS: [u16; TABLE.len() + 1] = firsts(TABLE, 2);

    #[test]
    fn axes_take_the_global_value_until_they_have_their_own() {
        let mut cells = Small::new(TABLE, &FIRSTS, 2);
        assert_eq!((cells.get(Id::Global), cells.at(Id::Global, 1), cells.of_axis(Id::Global, 1)), (3, 0, 3));
        cells.set_at(Id::Global, 1, -4);
        cells.set(Id::Global, 5);
        assert_eq!((cells.of_axis(Id::Global, 0), cells.of_axis(Id::Global, 1)), (5, -4));
        assert_eq!((cells.at(Id::Lost, 0), cells.at(Id::Several, 39)), (1, 3));
    }

    #[test]
    fn records_have_what_is_stored_and_not_the_default() {
        let mut cells = Small::new(TABLE, &FIRSTS, 2);
        assert_eq!(cells.records().count(), 0);
        cells.set_at(Id::Lost, 0, 7);
        cells.set_at(Id::Global, 0, 2);
        for place in 0..40 {
            cells.set_at(Id::Several, place, place as i32 % 10 - 9);
        }
        let records: heapless::Vec<_, 8> = cells.records().collect();
        assert_eq!(records.len(), 3);
        let mut again = Small::new(TABLE, &FIRSTS, 2);
        records.iter().for_each(|record| again.take(record));
        cells.set_at(Id::Lost, 0, 1);
        assert_eq!(again.values, cells.values);
    }

    #[test]
    fn strange_records_change_nothing() {
        let check = |record: &[u8]| {
            let mut cells = Small::new(TABLE, &FIRSTS, 2);
            cells.take(record);
            assert_eq!(cells.values, Small::new(TABLE, &FIRSTS, 2).values, "{record:?}");
        };
        check(&[]);
        check(&[1, 0, 2]);
        // No such entry, no such place, not stored, out of range.
        check(&[9, 0, 2, 0, 0, 0]);
        check(&[1, 3, 2, 0, 0, 0]);
        check(&[2, 0, 2, 0, 0, 0]);
        check(&[1, 0, 10, 0, 0, 0]);
    }
}
