//! Standalone programs in time: when their next lines are due and what they wait for.
//!
//! A thread is taken up one batch of lines at a time ([`Threads::run`]); what a line says is the device's
//! business, which then calls [`Threads::complete`], [`Threads::done`] or [`Threads::hold`].

use crate::controller::{ProgramRun, ProgramState};
use crate::gate::Gate;
#[cfg(feature = "std")]
use crate::rounds::Rounds;
#[cfg(feature = "std")]
use ascript::vm::Situation;
use ascript::vm::{Exit, Memory, State, Thread};
use motion::Ticks;

/// Lines that are executed at most before anything else is looked at.
const MAX_BATCH: u64 = 1 << 20;

/// How long a compiled line takes: so many clocks by so many, because 100 µs need not be whole clocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LineTime {
    /// Clocks of so many lines.
    pub clocks: Ticks,
    /// How many lines.
    pub lines: Ticks,
}

impl LineTime {
    /// Lines of `micros` microseconds on a clock of `hz`.
    pub const fn of_micros(micros: u32, hz: u32) -> Self {
        Self { clocks: micros as Ticks * hz as Ticks, lines: 1_000_000 }.reduced()
    }

    /// The same with the smallest numbers.
    const fn reduced(self) -> Self {
        let (mut divisor, mut rest) = (self.clocks, self.lines);
        while rest > 0 {
            (divisor, rest) = (rest, divisor % rest);
        }
        Self { clocks: self.clocks / divisor, lines: self.lines / divisor }
    }
}

/// What a thread waits for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hold {
    /// The end of an axis' motion.
    Axis(usize),
    /// A clock.
    Until(Ticks),
}

/// A thread in time.
#[derive(Debug)]
struct Timed {
    thread: Thread,
    /// When its next line is executed, in parts of a clock: [`LineTime::lines`] of them are one.
    next_at: Ticks,
    hold: Option<Hold>,
    /// When an error came last.
    failed_at: Option<Ticks>,
}

impl Timed {
    /// Whether lines are executed.
    fn goes(&self) -> bool {
        self.thread.state() == State::Running && self.hold.is_none()
    }

    fn is_active(&self) -> bool {
        matches!(self.thread.state(), State::Running | State::Paused)
    }

    fn start(&mut self, line: u16, parts: Ticks) {
        self.thread.start(line);
        self.next_at = parts;
        self.hold = None;
        self.failed_at = None;
    }
}

/// The threads of a device: its programs, and last that of the subroutines that a host starts.
#[derive(Debug)]
pub struct Threads<const N: usize> {
    threads: [Timed; N],
    line: LineTime,
    /// What a debugger lets through.
    pub gate: Gate,
    /// Of the thread with this number.
    #[cfg(feature = "std")]
    rounds: Rounds<(usize, Situation)>,
}

impl<const N: usize> Threads<N> {
    /// The thread of the host's subroutines.
    pub const HOST: usize = N - 1;

    /// Threads that do nothing.
    pub const fn new(line: LineTime) -> Self {
        let threads = [const { Timed { thread: Thread::new(), next_at: 0, hold: None, failed_at: None } }; N];
        Self {
            threads,
            line,
            gate: Gate::OPEN,
            #[cfg(feature = "std")]
            rounds: Rounds::new(),
        }
    }

    /// Changes how long a line takes, before anything has started.
    ///
    /// # Panics
    /// If it is nothing: a program would never let time pass.
    pub fn set_line_clocks(&mut self, clocks: Ticks) {
        assert!(clocks > 0, "a line takes time");
        self.line = LineTime { clocks, lines: 1 };
    }

    fn parts(&self, clock: Ticks) -> Ticks {
        clock * self.line.lines
    }

    /// The clock in which the parts are over.
    fn clock(&self, parts: Ticks) -> Ticks {
        parts.div_ceil(self.line.lines)
    }

    /// The thread whose next line is due first, and when.
    pub fn next(&self, now: Ticks) -> Option<(Ticks, usize)> {
        let threads = self.threads.iter().enumerate().filter(|(_, timed)| timed.goes());
        threads.map(|(number, timed)| (self.clock(timed.next_at).max(now), number)).min()
    }

    /// How many threads run, or are paused.
    pub fn active(&self) -> usize {
        self.threads.iter().filter(|timed| timed.is_active()).count()
    }

    /// When the first delay is over.
    pub fn delay_due(&self) -> Option<Ticks> {
        let until = |timed: &Timed| match timed.hold {
            Some(Hold::Until(clock)) => Some(clock),
            _ => None,
        };
        self.threads.iter().filter_map(until).min()
    }

    /// Runs a thread that is due now until `horizon`, before which nothing else happens, or until a line
    /// comes that is the device's business. Gives the clock at which that line acts.
    pub fn run<const LINES: usize, const VARIABLES: usize>(
        &mut self,
        number: usize,
        memory: &mut Memory<LINES, VARIABLES>,
        now: Ticks,
        horizon: Ticks,
    ) -> (Ticks, Exit) {
        // Another thread has its turn in between; which one comes first in a clock is not for this one to say.
        let others = self.threads.iter().enumerate().filter(|(other, it)| *other != number && it.goes());
        let others = others.map(|(_, timed)| self.clock(timed.next_at).max(now).saturating_sub(1));
        let horizon = others.fold(horizon, Ticks::min);
        let start = self.threads[number].next_at.max(self.parts(now.saturating_sub(1)) + 1);
        let lines = self.parts(horizon).saturating_sub(start) / self.line.clocks + 1;
        let timed = &mut self.threads[number];
        let (executed, exit) = timed.thread.run(memory, self.gate.limit(lines.min(MAX_BATCH) as u32));
        if !matches!(exit, Exit::Read(_) | Exit::Idle) {
            self.gate.executed();
        }
        timed.next_at = start + Ticks::from(executed) * self.line.clocks;
        #[cfg(feature = "std")]
        if matches!(exit, Exit::Read(_) | Exit::Write(..) | Exit::Do(_)) {
            self.skip_rounds(number, memory, self.parts(horizon));
        }
        let timed = &self.threads[number];
        let at = match exit {
            // What is read is known when the line is over; what is done happens with its begin.
            Exit::Write(..) | Exit::Do(_) | Exit::Stopped => timed.next_at - self.line.clocks,
            _ => timed.next_at,
        };
        // A line that is asked for again takes no time of its own.
        (self.clock(at).max(now), exit)
    }

    /// A thread that asks what it has asked before, with everything as it was, leaves out the rounds until `horizon`.
    #[cfg(feature = "std")]
    fn skip_rounds<const LINES: usize, const VARIABLES: usize>(
        &mut self,
        number: usize,
        memory: &Memory<LINES, VARIABLES>,
        horizon: Ticks,
    ) {
        let timed = &mut self.threads[number];
        let skipped = self.rounds.look(
            timed.next_at,
            timed.thread.instructions(),
            horizon,
            |(other, situation)| *other == number && situation.is(&timed.thread, memory),
            || (number, Situation::of(&timed.thread, memory)),
        );
        if let Some(skipped) = skipped {
            timed.next_at += skipped.time;
            timed.thread.count(skipped.instructions);
        }
    }

    /// Something has happened that programs do not show: rounds before it tell nothing about those to come.
    pub fn forget_rounds(&mut self) {
        #[cfg(feature = "std")]
        self.rounds.forget();
    }

    /// What a thread has read stays as it is until this clock, not longer.
    pub fn limit_rounds(&mut self, _clock: Ticks) {
        #[cfg(feature = "std")]
        self.rounds.limit(_clock.saturating_mul(self.line.lines));
    }

    /// Whether a thread's line is to begin now, and a debugger wants to see it before that.
    pub fn is_held(&self, number: usize) -> bool {
        let timed = &self.threads[number];
        self.gate.is_shut() && timed.goes() && timed.thread.pending().is_none()
    }

    /// The register that a thread reads has this value.
    pub fn complete(&mut self, number: usize, value: i32) {
        self.threads[number].thread.complete(value);
    }

    /// What a thread's line says is done.
    pub fn done(&mut self, number: usize) {
        self.threads[number].thread.done();
    }

    /// What a thread's line says cannot be done yet: it is asked for again, a line later.
    pub fn retry(&mut self, number: usize) {
        self.threads[number].next_at += self.line.clocks;
    }

    /// A thread waits.
    pub fn hold(&mut self, number: usize, hold: Hold) {
        self.threads[number].hold = Some(hold);
    }

    /// Ends the waits that are over.
    pub fn end_waits(&mut self, now: Ticks, is_done: impl Fn(usize) -> bool) {
        let LineTime { clocks, lines } = self.line;
        for timed in &mut self.threads {
            let next_at = match timed.hold {
                // Whether an axis stands is looked at line by line.
                Some(Hold::Axis(axis)) if is_done(axis) => now * lines + clocks,
                Some(Hold::Until(clock)) if clock <= now => now * lines,
                _ => continue,
            };
            timed.hold = None;
            timed.thread.done();
            timed.next_at = timed.next_at.max(next_at);
        }
    }

    /// Whose error one of an axis is: that of the program that set it in motion, else of the first that runs.
    pub fn responsible(&self, mover: Option<usize>) -> Option<usize> {
        let active = |number: &usize| self.threads[*number].is_active();
        mover.filter(active).or_else(|| (0..N).find(active))
    }

    /// To the error subroutine, which returns to the program's first line (`restart`) or to the present one,
    /// or into the error state. Errors that come in one clock, as those of axes that are stopped together, are
    /// one error.
    pub fn fail<const LINES: usize, const VARIABLES: usize>(
        &mut self,
        number: usize,
        memory: &Memory<LINES, VARIABLES>,
        restart: bool,
        now: Ticks,
    ) {
        let parts = self.parts(now);
        let timed = &mut self.threads[number];
        if timed.failed_at.replace(now) == Some(now) {
            return;
        }
        timed.thread.fail(memory, restart);
        timed.hold = None;
        timed.next_at = timed.next_at.max(parts);
    }

    /// Starts a program or a subroutine at its first line.
    pub fn start(&mut self, number: usize, line: u16, now: Ticks) {
        let parts = self.parts(now);
        self.threads[number].start(line, parts);
    }

    /// Starts the programs with a bit. One that is not there does not start.
    pub fn boot<const LINES: usize, const VARIABLES: usize>(
        &mut self,
        mask: i32,
        memory: &Memory<LINES, VARIABLES>,
        now: Ticks,
    ) {
        for number in (0..Self::HOST).filter(|number| mask >> number & 1 != 0) {
            self.control(number, 1, memory, now);
        }
    }

    /// Starts a subroutine of the host, unless one is on.
    pub fn call(&mut self, line: u16, now: Ticks) -> bool {
        let is_free = !self.is_active(Self::HOST);
        if is_free {
            self.start(Self::HOST, line, now);
        }
        is_free
    }

    /// Ends a program.
    pub fn stop(&mut self, number: usize) {
        self.threads[number].thread.stop();
        self.threads[number].hold = None;
    }

    /// Ends a program whose own line says so; one that is in its error subroutine goes to its end first
    /// (CMD-4CR manual, 5.4.10).
    pub fn stop_itself(&mut self, number: usize) {
        self.threads[number].thread.stop_itself();
    }

    /// A program is to go on later.
    pub fn pause(&mut self, number: usize) {
        self.threads[number].thread.pause();
    }

    /// A paused program goes on.
    pub fn resume(&mut self, number: usize, now: Ticks) {
        let parts = self.parts(now);
        let timed = &mut self.threads[number];
        timed.thread.resume();
        timed.next_at = timed.next_at.max(parts);
    }

    /// What a program is told: 0 stop, 1 start, 2 pause, 3 continue. One that runs is not started again.
    /// False if there is no such program to start.
    pub fn control<const LINES: usize, const VARIABLES: usize>(
        &mut self,
        number: usize,
        control: i32,
        memory: &Memory<LINES, VARIABLES>,
        now: Ticks,
    ) -> bool {
        match control {
            0 => self.stop(number),
            1 if self.state(number) == State::Running => {}
            1 => match memory.program(number as u8) {
                Some(line) => self.start(number, line, now),
                None => return false,
            },
            2 => self.pause(number),
            _ => self.resume(number, now),
        }
        true
    }

    /// What a thread is doing.
    pub fn state(&self, number: usize) -> State {
        self.threads[number].thread.state()
    }

    /// Whether a thread runs or is paused.
    pub fn is_active(&self, number: usize) -> bool {
        self.threads[number].is_active()
    }

    /// Where a thread is, innermost routine first; see [`Thread::frames`].
    pub fn frames(&self, number: usize) -> Option<impl Iterator<Item = u16>> {
        self.threads.get(number).map(|timed| timed.thread.frames())
    }

    /// The line at which a thread is.
    pub fn counter(&self, number: usize) -> u16 {
        self.threads[number].thread.counter()
    }

    /// A program, for views; the host's thread is none.
    pub fn view(&self, number: usize) -> Option<ProgramState> {
        let thread = &self.threads[..Self::HOST].get(number)?.thread;
        let run = match thread.state() {
            State::Idle => ProgramRun::Idle,
            State::Running => ProgramRun::Running,
            State::Paused => ProgramRun::Paused,
            State::Error => ProgramRun::Error,
        };
        Some(ProgramState { run, counter: thread.counter().into(), instructions: thread.instructions() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ascript::dialect::COMMANDER;

    #[test]
    fn lines_that_are_no_whole_clocks_add_up() {
        let line = LineTime::of_micros(100, 19_660_800);
        assert_eq!(line, LineTime { clocks: 49_152, lines: 25 });
        let mut memory: Memory<8, 4> = Memory::new();
        // V1=V1+1 for ever.
        let source = "PRG 0\nWHILE 1=1\nV1=V1+1\nENDWHILE\nEND\n";
        let code = ascript::compiler::compile("loop.prg", source.as_bytes(), &COMMANDER).code;
        assert!(memory.load(&code.expect("it compiles").lines));
        let mut threads: Threads<1> = Threads::new(line);
        threads.start(0, memory.program(0).expect("program 0"), 0);
        let second = 19_660_800;
        while let Some((clock, number)) = threads.next(0).filter(|(clock, _)| *clock < second) {
            // Cut at odd places.
            threads.run(number, &mut memory, clock, clock + 7777);
        }
        let executed = threads.threads[0].thread.instructions();
        assert_eq!(executed, 10_000);
    }
}
