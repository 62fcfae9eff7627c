//! What the controller remembers, in RAM and flash.

use super::table::{AXIS_COUNT, COMMANDS, Id};
use crate::ascii::cells::{self, Cells};
use crate::flash::Flash;
use crate::settings::{Kind, MAX_VALUE_BYTES, Number, Settings, StoreError};
use ascript::{dialect::PERFORMAX_2, line::Line, vm};
use heapless::Vec;

/// Compiled lines of programs (manual, 7.19.1).
pub const LINES: usize = 1275;

/// Variables; the upper half is stored (manual, 7.19.6).
pub const VARIABLES: usize = 64;

/// Where the stored half begins.
const STORED_VARIABLES: usize = 32;

/// The numbers that commands remember.
type Numbers = Cells<Id, { cells::count(COMMANDS, AXIS_COUNT) }>;

/// Programs and variables.
pub type Program = vm::Memory<LINES, VARIABLES>;

// What a record of settings is about: its first byte.
const CELLS: u8 = 0;
const VARIABLE: u8 = 1;
const NAME: u8 = 2;

/// Variables in a record, behind the number of the first one.
const VARIABLES_A_RECORD: usize = (MAX_VALUE_BYTES - 2) / 4;

type Record = Vec<u8, MAX_VALUE_BYTES>;

/// Settings, programs, variables and their store.
pub struct Memory<F: Flash> {
    store: Option<Settings<F>>,
    /// The numbers that commands remember.
    pub cells: Numbers,
    /// The device number, 0 to 99, as it was last set.
    pub number: u8,
    /// Programs and variables.
    pub program: Program,
}

impl<F: Flash> Memory<F> {
    /// Everything as it is after power-up. A flash that does not answer leaves the defaults.
    pub fn open(flash: F) -> Self {
        let mut memory =
            Self { store: None, cells: Cells::new(COMMANDS, AXIS_COUNT), number: 0, program: Program::new() };
        memory.store = Settings::open(flash, |kind, number, value| memory.take(kind, number, value)).ok();
        memory
    }

    fn take(&mut self, kind: Kind, number: Number, record: &[u8]) {
        if kind == Kind::Program {
            let line = record.try_into().ok().and_then(|bytes| Line::from_bytes(bytes, &PERFORMAX_2));
            if let Some(line) = line.filter(|_| usize::from(number) < LINES) {
                self.program.set_line(number, line);
            }
            return;
        }
        match *record {
            [CELLS, ref cells @ ..] => self.cells.take(cells),
            [VARIABLE, first, ref values @ ..] => {
                for (number, value) in (first..VARIABLES as u8).zip(values.as_chunks().0) {
                    self.program.set_variable(number, i32::from_le_bytes(*value));
                }
            }
            [NAME, number @ 0..=99] => self.number = number,
            _ => {}
        }
    }

    /// `STORE`: all settings, in one step (manual, table 7.15).
    ///
    /// # Errors
    /// As [`Settings::replace`].
    pub fn store(&mut self) -> Result<(), StoreError> {
        let cells = self.cells.records().map(|cells| record(&[CELLS], &cells));
        let variables = (STORED_VARIABLES..VARIABLES).step_by(VARIABLES_A_RECORD).map(|first| {
            let mut record = record(&[VARIABLE, first as u8], &[]);
            for number in first..VARIABLES.min(first + VARIABLES_A_RECORD) {
                let value = self.program.variable(number as u8).unwrap_or(0).to_le_bytes();
                assert!(record.extend_from_slice(&value).is_ok(), "room for each variable");
            }
            record
        });
        let name = core::iter::once(record(&[NAME, self.number], &[]));
        let store = self.store.as_mut().ok_or(StoreError::PowerLost)?;
        store.replace(Kind::Setting, cells.chain(variables).chain(name))
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
        let store = self.store.as_mut().ok_or(StoreError::PowerLost)?;
        store.store(Kind::Program, number, &line.to_bytes())?;
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
