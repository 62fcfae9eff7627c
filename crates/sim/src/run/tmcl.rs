//! TMCL programs on their way into a module (manual, section 3.7.53).

use super::{RunError, exchange};
use crate::device::VirtualDevice;
use protocol::tmcl::{Frame, Reply, Request, Status};
use tmcl::Command;

const STOP: u8 = 128;
const RUN: u8 = 129;
const ENTER_DOWNLOAD: u8 = 132;
const EXIT_DOWNLOAD: u8 = 133;

const fn control(opcode: u8) -> Command {
    Command { opcode, kind: 0, motor: 0, value: 0 }
}

pub(super) fn load(device: &mut VirtualDevice, commands: &[Command]) -> Result<(), RunError> {
    send(device, "the stop before the download", control(STOP), Status::OK)?;
    send(device, "the begin of the download", control(ENTER_DOWNLOAD), Status::OK)?;
    for (number, stored) in commands.iter().enumerate() {
        send(device, &format!("command {number} of the download"), *stored, Status::LOADED)?;
    }
    send(device, "the end of the download", control(EXIT_DOWNLOAD), Status::OK)
}

pub(super) fn start(device: &mut VirtualDevice) -> Result<(), RunError> {
    send(device, "the start", control(RUN), Status::OK)
}

/// Sends one command and looks at the answer; `what` is its name for messages.
pub(super) fn send(
    device: &mut VirtualDevice,
    what: &str,
    command: Command,
    expected: Status,
) -> Result<(), RunError> {
    let Command { opcode, kind, motor, value } = command;
    let request = Request { address: 1, opcode, kind, motor, value };
    let answer = exchange(device, &request.emit().0).and_then(|bytes| bytes.try_into().ok());
    match answer.and_then(|bytes| Reply::parse(&Frame(bytes)).ok()) {
        None => Err(RunError::Silent(what.into())),
        Some(reply) if reply.status == expected => Ok(()),
        Some(reply) => {
            Err(RunError::Refused { command: what.into(), answer: format!("status {}", reply.status.0) })
        }
    }
}
