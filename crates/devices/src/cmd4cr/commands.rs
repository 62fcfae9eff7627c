//! What each command does: from a line of text to its reply (manual, section 4).

use super::Cmd4cr;
use super::motion::Motion;
use super::path::Curve;
use super::refusal::Refusal;
use super::table::{AXES, AXIS_COUNT, COMMANDS, Id};
use crate::ascii::reply::{list, number, say};
use crate::ascii::station::Halt;
use crate::ascii::{Parsed, Value, parse};
use crate::board::Board;
use crate::flash::Flash;
use ::motion::path::End;
use protocol::performax::{MAX_REPLY, Reply};

/// The longest echo of a command that is not known.
const MAX_ECHO: usize = MAX_REPLY - Refusal::Unknown.text().len();

/// Conditions of `SYNC`; the bit above them chooses the counter.
const SYNC_CONDITIONS: i32 = 7;

/// The highest condition.
const SYNC_CONTINUOUS: i32 = 4;

type Line<'a> = Parsed<'a, Id>;

impl<F: Flash> Cmd4cr<F> {
    /// Does what a line says and gives the reply.
    /// One that is no line of text is not known.
    pub fn answer(&mut self, text: Option<&str>, board: &mut dyn Board) -> Reply {
        let mut reply = Reply::new();
        let Some(text) = text else {
            say(&mut reply, format_args!("{}", Refusal::Unknown.text()));
            return reply;
        };
        let line = parse(COMMANDS, AXES, text).map_err(Refusal::from);
        let done = line.and_then(|line| match line.value {
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
            Err(Refusal::Unknown) => {
                let echo = &text[..text.len().min(MAX_ECHO)];
                say(&mut reply, format_args!("{}{echo}", Refusal::Unknown.text()));
            }
            Err(refusal) => say(&mut reply, format_args!("{}", refusal.text())),
        }
        reply
    }

    /// Something to read.
    pub fn ask(&self, line: &Line<'_>, reply: &mut Reply, board: &mut dyn Board) {
        let id = line.command.id;
        match (id, line.place()) {
            (Id::Version, _) => say(reply, format_args!("V126BL")),
            (Id::Identity, _) => say(reply, format_args!("{:02}", self.memory.number)),
            (Id::Positions, _) => list(reply, (0..AXIS_COUNT).map(|axis| self.position(axis))),
            (Id::Encoders, _) => list(reply, (0..AXIS_COUNT).map(|axis| self.encoder(axis, board))),
            (Id::BufferStatus, _) => list(reply, self.buffer.status().into_iter()),
            (Id::ProgramLine, Some(number)) => {
                let line = self.memory.program.line(number as u16).unwrap_or(ascript::line::Line::Empty);
                say(reply, format_args!("{line}"));
            }
            (_, place) => number(reply, line.command.value, self.read(id, place, board)),
        }
    }

    /// Something to set.
    fn set(&mut self, line: &Line<'_>, value: &str, board: &mut dyn Board) -> Result<(), Refusal> {
        match line.command.id {
            Id::ProgramLine => self.download(line.index.ok_or(Refusal::Index)?, value),
            id => {
                let number = line.number()?;
                self.write(id, line.place(), number, board)
            }
        }
    }

    /// The value of a command as a number. `place` is its axis, or its index above the least; `None` is
    /// the value for all of them, or the first one's.
    pub fn read(&self, id: Id, place: Option<usize>, board: &mut dyn Board) -> i32 {
        let axis = place.unwrap_or(0);
        match id {
            Id::Analog => self.analog(axis, board),
            Id::Delta => self.delta(axis, board),
            Id::Enables | Id::Enable => self.enables(place),
            Id::Encoder => self.encoder(axis, board),
            Id::Identity => self.memory.number.into(),
            Id::Inputs | Id::Input => self.inputs(place),
            Id::LatchStatus => self.latch_status(axis),
            Id::LatchedEncoder => self.latched_encoder(axis),
            Id::LatchedPosition => self.latched_position(axis),
            Id::LoopStatus => self.stations[axis].closed.status() as i32,
            Id::MoveMode => self.incremental.into(),
            Id::Outputs | Id::Output => self.outputs(place),
            Id::Ports | Id::Port => self.ports(place),
            Id::Position => self.position(axis),
            Id::ProgramCounter => self.programs.counter(axis).into(),
            Id::ProgramStatus => self.programs.state(axis) as i32,
            Id::PulseSpeed => self.speed(axis),
            Id::Pulser => self.pulser_position(axis),
            Id::RunsOnBoot => self.memory.cells.get(Id::RunOnBoot) >> axis & 1,
            Id::Status => self.status(axis, board),
            Id::SyncStatus => self.sync_status(axis),
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
            Id::Enables | Id::Enable => self.set_enables(place, value, board),
            Id::Encoder => self.set_encoder(axis, value, board),
            // An axis of 0 takes the global speed, but the global one has to be one.
            Id::HighSpeed | Id::LowSpeed if value == 0 && place.is_none() => return Err(Refusal::Index),
            Id::Identity => self.memory.number = value as u8,
            Id::JoystickMask => self.set_joystick(value)?,
            Id::Latch => self.set_latch(axis, value != 0),
            Id::Loop => self.switch_loop(axis, value != 0, board)?,
            // The loop has reckoned its origin with it.
            Id::LoopRatio if self.stations[axis].closed.is_on() => return Err(Refusal::Moving),
            Id::Output if self.is_synchronised(axis) => return Err(Refusal::Index),
            Id::Outputs | Id::Output => self.set_outputs(place, value, board),
            Id::Polarity => self.set_polarity(axis, value, board),
            Id::Ports | Id::Port => self.set_ports(place, value, board),
            Id::PortsOut => self.configure_ports(value, board),
            Id::Position => self.set_position(axis, value, board)?,
            Id::ProgramControl => self.control_program(axis, value)?,
            Id::Pulser => self.set_pulser_position(axis, value),
            Id::PulserEnable => self.set_pulser(axis, value != 0)?,
            Id::RunsOnBoot => {
                let mask = self.memory.cells.get(Id::RunOnBoot) & !(1 << axis);
                self.memory.cells.set(Id::RunOnBoot, mask | value << axis);
            }
            Id::SetSpeed => self.change_speed(axis, value)?,
            Id::Sync if value & SYNC_CONDITIONS > SYNC_CONTINUOUS => return Err(Refusal::Index),
            Id::Variable => {
                self.memory.program.set_variable(axis as u8, value);
            }
            _ => {
                self.keep(id, place, value);
                self.heed(id, axis, board);
            }
        }
        Ok(())
    }

    /// Remembers a value; of these without an axis, that of each.
    fn keep(&mut self, id: Id, place: Option<usize>, value: i32) {
        match (id, place) {
            (_, Some(place)) => self.memory.cells.set_at(id, place, value),
            (Id::ErrorClearDelay | Id::ErrorClearWidth, None) => {
                (0..AXIS_COUNT).for_each(|axis| self.memory.cells.set_at(id, axis, value));
            }
            (_, None) => self.memory.cells.set(id, value),
        }
    }

    /// What follows at once from a value that is remembered.
    fn heed(&mut self, id: Id, axis: usize, board: &mut dyn Board) {
        match id {
            Id::OutputsPolarity | Id::PortsPolarity => self.put_out(board),
            Id::Duty => self.put_duty(axis, board),
            Id::Slowdown => self.watch_slowdown(axis, board),
            Id::Sync | Id::SyncPosition => self.sync_changed(axis, board),
            Id::SyncMin | Id::SyncMax => self.sync_window_changed(axis),
            _ => {}
        }
    }

    /// Does what a command without a value is for.
    fn act(&mut self, line: &Line<'_>, board: &mut dyn Board) -> Result<(), Refusal> {
        let named = line.axis.ok_or(Refusal::Unknown);
        match line.command.id {
            Id::Abort => self.stop(line.axis, Halt::AtOnce)?,
            Id::Stop => self.stop(line.axis, Halt::Ramp)?,
            Id::EmergencyStop => self.emergency_stop(),
            Id::Absolute => self.incremental = false,
            Id::Incremental => self.incremental = true,
            Id::Clear => self.clear(named?, board),
            Id::BufferOn => self.buffer_on()?,
            Id::BufferOff => self.buffer_off(),
            Id::BufferStart => self.buffer_start(None, board)?,
            Id::BufferMove => {
                let [x, y, z, speed_pps] = line.numbers;
                self.buffer_line([x, y, z], speed_pps)?;
            }
            Id::Target => {
                let axis = named?;
                self.change_target(axis, line.targets[axis].ok_or(Refusal::Index)?)?;
            }
            Id::SyncOn => self.sync_on(named?, false, board),
            Id::SyncOff => self.sync_off(named?, board),
            Id::SyncWindowOn => self.sync_on(named?, true, board),
            Id::SyncWindowOff => self.sync_window_off(named?),
            Id::Subroutine => self.run_subroutine(line.index.ok_or(Refusal::Index)?)?,
            Id::Store => self.store(),
            _ => {
                let motion = self.motion(line).ok_or(Refusal::Unknown)?;
                self.command(motion, None, board)?;
            }
        }
        Ok(())
    }

    /// The motion that a line asks for.
    fn motion(&self, line: &Line<'_>) -> Option<Motion> {
        let way = || line.axis.zip(line.way);
        let curve = |end, rise| {
            let (axes, turn) = line.plane?;
            let [first, second, ..] = line.numbers;
            Some(Motion::Curve(Curve { axes, turn, centre: [first, second], end, rise }))
        };
        let [_, _, third, fourth] = line.numbers;
        match line.command.id {
            Id::Move => Some(Motion::To { targets: line.targets, incremental: self.incremental }),
            Id::Jog => way().map(|(axis, way)| Motion::Jog { axis, way }),
            Id::Home => {
                way().map(|(axis, way)| Motion::Home { axis, way, mode: line.index.map(usize::from) })
            }
            Id::IndexMove => way().map(|(axis, way)| Motion::Home { axis, way, mode: None }),
            Id::Circle => curve(End::Circle, None),
            Id::CircleHelix => curve(End::Circle, Some(third)),
            Id::Arc => curve(End::Angle(third), None),
            Id::ArcHelix => curve(End::Angle(third), Some(fourth)),
            _ => None,
        }
    }

    /// Stores the settings. Without a supply nobody is told anything any more.
    pub fn store(&mut self) {
        if self.memory.store().is_err() {
            self.die();
        }
    }
}
