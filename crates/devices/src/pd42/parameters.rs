//! Reading and writing parameters: what happens beyond keeping a number
//! (manual, chapters 4 and 5).

use super::motion::ramp_mode;
use super::{MILLISECOND, Pd42, ap, global_parameters as gp};
use crate::board::Board;
use crate::flash::Flash;
use crate::settings::{Kind, StoreError};
use ::motion::{Ticks, tmc429};
use protocol::tmcl::Status;
use rand_core::{Rng, SeedableRng};
use tmcl::isa::VARIABLE_BANK;
use tmcl::vm::Mode;

/// Banks of global parameters.
const MODULE_BANK: u8 = 0;
const INTERRUPT_BANK: u8 = 3;

impl<F: Flash> Pd42<F> {
    /// Reads an axis parameter.
    ///
    /// # Errors
    /// [`Status::WRONG_TYPE`] if there is none of this number.
    pub fn get_axis(&mut self, number: u8, board: &mut dyn Board) -> Result<i32, Status> {
        let entry = ap::TABLE.find(number).ok_or(Status::WRONG_TYPE)?;
        let sign = self.axis.direction().sign() as i32;
        let [left, right] = self.stop_switches();
        Ok(match entry.number {
            ap::ACTUAL_POSITION => self.axis.position(),
            ap::ACTUAL_SPEED => sign * tmc429::internal(self.axis.speed()),
            ap::POSITION_REACHED => self.reached().into(),
            ap::HOME_SWITCH => self.inputs.home.into(),
            ap::LEFT_SWITCH => left.into(),
            ap::RIGHT_SWITCH => right.into(),
            ap::ACTUAL_ACCELERATION => self.axis.acceleration() * self.memory.axis.get(ap::MAX_ACCELERATION),
            ap::ACTUAL_CURRENT => i32::from(self.power.current()).max(1) - 1,
            ap::LOAD_VALUE => {
                self.measure_load(board);
                self.power.driver.reading().into()
            }
            ap::EXTENDED_ERRORS => {
                let errors = self.memory.axis.get(number);
                self.memory.axis.set(number, 0);
                errors
            }
            ap::DRIVER_ERRORS => {
                self.measure_load(board);
                self.driver_flags()
            }
            ap::ENCODER_POSITION | ap::EXTERNAL_ENCODER | ap::ABSOLUTE_POSITION => {
                self.encoders.update(board);
                match number {
                    ap::ENCODER_POSITION => self.encoders.internal.position(),
                    ap::EXTERNAL_ENCODER => self.encoders.external.position(),
                    _ => self.encoders.internal.angle() as i32,
                }
            }
            _ => self.memory.axis.get(number),
        })
    }

    /// Writes an axis parameter.
    ///
    /// # Errors
    /// [`Status::WRONG_TYPE`] if there is none of this number or it cannot be written,
    /// [`Status::INVALID_VALUE`] out of range, [`Status::NOT_AVAILABLE`] if the motor may not be moved.
    pub fn set_axis(&mut self, number: u8, value: i32, board: &mut dyn Board) -> Result<(), Status> {
        let entry = ap::TABLE.find(number).ok_or(Status::WRONG_TYPE)?;
        if !entry.access.writable() {
            return Err(Status::WRONG_TYPE);
        }
        if !entry.allows(value) || number == ap::SEARCH_MODE && !is_search_mode(value) {
            return Err(Status::INVALID_VALUE);
        }
        match number {
            ap::TARGET_POSITION => return self.move_to(value),
            ap::TARGET_SPEED => return self.rotate(value),
            ap::ACTUAL_POSITION => {
                self.set_position(value);
                return Ok(());
            }
            _ => {}
        }
        self.memory.axis.set(number, value);
        match number {
            ap::MAX_SPEED | ap::MAX_ACCELERATION | ap::MIN_SPEED => self.apply_limits(),
            ap::RAMP_DIVISOR | ap::PULSE_DIVISOR => {
                self.apply_limits();
                // A speed of velocity mode means another speed now.
                if self.memory.axis.get(ap::RAMP_MODE) == ramp_mode::VELOCITY && self.search_status() == 0 {
                    self.resume_mode();
                }
            }
            ap::RAMP_MODE => {
                self.end_search();
                self.resume_mode();
            }
            ap::SHORT_PROTECTION_OFF => self.watch_shorts(),
            ap::RIGHT_SWITCH_OFF | ap::LEFT_SWITCH_OFF | ap::SOFT_STOP => self.apply_blocks(),
            ap::ENCODER_POSITION => {
                self.encoders.update(board);
                self.encoders.internal.set_position(value);
            }
            ap::EXTERNAL_ENCODER => {
                self.encoders.update(board);
                self.encoders.external.set_position(value);
            }
            ap::ENCODER_PRESCALER | ap::EXTERNAL_PRESCALER | ap::EXTERNAL_ENCODER_FUNCTIONS => {
                self.configure_encoders(board);
            }
            _ => {}
        }
        Ok(())
    }

    /// Reads a global parameter.
    ///
    /// # Errors
    /// [`Status::WRONG_TYPE`] for an unknown number, [`Status::INVALID_VALUE`] for an unknown bank.
    pub fn get_global(&mut self, number: u8, bank: u8) -> Result<i32, Status> {
        match bank {
            MODULE_BANK => {}
            VARIABLE_BANK => return Ok(self.vm.variable(number)),
            INTERRUPT_BANK => {
                gp::interrupts::TABLE.find(number).ok_or(Status::WRONG_TYPE)?;
                return Ok(self.memory.interrupts.get(number));
            }
            _ => return Err(Status::INVALID_VALUE),
        }
        gp::module::TABLE.find(number).ok_or(Status::WRONG_TYPE)?;
        Ok(match number {
            gp::module::PROGRAM_STATUS => self.vm.mode() as i32,
            gp::module::DOWNLOAD_MODE => self.program.download.is_some().into(),
            gp::module::PROGRAM_COUNTER => self.vm.counter().into(),
            gp::module::TICK_TIMER => self.timer_ms(),
            gp::module::RANDOM => self.random_number(),
            _ => self.memory.module.get(number),
        })
    }

    /// Writes a global parameter.
    ///
    /// # Errors
    /// [`Status::WRONG_TYPE`] for an unknown or read-only number, [`Status::INVALID_VALUE`] for an unknown
    /// bank or a value out of range, [`Status::LOCKED`] if it could not be stored.
    pub fn set_global(
        &mut self,
        number: u8,
        bank: u8,
        value: i32,
        board: &mut dyn Board,
    ) -> Result<(), Status> {
        let table = match bank {
            MODULE_BANK => gp::module::TABLE,
            VARIABLE_BANK => {
                self.vm.set_variable(number, value);
                return Ok(());
            }
            INTERRUPT_BANK => gp::interrupts::TABLE,
            _ => return Err(Status::INVALID_VALUE),
        };
        let entry = table.find(number).ok_or(Status::WRONG_TYPE)?;
        if !entry.access.writable() {
            return Err(Status::WRONG_TYPE);
        }
        if !entry.allows(value) {
            return Err(Status::INVALID_VALUE);
        }
        if bank == INTERRUPT_BANK {
            self.memory.interrupts.set(number, value);
            self.set_timer(number);
            return Ok(());
        }
        let before = self.memory.module.get(number);
        if number == gp::module::CODE_PROTECTION && before & 1 != 0 && value & 1 == 0 {
            self.erase_program()?;
        }
        let stored = self.memory.set_module(entry, value);
        self.stored(stored)?;
        match number {
            gp::module::TICK_TIMER => {
                self.timer_zero = i128::from(self.now) - i128::from(value) * i128::from(MILLISECOND);
            }
            gp::module::RANDOM => self.random = Some(SeedableRng::seed_from_u64(value as u64)),
            gp::module::SWITCH_POLARITY => self.apply_blocks(),
            gp::module::REVERSE_SHAFT => self.configure_encoders(board),
            _ => {}
        }
        Ok(())
    }

    fn random_number(&mut self) -> i32 {
        self.random.as_mut().map_or(0, |random| (random.next_u32() >> 1) as i32)
    }

    /// Stores a user variable (`STGP`).
    ///
    /// # Errors
    /// [`Status::INVALID_VALUE`] for an unknown bank, [`Status::WRONG_TYPE`] for what is not stored on
    /// command, [`Status::LOCKED`] if it could not be stored.
    pub fn store_global(&mut self, number: u8, bank: u8) -> Result<(), Status> {
        self.storable(number, bank)?;
        let stored = self.memory.store_variable(number, self.vm.variable(number));
        self.stored(stored)
    }

    /// Restores a user variable (`RSGP`).
    ///
    /// # Errors
    /// As [`store_global`](Self::store_global).
    pub fn restore_global(&mut self, number: u8, bank: u8) -> Result<(), Status> {
        self.storable(number, bank)?;
        self.vm.set_variable(number, self.memory.stored_variable(number));
        Ok(())
    }

    fn storable(&self, number: u8, bank: u8) -> Result<(), Status> {
        match bank {
            VARIABLE_BANK if number < gp::STORABLE_VARIABLES => Ok(()),
            MODULE_BANK | VARIABLE_BANK | INTERRUPT_BANK => Err(Status::WRONG_TYPE),
            _ => Err(Status::INVALID_VALUE),
        }
    }

    /// The status of a store. A lost supply ends everything.
    ///
    /// # Errors
    /// [`Status::LOCKED`].
    pub fn stored(&mut self, stored: Result<(), StoreError>) -> Result<(), Status> {
        stored.map_err(|error| {
            if error == StoreError::PowerLost {
                self.die();
            }
            Status::LOCKED
        })
    }

    /// Empties the program memory, in flash first.
    ///
    /// # Errors
    /// [`Status::LOCKED`] if flash refuses.
    pub fn erase_program(&mut self) -> Result<(), Status> {
        let forgotten = self.memory.forget(Kind::Program);
        self.stored(forgotten)?;
        self.vm.reset();
        self.vm.erase();
        Ok(())
    }

    /// The axis' state as bits, for views: 0 moving, 1 target reached, 2 left and 3 right stop switch,
    /// 4 home switch, 5 stall and 6 deviation error, 7 reference search.
    pub fn axis_status(&self) -> u32 {
        let [left, right] = self.stop_switches();
        let errors = self.memory.axis.get(ap::EXTENDED_ERRORS);
        let bits = [
            self.axis.is_moving(),
            self.reached(),
            left,
            right,
            self.inputs.home,
            errors & super::motion::STALL_ERROR != 0,
            errors & super::motion::DEVIATION_ERROR != 0,
            self.search_status() != 0,
        ];
        bits.iter().rev().fold(0, |status, &bit| status << 1 | u32::from(bit))
    }

    /// The period of a timer interrupt in clocks; `None` if it is off or no timer.
    pub fn timer_period(&self, number: u8) -> Option<Ticks> {
        let period = self.memory.interrupts.get(number) as u32;
        (period != 0).then(|| Ticks::from(period) * MILLISECOND)
    }

    /// Whether a program is running or stepping.
    pub fn program_active(&self) -> bool {
        matches!(self.vm.mode(), Mode::Run | Mode::Step) && self.vm.is_active()
    }
}

/// Modes 1 to 8; 64 goes with 1 to 4, 128 with 5 to 8.
fn is_search_mode(value: i32) -> bool {
    matches!(value, 1..=8 | 65..=68 | 133..=136)
}
