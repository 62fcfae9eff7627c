//! A-SCRIPT programs on their way into a controller (PMX-2ED-SA manual, 7.19 and table 9.0; CMD-4CR manual, 2.7).

use super::{RunError, exchange};
use crate::device::VirtualDevice;
use ascript::{Dialect, Line};
use std::collections::BTreeSet;

pub(super) fn load(device: &mut VirtualDevice, dialect: &Dialect, lines: &[Line]) -> Result<(), RunError> {
    for number in 0..dialect.threads {
        send(device, &format!("{}{number}=0", dialect.control))?;
    }
    for (number, line) in lines.iter().enumerate() {
        send(device, &format!("SA{number}={line}"))?;
    }
    Ok(())
}

/// Starts every program that the lines define.
pub(super) fn start(device: &mut VirtualDevice, dialect: &Dialect, lines: &[Line]) -> Result<(), RunError> {
    let program = |line: &Line| if let Line::Program(number) = *line { Some(number) } else { None };
    let programs: BTreeSet<u8> = lines.iter().filter_map(program).collect();
    programs.into_iter().try_for_each(|number| send(device, &format!("{}{number}=1", dialect.control)))
}

/// Sends one command, which must be answered with `OK`.
fn send(device: &mut VirtualDevice, command: &str) -> Result<(), RunError> {
    let answer = exchange(device, format!("{command}\r").as_bytes());
    match answer.as_deref() {
        None => Err(RunError::Silent(format!("`{command}`"))),
        Some(b"OK\r") => Ok(()),
        Some(bytes) => {
            let answer = String::from_utf8_lossy(bytes);
            Err(RunError::Refused {
                command: format!("`{command}`"),
                answer: format!("`{}`", answer.trim_end()),
            })
        }
    }
}
