//! What the controller remembers, in RAM and flash (manual, 7.19.1, 7.19.6 and table 7.15).

use super::table::{AXIS_COUNT, COMMANDS, Id};
use crate::ascii::{cells, memory};
use ascript::dialect::PERFORMAX_2;

/// Compiled lines of programs.
pub const LINES: usize = PERFORMAX_2.lines as usize;

/// Variables of programs.
const VARIABLES: usize = PERFORMAX_2.variables as usize;

/// Settings, programs, variables and their store.
pub type Memory<F> = memory::Memory<F, Id, { cells::count(COMMANDS, AXIS_COUNT) }, LINES, VARIABLES>;

/// The upper half of the variables is stored.
pub static LAYOUT: memory::Layout<Id> =
    memory::Layout { table: COMMANDS, firsts: &FIRSTS, dialect: &PERFORMAX_2, stored_from: 32, number: 0 };

static FIRSTS: [u16; COMMANDS.len() + 1] = cells::firsts(COMMANDS, AXIS_COUNT);
