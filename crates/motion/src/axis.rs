//! An axis: position counter, goal, limits, and the train that is on its way.
//!
//! Time moves by [`Axis::advance`]. Everything else happens at the end of the clock that was advanced to
//! last: pulses of that clock have happened, the next one is at least a clock away. A change of goal or
//! limits cuts the train on its way between two pulses, and the part of a pulse that was already made
//! counts.

use crate::block;
use crate::foot::Foot;
use crate::plan::{self, Kind, Limits, Now, Piece, Run, Shape, Wish};
use crate::scurve::{self, Course};
use crate::speed::{MAX_SPEED, Pace, Speed, SpeedSquared};
use crate::train::{Direction, FRACTION_BITS, Moment, Ticks, Train};

/// One whole pulse in 2⁻³².
const WHOLE: u64 = 1 << 32;

/// What an axis wants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Goal {
    /// To stand at this position. Positions wrap at 32 bits, and the way is the shorter one.
    Position(i32),
    /// To move at this speed; 0 to stand still.
    Speed(Direction, Speed),
}

/// How an axis ends its motion into a blocked direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// At once.
    Hard,
    /// With the deceleration ramp.
    Soft,
}

/// A train on its way: the pulses that have not happened.
#[derive(Clone, Copy, Debug)]
struct Leg {
    train: Train,
    /// At the end of the train; at its start it is that of the axis.
    end: Pace,
    /// The moment of the last pulse.
    last: Moment,
    kind: Kind,
}

/// The window in which nothing outside changes, in pulses of the odometer.
#[derive(Clone, Copy, Debug)]
struct Window {
    low: i64,
    high: i64,
}

impl Window {
    const WHOLE: Self = Self { low: i64::MIN, high: i64::MAX };

    /// Pulses to its edge.
    fn room(self, odometer: i64, direction: Direction) -> i64 {
        match direction {
            Direction::Negative => odometer.saturating_sub(self.low),
            Direction::Positive => self.high.saturating_sub(odometer),
        }
    }
}

/// A motion axis.
#[derive(Clone, Debug)]
pub struct Axis {
    limits: Limits,
    goal: Goal,
    /// Directions that are blocked: negative, positive.
    blocked: [Option<Stop>; 2],
    position: i32,
    odometer: i64,
    steps: u64,
    window: Window,
    /// Where the controller itself wants to look after something.
    marks: Window,
    /// The end of the clock that was advanced to, or the moment of the last pulse while moving.
    since: Moment,
    now: Ticks,
    /// The speed at `since`; 0 at standstill.
    pace: Pace,
    direction: Direction,
    /// What is left of the next pulse at `since`, in 2⁻³².
    rest: u64,
    leg: Option<Leg>,
    /// What follows the leg.
    run: Run,
    /// How a motion with S-curves goes on.
    course: Option<Course>,
    /// The slow ends of a braking ramp and of one that speeds up.
    feet: [Foot; 2],
}

impl Axis {
    /// An axis at rest at position 0 at clock 0.
    pub const fn new(limits: Limits) -> Self {
        Self {
            limits: limits.clamped(),
            goal: Goal::Position(0),
            blocked: [None; 2],
            position: 0,
            odometer: 0,
            steps: 0,
            window: Window::WHOLE,
            marks: Window::WHOLE,
            since: Moment::at(0),
            now: 0,
            pace: Pace::STILL,
            direction: Direction::Positive,
            rest: WHOLE,
            leg: None,
            run: Run::NONE,
            course: None,
            feet: [Foot::new(limits.scale, false), Foot::new(limits.scale, true)],
        }
    }

    /// The limits in force.
    pub const fn limits(&self) -> Limits {
        self.limits
    }

    /// What the axis wants.
    pub fn goal(&self) -> Goal {
        self.goal
    }

    /// The position counter.
    pub fn position(&self) -> i32 {
        self.position
    }

    /// Net pulses since power-up; setting the position does not change it.
    pub fn odometer(&self) -> i64 {
        self.odometer
    }

    /// All pulses since power-up, both ways.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Whether pulses are on their way.
    pub fn is_moving(&self) -> bool {
        self.pace != Pace::STILL
    }

    /// The way the axis moves, or moved last.
    pub fn direction(&self) -> Direction {
        self.direction
    }

    /// The present speed; 0 at standstill.
    pub fn speed(&self) -> Speed {
        self.leg.as_ref().map_or(0, |leg| self.progress(leg).0)
    }

    /// Whether the speed is rising (1), falling (−1) or neither.
    pub fn acceleration(&self) -> i32 {
        self.leg.as_ref().map_or(0, |leg| match leg.end.squared.cmp(&self.pace.squared) {
            core::cmp::Ordering::Less => -1,
            core::cmp::Ordering::Equal => 0,
            core::cmp::Ordering::Greater => 1,
        })
    }

    /// Overwrites the position counter. The axis need not stand still; a target stays where it is, and the
    /// way to it changes.
    pub fn set_position(&mut self, position: i32) {
        match self.goal {
            Goal::Position(_) => self.change(|axis| axis.position = position),
            Goal::Speed(..) => self.position = position,
        }
    }

    /// Gives the present place another number, and a target the one that is as far away as before: the motion
    /// goes on as if nothing had happened.
    pub fn renumber(&mut self, position: i32) {
        if let Goal::Position(target) = &mut self.goal {
            *target = target.wrapping_add(position.wrapping_sub(self.position));
        }
        self.position = position;
    }

    /// Changes what the axis wants.
    pub fn set_goal(&mut self, goal: Goal) {
        if goal != self.goal {
            self.change(|axis| axis.goal = goal);
        }
    }

    /// Changes the limits. A motion goes on at its speed, also when the scale changes.
    pub fn set_limits(&mut self, limits: Limits) {
        let limits = limits.clamped();
        if limits != self.limits {
            self.change(|axis| {
                let (old, new) = (axis.limits.scale.bits(), limits.scale.bits());
                let speed = u64::from(axis.pace.speed);
                if new != old && speed != 0 {
                    let speed = if new > old { speed << (new - old) } else { speed >> (old - new) };
                    let speed = speed.clamp(limits.scale.slowest().into(), MAX_SPEED.into());
                    axis.pace = Pace::of(speed as Speed);
                }
                axis.limits = limits;
            });
        }
    }

    /// Blocks a direction or frees it. A motion into it ends as the stop says; one that was held goes on
    /// when the direction is freed and the goal still lies there.
    pub fn set_blocked(&mut self, direction: Direction, stop: Option<Stop>) {
        if self.blocked[direction as usize] != stop {
            self.change(|axis| axis.blocked[direction as usize] = stop);
        }
    }

    /// Stands still at once and wants nothing else.
    pub fn halt(&mut self) {
        self.change(|axis| {
            axis.rest();
            axis.goal = Goal::Speed(axis.direction, 0);
        });
    }

    /// Nothing outside changes while the odometer is strictly between these; the axis wakes at them.
    pub fn set_window(&mut self, low: i64, high: i64) {
        self.window = Window { low, high };
    }

    /// Whether the odometer stands at an edge of the window, or beyond.
    pub fn at_window(&self) -> bool {
        self.odometer <= self.window.low || self.odometer >= self.window.high
    }

    /// The controller wants to look after something when the odometer arrives at one of these: the axis wakes
    /// there too, and goes on. A comparator is told its counter so at the very pulse.
    pub fn set_marks(&mut self, low: i64, high: i64) {
        self.marks = Window { low, high };
    }

    /// Pulses to the next edge of the window or mark; 0 beyond both.
    pub(crate) fn room(&self, direction: Direction) -> i64 {
        let rooms = [self.window, self.marks].map(|window| window.room(self.odometer, direction));
        rooms.into_iter().filter(|room| *room > 0).min().unwrap_or(0)
    }

    /// The pulses on their way.
    pub(crate) fn train(&self) -> Option<&Train> {
        self.leg.as_ref().map(|leg| &leg.train)
    }

    /// Counts pulses that others made with an axis at rest. It wants to stay where they take it.
    pub(crate) fn carry(&mut self, direction: Direction, pulses: u32) {
        assert!(!self.is_moving(), "an axis moves by itself or with others");
        self.direction = direction;
        self.goal = Goal::Speed(direction, 0);
        self.count(direction, pulses);
    }

    /// The clock at which the axis must be advanced: the end of its train, or the pulse with which it
    /// reaches its window's edge. `None` at rest.
    pub fn wake(&self) -> Option<Ticks> {
        let leg = self.leg.as_ref()?;
        let train = &leg.train;
        Some(match u32::try_from(self.room(train.direction)) {
            Ok(room @ 1..) if room < train.count => train.edge(room),
            _ => leg.last.ticks,
        })
    }

    /// The clock at which something may happen that others have to see: the axis comes to rest, or reaches an
    /// edge of its window or a mark. Later than [`wake`](Self::wake) where that is far away; what the speed does
    /// meanwhile is the axis' own business. `None` at rest.
    pub fn due(&self) -> Option<Ticks> {
        let direction = self.leg.as_ref()?.train.direction;
        let room = self.room(direction);
        let wake = self.wake()?;
        Some(if room > 0 { wake.max(self.before(room as u64)) } else { wake })
    }

    /// A clock before which the axis makes fewer pulses than these and does not come to rest.
    pub(crate) fn before(&self, pulses: u64) -> Ticks {
        let top = match (self.goal, self.wish(), self.limits.shape) {
            // Jerk-limited ramps may go on speeding up for a while, and the end of a braking ramp is not looked
            // for.
            (_, _, Shape::SCurve { .. }) | (_, None | Some(Wish::Brake), _) => return 0,
            (Goal::Speed(_, speed), ..) => speed,
            (Goal::Position(_), ..) => self.limits.top,
        };
        let pulses = match self.wish() {
            Some(Wish::To(left)) => pulses.min(left),
            _ => pulses,
        };
        let fastest = top.max(self.limits.start).max(self.pace.speed);
        let spacing = self.limits.scale.spacing(fastest);
        // Ramps round their spacings, and of the first pulse a part may have been made.
        let spacing = u128::from(spacing - (spacing >> 10));
        let span = (spacing * u128::from(pulses.saturating_sub(2))) >> FRACTION_BITS;
        self.since.ticks.saturating_add(span.min(Ticks::MAX.into()) as Ticks)
    }

    /// Lets time pass to the end of clock `now`; `emit` gets the trains of the pulses made until then.
    ///
    /// # Panics
    /// If `now` is earlier than the last time.
    pub fn advance(&mut self, now: Ticks, mut emit: impl FnMut(&Train)) {
        assert!(now >= self.now, "time moves forward");
        self.now = now;
        while let Some(leg) = &self.leg {
            if now < leg.last.ticks {
                if leg.train.first_slot() <= now {
                    self.advance_inside(now, emit);
                }
                return;
            }
            emit(&leg.train);
            let Train { count, direction, .. } = leg.train;
            self.since = leg.last;
            self.pace = leg.end;
            self.rest = WHOLE;
            self.count(direction, count);
            self.leg = None;
            self.plan();
        }
    }

    /// The same between the first pulse and the last of the train on its way.
    #[cold]
    fn advance_inside(&mut self, now: Ticks, mut emit: impl FnMut(&Train)) {
        let Some(leg) = self.leg else { return };
        let done = leg.train.count_until(now);
        let (head, tail) = leg.train.split(done);
        emit(&head);
        self.since = tail.start;
        self.pace = self.pace_after(&leg, done);
        self.rest = WHOLE;
        self.count(head.direction, done);
        self.leg = Some(Leg { train: tail, ..leg });
    }

    /// Puts a change into effect at the end of the present clock.
    fn change(&mut self, change: impl FnOnce(&mut Self)) {
        let before = (self.leg, self.pace, self.rest, self.since);
        if let Some(leg) = self.leg.take() {
            assert!(leg.train.edge(1) > self.now, "pulses in the past belong out before a change");
            let (speed, rest) = self.progress(&leg);
            self.pace = Pace::of(speed);
            self.rest = rest;
        }
        self.since = Moment::at(self.now + 1);
        change(self);
        if self.keeps_course() {
            (self.leg, self.pace, self.rest, self.since) = before;
        } else {
            self.course = None;
            self.run = Run::NONE;
            self.plan();
        }
    }

    /// Speed and rest of the pulse at the end of the present clock.
    fn progress(&self, leg: &Leg) -> (Speed, u64) {
        let spacing = leg.train.interval;
        let gone = Moment::at(self.now + 1).since(leg.train.start).unwrap_or(0).min(spacing - 1);
        let [from, to] = [self.pace, self.pace_after(leg, 1)].map(|pace| i64::from(pace.speed));
        // Over one pulse the speed is taken as linear in time; way is speed by time.
        let share = ((u128::from(gone) << 32) / u128::from(spacing)) as i64;
        let speed = from + (((to - from) * share) >> 32);
        let way = (i128::from(share) * i128::from(from + speed) / i128::from(from + to)) as u64;
        let left = ((u128::from(self.rest) * u128::from(WHOLE - way.min(WHOLE - 1))) >> 32) as u64;
        (speed as Speed, left.max(1))
    }

    /// Whether the course on its way is still right, so that a curve need not start anew.
    fn keeps_course(&self) -> bool {
        let now = Now { squared: self.pace.squared, rest: self.rest };
        match (&self.course, self.limits.bend(), self.wish()) {
            (Some(course), Some(bend), Some(wish)) => course.serves(&self.limits, bend, now, wish),
            _ => false,
        }
    }

    /// The speed after some pulses of the leg.
    fn pace_after(&self, leg: &Leg, pulses: u32) -> Pace {
        match (&self.course, leg.kind) {
            (Some(course), Kind::Curve(_)) => Pace::of(course.speed_at(pulses)),
            _ => leg.pace_after(self.pace, pulses),
        }
    }

    fn count(&mut self, direction: Direction, pulses: u32) {
        if let Some(course) = &mut self.course {
            course.pass(pulses);
        }
        let way = direction.sign() * i64::from(pulses);
        self.position = self.position.wrapping_add(way as i32);
        self.odometer += way;
        self.steps += u64::from(pulses);
    }

    fn rest(&mut self) {
        self.pace = Pace::STILL;
        self.rest = WHOLE;
        self.leg = None;
        self.run = Run::NONE;
        self.course = None;
    }

    /// Finds the next leg, or comes to rest.
    #[inline]
    fn plan(&mut self) {
        match self.run.next(self.pace.squared) {
            Some(Piece { count, end, kind: Kind::Foot(at) }) => self.go_on_foot(at as u32, count, end),
            Some(piece) => self.go(piece),
            None => self.plan_anew(),
        }
    }

    /// The same where nothing was decided beforehand.
    #[inline(never)]
    fn plan_anew(&mut self) {
        // Twice at the most: coming to rest may be the start of a motion the other way.
        for _ in 0..2 {
            if self.pace == Pace::STILL && !self.start() {
                return;
            }
            match self.next_piece() {
                Some(piece) => return self.go(piece),
                None => self.rest(),
            }
        }
    }

    /// Gets going if the goal asks for it and no switch forbids it.
    fn start(&mut self) -> bool {
        let (direction, speed) = match self.goal {
            Goal::Position(target) => {
                let way = target.wrapping_sub(self.position);
                let pulses = u64::from(way.unsigned_abs());
                let speed = match self.limits.bend() {
                    _ if way == 0 => return false,
                    Some(bend) => scurve::entry(&self.limits, bend, pulses),
                    None => plan::entry(&self.limits, pulses),
                };
                (Direction::of(way.into()), speed)
            }
            Goal::Speed(_, 0) => return false,
            Goal::Speed(direction, speed) => (direction, self.limits.start.min(speed)),
        };
        if self.blocked[direction as usize].is_some() {
            return false;
        }
        self.direction = direction;
        self.pace = Pace::of(speed.max(self.limits.scale.slowest()));
        true
    }

    /// What the next pulses are for; `None` to stand still now.
    fn wish(&self) -> Option<Wish> {
        match self.blocked[self.direction as usize] {
            Some(Stop::Hard) => return None,
            Some(Stop::Soft) => return Some(Wish::Brake),
            None => {}
        }
        Some(match self.goal {
            Goal::Position(target) => {
                let way = i64::from(target.wrapping_sub(self.position)) * self.direction.sign();
                match u64::try_from(way) {
                    Ok(pulses @ 1..) => Wish::To(pulses),
                    _ => Wish::Brake,
                }
            }
            Goal::Speed(direction, speed) if direction == self.direction && speed != 0 => {
                Wish::Speed(speed.clamp(self.limits.scale.slowest(), MAX_SPEED))
            }
            Goal::Speed(..) => Wish::Brake,
        })
    }

    /// How to go on from a speed that is not 0; `None` to stand still now.
    fn next_piece(&mut self) -> Option<Piece> {
        let wish = self.wish()?;
        let now = Now { squared: self.pace.squared, rest: self.rest };
        if let Some(bend) = self.limits.bend() {
            if self.course.is_none() {
                self.course = Course::new(&self.limits, bend, now, wish);
            }
            return self.course.as_mut()?.piece(self.rest);
        }
        if let Some((key, piece, run)) = plan::foot(&self.limits, now, wish) {
            self.feet[usize::from(key.rises)].suit(key);
            self.run = run;
            return Some(piece);
        }
        let piece = match wish {
            Wish::To(pulses) => {
                plan::toward(&self.limits, now, pulses).or_else(|| plan::brake(&self.limits, now))
            }
            Wish::Speed(speed) => Some(plan::at_speed(&self.limits, now, speed)),
            Wish::Brake => plan::brake(&self.limits, now),
        }?;
        self.run = Run::after(&piece, &self.limits, now.squared, wish);
        Some(piece)
    }

    /// Sets out on a piece.
    fn go(&mut self, piece: Piece) {
        let Piece { count, end, kind } = piece;
        let (scale, start, direction) = (self.limits.scale, self.since, self.direction);
        if let Kind::Foot(at) = kind {
            return self.go_on_foot(at as u32, count, end);
        }
        let from = self.pace.complete();
        let end = match (kind, &self.course) {
            (Kind::Curve(_), Some(course)) => course.pace(),
            _ => from.next(end),
        };
        let ends = [from, end];
        let train = match kind {
            Kind::Cruise => Train { interval: scale.spacing(self.pace.speed), count, ..self.still() },
            Kind::Glide => block::glide(scale, start, direction, count, ends),
            Kind::Curve(duration) => block::curve(scale, start, direction, count, ends, duration),
            Kind::Ramp | Kind::Foot(_) => {
                let whole = block::ramp(scale, start, direction, count, ends);
                if self.rest == WHOLE {
                    whole
                } else {
                    let interval = ((u128::from(whole.interval) * u128::from(self.rest)) >> 32) as u64;
                    Train { interval: interval.max(1), ..whole }
                }
            }
        };
        self.leg = Some(Leg { train, end, last: train.moment(count), kind });
    }

    /// Sets out on pulses that are known. Nothing is calculated, so it is a function of its own: the leg is
    /// written where it stays.
    #[inline(never)]
    fn go_on_foot(&mut self, at: u32, count: u32, end: SpeedSquared) {
        let foot = &mut self.feet[usize::from(end > self.pace.squared)];
        let (train, span, speed) = foot.train(at, count, self.since, self.direction, &self.pace);
        let last = self.since.after(span);
        let end = Pace::on_the_way(speed, end);
        self.leg = Some(Leg { train, end, last, kind: Kind::Foot(at.into()) });
    }

    fn still(&self) -> Train {
        block::single(self.since, self.direction, 0)
    }
}

impl Leg {
    /// The speed after some of the pulses, from that at the start.
    fn pace_after(&self, from: Pace, pulses: u32) -> Pace {
        let count = i128::from(self.train.count);
        let between = |from: u64, to: u64| {
            let change = (i128::from(to) - i128::from(from)) * i128::from(pulses) / count;
            (i128::from(from) + change) as u64
        };
        let to = self.end;
        match self.kind {
            Kind::Cruise => to,
            // Of a curve only the ends are known here.
            Kind::Curve(_) | Kind::Ramp | Kind::Foot(_) => Pace::of_square(between(from.squared, to.squared)),
            Kind::Glide => Pace::of(between(from.speed.into(), to.speed.into()) as Speed),
        }
    }
}
