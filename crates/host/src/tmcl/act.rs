//! What an action is in commands (TMCL manual, 3.6).

use super::Module;
use crate::error::{Error, Result};
use crate::types::{Action, Direction, Level};
use std::{collections::BTreeMap, ops::RangeInclusive, sync::atomic::Ordering};
use tmcl::isa::{Command, MoveKind, RefSearch, opcode};

/// Numbers of axis parameters (TMCL manual, 4).
pub(super) mod parameter {
    pub const TARGET_POSITION: u8 = 0;
    pub const ACTUAL_POSITION: u8 = 1;
    pub const TARGET_SPEED: u8 = 2;
    pub const ACTUAL_SPEED: u8 = 3;
    pub const MAX_SPEED: u8 = 4;
    pub const MAX_ACCELERATION: u8 = 5;
    pub const POSITION_REACHED: u8 = 8;
    pub const HOME_SWITCH: u8 = 9;
    pub const RIGHT_SWITCH: u8 = 10;
    pub const LEFT_SWITCH: u8 = 11;
    pub const RAMP_MODE: u8 = 138;
    pub const SEARCH_MODE: u8 = 193;
    pub const LOAD_VALUE: u8 = 206;
    pub const EXTENDED_ERRORS: u8 = 207;
    pub const ENCODER_POSITION: u8 = 209;
}

/// The ramp mode in which an axis goes on and on (TMCL manual, axis parameter 138).
const VELOCITY_MODE: i32 = 2;

/// The modes of reference search that look for an end switch, and what is added to them for the other end (TMCL manual,
/// 7.1). With the others the mode is the direction.
const END_SWITCH_MODES: RangeInclusive<u8> = 1..=4;
const OTHER_END: u8 = 64;

/// An output: the name of its pin, port and bank (TMCL manual, 3.7.14).
type Output = (&'static str, u8, u8);

/// The outputs that can be read again.
pub(super) const OUTPUTS: [Output; 2] = [("OUT0", 0, 2), ("OUT1", 1, 2)];

/// What pulls inputs up; reading its port gives an input.
const PULL_UPS: Output = ("PULLUPS", 0, 0);

impl Module {
    /// Does something.
    pub async fn act(&self, action: &Action) -> Result<()> {
        match action {
            Action::Power { .. } => Err(Error::Unsupported("switch for motor power")),
            Action::SetMode { .. } => Err(Error::Unsupported("mode of targets: each move says it")),
            Action::Abort { .. } => Err(Error::Unsupported("command that stops without a ramp")),
            Action::Jog { axis, direction, speed, held: _ } => {
                let motor = self.axis(axis)?;
                let speed = match speed {
                    Some(speed) => *speed,
                    None => self.parameter(parameter::MAX_SPEED).await?,
                };
                let opcode = match direction {
                    Direction::Positive => opcode::ROR,
                    Direction::Negative => opcode::ROL,
                };
                self.send(Command::new(opcode, 0, motor, speed)).await.map(drop)
            }
            Action::Move { targets, relative } => self.move_to(targets, *relative).await,
            Action::Stop { axis } => {
                let motor = axis.as_deref().map_or(Ok(0), |axis| self.axis(axis))?;
                self.send(Command::new(opcode::MST, 0, motor, 0)).await.map(drop)
            }
            Action::Home { axis, mode, direction } => {
                let motor = self.axis(axis)?;
                let mode = match direction {
                    Direction::Positive if END_SWITCH_MODES.contains(mode) => mode + OTHER_END,
                    _ => *mode,
                };
                self.set(motor, parameter::SEARCH_MODE, mode.into()).await?;
                self.send(Command::new(opcode::RFS, RefSearch::Start as u8, motor, 0)).await.map(drop)
            }
            Action::SetPosition { axis, value } => {
                self.set(self.axis(axis)?, parameter::ACTUAL_POSITION, *value).await
            }
            Action::SetEncoder { axis, value } => {
                self.set(self.axis(axis)?, parameter::ENCODER_POSITION, *value).await
            }
            Action::ClearError { axis } => {
                self.axis(axis)?;
                // Reading clears them (TMCL manual, axis parameter 207).
                self.parameter(parameter::EXTENDED_ERRORS).await?;
                self.memory().errors = 0;
                Ok(())
            }
            Action::ChangeSpeed { axis, speed, acceleration, mode } => {
                let motor = self.axis(axis)?;
                if mode.is_some() {
                    return Err(Error::Unsupported("speed windows"));
                }
                if let Some(acceleration) = acceleration {
                    self.set(motor, parameter::MAX_ACCELERATION, *acceleration).await?;
                }
                if self.parameter(parameter::RAMP_MODE).await? != VELOCITY_MODE {
                    return self.set(motor, parameter::MAX_SPEED, *speed).await;
                }
                let way = self.parameter(parameter::TARGET_SPEED).await?.signum();
                self.set(motor, parameter::TARGET_SPEED, way * speed.wrapping_abs()).await
            }
            Action::ChangeTarget { axis, target } => {
                self.move_to(&[(axis.clone(), *target)].into(), false).await
            }
            Action::Output { name, value } => {
                let mut outputs = OUTPUTS.iter().chain([&PULL_UPS]);
                let output = outputs.find(|(output, ..)| output == name);
                let (_, port, bank) = *output.ok_or_else(|| Error::NoSuch(name.clone()))?;
                let Level::Digital(on) = *value else {
                    return Err(Error::Value(format!("{name} is on or off")));
                };
                self.send(Command::new(opcode::SIO, port, bank, on.into())).await.map(drop)
            }
        }
    }

    /// Stops the axis and the program. What the program did between the two is stopped too; a download ends.
    pub async fn stop_all(&self) -> Result<()> {
        self.stops.fetch_add(1, Ordering::Relaxed);
        let mut talk = self.talk().await?;
        let stop = Command::new(opcode::MST, 0, 0, 0);
        let first = self.send_in(&mut talk, stop).await;
        let program = self.send_in(&mut talk, Command::new(opcode::STOP_APPLICATION, 0, 0, 0)).await;
        let last = self.send_in(&mut talk, stop).await;
        self.memory().paused = None;
        first.and(program).and(last).map(drop)
    }

    async fn move_to(&self, targets: &BTreeMap<String, i32>, relative: bool) -> Result<()> {
        let kind = if relative { MoveKind::Relative } else { MoveKind::Absolute };
        if targets.is_empty() {
            return Err(Error::Value("a move has a target".into()));
        }
        for (axis, target) in targets {
            let motor = self.axis(axis)?;
            self.send(Command::new(opcode::MVP, kind as u8, motor, *target)).await?;
        }
        Ok(())
    }

    async fn set(&self, motor: u8, number: u8, value: i32) -> Result<()> {
        self.send(Command::new(opcode::SAP, number, motor, value)).await.map(drop)
    }

    /// An axis parameter.
    pub(super) async fn parameter(&self, number: u8) -> Result<i32> {
        self.ask(Command::new(opcode::GAP, number, 0, 0)).await
    }
}
