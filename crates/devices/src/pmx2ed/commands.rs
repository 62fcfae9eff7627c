//! What each command does: from a line of text to its reply (manual, section 9).

use super::refusal::Refusal;
use super::table::{AXES, AXIS_COUNT, COMMANDS, Id};
use super::{NAME, Pmx2ed, joystick, polarity};
use crate::ascii::reply::{list, number, say};
use crate::ascii::station::Halt;
use crate::ascii::{Parsed, Value, parse};
use crate::board::Board;
use crate::flash::Flash;
use protocol::performax::{MAX_REPLY, Reply};

/// The greatest zero tolerance of the joystick, in mV.
const MAX_TOLERANCE_MV: i32 = 5000;

/// The longest echo of a command that is not known.
const MAX_ECHO: usize = MAX_REPLY - 1;

type Line<'a> = Parsed<'a, Id>;

impl<F: Flash> Pmx2ed<F> {
    /// Does what a line says and gives the reply.
    pub fn answer(&mut self, text: &str, board: &mut dyn Board) -> Reply {
        let mut reply = Reply::new();
        let done = parse(COMMANDS, AXES, text).map_err(Refusal::from).and_then(|line| match line.value {
            None if line.command.value == Value::None => self.act(&line, board).map(|()| false),
            None => {
                self.ask(&line, &mut reply, board);
                Ok(true)
            }
            Some(value) => self.set(&line, value, board).map(|()| false),
        });
        match done {
            Ok(true) => {}
            Ok(false) => say(&mut reply, format_args!("OK")),
            Err(Refusal::Unknown) => say(&mut reply, format_args!("?{}", &text[..text.len().min(MAX_ECHO)])),
            Err(refusal) => say(&mut reply, format_args!("{}", refusal.text())),
        }
        reply
    }

    /// Something to read.
    pub fn ask(&self, line: &Line<'_>, reply: &mut Reply, board: &mut dyn Board) {
        let id = line.command.id;
        match (id, line.place()) {
            (Id::Identity, _) => say(reply, format_args!("PERFORMAX-2ED-SA")),
            (Id::Version, _) => say(reply, format_args!("V128BL")),
            (Id::DeviceName, _) => say(reply, format_args!("{NAME}{:02}", self.memory.number)),
            (Id::Status, None) => {
                for axis in 0..AXIS_COUNT {
                    let status = self.status(axis, board);
                    say(reply, format_args!("{status}:"));
                }
                // There is no buffered move.
                say(reply, format_args!("0:{}", i32::from(self.incremental)));
            }
            (Id::PulseSpeed, None) => list(reply, (0..AXIS_COUNT).map(|axis| self.speed(axis))),
            (Id::ProgramLine, Some(number)) => {
                let line = self.memory.program.line(number as u16).unwrap_or(ascript::line::Line::Empty);
                say(reply, format_args!("{line}"));
            }
            (_, place) => number(reply, line.command.value, self.read(id, place, board)),
        }
    }

    /// A command with a value.
    fn set(&mut self, line: &Line<'_>, value: &str, board: &mut dyn Board) -> Result<(), Refusal> {
        match line.command.id {
            Id::DeviceName => {
                let digits = value.strip_prefix(NAME).filter(|digits| digits.len() == 2);
                let digits = digits.filter(|digits| digits.bytes().all(|digit| digit.is_ascii_digit()));
                self.memory.number = digits.and_then(|digits| digits.parse().ok()).ok_or(Refusal::Value)?;
                Ok(())
            }
            Id::ProgramLine => {
                let line_number = line.index.ok_or(Refusal::Index)?;
                self.download(line_number, value)
            }
            id => {
                let number = line.number()?;
                self.write(id, line.place(), number, board)
            }
        }
    }

    /// The value of a command as a number. `place` is its axis, or its index above the least; `None` is
    /// the value for all of them.
    pub fn read(&self, id: Id, place: Option<usize>, board: &mut dyn Board) -> i32 {
        let axis = place.unwrap_or(0);
        match id {
            Id::Analog => self.analog(axis, board),
            Id::Inputs => self.inputs(place),
            Id::Outputs | Id::Output => self.outputs(place),
            Id::Enables | Id::Enable => self.enables(place),
            Id::Encoder => self.encoder(axis, board),
            Id::Position => self.position(axis),
            Id::PulseSpeed => self.speed(axis),
            Id::Delta => self.delta(axis, board),
            Id::Status => self.status(axis, board),
            Id::LoopStatus => self.stations[axis].closed.status() as i32,
            Id::MoveMode => self.incremental.into(),
            Id::ReturnRule => i32::from(self.polarity(0) & polarity::RESTART != 0),
            Id::ProgramStatus => self.programs.state(axis) as i32,
            Id::ProgramCounter => self.programs.counter(axis).into(),
            Id::Variable => self.memory.program.variable(axis as u8).unwrap_or(0),
            _ => match place {
                Some(place) => self.memory.cells.at(id, place),
                None => self.memory.cells.get(id),
            },
        }
    }

    /// Sets the value of a command; it is in the range of its entry.
    pub fn write(
        &mut self,
        id: Id,
        place: Option<usize>,
        value: i32,
        board: &mut dyn Board,
    ) -> Result<(), Refusal> {
        let axis = place.unwrap_or(0);
        match id {
            Id::Outputs | Id::Output => self.set_outputs(place, value, board),
            Id::Enables | Id::Enable => self.set_enables(place, value, board),
            Id::Encoder => self.set_encoder(axis, value, board),
            Id::Position => self.set_position(axis, value)?,
            Id::Variable => {
                self.memory.program.set_variable(axis as u8, value);
            }
            Id::Polarity => self.set_polarity(axis, value, board),
            Id::ReturnRule => {
                let word = self.polarity(0) & !polarity::RESTART;
                self.set_polarity(0, if value == 0 { word } else { word | polarity::RESTART }, board);
            }
            Id::ProgramControl => self.control_program(axis, value)?,
            Id::SetSpeed => self.change_speed(axis, value)?,
            Id::Loop => self.switch_loop(axis, value != 0, board)?,
            Id::JoystickMask => self.set_joystick(value)?,
            // The loop has reckoned its origin with it.
            Id::LoopRatio if self.stations[axis].closed.is_on() => return Err(Refusal::State),
            Id::SpeedMode if self.is_moving(axis) => return Err(Refusal::Moving),
            Id::LowSpeed => {
                let high = match place {
                    Some(axis) => self.memory.cells.of_axis(Id::HighSpeed, axis),
                    None => self.memory.cells.get(Id::HighSpeed),
                };
                // 0 is no speed, but for an axis it means the global one.
                if value > high || value == 0 && place.is_none() {
                    return Err(Refusal::LowSpeed);
                }
                self.keep(id, place, value);
            }
            Id::HighSpeed if value == 0 && place.is_none() => return Err(Refusal::Value),
            Id::JoystickValues if axis >= joystick::TOLERANCES && value > MAX_TOLERANCE_MV => {
                return Err(Refusal::Value);
            }
            Id::TimeOut => {
                self.keep(id, place, value);
                self.wire.heard(self.now);
            }
            _ => self.keep(id, place, value),
        }
        Ok(())
    }

    fn keep(&mut self, id: Id, place: Option<usize>, value: i32) {
        match place {
            Some(place) => self.memory.cells.set_at(id, place, value),
            None => self.memory.cells.set(id, value),
        }
    }

    /// Does what a command without a value is for.
    fn act(&mut self, line: &Line<'_>, board: &mut dyn Board) -> Result<(), Refusal> {
        let axis = line.axis;
        match line.command.id {
            Id::Abort => self.stop(axis, Halt::AtOnce),
            Id::Stop => self.stop(axis, Halt::Ramp),
            Id::Absolute => self.incremental = false,
            Id::Incremental => self.incremental = true,
            Id::Clear => self.clear(axis.ok_or(Refusal::Unknown)?, board),
            Id::ClearLoop => self.clear_loop(axis.ok_or(Refusal::Unknown)?, board),
            Id::JoystickOn => self.set_joystick((1 << AXIS_COUNT) - 1)?,
            Id::JoystickOff => self.set_joystick(0)?,
            Id::Jog => self.jog(axis, line.way.ok_or(Refusal::Unknown)?, None)?,
            Id::Home | Id::HomeLow | Id::LimitHome | Id::HomeIndex | Id::IndexHome => {
                let (axis, way) = axis.zip(line.way).ok_or(Refusal::Unknown)?;
                self.home(line.command.id, axis, way, None, board)?;
            }
            Id::Move => self.move_to([line.targets[0], line.targets[1]], None, board)?,
            Id::Interpolate => {
                self.move_to([Some(line.numbers[0]), Some(line.numbers[1])], None, board)?;
            }
            Id::Target => {
                let axis = axis.ok_or(Refusal::Unknown)?;
                self.change_target(axis, line.targets[axis].ok_or(Refusal::Value)?)?;
            }
            Id::Subroutine => self.run_subroutine(line.index.ok_or(Refusal::Index)?)?,
            Id::Store => self.store(),
            _ => return Err(Refusal::Unknown),
        }
        Ok(())
    }

    /// Stores the settings. Without a supply nobody is told anything any more.
    pub fn store(&mut self) {
        if self.memory.store().is_err() {
            self.die();
        }
    }
}
