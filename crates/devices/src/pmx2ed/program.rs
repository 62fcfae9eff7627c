//! The standalone programs in time: when their next lines are due, their waits, and what they do to the
//! controller (manual, sections 7.19 and 10).

use super::motion::Halt;
use super::table::{AXIS_COUNT, COMMANDS, Id};
use super::{MILLISECOND, Pmx2ed, polarity};
use crate::ascii::{Refusal, command::Id as _};
use crate::board::Board;
use crate::controller::{ProgramRun, ProgramState};
use crate::flash::Flash;
use ::motion::{Direction, Ticks};
use ascript::dialect::PERFORMAX_2;
use ascript::isa::{self, Place, Word};
use ascript::line::Line;
use ascript::vm::{Action, Exit, State, Thread};

/// Programs that a host starts and stops.
const PROGRAMS: usize = PERFORMAX_2.threads as usize;

/// The thread of subroutines that a host starts by `GS`.
const HOST: usize = PROGRAMS;

/// Lines that are executed at most before anything else is looked at.
const MAX_BATCH: u64 = 1 << 20;

/// What a thread waits for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Hold {
    /// The end of an axis' motion.
    Axis(usize),
    /// A clock.
    Until(Ticks),
}

/// A thread in time.
struct Timed {
    thread: Thread,
    /// When its next line is executed.
    next_at: Ticks,
    hold: Option<Hold>,
}

impl Timed {
    /// Whether lines are executed.
    fn goes(&self) -> bool {
        self.thread.state() == State::Running && self.hold.is_none()
    }

    fn is_active(&self) -> bool {
        matches!(self.thread.state(), State::Running | State::Paused)
    }

    fn stop(&mut self) {
        self.thread.stop();
        self.hold = None;
    }

    fn start(&mut self, line: u16, now: Ticks) {
        self.thread.start(line);
        self.next_at = now;
        self.hold = None;
    }
}

/// The threads: programs 0 and 1, and that of the host.
pub struct Programs {
    threads: [Timed; PROGRAMS + 1],
}

impl Programs {
    pub fn new() -> Self {
        let thread = || Timed { thread: Thread::new(), next_at: 0, hold: None };
        Self { threads: core::array::from_fn(|_| thread()) }
    }
}

impl<F: Flash> Pmx2ed<F> {
    /// The thread whose next line is due first, and when.
    pub fn next_program(&self) -> Option<(Ticks, usize)> {
        let threads = self.programs.threads.iter().enumerate().filter(|(_, timed)| timed.goes());
        threads.map(|(number, timed)| (timed.next_at.max(self.now), number)).min()
    }

    /// When the first delay is over.
    pub fn delay_due(&self) -> Option<Ticks> {
        let until = |timed: &Timed| match timed.hold {
            Some(Hold::Until(clock)) => Some(clock),
            _ => None,
        };
        self.programs.threads.iter().filter_map(until).min()
    }

    /// Runs a thread until `horizon`, before which nothing else happens, or until it has done something
    /// after which the horizon may be another. Time stands at its next line.
    pub fn run_program(&mut self, number: usize, horizon: Ticks, board: &mut dyn Board) {
        let at = self.now;
        // Another thread has its turn in between.
        let others =
            self.programs.threads.iter().enumerate().filter(|(other, it)| *other != number && it.goes());
        let horizon = others.map(|(_, timed)| timed.next_at.max(at)).fold(horizon, Ticks::min);
        let budget = ((horizon - at) / self.line_clocks + 1).min(MAX_BATCH) as u32;
        let timed = &mut self.programs.threads[number];
        let (executed, exit) = timed.thread.run(&mut self.memory.program, budget);
        timed.next_at = at + Ticks::from(executed) * self.line_clocks;
        match exit {
            Exit::Budget | Exit::Idle | Exit::Stopped => {}
            Exit::Read(place) => {
                let clock = timed.next_at;
                self.step_to(clock, board);
                let value = register(place).map_or(0, |(id, place)| self.read(id, place, board));
                self.programs.threads[number].thread.complete(value);
            }
            Exit::Write(place, value) => {
                let clock = timed.next_at - self.line_clocks;
                self.step_to(clock, board);
                // What a host would be refused changes nothing here either.
                let _ = self.write_register(place, value, board);
                self.programs.threads[number].thread.done();
                self.react(board);
            }
            Exit::Do(action) => {
                let clock = timed.next_at - self.line_clocks;
                self.step_to(clock, board);
                self.perform(number, action, board);
                self.react(board);
            }
            Exit::Fault(_) => self.fail(number),
        }
    }

    fn write_register(&mut self, place: Place, value: i32, board: &mut dyn Board) -> Result<(), Refusal> {
        let (id, place) = register(place).ok_or(Refusal::Unknown)?;
        let range = COMMANDS[id.position()].value.range();
        if !range.is_some_and(|(low, high)| (low..=high).contains(&value)) {
            return Err(Refusal::Value);
        }
        self.write(id, place, value, board)
    }

    /// Does what a line says.
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
            self.programs.threads[number].thread.done();
        }
    }

    fn hold(&mut self, number: usize, hold: Hold) {
        self.programs.threads[number].hold = Some(hold);
        self.end_waits();
    }

    /// Ends the waits that are over.
    pub fn end_waits(&mut self) {
        for number in 0..self.programs.threads.len() {
            let next_at = match self.programs.threads[number].hold {
                // Whether an axis stands is looked at line by line.
                Some(Hold::Axis(axis)) if self.is_done(axis) => self.now + self.line_clocks,
                Some(Hold::Until(clock)) if clock <= self.now => self.now,
                _ => continue,
            };
            let timed = &mut self.programs.threads[number];
            timed.hold = None;
            timed.thread.done();
            timed.next_at = timed.next_at.max(next_at);
        }
    }

    /// An error of an axis is one of the program that set it in motion, else of the first that runs
    /// (manual, 7.19.5).
    pub fn program_error(&mut self, axis: usize) {
        let active = |number: &usize| self.programs.threads[*number].is_active();
        let mover = self.stations[axis].program.filter(active);
        if let Some(number) = mover.or_else(|| (0..self.programs.threads.len()).find(active)) {
            self.fail(number);
        }
    }

    /// To the error subroutine, or into the error state.
    fn fail(&mut self, number: usize) {
        let restart = self.polarity(0) & polarity::RESTART != 0;
        let timed = &mut self.programs.threads[number];
        timed.thread.fail(&self.memory.program, restart);
        timed.hold = None;
        timed.next_at = timed.next_at.max(self.now);
    }

    /// `SR`: 0 stop, 1 start, 2 pause, 3 continue.
    pub fn control_program(&mut self, number: usize, control: i32) -> Result<(), Refusal> {
        let timed = &mut self.programs.threads[number];
        match control {
            0 => timed.stop(),
            1 if timed.thread.state() == State::Running => {}
            1 => timed.start(self.memory.program.program(number as u8).ok_or(Refusal::State)?, self.now),
            2 => timed.thread.pause(),
            _ => {
                timed.thread.resume();
                timed.next_at = timed.next_at.max(self.now);
            }
        }
        Ok(())
    }

    /// `GS`: a subroutine by itself.
    pub fn run_subroutine(&mut self, number: u16) -> Result<(), Refusal> {
        let line = self.memory.program.subroutine(number as u8).ok_or(Refusal::NoSubroutine)?;
        let timed = &mut self.programs.threads[HOST];
        if timed.is_active() {
            return Err(Refusal::State);
        }
        timed.start(line, self.now);
        Ok(())
    }

    /// Starts the programs that run at power-up.
    pub fn boot_programs(&mut self) {
        let mask = self.memory.cells.get(Id::RunOnBoot);
        for number in (0..PROGRAMS).filter(|number| mask >> number & 1 != 0) {
            // A program that is not there does not start.
            let _ = self.control_program(number, 1);
        }
    }

    /// `SA`: a line of the program; it is in flash when this returns.
    pub fn download(&mut self, number: u16, text: &str) -> Result<(), Refusal> {
        let line = Line::parse(text, &PERFORMAX_2).ok_or(Refusal::Value)?;
        if self.memory.set_line(number, line).is_err() {
            self.die();
        }
        Ok(())
    }

    /// `SASTAT`.
    pub fn program_status(&self, number: usize) -> i32 {
        self.programs.threads[number].thread.state() as i32
    }

    /// `SPC`.
    pub fn program_counter(&self, number: usize) -> i32 {
        self.programs.threads[number].thread.counter().into()
    }

    /// A program, for views.
    pub fn program_state(&self, number: usize) -> Option<ProgramState> {
        let thread = &self.programs.threads[..PROGRAMS].get(number)?.thread;
        let run = match thread.state() {
            State::Idle => ProgramRun::Idle,
            State::Running => ProgramRun::Running,
            State::Paused => ProgramRun::Paused,
            State::Error => ProgramRun::Error,
        };
        Some(ProgramState { run, counter: thread.counter().into(), instructions: thread.instructions() })
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
