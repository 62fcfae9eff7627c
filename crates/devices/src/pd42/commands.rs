//! What each command does, whether it was sent or stands in a program (manual, section 3.7).

use super::motion::ramp_mode;
use super::pins::number as pin;
use super::{Pd42, ap};
use crate::board::Board;
use crate::flash::Flash;
use protocol::tmcl::Status;
use tmcl::isa::{Command, MAX_COORDINATE, MoveKind, RefSearch, opcode};

/// Stands for all coordinates' EEPROM instead of a motor (manual 3.7.24, 3.7.25).
const EEPROM: u8 = 255;

/// All inputs or outputs at once.
const ALL_PORTS: u8 = 255;

/// The value that takes the accumulator instead (manual 3.7.14).
const ACCUMULATOR: i32 = -1;

/// What a command gives: a value it has read, or nothing.
pub type Executed = Result<Option<i32>, Status>;

impl<F: Flash> Pd42<F> {
    /// Executes a command that concerns the module, not the program's registers or flow.
    ///
    /// # Errors
    /// The status of the refusal; nothing has changed then.
    pub fn execute(&mut self, command: Command, board: &mut dyn Board) -> Executed {
        let Command { kind, motor, value, .. } = command;
        let accumulator = self.vm.accumulator();
        match command.opcode {
            opcode::ROR => axis(motor).and_then(|()| self.rotate(value))?,
            opcode::ROL => {
                axis(motor)?;
                self.rotate(value.checked_neg().ok_or(Status::INVALID_VALUE)?)?;
            }
            opcode::RORA => axis(motor).and_then(|()| self.rotate(accumulator))?,
            opcode::ROLA => {
                axis(motor)?;
                self.rotate(accumulator.checked_neg().ok_or(Status::INVALID_VALUE)?)?;
            }
            opcode::MST => axis(motor).and_then(|()| self.rotate(0))?,
            opcode::MVP => self.move_position(kind, motor, value)?,
            opcode::MVPA => self.move_position(kind, motor, accumulator)?,
            opcode::SAP => self.set_axis_of(kind, motor, value, board)?,
            opcode::AAP => self.set_axis_of(kind, motor, accumulator, board)?,
            opcode::GAP => {
                ap::TABLE.find(kind).ok_or(Status::WRONG_TYPE)?;
                axis(motor)?;
                return self.get_axis(kind, board).map(Some);
            }
            opcode::STAP => {
                storable_axis(kind, motor)?;
                let stored = self.memory.store_axis(kind);
                self.stored(stored)?;
            }
            opcode::RSAP => {
                storable_axis(kind, motor)?;
                let value = self.memory.stored_axis(kind);
                self.set_axis(kind, value, board)?;
            }
            opcode::SGP => self.set_global(kind, motor, value, board)?,
            opcode::AGP => self.set_global(kind, motor, accumulator, board)?,
            opcode::GGP => return self.get_global(kind, motor).map(Some),
            opcode::STGP => self.store_global(kind, motor)?,
            opcode::RSGP => self.restore_global(kind, motor)?,
            opcode::RFS => return self.reference_search(kind, motor),
            opcode::SIO => self.set_output(kind, motor, value, board)?,
            opcode::GIO => return self.get_input(kind, motor, board).map(Some),
            opcode::SCO => self.set_coordinate(kind, motor, value)?,
            opcode::GCO => return self.get_coordinate(kind, motor).map(Some),
            opcode::CCO => {
                coordinate(kind)?;
                axis(motor)?;
                let stored = self.memory.set_coordinate(kind, self.axis.position());
                self.stored(stored)?;
            }
            opcode::ACO => {
                coordinate(kind)?;
                axis(motor)?;
                let stored = self.memory.set_coordinate(kind, accumulator);
                self.stored(stored)?;
            }
            opcode::UF0..=opcode::UF7 => return Err(Status::NOT_AVAILABLE),
            _ => return Err(Status::INVALID_COMMAND),
        }
        Ok(None)
    }

    fn move_position(&mut self, kind: u8, motor: u8, value: i32) -> Result<(), Status> {
        let kind = MoveKind::from_number(kind).ok_or(Status::WRONG_TYPE)?;
        let target = match kind {
            MoveKind::Absolute => value,
            // Added to the actual position, not to the target.
            MoveKind::Relative => self.axis.position().wrapping_add(value),
            MoveKind::Coordinate => {
                let number = u8::try_from(value).ok().filter(|&number| number <= MAX_COORDINATE);
                self.memory.coordinates[usize::from(number.ok_or(Status::INVALID_VALUE)?)]
            }
        };
        if kind != MoveKind::Coordinate {
            axis(motor)?;
        }
        self.move_to(target)?;
        self.wire.move_begun();
        Ok(())
    }

    fn set_axis_of(&mut self, kind: u8, motor: u8, value: i32, board: &mut dyn Board) -> Result<(), Status> {
        ap::TABLE.find(kind).ok_or(Status::WRONG_TYPE)?;
        axis(motor)?;
        self.set_axis(kind, value, board)
    }

    fn reference_search(&mut self, kind: u8, motor: u8) -> Executed {
        let action = RefSearch::from_number(kind).ok_or(Status::WRONG_TYPE)?;
        axis(motor)?;
        match action {
            RefSearch::Start => self.start_search()?,
            RefSearch::Stop => self.end_search(),
            RefSearch::Status => return Ok(Some(self.search_status())),
        }
        Ok(None)
    }

    /// Bank 2: the outputs; bank 0, port 0: the pull-up resistors of the inputs.
    fn set_output(&mut self, port: u8, bank: u8, value: i32, board: &mut dyn Board) -> Result<(), Status> {
        let on = || if let 0 | 1 = value { Ok(value == 1) } else { Err(Status::INVALID_VALUE) };
        match (bank, port) {
            (2, 0 | 1) => self.drive_output(port, on()?, board),
            (2, ALL_PORTS) => {
                let bits = if value == ACCUMULATOR { self.vm.accumulator() } else { value };
                if value != ACCUMULATOR && !(0..=255).contains(&bits) {
                    return Err(Status::INVALID_VALUE);
                }
                self.drive_output(0, bits & 1 != 0, board);
                self.drive_output(1, bits & 2 != 0, board);
            }
            (0, 0) => {
                self.pull_ups = on()?;
                board.output(pin::PULLUPS, self.pull_ups);
            }
            (0 | 2, _) => return Err(Status::WRONG_TYPE),
            _ => return Err(Status::INVALID_VALUE),
        }
        Ok(())
    }

    fn drive_output(&mut self, port: u8, on: bool, board: &mut dyn Board) {
        let output = &mut self.outputs[usize::from(port)];
        if *output != on {
            *output = on;
            board.output(pin::OUT0 + usize::from(port), on);
        }
    }

    fn get_input(&mut self, port: u8, bank: u8, board: &mut dyn Board) -> Result<i32, Status> {
        let inputs = [self.inputs.analog, self.inputs.left, self.inputs.right, self.inputs.home];
        Ok(match (bank, port) {
            (0, 0..=3) => inputs[usize::from(port)].into(),
            (0, 11) => {
                self.encoders.update(board);
                self.encoders.near_zero().into()
            }
            (0, ALL_PORTS) => inputs.iter().rev().fold(0, |bits, &on| bits << 1 | i32::from(on)),
            (1, 0) => board.analog(pin::AIN0).clamp(0, 4095),
            (1, 8) => board.analog(pin::SUPPLY) / 100,
            (1, 9) => board.analog(pin::TEMPERATURE) / 10,
            (2, 0 | 1) => self.outputs[usize::from(port)].into(),
            (0..=2, _) => return Err(Status::WRONG_TYPE),
            _ => return Err(Status::INVALID_VALUE),
        })
    }

    fn set_coordinate(&mut self, number: u8, motor: u8, value: i32) -> Result<(), Status> {
        coordinate(number)?;
        let stored = match motor {
            0 => self.memory.set_coordinate(number, value),
            EEPROM if value != 0 => return Err(Status::INVALID_VALUE),
            EEPROM => self.memory.store_coordinates((number != 0).then_some(number)),
            _ => return Err(Status::INVALID_VALUE),
        };
        self.stored(stored)
    }

    fn get_coordinate(&mut self, number: u8, motor: u8) -> Result<i32, Status> {
        coordinate(number)?;
        match motor {
            0 => {}
            EEPROM => self.memory.restore_coordinates((number != 0).then_some(number)),
            _ => return Err(Status::INVALID_VALUE),
        }
        Ok(self.memory.coordinates[usize::from(number)])
    }

    /// Whether a command sets the motor going.
    pub fn is_motion(command: Command) -> bool {
        match command.opcode {
            opcode::ROR | opcode::ROL | opcode::RORA | opcode::ROLA | opcode::MVP | opcode::MVPA => true,
            opcode::SAP | opcode::AAP => {
                matches!(command.kind, ap::TARGET_POSITION | ap::TARGET_SPEED | ap::RAMP_MODE)
            }
            opcode::RFS => command.kind == RefSearch::Start as u8,
            _ => false,
        }
    }

    /// Stops the motor with its ramp, as `MST` does.
    pub fn stop_motor(&mut self) {
        let in_search = self.search_status() != 0;
        if in_search || self.axis.is_moving() || self.memory.axis.get(ap::RAMP_MODE) != ramp_mode::VELOCITY {
            let stopped = self.rotate(0);
            assert!(stopped.is_ok(), "stopping is always possible");
        }
    }
}

/// There is one motor.
fn axis(motor: u8) -> Result<(), Status> {
    if motor == 0 { Ok(()) } else { Err(Status::INVALID_VALUE) }
}

fn coordinate(number: u8) -> Result<(), Status> {
    if number <= MAX_COORDINATE { Ok(()) } else { Err(Status::WRONG_TYPE) }
}

fn storable_axis(number: u8, motor: u8) -> Result<(), Status> {
    let entry = ap::TABLE.find(number).ok_or(Status::WRONG_TYPE)?;
    if !entry.access.storable() {
        return Err(Status::WRONG_TYPE);
    }
    axis(motor)
}
