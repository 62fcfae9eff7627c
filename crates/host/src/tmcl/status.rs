//! What the module says of itself, parameter by parameter.

use super::Module;
use super::act::{OUTPUTS, parameter};
use crate::bits::{errors, flags};
use crate::error::Result;
use crate::pace::Turns;
use crate::types::{AxisStatus, Level, ProgramState, ProgramStatus, Status};
use std::{collections::BTreeMap, time::Instant};
use tmcl::isa::{Command, RefSearch, opcode};
use tmcl::vm::Mode;

/// The bank of analog inputs, and what there is: names of pins, port, and how many of its numbers are one of the pin's
/// unit (TMCL manual, 3.7.15).
const ANALOG_BANK: u8 = 1;
const ANALOG: [(&str, u8, f64); 3] = [("AIN0", 0, 1.0), ("SUPPLY", 8, 10.0), ("TEMPERATURE", 9, 1.0)];

/// The status word, which is put together here: the module has none.
mod bit {
    pub const MOVING: u32 = 0;
    pub const REACHED: u32 = 1;
    pub const LEFT: u32 = 2;
    pub const RIGHT: u32 = 3;
    pub const HOME: u32 = 4;
    /// And the next one: the extended error flags.
    pub const ERRORS: u32 = 5;
    pub const SEARCHING: u32 = 7;
}

/// What is asked for when it is its turn, and what was heard of it last.
#[derive(Debug, Default)]
pub(super) struct Rest {
    turns: Turns,
    inputs: BTreeMap<String, Level>,
    outputs: BTreeMap<String, Level>,
}

/// How many other questions there are.
const ASKED: u32 = 11;

impl Module {
    /// Asks for everything there is to see, or for what moves and a share of the rest.
    pub async fn status(&self, seconds: f64) -> Result<Status> {
        let begin = Instant::now();
        let search = Command::new(opcode::RFS, RefSearch::Status as u8, 0, 0);
        let searching = self.ask(search).await? != 0;
        let position = self.parameter(parameter::ACTUAL_POSITION).await?;
        let speed = self.parameter(parameter::ACTUAL_SPEED).await?;
        let target = self.parameter(parameter::TARGET_POSITION).await?;
        let encoder = self.parameter(parameter::ENCODER_POSITION).await?;
        let load = self.parameter(parameter::LOAD_VALUE).await?;
        let reached = self.parameter(parameter::POSITION_REACHED).await? != 0;
        let left = self.parameter(parameter::LEFT_SWITCH).await? != 0;
        let right = self.parameter(parameter::RIGHT_SWITCH).await? != 0;
        let home = self.parameter(parameter::HOME_SWITCH).await? != 0;
        let program = self.program_status().await?;
        let is_moving = speed != 0;
        let found = self.look_for_errors(position, is_moving, program).await?;
        let levels = [
            (bit::MOVING, is_moving),
            (bit::REACHED, reached),
            (bit::LEFT, left),
            (bit::RIGHT, right),
            (bit::HOME, home),
            (bit::SEARCHING, searching),
        ];
        let word =
            levels.into_iter().fold(found << bit::ERRORS, |word, (bit, on)| word | u32::from(on) << bit);
        let state = match () {
            () if searching => "homing",
            () if is_moving => "moving",
            () => "idle",
        };
        let axis = AxisStatus {
            position,
            encoder: Some(encoder),
            speed,
            target: Some(target),
            load: Some(load),
            status: word,
            flags: flags(&self.bits, word),
            state: state.into(),
            negative_limit: Some(left),
            positive_limit: Some(right),
            home: Some(home),
            error: errors(&self.bits, word),
            ..AxisStatus::default()
        };
        let mut status = Status { seconds, programs: vec![program], ..Status::default() };
        status.alarms.extend(axis.error.iter().map(|error| format!("0: {error}")));
        status.axes.insert("0".into(), axis);
        for (name, on) in [("STOP_L", left), ("STOP_R", right), ("HOME", home)] {
            status.inputs.insert(name.into(), Level::Digital(on));
        }
        let mut rest = self.rest.lock().await;
        for number in rest.turns.take(ANALOG.len() + OUTPUTS.len(), ASKED, begin.elapsed()) {
            self.look(&mut rest, number).await?;
        }
        status.inputs.extend(rest.inputs.clone());
        status.outputs = rest.outputs.clone();
        Ok(status)
    }

    /// An analog input, or behind them an output.
    async fn look(&self, rest: &mut Rest, number: usize) -> Result<()> {
        if let Some(&(name, port, scale)) = ANALOG.get(number) {
            let value = self.ask(Command::new(opcode::GIO, port, ANALOG_BANK, 0)).await?;
            rest.inputs.insert(name.into(), Level::Analog(f64::from(value) / scale));
        } else if let Some(&(name, port, bank)) = OUTPUTS.get(number - ANALOG.len()) {
            let level = self.ask(Command::new(opcode::GIO, port, bank, 0)).await? != 0;
            rest.outputs.insert(name.into(), Level::Digital(level));
        }
        Ok(())
    }

    /// The extended error flags. Reading clears them, and a motion command does, so they are read once for each time that
    /// the axis comes to rest, and not while a program may want to read them itself.
    async fn look_for_errors(&self, position: i32, is_moving: bool, program: ProgramStatus) -> Result<u32> {
        if is_moving {
            let mut memory = self.memory();
            (memory.errors, memory.looked_at) = (0, None);
            return Ok(0);
        }
        if self.memory().looked_at != Some(position) && program.state != ProgramState::Running {
            let found = self.parameter(parameter::EXTENDED_ERRORS).await? as u32;
            let mut memory = self.memory();
            memory.errors |= found;
            memory.looked_at = Some(position);
        }
        Ok(self.memory().errors)
    }

    /// The program, as command 135 tells (TMCL manual, 3.7.53). The module does not tell a pause from an end; what was
    /// made to wait here waits as long as it stays where it is.
    async fn program_status(&self) -> Result<ProgramStatus> {
        let answer = self.ask(Command::new(opcode::APPLICATION_STATUS, 1, 0, 0)).await?;
        let [mode, _, high, low] = answer.to_be_bytes();
        let counter = u16::from_be_bytes([high, low]);
        let mut memory = self.memory();
        let runs = mode == Mode::Run as u8;
        memory.paused = memory.paused.filter(|paused| !runs && *paused == counter);
        let state = match memory.paused {
            _ if runs => ProgramState::Running,
            Some(_) => ProgramState::Paused,
            None => ProgramState::Idle,
        };
        Ok(ProgramStatus { state, counter })
    }

    /// Where the program is.
    pub(super) async fn counter(&self) -> Result<u16> {
        self.program_status().await.map(|status| status.counter)
    }
}
