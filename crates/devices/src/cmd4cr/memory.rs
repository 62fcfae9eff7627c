//! What the controller remembers, in RAM and flash (manual, 2.1.7 and 2.7).

use super::table::{AXIS_COUNT, COMMANDS, Id};
use crate::ascii::{cells, memory};
use ascript::dialect::COMMANDER;

/// Compiled lines of programs.
pub const LINES: usize = COMMANDER.lines as usize;

/// Variables of programs.
const VARIABLES: usize = COMMANDER.variables as usize;

/// Settings, programs, variables and their store.
pub type Memory<F> = memory::Memory<F, Id, { cells::count(COMMANDS, AXIS_COUNT) }, LINES, VARIABLES>;

/// All variables are stored; the identification number from the factory is 01 (manual, 3.3).
pub static LAYOUT: memory::Layout<Id> =
    memory::Layout { table: COMMANDS, firsts: &FIRSTS, dialect: &COMMANDER, stored_from: 0, number: 1 };

static FIRSTS: [u16; COMMANDS.len() + 1] = cells::firsts(COMMANDS, AXIS_COUNT);
