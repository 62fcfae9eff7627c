//! How time passes in a device of this language: from one thing that happens to the next, and line by line
//! through its programs.

use super::parse::MAX_AXES;
use super::threads::Threads;
use crate::board::Board;
use ascript::isa::Place;
use ascript::vm::{Action, Exit};
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
pub trait Programmed<const N: usize>: Clocked {
    /// Its threads.
    fn threads(&mut self) -> &mut Threads<N>;

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

    /// Runs a thread until `horizon`, before which nothing else happens, or until it has done something
    /// after which the horizon may be another. Time stands at its next line.
    fn run_program(&mut self, number: usize, horizon: Ticks, board: &mut dyn Board) {
        let (clock, exit) = self.run_thread(number, horizon);
        match exit {
            Exit::Budget | Exit::Idle | Exit::Stopped => {}
            Exit::Read(place) => {
                self.step_to(clock, board);
                let value = self.read_register(place, board);
                self.threads().complete(number, value);
            }
            Exit::Write(place, value) => {
                self.step_to(clock, board);
                self.write_register(place, value, board);
                self.threads().done(number);
                self.react(board);
            }
            Exit::Do(action) => {
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

    /// Lets time pass until `now`, or until a window ends or may be another; the clock that was reached.
    /// A device whose supply goes meanwhile stays where it is.
    fn pass(&mut self, now: Ticks, board: &mut dyn Board) -> Ticks {
        let outside = self.outside();
        loop {
            let horizon = self.due().min(now);
            let axes = self.axes();
            let before: heapless::Vec<_, MAX_AXES> = axes.iter().map(Axis::odometer).collect();
            match self.next_program().filter(|&(clock, _)| clock <= horizon) {
                Some((clock, thread)) => {
                    self.step_to(clock, board);
                    if !at_window(self.axes(), &before) {
                        self.run_program(thread, horizon, board);
                    }
                }
                None => self.step_to(horizon, board),
            }
            if self.is_dead() || at_window(self.axes(), &before) || self.outside() != outside {
                return self.now();
            }
            let idle = self.next_program().is_none_or(|(clock, _)| clock > now);
            if self.now() == now && idle && self.due() > now {
                return now;
            }
        }
    }
}

/// Whether an axis has arrived at an edge of its window since its odometer was this.
fn at_window(axes: &[Axis], before: &[i64]) -> bool {
    axes.iter().zip(before).any(|(axis, before)| axis.odometer() != *before && axis.at_window())
}
