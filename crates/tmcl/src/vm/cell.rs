//! Program memory without gaps: a chip's memory is little, and there are many commands.

use crate::isa::Command;

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
