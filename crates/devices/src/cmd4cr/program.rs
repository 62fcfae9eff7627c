//! What the standalone programs do to the controller (manual, 2.7 and table 5-42).

use super::buffer;
use super::motion::{Motion, axes_in};
use super::path::Curve;
use super::refusal::Refusal;
use super::table::{AXIS_COUNT, COMMANDS, Id, JOYSTICK_AXES};
use super::{Cmd4cr, milliseconds};
use crate::ascii::clock::Programmed;
use crate::ascii::command::Id as _;
use crate::ascii::station::Halt;
use crate::ascii::threads::{Hold, Threads};
use crate::board::Board;
use crate::flash::Flash;
use ::motion::path::{End, Turn};
use ::motion::{Direction, Ticks};
use ascript::dialect::COMMANDER;
use ascript::isa::{self, Place, Word};
use ascript::line::Line;
use ascript::vm::{Action, Exit, State};

/// Programs that a host starts and stops.
pub const PROGRAMS: usize = COMMANDER.threads as usize;

/// The programs' threads and that of the host.
pub const THREADS: usize = PROGRAMS + 1;

impl<F: Flash> Programmed<THREADS> for Cmd4cr<F> {
    fn threads(&mut self) -> &mut Threads<THREADS> {
        &mut self.programs
    }

    fn put_out_last(&self) -> [u32; 3] {
        self.latches()
    }

    fn poll_status(&mut self, axis: usize) -> Ticks {
        self.stations[axis].poll(&self.axes[axis]).unwrap_or(self.now)
    }

    fn next_program(&self) -> Option<(Ticks, usize)> {
        self.programs.next(self.now)
    }

    fn run_thread(&mut self, number: usize, horizon: Ticks) -> (Ticks, Exit) {
        self.programs.run(number, &mut self.memory.program, self.now, horizon)
    }

    fn read_register(&self, place: Place, board: &mut dyn Board) -> i32 {
        register(place).map_or(0, |(id, place)| self.read(id, place, board))
    }

    fn write_register(&mut self, place: Place, value: i32, board: &mut dyn Board) {
        // What a host would be refused changes nothing here either.
        let _ = self.set_register(place, value, board);
    }

    fn perform(&mut self, number: usize, action: Action, board: &mut dyn Board) {
        let axis = action.axis.map(usize::from);
        let which = axis.unwrap_or(0);
        if let Some(motion) = motion(&action, self.incremental) {
            let moved = self.command(motion, Some(number), board);
            return self.after_motion(number, motion.axes(), moved);
        }
        match action.word {
            Word::Delay => {
                let span = milliseconds(Ticks::from(action.arguments[0] as u32));
                return self.hold(number, Hold::Until(self.now + span));
            }
            Word::Wait => return self.hold(number, Hold::Axis(which)),
            Word::IStart => {
                let started = self.buffer_start(Some(number), board);
                return self.after_motion(number, buffer::MOVABLE, started);
            }
            Word::BufOn => {
                // What a host would be refused changes nothing here either.
                let _ = self.buffer_on();
            }
            Word::BufOff => self.buffer_off(),
            Word::Abort | Word::AbortAxis => {
                let _ = self.stop(axis, Halt::AtOnce);
            }
            Word::Stop | Word::StopAxis => {
                let _ = self.stop(axis, Halt::Ramp);
            }
            Word::Abs => self.incremental = false,
            Word::Inc => self.incremental = true,
            Word::Eclear => self.clear(which, board),
            Word::Store => self.store(),
            Word::SynOn => self.sync_on(which, false, board),
            Word::SynOff => self.sync_off(which, board),
            Word::Sr if action.index == number as u8 && action.arguments[0] == 0 => {
                self.programs.stop_itself(number);
            }
            Word::Sr => {
                // A program that is not there does not start.
                let _ = self.control_program(action.index.into(), action.arguments[0]);
            }
            // Other words are not of this dialect; lines with them cannot be downloaded.
            _ => {}
        }
        self.programs.done(number);
    }

    fn fail(&mut self, number: usize) {
        let restart = self.memory.cells.get(Id::ReturnRule) != 0;
        self.programs.fail(number, &self.memory.program, restart, self.now);
    }
}

impl<F: Flash> Cmd4cr<F> {
    fn set_register(&mut self, place: Place, value: i32, board: &mut dyn Board) -> Result<(), Refusal> {
        let (id, place) = register(place).ok_or(Refusal::Unknown)?;
        let range = COMMANDS[id.position()].value.range();
        if !range.is_some_and(|(low, high)| (low..=high).contains(&value)) {
            return Err(Refusal::Index);
        }
        self.write(id, place, value, board)
    }

    /// A motion that an error of an axis forbids is an error of the program. One for which the buffer has no
    /// room waits. Any other refusal is passed over: the manual's examples move axes that may still be moving.
    fn after_motion(&mut self, number: usize, axes: u8, moved: Result<(), Refusal>) {
        let barred = |axis: usize| self.is_barred(axis) || self.stations[axis].closed.status().is_error();
        match moved {
            Err(Refusal::BufferFull) => self.programs.retry(number),
            Err(Refusal::Moving) if !axes_in(axes).any(barred) => self.programs.done(number),
            Ok(()) | Err(Refusal::BufferEnabled | Refusal::BufferDisabled) => self.programs.done(number),
            Err(_) => self.fail(number),
        }
    }

    fn hold(&mut self, number: usize, hold: Hold) {
        self.programs.hold(number, hold);
        self.end_waits();
    }

    /// Ends the waits that are over.
    pub fn end_waits(&mut self) {
        let done: [bool; AXIS_COUNT] = core::array::from_fn(|axis| self.is_done(axis));
        self.programs.end_waits(self.now, |axis| done[axis]);
    }

    /// An error of an axis is one of the program that set it in motion, else of the first that runs
    /// (manual, 2.7.5).
    pub fn program_error(&mut self, axis: usize) {
        if let Some(number) = self.programs.responsible(self.stations[axis].program) {
            self.fail(number);
        }
    }

    /// `SACTRL`, `SR`: 0 stop, 1 start, 2 pause, 3 continue. A program in its error state has to be stopped
    /// first.
    pub fn control_program(&mut self, number: usize, control: i32) -> Result<(), Refusal> {
        if control != 0 && self.programs.state(number) == State::Error {
            return Err(Refusal::Program);
        }
        let known = self.programs.control(number, control, &self.memory.program, self.now);
        if known { Ok(()) } else { Err(Refusal::Program) }
    }

    /// `GS`: a subroutine by itself.
    pub fn run_subroutine(&mut self, number: u16) -> Result<(), Refusal> {
        let line = self.memory.program.subroutine(number as u8).ok_or(Refusal::NoSubroutine)?;
        if self.programs.call(line, self.now) { Ok(()) } else { Err(Refusal::Program) }
    }

    /// Starts the programs that run at power-up.
    pub fn boot_programs(&mut self) {
        let mask = self.memory.cells.get(Id::RunOnBoot);
        self.programs.boot(mask, &self.memory.program, self.now);
    }

    /// `SA`: a line of the program; it is in flash when this returns.
    pub fn download(&mut self, number: u16, text: &str) -> Result<(), Refusal> {
        let line = Line::parse(text, &COMMANDER).ok_or(Refusal::Index)?;
        if self.memory.set_line(number, line).is_err() {
            self.die();
        }
        Ok(())
    }
}

/// The motion that a statement asks for.
fn motion(action: &Action, incremental: bool) -> Option<Motion> {
    let axis = action.axis.map_or(0, usize::from);
    let second = action.second_axis.map_or(1, usize::from);
    let (way, turn) = match action.direction {
        Some(isa::Direction::Minus) => (Direction::Negative, Turn::CounterClockwise),
        _ => (Direction::Positive, Turn::Clockwise),
    };
    let [one, two, three, four] = action.arguments;
    let curve = |axes, end, rise| Motion::Curve(Curve { axes, turn, centre: [one, two], end, rise });
    Some(match action.word {
        Word::X | Word::Y | Word::Z | Word::U | Word::Linear => {
            Motion::To { targets: action.targets, incremental }
        }
        Word::Jog => Motion::Jog { axis, way },
        Word::Home => Motion::Home { axis, way, mode: Some(one as usize) },
        Word::ZMove => Motion::Home { axis, way, mode: None },
        Word::Cir => curve([axis, second], End::Circle, None),
        Word::Arc => curve([axis, second], End::Angle(three), None),
        Word::CirT => curve([0, 1], End::Circle, Some(three)),
        Word::ArcT => curve([0, 1], End::Angle(three), Some(four)),
        _ => return None,
    })
}

/// The command that is the same as a register of the language, and its place.
fn register(place: Place) -> Option<(Id, Option<usize>)> {
    let axis = place.axis().map(usize::from);
    // The others have no joystick.
    let stick = axis.filter(|&axis| axis < JOYSTICK_AXES);
    // Bits are numbered from 1.
    let bit = usize::from(place.index).checked_sub(1);
    Some(match place.word {
        Word::Hspd | Word::HspdAxis => (Id::HighSpeed, axis),
        Word::Lspd | Word::LspdAxis => (Id::LowSpeed, axis),
        Word::Acc | Word::AccAxis => (Id::Acceleration, axis),
        Word::Dec | Word::DecAxis => (Id::Deceleration, axis),
        Word::Sspd => (Id::SetSpeed, axis),
        Word::SspdM => (Id::SpeedMode, axis),
        Word::P => (Id::Position, axis),
        Word::E => (Id::Encoder, axis),
        Word::Ps => (Id::PulseSpeed, axis),
        Word::Mst => (Id::Status, axis),
        Word::Di => (Id::Inputs, None),
        Word::DiBit => (Id::Input, bit),
        Word::Do => (Id::Outputs, None),
        Word::DoBit => (Id::Output, bit),
        Word::Eo => (Id::Enables, None),
        Word::EoBit => (Id::Enable, bit),
        Word::Ai => (Id::Analog, bit),
        Word::Io => (Id::Ports, None),
        Word::IoBit => (Id::Port, bit),
        Word::Eint => (Id::Interpolation, None),
        Word::Sl => (Id::Loop, axis),
        Word::Sls => (Id::LoopStatus, axis),
        Word::JoyEna => (Id::JoystickMask, None),
        Word::JoyHs => (Id::JoystickSpeed, Some(stick?)),
        Word::JoyDel => (Id::JoystickChange, Some(stick?)),
        Word::SynCfg => (Id::Sync, axis),
        Word::SynPos => (Id::SyncPosition, axis),
        Word::SynStat => (Id::SyncStatus, axis),
        Word::MpgE => (Id::PulserEnable, axis),
        Word::Pwm => (Id::Duty, bit),
        Word::Lt => (Id::Latch, axis),
        Word::Lts => (Id::LatchStatus, axis),
        Word::Lte => (Id::LatchedEncoder, axis),
        Word::Ltp => (Id::LatchedPosition, axis),
        _ => return None,
    })
}
