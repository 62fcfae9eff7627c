//! The standalone programs in time: when their next lines are due, their waits, and what they do to the
//! controller (manual, sections 7.19 and 10).

use super::refusal::Refusal;
use super::table::{AXIS_COUNT, COMMANDS, Id};
use super::{MILLISECOND, Pmx2ed, polarity};
use crate::ascii::clock::Programmed;
use crate::ascii::command::Id as _;
use crate::ascii::station::Halt;
use crate::ascii::threads::{Hold, Threads};
use crate::board::Board;
use crate::flash::Flash;
use ::motion::{Direction, Ticks};
use ascript::dialect::PERFORMAX_2;
use ascript::isa::{self, Place, Word};
use ascript::line::Line;
use ascript::vm::{Action, Exit};

/// Programs that a host starts and stops.
const PROGRAMS: usize = PERFORMAX_2.threads as usize;

/// The programs' threads and that of the host.
pub const THREADS: usize = PROGRAMS + 1;

impl<F: Flash> Programmed<THREADS> for Pmx2ed<F> {
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
        let way = match action.direction {
            Some(isa::Direction::Minus) => Direction::Negative,
            _ => Direction::Positive,
        };
        let which = axis.unwrap_or(0);
        let by = Some(number);
        let moved = match action.word {
            Word::Delay => {
                let span = Ticks::from(action.arguments[0] as u32) * MILLISECOND;
                return self.hold(number, Hold::Until(self.now + span));
            }
            Word::Wait => return self.hold(number, Hold::Axis(which)),
            Word::X | Word::Y | Word::Linear => {
                self.move_to([action.targets[0], action.targets[1]], by, board)
            }
            Word::Jog => self.jog(axis, way, by),
            Word::Home => self.home(Id::Home, which, way, by, board),
            Word::HlHome => self.home(Id::HomeLow, which, way, by, board),
            Word::LHome => self.home(Id::LimitHome, which, way, by, board),
            Word::ZHome => self.home(Id::HomeIndex, which, way, by, board),
            Word::Zome => self.home(Id::IndexHome, which, way, by, board),
            word => {
                match word {
                    Word::Abort | Word::AbortAxis => self.stop(axis, Halt::AtOnce),
                    Word::Stop | Word::StopAxis => self.stop(axis, Halt::Ramp),
                    Word::Abs => self.incremental = false,
                    Word::Inc => self.incremental = true,
                    Word::Eclear => {
                        self.clear(which, board);
                        self.wire.heard(self.now);
                    }
                    Word::Store => self.store(),
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
                Ok(())
            }
        };
        // A motion that an error of the axis forbids is an error of the program. Any other refusal is
        // passed over: the manual's examples move axes that may still be moving.
        let axes = [Some(which), action.targets[1].map(|_| 1)];
        let barred = |axis: usize| {
            let station = &self.stations[axis];
            station.errors.contains(&true) || station.closed.status().is_error()
        };
        if moved.is_err() && axes.into_iter().flatten().any(barred) {
            self.fail(number);
        } else {
            self.programs.done(number);
        }
    }

    fn fail(&mut self, number: usize) {
        let restart = self.polarity(0) & polarity::RESTART != 0;
        self.programs.fail(number, &self.memory.program, restart, self.now);
    }
}

impl<F: Flash> Pmx2ed<F> {
    fn set_register(&mut self, place: Place, value: i32, board: &mut dyn Board) -> Result<(), Refusal> {
        let (id, place) = register(place).ok_or(Refusal::Unknown)?;
        let range = COMMANDS[id.position()].value.range();
        if !range.is_some_and(|(low, high)| (low..=high).contains(&value)) {
            return Err(Refusal::Value);
        }
        self.write(id, place, value, board)
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
    /// (manual, 7.19.5).
    pub fn program_error(&mut self, axis: usize) {
        if let Some(number) = self.programs.responsible(self.stations[axis].program) {
            self.fail(number);
        }
    }

    /// `SR`: 0 stop, 1 start, 2 pause, 3 continue.
    pub fn control_program(&mut self, number: usize, control: i32) -> Result<(), Refusal> {
        let known = self.programs.control(number, control, &self.memory.program, self.now);
        if known { Ok(()) } else { Err(Refusal::State) }
    }

    /// `GS`: a subroutine by itself.
    pub fn run_subroutine(&mut self, number: u16) -> Result<(), Refusal> {
        let line = self.memory.program.subroutine(number as u8).ok_or(Refusal::NoSubroutine)?;
        if self.programs.call(line, self.now) { Ok(()) } else { Err(Refusal::State) }
    }

    /// Starts the programs that run at power-up.
    pub fn boot_programs(&mut self) {
        let mask = self.memory.cells.get(Id::RunOnBoot);
        self.programs.boot(mask, &self.memory.program, self.now);
    }

    /// `SA`: a line of the program; it is in flash when this returns.
    pub fn download(&mut self, number: u16, text: &str) -> Result<(), Refusal> {
        let line = Line::parse(text, &PERFORMAX_2).ok_or(Refusal::Value)?;
        if self.memory.set_line(number, line).is_err() {
            self.die();
        }
        Ok(())
    }
}

/// The command that is the same as a register of the language, and its place.
fn register(place: Place) -> Option<(Id, Option<usize>)> {
    let axis = place.axis().map(usize::from);
    // Bits are numbered from 1.
    let bit = usize::from(place.index).checked_sub(1);
    let of_axis = |first: usize| axis.map(|axis| first + axis);
    let limit = |side: usize| axis.map(|axis| super::joystick::limit_place(axis, side));
    Some(match place.word {
        Word::Hspd | Word::HspdAxis => (Id::HighSpeed, axis),
        Word::Lspd | Word::LspdAxis => (Id::LowSpeed, axis),
        Word::Acc | Word::AccAxis => (Id::Acceleration, axis),
        Word::Dec | Word::DecAxis => (Id::Deceleration, axis),
        Word::Scv => (Id::SCurve, axis),
        Word::Sspd => (Id::SetSpeed, axis),
        Word::SspdM => (Id::SpeedMode, axis),
        Word::P => (Id::Position, axis),
        Word::E => (Id::Encoder, axis),
        Word::Ps => (Id::PulseSpeed, axis),
        Word::Mst => (Id::Status, axis),
        Word::Di => (Id::Inputs, None),
        Word::DiBit => (Id::Inputs, bit),
        Word::Do => (Id::Outputs, None),
        Word::DoBit => (Id::Output, bit),
        Word::Eo => (Id::Enables, None),
        Word::EoBit => (Id::Enable, bit),
        Word::Ai => (Id::Analog, bit),
        Word::Sl => (Id::Loop, axis),
        Word::Sls => (Id::LoopStatus, axis),
        Word::Toc => (Id::TimeOut, None),
        Word::JoyEna => (Id::JoystickMask, None),
        Word::JoyHs => (Id::JoystickValues, of_axis(super::joystick::SPEEDS)),
        Word::JoyDel => (Id::JoystickValues, of_axis(super::joystick::CHANGES)),
        Word::JoyTol => (Id::JoystickValues, of_axis(super::joystick::TOLERANCES)),
        Word::JoyNo => (Id::JoystickLimits, limit(0)),
        Word::JoyNi => (Id::JoystickLimits, limit(1)),
        Word::JoyPi => (Id::JoystickLimits, limit(2)),
        Word::JoyPo => (Id::JoystickLimits, limit(3)),
        _ => return None,
    })
}

const _: () = assert!(AXIS_COUNT == 2, "moves have two targets");
