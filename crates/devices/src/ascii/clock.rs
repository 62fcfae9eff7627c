//! How time passes in a device of this language: from one thing that happens to the next, and line by line
//! through its programs.

use super::parse::MAX_AXES;
use super::threads::Threads;
use crate::board::Board;
use crate::controller::Controller;
use ascript::isa::{Place, Word};
use ascript::vm::{Action, Exit, State};
use motion::{Axis, Ticks};

/// A device as its clock sees it.
pub trait Clocked {
    /// What the windows of its axes depend on.
    type Outside: PartialEq;

    /// The clock that it has come to.
    fn now(&self) -> Ticks;

    /// Its supply is gone: nothing happens any more.
    fn is_dead(&self) -> bool;

    /// Its axes.
    fn axes(&self) -> &[Axis];

    /// Driver stages, and the inputs and encoders that matter now.
    fn outside(&self) -> Self::Outside;

    /// The next clock at which something is due, programs left out; not in the past.
    fn due(&self) -> Ticks;

    /// Lets the axes run to a clock and sees to what has changed there.
    fn step_to(&mut self, clock: Ticks, board: &mut dyn Board);

    /// Sees to whatever follows from the present state.
    fn react(&mut self, board: &mut dyn Board);
}

/// A device with programs in so many threads.
pub trait Programmed<const N: usize>: Clocked + Controller {
    /// Its threads.
    fn threads(&mut self) -> &mut Threads<N>;

    /// What was put out last: digital outputs, configurable ones, motor power.
    fn put_out_last(&self) -> [u32; 3];

    /// The thread whose next line is due first, and when.
    fn next_program(&self) -> Option<(Ticks, usize)>;

    /// [`Threads::run`] with its memory.
    fn run_thread(&mut self, number: usize, horizon: Ticks) -> (Ticks, Exit);

    /// The value of a register.
    fn read_register(&self, place: Place, board: &mut dyn Board) -> i32;

    /// Sets a register. What a host would be refused changes nothing.
    fn write_register(&mut self, place: Place, value: i32, board: &mut dyn Board);

    /// Does what a line says.
    fn perform(&mut self, number: usize, action: Action, board: &mut dyn Board);

    /// An error of a thread.
    fn fail(&mut self, number: usize);

    /// Until when a register that is not an input or output holds its value if nothing happens, while axes move; now
    /// if that is not known.
    fn holds_until(&mut self, place: Place) -> Ticks {
        let axis = place.axis().filter(|_| place.word == Word::Mst);
        axis.map_or(self.now(), |axis| self.poll_status(axis.into()))
    }

    /// A program looks at the status of an axis: its inputs matter then. Until when the status stays as it is if
    /// nothing happens; now if that is not known.
    fn poll_status(&mut self, axis: usize) -> Ticks;

    /// Whether this starts a program that runs, which changes nothing.
    fn is_started(&mut self, action: &Action) -> bool {
        let number = usize::from(action.index);
        action.word == Word::Sr
            && action.arguments[0] == 1
            && number < N
            && self.threads().state(number) == State::Running
    }

    /// Runs a thread until `horizon`, before which nothing else happens, or until it has done something
    /// after which the horizon may be another. Time stands at its next line.
    fn run_program(&mut self, number: usize, horizon: Ticks, board: &mut dyn Board) {
        let (clock, exit) = self.run_thread(number, horizon);
        match exit {
            Exit::Budget | Exit::Idle => {}
            Exit::Stopped => self.step_to(clock, board),
            Exit::Read(place) => {
                self.step_to(clock, board);
                let value = self.read_register(place, board);
                self.threads().complete(number, value);
                if self.is_moving() && !is_input_or_output(place) {
                    let until = self.holds_until(place);
                    self.threads().limit_rounds(until);
                }
            }
            Exit::Write(place, value) => {
                self.step_to(clock, board);
                let before = self.put_out_last();
                self.write_register(place, value, board);
                self.threads().done(number);
                if !is_input_or_output(place) || self.put_out_last() != before {
                    self.threads().forget_rounds();
                }
                self.react(board);
            }
            Exit::Do(action) => {
                if !self.is_started(&action) {
                    self.threads().forget_rounds();
                }
                self.step_to(clock, board);
                self.perform(number, action, board);
                self.react(board);
            }
            Exit::Fault(_) => self.fail(number),
        }
    }

    /// When something is due. A program has something to do all the time: that is looked after every so many
    /// clocks.
    fn next_look(&self, every: Ticks) -> Ticks {
        let program = self.next_program().map_or(Ticks::MAX, |(at, _)| at.max(self.now() + every));
        self.due().min(program)
    }

    /// Lets time pass until `now`, or until a window ends or may be another, or a program ends; the clock that was
    /// reached.
    /// A device whose supply goes meanwhile stays where it is.
    fn pass(&mut self, now: Ticks, board: &mut dyn Board) -> Ticks {
        let outside = self.outside();
        self.threads().forget_rounds();
        self.threads().gate.look();
        let active = self.threads().active();
        loop {
            let due = self.due();
            let horizon = due.min(now);
            let axes = Clocked::axes(self);
            let before: heapless::Vec<_, MAX_AXES> = axes.iter().map(Axis::odometer).collect();
            let next = self.next_program().filter(|&(clock, _)| clock <= horizon);
            if next.is_none_or(|(clock, _)| clock >= due) {
                self.threads().forget_rounds();
            }
            let mut stale = false;
            match next {
                Some((clock, thread)) => {
                    self.step_to(clock, board);
                    if !at_window(Clocked::axes(self), &before) {
                        if self.threads().is_held(thread) {
                            let stale = self.threads().active() < active || self.outside() != outside;
                            self.threads().gate.hold(stale);
                            return self.now();
                        }
                        stale = self.threads().gate.pass();
                        // What is due in a clock comes before a line in it.
                        let last = if due > now { now } else { due.saturating_sub(1).max(clock) };
                        self.run_program(thread, last, board);
                    }
                }
                None => self.step_to(horizon, board),
            }
            let stale = stale || self.threads().active() < active;
            if self.is_dead() || stale || at_window(Clocked::axes(self), &before) || self.outside() != outside
            {
                return self.now();
            }
            let idle = self.next_program().is_none_or(|(clock, _)| clock > now);
            if self.now() == now && idle && self.due() > now {
                return now;
            }
        }
    }
}

/// Whether a register shows inputs or outputs, which stay as they are between two things that happen.
const fn is_input_or_output(place: Place) -> bool {
    use Word::{Di, DiBit, Do, DoBit, Eo, EoBit, Io, IoBit};
    matches!(place.word, Di | DiBit | Do | DoBit | Eo | EoBit | Io | IoBit)
}

/// Whether an axis has arrived at an edge of its window since its odometer was this.
fn at_window(axes: &[Axis], before: &[i64]) -> bool {
    axes.iter().zip(before).any(|(axis, before)| axis.odometer() != *before && axis.at_window())
}
