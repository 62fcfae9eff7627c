//! The control commands 128 to 139 and 255, which only a host sends (manual, sections 3.7.52 and 3.7.53).

use super::wire::{Link, Response};
use super::{Pd42, VERSION, gp};
use crate::board::Board;
use crate::flash::Flash;
use crate::settings::Kind;
use protocol::tmcl::Status;
use tmcl::isa::{Command, PROGRAM_LENGTH, opcode};
use tmcl::vm::Direct;

/// The value without which factory settings and reset are refused.
const CONFIRMATION: i32 = 1234;

/// The answer to command 136 type 1: 1140, then 1 and 47.
const VERSION_NUMBER: i32 = 0x0474_012F;

/// Bits of global parameter 81.
const PROTECT_READING: i32 = 1;
const PROTECT_WRITING: i32 = 2;

/// Bit of the application status that says that a WAIT is pending.
const WAITING: i32 = 1 << 16;

impl<F: Flash> Pd42<F> {
    /// Executes a command that a host has sent.
    pub fn direct(&mut self, command: Command, link: Link, board: &mut dyn Board) -> Response {
        let is_control = (opcode::STOP_APPLICATION..=opcode::ASCII_MODE).contains(&command.opcode)
            || command.opcode == opcode::SOFTWARE_RESET;
        if let Some(address) = self.program.download
            && !is_control
        {
            return self.store_word(address, command).into();
        }
        if is_control {
            return self.control(command, link);
        }
        match self.vm.direct(command) {
            Direct::Done(value) => Response::Reply(Status::OK, value),
            Direct::Refused(status) => status.into(),
            Direct::Device => match self.execute(command, board) {
                Ok(value) => Response::Reply(Status::OK, value.unwrap_or(command.value)),
                Err(status) => status.into(),
            },
        }
    }

    /// One word of a download.
    fn store_word(&mut self, address: usize, command: Command) -> Status {
        if address >= PROGRAM_LENGTH {
            return Status::INVALID_VALUE;
        }
        let stored = self.memory.store_command(address, command);
        if let Err(status) = self.stored(stored) {
            return status;
        }
        let stored = self.vm.store(address, command);
        assert!(stored.is_ok(), "the address was checked");
        self.program.download = Some(address + 1);
        Status::LOADED
    }

    fn control(&mut self, command: Command, link: Link) -> Response {
        let Command { kind, value, .. } = command;
        let protection = self.memory.module.get(gp::CODE_PROTECTION);
        let address = usize::try_from(value).ok().filter(|&address| address < PROGRAM_LENGTH);
        match command.opcode {
            opcode::STOP_APPLICATION => self.vm.stop(),
            opcode::RUN_APPLICATION => {
                let address = match kind {
                    0 => None,
                    1 => Some(value),
                    _ => return Status::WRONG_TYPE.into(),
                };
                if !self.power.allows_motion() {
                    return Status::NOT_AVAILABLE.into();
                }
                if !self.start_program(address) {
                    return Status::INVALID_VALUE.into();
                }
            }
            opcode::STEP_APPLICATION => self.step_program(),
            opcode::RESET_APPLICATION => self.vm.reset(),
            opcode::START_DOWNLOAD => {
                if protection & PROTECT_WRITING != 0 {
                    return Status::LOCKED.into();
                }
                let Some(address) = address else { return Status::INVALID_VALUE.into() };
                self.vm.stop();
                self.program.download = Some(address);
            }
            opcode::END_DOWNLOAD => self.program.download = None,
            opcode::READ_MEMORY => {
                if protection & PROTECT_READING != 0 {
                    return Status::NOT_AVAILABLE.into();
                }
                let command = address.and_then(|address| self.vm.command(address));
                return command.map_or(Status::INVALID_VALUE.into(), Response::Memory);
            }
            opcode::APPLICATION_STATUS => return self.application_status(kind),
            opcode::FIRMWARE_VERSION => match kind {
                0 => return Response::Version(*VERSION),
                1 => return Response::Reply(Status::OK, VERSION_NUMBER),
                _ => return Status::WRONG_TYPE.into(),
            },
            opcode::FACTORY_SETTINGS => {
                if value != CONFIRMATION {
                    return Status::INVALID_VALUE.into();
                }
                let forgotten = self.memory.forget(Kind::Setting);
                if let Err(status) = self.stored(forgotten) {
                    return status.into();
                }
                return Response::Reset { reply: false };
            }
            opcode::POSITION_REACHED_EVENT => {
                let every = match kind {
                    0 => false,
                    1 => true,
                    _ => return Status::WRONG_TYPE.into(),
                };
                match value {
                    0 => self.wire.forget_event(),
                    1 => self.wire.request_event(link, every),
                    _ => return Status::INVALID_VALUE.into(),
                }
            }
            opcode::ASCII_MODE => {
                if matches!(link, Link::Can { .. }) {
                    return Status::NOT_AVAILABLE.into();
                }
                return Response::Ascii;
            }
            opcode::SOFTWARE_RESET => {
                if value != CONFIRMATION {
                    return Status::INVALID_VALUE.into();
                }
                return Response::Reset { reply: true };
            }
            _ => return Status::INVALID_COMMAND.into(),
        }
        Response::Reply(Status::OK, value)
    }

    fn application_status(&self, kind: u8) -> Response {
        let state = (self.vm.mode() as i32) << 24 | if self.vm.waiting().is_some() { WAITING } else { 0 };
        let value = match kind {
            0 => state | self.program.download.unwrap_or(0) as i32,
            1 => state | i32::from(self.vm.counter()),
            2 => self.vm.accumulator(),
            3 => self.vm.x(),
            _ => return Status::WRONG_TYPE.into(),
        };
        Response::Reply(Status::OK, value)
    }
}
