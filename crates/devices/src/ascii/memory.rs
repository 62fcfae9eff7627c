//! What a controller of this language remembers, in RAM and flash.

use super::cells::Cells;
use super::command::{Command, Id};
use crate::flash::Flash;
use crate::settings::{Kind, MAX_VALUE_BYTES, Settings, StoreError};
use ascript::{Dialect, line::Line, vm};
use heapless::Vec;

/// What a device has to remember.
pub struct Layout<I: 'static> {
    /// Its commands.
    pub table: &'static [Command<I>],
    /// [`firsts`](super::cells::firsts) of them.
    pub firsts: &'static [u16],
    /// The language of its programs.
    pub dialect: &'static Dialect,
    /// Variables from this one on are stored.
    pub stored_from: u8,
    /// The device number from the factory.
    pub number: u8,
}

// What a record of settings is about: its first byte.
const CELLS: u8 = 0;
const VARIABLE: u8 = 1;
const NUMBER: u8 = 2;

/// Variables in a record, behind the number of the first one.
const VARIABLES_A_RECORD: usize = (MAX_VALUE_BYTES - 2) / 4;

/// The highest device number.
pub const MAX_NUMBER: u8 = 99;

type Record = Vec<u8, MAX_VALUE_BYTES>;

/// Settings, programs, variables and their store. `COUNT` is [`count`](super::cells::count) of the
/// table.
pub struct Memory<F: Flash, I: Id, const COUNT: usize, const LINES: usize, const VARIABLES: usize> {
    layout: &'static Layout<I>,
    store: Settings<F>,
    /// The numbers that commands remember.
    pub cells: Cells<I, COUNT>,
    /// The device number, 0 to 99, as it was last set.
    pub number: u8,
    /// Programs and variables.
    pub program: vm::Memory<LINES, VARIABLES>,
}

impl<F: Flash, I: Id, const COUNT: usize, const LINES: usize, const VARIABLES: usize>
    Memory<F, I, COUNT, LINES, VARIABLES>
{
    /// Defaults and no program; the flash is still to be read.
    pub const fn new(flash: F, layout: &'static Layout<I>) -> Self {
        Self {
            layout,
            store: Settings::new(flash),
            cells: Cells::new(layout.table, layout.firsts, layout.dialect.axis_count() as usize),
            number: layout.number,
            program: vm::Memory::new(),
        }
    }

    /// Reads everything as it is after power-up. A flash that does not answer leaves the defaults.
    pub fn open(&mut self) {
        let Self { layout, store, cells, number: device, program } = self;
        // What was read before it stopped answering counts.
        let _ = store.open(|kind, number, record| match (kind, record) {
            (Kind::Program, _) => {
                let bytes = record.try_into().ok();
                let line = bytes.and_then(|bytes| Line::from_bytes(bytes, layout.dialect));
                if let Some(line) = line.filter(|_| usize::from(number) < LINES) {
                    program.set_line(number, line);
                }
            }
            (Kind::Setting, [CELLS, record @ ..]) => cells.take(record),
            (Kind::Setting, [VARIABLE, first, values @ ..]) => {
                for (number, value) in (*first..VARIABLES as u8).zip(values.as_chunks().0) {
                    program.set_variable(number, i32::from_le_bytes(*value));
                }
            }
            (Kind::Setting, [NUMBER, number @ 0..=MAX_NUMBER]) => *device = *number,
            (Kind::Setting, _) => {}
        });
    }

    /// `STORE`: all settings, in one step.
    ///
    /// # Errors
    /// As [`Settings::replace`].
    pub fn store(&mut self) -> Result<(), StoreError> {
        let cells = self.cells.records().map(|cells| record(&[CELLS], &cells));
        let stored = usize::from(self.layout.stored_from)..VARIABLES;
        let variables = stored.step_by(VARIABLES_A_RECORD).map(|first| {
            let mut record = record(&[VARIABLE, first as u8], &[]);
            for number in first..VARIABLES.min(first + VARIABLES_A_RECORD) {
                let value = self.program.variable(number as u8).unwrap_or(0).to_le_bytes();
                assert!(record.extend_from_slice(&value).is_ok(), "room for each variable");
            }
            record
        });
        let number = core::iter::once(record(&[NUMBER, self.number], &[]));
        self.store.replace(Kind::Setting, cells.chain(variables).chain(number))
    }

    /// Sets a line of the program, in flash first.
    ///
    /// # Errors
    /// As [`Settings::store`]; nothing has changed then.
    ///
    /// # Panics
    /// If there is no such line.
    pub fn set_line(&mut self, number: u16, line: Line) -> Result<(), StoreError> {
        assert!(usize::from(number) < LINES, "lines are checked before");
        self.store.store(Kind::Program, number, &line.to_bytes())?;
        self.program.set_line(number, line);
        Ok(())
    }
}

fn record(head: &[u8], tail: &[u8]) -> Record {
    let mut record = Record::new();
    let fits = record.extend_from_slice(head).and_then(|()| record.extend_from_slice(tail));
    assert!(fits.is_ok(), "room for a record");
    record
}
