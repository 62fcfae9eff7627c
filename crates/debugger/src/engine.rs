//! Running, stepping and going back.

use crate::{
    code::Place,
    stop::{self, Breakpoint, Condition, Stop, Watch},
    timeline::{Deed, Point, Session, Target, next_second},
};
use devices::ProgramRun;
use motion::Ticks;
use sim::{
    PinValue, VirtualDevice,
    run::{MAX_COAST_SECONDS, RunError},
    tape::Act,
};
use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

/// How far back is looked first, as a part of a second; each time that nothing is found it is twice as far.
const FIRST_LOOK_PER_SECOND: Ticks = 50;

/// How long it runs at most if no other time is said.
pub const DEFAULT_SECONDS: f64 = 3600.0;

/// Forwards or backwards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Time goes on.
    Forward,
    /// It goes back.
    Backward,
}

/// How far to go, unless a breakpoint or a watch is met before.
#[derive(Clone, Debug, PartialEq)]
pub enum Goal {
    /// To the end, or to the start.
    End,
    /// To the next line of the program in view, into subroutines.
    Into,
    /// To its next line, over subroutines.
    Over,
    /// To the line from which its present routine was called; forwards, to the one behind it.
    Out,
    /// To one of these addresses, in any program.
    Addresses(Vec<u16>),
    /// To a clock of the device, forwards only.
    Clock(Ticks),
}

/// Why a breakpoint or watch cannot be set; one line of text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SetError {
    /// The program has nothing there.
    #[error("there is no line of the program at or behind {0}")]
    NoLine(usize),
    /// No quantity or pin has this name.
    #[error("nothing is called `{0}`")]
    NoName(String),
}

/// A program in the middle of a run.
pub struct Debugger {
    target: Target,
    session: Session,
    start: Point,
    deeds: Vec<Deed>,
    breakpoints: Vec<Breakpoint>,
    watches: Vec<Watch>,
    next_number: u32,
    /// The program in view.
    program: usize,
    limit: Ticks,
    interrupt: Arc<AtomicBool>,
}

/// What is looked for on the way.
struct Search {
    goal: Goal,
    program: usize,
    /// How deep the program may be in subroutines where a step ends.
    depth: usize,
    errors: usize,
    /// When the programs ended.
    ended: Option<Ticks>,
}

/// The last stop of a part of the past.
struct Last {
    point: Point,
    stop: Stop,
    /// The clock of the look before, if what is watched has changed since then and no line has changed it.
    quiet: Option<Ticks>,
}

impl Debugger {
    /// A program that is about to execute its first line. It runs for `seconds` at most.
    ///
    /// # Errors
    /// [`RunError`].
    pub fn new(target: Target, seconds: f64) -> Result<Self, RunError> {
        let session = Session::start(&target)?;
        let limit = session.point.clock.saturating_add(session.device.ticks(seconds));
        let (start, program) = (session.point, session.held.unwrap_or(0));
        Ok(Self {
            target,
            session,
            start,
            deeds: Vec::new(),
            breakpoints: Vec::new(),
            watches: Vec::new(),
            next_number: 1,
            program,
            limit,
            interrupt: Arc::default(),
        })
    }

    /// What is debugged.
    pub fn target(&self) -> &Target {
        &self.target
    }

    /// The device as it stands. Who changes anything about it does so with [`perform`](Self::perform).
    pub fn device(&mut self) -> &mut VirtualDevice {
        &mut self.session.device
    }

    /// Seconds of device time since the start of the program.
    pub fn seconds(&self) -> f64 {
        let ticks = self.session.point.clock - self.start.clock;
        ticks as f64 / f64::from(self.session.device.clock_hz())
    }

    /// The clock of a time since the start of the program.
    pub fn clock(&self, seconds: f64) -> Ticks {
        self.start.clock.saturating_add(self.session.device.ticks(seconds))
    }

    /// The program in view: the one that stopped last, unless another one was chosen.
    pub fn program(&self) -> usize {
        self.program
    }

    /// Looks at another program; false if there is none of this number.
    pub fn view(&mut self, program: usize) -> bool {
        let known = self.session.device.program(program).is_some();
        if known {
            self.program = program;
        }
        known
    }

    /// Whether a program stands before a line that is executed next.
    pub fn is_next(&self, program: usize) -> bool {
        self.session.held == Some(program)
    }

    /// The address of a program's next line.
    pub fn address(&mut self, program: usize) -> Option<u16> {
        self.session.device.address(program)
    }

    /// Where a program is, innermost routine first.
    pub fn frames(&mut self, program: usize) -> Vec<u16> {
        self.session.device.frames(program)
    }

    /// The line at which a program is.
    pub fn place(&mut self, program: usize) -> Option<Place> {
        let address = self.address(program)?;
        self.target.code.place(address)
    }

    /// Where it stands in time.
    pub fn point(&self) -> Point {
        self.session.point
    }

    /// Whoever sets this flag stops the device, wherever it is; it is cleared then.
    pub fn set_interrupt(&mut self, flag: Arc<AtomicBool>) {
        self.interrupt = flag;
    }

    /// Stops before a line, or the first one behind it that the program has. Gives the breakpoint.
    ///
    /// # Errors
    /// [`SetError`].
    pub fn break_at(&mut self, place: Place, condition: Option<Condition>) -> Result<&Breakpoint, SetError> {
        let found = self.target.code.find(place);
        let (place, addresses) = found.ok_or(SetError::NoLine(place.line))?;
        let unknown = |name: &&str| stop::value(&mut self.session.device, name).is_none();
        if let Some(name) = condition.as_ref().and_then(|condition| condition.names().find(unknown)) {
            return Err(SetError::NoName(name.into()));
        }
        let number = self.number();
        self.breakpoints.push(Breakpoint { number, place, addresses, condition });
        Ok(&self.breakpoints[self.breakpoints.len() - 1])
    }

    /// Stops when a value changes. Gives the watch.
    ///
    /// # Errors
    /// [`SetError::NoName`].
    pub fn watch(&mut self, name: &str) -> Result<&Watch, SetError> {
        let value = stop::value(&mut self.session.device, name);
        let value = value.ok_or_else(|| SetError::NoName(name.into()))?;
        let number = self.number();
        self.watches.push(Watch { number, name: name.into(), value });
        Ok(&self.watches[self.watches.len() - 1])
    }

    fn number(&mut self) -> u32 {
        self.next_number += 1;
        self.next_number - 1
    }

    /// Takes a breakpoint or watch away; false if there is none of this number.
    pub fn delete(&mut self, number: u32) -> bool {
        let count = self.breakpoints.len() + self.watches.len();
        self.breakpoints.retain(|breakpoint| breakpoint.number != number);
        self.watches.retain(|watch| watch.number != number);
        self.breakpoints.len() + self.watches.len() < count
    }

    /// The breakpoints.
    pub fn breakpoints(&self) -> &[Breakpoint] {
        &self.breakpoints
    }

    /// The watches.
    pub fn watches(&self) -> &[Watch] {
        &self.watches
    }

    /// Does something to the device, here and now. What would have been done later is forgotten: from here on
    /// time takes another course. Gives what the device has sent.
    ///
    /// # Errors
    /// What the device says against it.
    pub fn perform(&mut self, act: Act) -> Result<Vec<sim::Sent>, String> {
        self.session.device.drain_sent().for_each(drop);
        self.session.perform(&act)?;
        let at = self.session.point;
        self.deeds.retain(|deed| deed.at <= at);
        self.deeds.push(Deed { at, act });
        Ok(self.session.device.drain_sent().collect())
    }

    /// Goes somewhere.
    ///
    /// # Errors
    /// [`RunError`], where it goes over the past.
    pub fn go(&mut self, direction: Direction, goal: Goal) -> Result<Stop, RunError> {
        let stop = match direction {
            Direction::Forward => self.forward(goal)?,
            Direction::Backward => self.backward(goal)?,
        };
        let values = values(&self.watches, &mut self.session);
        self.watches.iter_mut().zip(values).for_each(|(watch, value)| watch.value = value);
        self.interrupt.store(false, Ordering::Relaxed);
        match stop {
            Stop::Failed(program) => self.program = program,
            _ => self.program = self.session.held.unwrap_or(self.program),
        }
        Ok(stop)
    }

    fn search(&mut self, goal: Goal) -> Search {
        let program = self.program;
        let depth = self.session.device.frames(program).len();
        let depth = match goal {
            Goal::Over => depth,
            Goal::Out => depth.saturating_sub(1),
            _ => usize::MAX,
        };
        let errors = errors(&self.session.device);
        Search { goal, program, depth, errors, ended: None }
    }

    fn forward(&mut self, goal: Goal) -> Result<Stop, RunError> {
        let mut search = self.search(goal);
        let until = match search.goal {
            Goal::Clock(clock) => clock.min(self.limit),
            _ => self.limit,
        };
        if self.session.point.clock >= until && self.session.held.is_none() {
            return Ok(Stop::Time);
        }
        loop {
            let (before, values) = (self.session.point.clock, self.values());
            let by_line = self.execute();
            self.arrive(until);
            if let Some(stop) = self.look(&mut search) {
                let is_late = matches!(stop, Stop::Watch { .. }) && !by_line;
                let change = if is_late { self.change(before, |now| *now != values)? } else { None };
                return Ok(change.unwrap_or(stop));
            }
            if self.session.held.is_none() && self.session.point.clock >= until {
                return Ok(Stop::Time);
            }
            if self.interrupt.swap(false, Ordering::Relaxed) {
                return Ok(Stop::Interrupted);
            }
        }
    }

    /// What the watches have seen last.
    fn values(&self) -> Vec<PinValue> {
        self.watches.iter().map(|watch| watch.value).collect()
    }

    /// What the watches see at a point of the past; `None` if somebody interrupts the way there.
    fn values_at(&self, point: Point) -> Result<Option<(Session, Vec<PinValue>)>, RunError> {
        let session = Session::at(&self.target, &self.deeds, point, &self.interrupt)?;
        Ok(session.map(|mut session| {
            let values = values(&self.watches, &mut session);
            (session, values)
        }))
    }

    /// Between two looks nobody watches. Finds the clock after `from`, and before that at which it stands now, from
    /// which on the values `have_changed`, and goes there; `None` if that is where it stands, or if somebody interrupts
    /// the search.
    fn change(
        &mut self,
        from: Ticks,
        have_changed: impl Fn(&Vec<PinValue>) -> bool,
    ) -> Result<Option<Stop>, RunError> {
        let (mut low, mut high) = (from, self.session.point.clock);
        let start = Point { clock: from, round: 0, line: Point::OVER };
        let Some(mut before) = self.values_at(start)?.map(|(_, values)| values) else { return Ok(None) };
        let mut found = None;
        while high.saturating_sub(low) > 1 {
            let clock = low.midpoint(high);
            let point = Point { clock, round: 0, line: Point::OVER };
            let Some((session, values)) = self.values_at(point)? else { return Ok(None) };
            if have_changed(&values) {
                high = clock;
                found = Some((session, values));
            } else {
                low = clock;
                before = values;
            }
        }
        let Some((session, values)) = found else { return Ok(None) };
        self.session = session;
        let changes = self.watches.iter().zip(before.into_iter().zip(values));
        let mut changes = changes.filter(|(_, (before, now))| before != now);
        Ok(changes.next().map(|(Watch { number, name, .. }, (before, now))| Stop::Watch {
            number: *number,
            name: name.clone(),
            before,
            now,
        }))
    }

    /// Executes the line before which it stands, if it does. Whether that has changed what is watched.
    fn execute(&mut self) -> bool {
        let was_held = self.session.held.is_some();
        self.session.execute();
        let device = &mut self.session.device;
        let has_changed =
            |watch: &Watch| stop::value(device, &watch.name).is_some_and(|now| now != watch.value);
        was_held && self.watches.iter().any(has_changed)
    }

    /// To the next line that is due, or whatever else is worth a look, and what was done there.
    fn arrive(&mut self, until: Ticks) {
        let next = self.deeds.iter().find(|deed| deed.at > self.session.point).map(|deed| deed.at);
        let until = next.map_or(until, |point| point.clock.min(until));
        let device = &self.session.device;
        let running = device.programs().any(|program| program.run == ProgramRun::Running);
        let until = if running { next_second(device).min(until) } else { until };
        self.session.arrive(until, !self.watches.is_empty() || !running);
        let here = self.session.point;
        for deed in self.deeds.iter().filter(|deed| deed.at == here) {
            let done = self.session.perform(&deed.act);
            assert!(done.is_ok(), "what could be done once can be done again");
        }
    }

    /// Whether to stop here.
    fn look(&mut self, search: &mut Search) -> Option<Stop> {
        let device = &mut self.session.device;
        let mut changed = None;
        for watch in &mut self.watches {
            let now = stop::value(device, &watch.name).unwrap_or(watch.value);
            let before = std::mem::replace(&mut watch.value, now);
            if before != now && changed.is_none() {
                changed = Some(Stop::Watch { number: watch.number, name: watch.name.clone(), before, now });
            }
        }
        if let Some(stop) = changed {
            return Some(stop);
        }
        if errors(device) > search.errors {
            let failed = device.programs().position(|program| program.run == ProgramRun::Error);
            return failed.map(Stop::Failed);
        }
        let Some(program) = self.session.held else { return self.at_rest(search) };
        let address = device.address(program)?;
        let hit = self.breakpoints.iter().find(|breakpoint| {
            let condition = breakpoint.condition.as_ref();
            breakpoint.addresses.contains(&address) && condition.is_none_or(|it| it.holds(device))
        });
        if let Some(breakpoint) = hit {
            return Some(Stop::Breakpoint(breakpoint.number));
        }
        let there = match &search.goal {
            Goal::End | Goal::Clock(_) => false,
            Goal::Addresses(addresses) => addresses.contains(&address),
            Goal::Into | Goal::Over | Goal::Out => {
                program == search.program
                    && self.target.code.is_statement(address)
                    && device.frames(program).len() <= search.depth
            }
        };
        there.then_some(Stop::Step)
    }

    /// Whether the programs have ended, and the axes stand.
    fn at_rest(&mut self, search: &mut Search) -> Option<Stop> {
        let device = &mut self.session.device;
        let goes_on = |run| matches!(run, ProgramRun::Running | ProgramRun::Paused);
        // Without a supply they have not ended: they may start again.
        if !device.is_powered() || device.programs().any(|program| goes_on(program.run)) {
            search.ended = None;
            return None;
        }
        let now = self.session.point.clock;
        let since = *search.ended.get_or_insert(now);
        let standing = (0..device.axes().len()).all(|axis| device.axis(axis).speed_mpps == 0);
        let coasted = now >= since + MAX_COAST_SECONDS * Ticks::from(device.clock_hz());
        (standing || coasted).then_some(Stop::Ended)
    }

    /// To the last point before this one at which going forward would stop. Whoever interrupts it stays here.
    fn backward(&mut self, goal: Goal) -> Result<Stop, RunError> {
        let mut home = None;
        let stop = self.look_back(goal, &mut home)?;
        if stop == Stop::Interrupted {
            self.interrupt.store(false, Ordering::Relaxed);
            if let Some(home) = home {
                self.session = home;
            }
        }
        Ok(stop)
    }

    /// The same; `home` is the session that was left.
    fn look_back(&mut self, goal: Goal, home: &mut Option<Session>) -> Result<Stop, RunError> {
        let (here, mut search) = (self.session.point, self.search(goal));
        if here <= self.start {
            return Ok(Stop::Start);
        }
        let first = Ticks::from(self.session.device.clock_hz()) / FIRST_LOOK_PER_SECOND;
        let mut span = first.max(1);
        let mut end = here;
        loop {
            let from = here.clock.saturating_sub(span);
            let from = if from <= self.start.clock {
                self.start
            } else {
                Point { clock: from, round: 0, line: Point::OVER }
            };
            if !self.travel(from, home)? {
                return Ok(Stop::Interrupted);
            }
            let last = self.last_stop(from, end, &mut search);
            if self.interrupt.load(Ordering::Relaxed) {
                return Ok(Stop::Interrupted);
            }
            let start = (from == self.start).then_some(Last { point: from, stop: Stop::Start, quiet: None });
            if let Some(Last { point, stop, quiet }) = last.or(start) {
                if !self.travel(point, home)? {
                    return Ok(Stop::Interrupted);
                }
                let values = values(&self.watches, &mut self.session);
                let change = quiet.map(|since| self.change(since, |now| *now == values)).transpose()?;
                return Ok(change.flatten().unwrap_or(stop));
            }
            end = from;
            span = span.saturating_mul(2);
        }
    }

    /// The last stop from this point, which was travelled to, to before another.
    fn last_stop(&mut self, from: Point, end: Point, search: &mut Search) -> Option<Last> {
        let values = values(&self.watches, &mut self.session);
        self.watches.iter_mut().zip(values).for_each(|(watch, value)| watch.value = value);
        search.errors = errors(&self.session.device);
        let mut last = None;
        let (mut before, mut by_line) = (from.clock, false);
        loop {
            let stop = match self.look(search) {
                // The programs end once.
                Some(Stop::Ended | Stop::Failed(_)) | None => None,
                stop => stop,
            };
            // A stop where one starts from is found in the part before, or is the start.
            if self.session.point != from
                && let Some(stop) = stop
            {
                let is_late = matches!(stop, Stop::Watch { .. }) && !by_line;
                last = Some(Last { point: self.session.point, stop, quiet: is_late.then_some(before) });
            }
            before = self.session.point.clock;
            by_line = self.execute();
            // What changes between this look and the end is seen in the clock before that. What a line changes is seen
            // at the next one.
            let sight = end.clock.saturating_sub(1);
            let ends = by_line || self.watches.is_empty() || before >= sight;
            self.arrive(if ends { end.clock } else { sight });
            if self.session.point >= end || self.interrupt.load(Ordering::Relaxed) {
                return last;
            }
        }
    }

    /// To a point of the past; the first session that is left goes `home`. False if somebody interrupts it: it stays
    /// where it is then.
    fn travel(&mut self, point: Point, home: &mut Option<Session>) -> Result<bool, RunError> {
        let session = Session::at(&self.target, &self.deeds, point, &self.interrupt)?;
        let arrives = session.is_some();
        if let Some(session) = session {
            let left = std::mem::replace(&mut self.session, session);
            home.get_or_insert(left);
        }
        Ok(arrives)
    }

    /// The value of a quantity or a pin.
    pub fn value(&mut self, name: &str) -> Option<PinValue> {
        stop::value(&mut self.session.device, name)
    }
}

/// What watches see in a session.
fn values(watches: &[Watch], session: &mut Session) -> Vec<PinValue> {
    let value = |watch: &Watch| stop::value(&mut session.device, &watch.name).unwrap_or(watch.value);
    watches.iter().map(value).collect()
}

/// How many programs are in their error state.
fn errors(device: &VirtualDevice) -> usize {
    device.programs().filter(|program| program.run == ProgramRun::Error).count()
}
