//! What the module remembers: parameters and coordinates in RAM, and their records in flash.

use super::{axis_parameters as ap, global_parameters as gp};
use crate::flash::Flash;
use crate::parameter::{Parameter, Table, Values};
use crate::settings::{Kind, Number, Settings, StoreError};
use tmcl::isa::{Command, MAX_COORDINATE, PROGRAM_LENGTH};
use tmcl::vm::Vm;

/// Coordinates 0 to 20; the first is never stored (manual 3.7.24).
pub const COORDINATES: usize = MAX_COORDINATE as usize + 1;

/// Record numbers of settings: a parameter's number above one of these.
const AXIS_RECORDS: Number = 0x0000;
const MODULE_RECORDS: Number = 0x0100;
const VARIABLE_RECORDS: Number = 0x0200;

/// All coordinates are one record, so that storing all of them is one step.
const COORDINATE_RECORD: Number = 0x0300;

/// Parameters, coordinates and their store.
pub struct Memory<F: Flash> {
    store: Settings<F>,
    /// Axis parameters.
    pub axis: Values<{ ap::COUNT }>,
    /// Global parameters of bank 0.
    pub module: Values<{ gp::module::COUNT }>,
    /// Global parameters of bank 3.
    pub interrupts: Values<{ gp::interrupts::COUNT }>,
    /// Coordinates.
    pub coordinates: [i32; COORDINATES],
    stored: Stored,
}

/// What flash holds, for restoring.
struct Stored {
    axis: Values<{ ap::COUNT }>,
    variables: [i32; gp::STORABLE_VARIABLES as usize],
    coordinates: [i32; COORDINATES],
}

impl Stored {
    const fn new() -> Self {
        Self {
            axis: Values::new(ap::TABLE),
            variables: [0; gp::STORABLE_VARIABLES as usize],
            coordinates: [0; COORDINATES],
        }
    }

    fn reset(&mut self) {
        self.axis.reset();
        self.variables.fill(0);
        self.coordinates.fill(0);
    }

    /// Takes a record; those of parameters of bank 0 and of the program are nowhere else.
    fn take(
        &mut self,
        module: &mut Values<{ gp::module::COUNT }>,
        vm: &mut Vm,
        kind: Kind,
        number: Number,
        value: &[u8],
    ) {
        if kind == Kind::Program {
            if let Some(command) = read_command(value) {
                // Records beyond the memory would be another firmware's.
                let _ = vm.store(number.into(), command);
            }
        } else if number == COORDINATE_RECORD {
            for (coordinate, bytes) in self.coordinates[1..].iter_mut().zip(value.as_chunks().0) {
                *coordinate = i32::from_le_bytes(*bytes);
            }
        } else if let Ok(bytes) = value.try_into() {
            let value = i32::from_le_bytes(bytes);
            let low = number as u8;
            match number & !0xFF {
                AXIS_RECORDS if known(ap::TABLE, low, value) => self.axis.set(low, value),
                MODULE_RECORDS if known(gp::module::TABLE, low, value) => module.set(low, value),
                VARIABLE_RECORDS if low < gp::STORABLE_VARIABLES => {
                    self.variables[usize::from(low)] = value;
                }
                _ => {}
            }
        }
    }
}

impl<F: Flash> Memory<F> {
    /// Defaults; the flash is still to be read.
    pub const fn new(flash: F) -> Self {
        Self {
            store: Settings::new(flash),
            axis: Values::new(ap::TABLE),
            module: Values::new(gp::module::TABLE),
            interrupts: Values::new(gp::interrupts::TABLE),
            coordinates: [0; COORDINATES],
            stored: Stored::new(),
        }
    }

    /// Reads everything as it is after power-up, at power-up or again; `vm` gets the program and the user
    /// variables. A flash that does not answer leaves the defaults.
    pub fn open(&mut self, vm: &mut Vm) {
        self.module.reset();
        self.interrupts.reset();
        self.coordinates = [0; COORDINATES];
        self.stored.reset();
        let Self { store, module, stored, .. } = self;
        // What was read before it stopped answering counts.
        let _ = store.open(|kind, number, value| stored.take(module, vm, kind, number, value));
        self.restore_all(vm);
    }

    /// Whether flash answered.
    pub const fn is_open(&self) -> bool {
        self.store.is_open()
    }

    fn restore_all(&mut self, vm: &mut Vm) {
        self.axis = self.stored.axis.clone();
        if self.module.get(gp::module::KEEP_VARIABLES_OUT) == 0 {
            for (variable, &value) in (0..).zip(&self.stored.variables) {
                vm.set_variable(variable, value);
            }
        }
        if self.module.get(gp::module::COORDINATE_STORAGE) != 0 {
            self.coordinates = self.stored.coordinates;
        }
    }

    /// Stores an axis parameter's present value.
    ///
    /// # Errors
    /// As [`Settings::store`].
    pub fn store_axis(&mut self, number: u8) -> Result<(), StoreError> {
        let value = self.axis.get(number);
        self.write(AXIS_RECORDS + Number::from(number), value)?;
        self.stored.axis.set(number, value);
        Ok(())
    }

    /// The stored value of an axis parameter; its default if there is none.
    pub fn stored_axis(&self, number: u8) -> i32 {
        self.stored.axis.get(number)
    }

    /// Sets a global parameter of bank 0, which stores it first if that is what the parameter does.
    ///
    /// # Errors
    /// As [`Settings::store`]; nothing is changed then.
    pub fn set_module(&mut self, entry: &Parameter, value: i32) -> Result<(), StoreError> {
        if entry.access.automatic() {
            self.write(MODULE_RECORDS + Number::from(entry.number), value)?;
        }
        self.module.set(entry.number, value);
        Ok(())
    }

    /// Stores a user variable below [`gp::STORABLE_VARIABLES`].
    ///
    /// # Errors
    /// As [`Settings::store`].
    pub fn store_variable(&mut self, number: u8, value: i32) -> Result<(), StoreError> {
        self.write(VARIABLE_RECORDS + Number::from(number), value)?;
        self.stored.variables[usize::from(number)] = value;
        Ok(())
    }

    /// The stored value of a user variable below [`gp::STORABLE_VARIABLES`].
    pub fn stored_variable(&self, number: u8) -> i32 {
        self.stored.variables[usize::from(number)]
    }

    /// Sets a coordinate, and stores it if global parameter 84 says so.
    ///
    /// # Errors
    /// As [`Settings::store`]; nothing is changed then.
    pub fn set_coordinate(&mut self, number: u8, value: i32) -> Result<(), StoreError> {
        let before = core::mem::replace(&mut self.coordinates[usize::from(number)], value);
        if number != 0 && self.module.get(gp::module::COORDINATE_STORAGE) != 0 {
            let stored = self.store_coordinates(Some(number));
            if stored.is_err() {
                self.coordinates[usize::from(number)] = before;
            }
            return stored;
        }
        Ok(())
    }

    /// Stores one coordinate or, with `None`, all but the first.
    ///
    /// # Errors
    /// As [`Settings::store`].
    pub fn store_coordinates(&mut self, number: Option<u8>) -> Result<(), StoreError> {
        let mut next = self.stored.coordinates;
        match number {
            Some(number) => next[usize::from(number)] = self.coordinates[usize::from(number)],
            None => next[1..].copy_from_slice(&self.coordinates[1..]),
        }
        let mut bytes = [0; 4 * MAX_COORDINATE as usize];
        for (chunk, coordinate) in bytes.as_chunks_mut().0.iter_mut().zip(&next[1..]) {
            *chunk = coordinate.to_le_bytes();
        }
        self.record(Kind::Setting, COORDINATE_RECORD, &bytes)?;
        self.stored.coordinates = next;
        Ok(())
    }

    /// Copies one stored coordinate or, with `None`, all but the first, to RAM.
    pub fn restore_coordinates(&mut self, number: Option<u8>) {
        match number {
            Some(number) => {
                self.coordinates[usize::from(number)] = self.stored.coordinates[usize::from(number)];
            }
            None => self.coordinates[1..].copy_from_slice(&self.stored.coordinates[1..]),
        }
    }

    /// Stores a word of the program.
    ///
    /// # Errors
    /// As [`Settings::store`].
    pub fn store_command(&mut self, address: usize, command: Command) -> Result<(), StoreError> {
        assert!(address < PROGRAM_LENGTH, "addresses are checked before");
        let mut bytes = [command.opcode, command.kind, command.motor, 0, 0, 0, 0];
        bytes[3..].copy_from_slice(&command.value.to_be_bytes());
        self.record(Kind::Program, address as Number, &bytes)
    }

    /// Forgets the program or all settings.
    ///
    /// # Errors
    /// As [`Settings::forget`].
    pub fn forget(&mut self, kind: Kind) -> Result<(), StoreError> {
        self.store.forget(kind)
    }

    fn write(&mut self, number: Number, value: i32) -> Result<(), StoreError> {
        self.record(Kind::Setting, number, &value.to_le_bytes())
    }

    fn record(&mut self, kind: Kind, number: Number, value: &[u8]) -> Result<(), StoreError> {
        self.store.store(kind, number, value)
    }
}

/// Whether a record is one that this table's commands could have written.
fn known(table: &Table, number: u8, value: i32) -> bool {
    table
        .find(number)
        .is_some_and(|entry| entry.allows(value) && (entry.access.storable() || entry.access.automatic()))
}

fn read_command(bytes: &[u8]) -> Option<Command> {
    let &[opcode, kind, motor, a, b, c, d] = bytes else { return None };
    Some(Command::new(opcode, kind, motor, i32::from_be_bytes([a, b, c, d])))
}
