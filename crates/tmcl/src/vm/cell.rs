//! Program memory. On a chip it is set aside, without gaps, since memory is little and there are many commands; on a
//! host, where there may be thousands of controllers, it is as long as the program.

use crate::isa::{Command, PROGRAM_LENGTH};
use core::{iter::repeat_n, ops::Deref};

#[cfg(feature = "std")]
type Room = std::vec::Vec<Cell>;
#[cfg(not(feature = "std"))]
type Room = heapless::Vec<Cell, PROGRAM_LENGTH>;

/// The cells up to the last one that was written; those behind it are empty.
#[derive(Clone, Debug)]
pub(super) struct Cells(Room);

impl Cells {
    /// Empty memory.
    pub(super) const fn new() -> Self {
        Self(Room::new())
    }

    /// Writes a cell.
    ///
    /// # Panics
    /// If there is no such cell.
    pub(super) fn set(&mut self, address: usize, cell: Cell) {
        assert!(address < PROGRAM_LENGTH, "addresses are checked before");
        let missing = (address + 1).saturating_sub(self.0.len());
        self.0.extend(repeat_n(Cell::EMPTY, missing));
        self.0[address] = cell;
    }

    /// Empties it.
    pub(super) fn clear(&mut self) {
        self.0 = Room::new();
    }
}

impl Deref for Cells {
    type Target = [Cell];

    fn deref(&self) -> &[Cell] {
        &self.0
    }
}

/// A [`Command`] without the byte that its alignment takes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    /// Opcode, type, motor or bank.
    fields: [u8; 3],
    value: [u8; 4],
}

const _: () = assert!(size_of::<Cell>() == 7);

impl Cell {
    /// An empty cell, all zeros.
    pub(super) const EMPTY: Self = Self::new(Command::EMPTY);

    /// The cell of a command.
    pub(super) const fn new(command: Command) -> Self {
        let Command { opcode, kind, motor, value } = command;
        Self { fields: [opcode, kind, motor], value: value.to_ne_bytes() }
    }

    /// What it holds.
    #[inline(always)]
    pub(super) const fn command(self) -> Command {
        let [opcode, kind, motor] = self.fields;
        Command { opcode, kind, motor, value: i32::from_ne_bytes(self.value) }
    }
}
