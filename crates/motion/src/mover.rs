//! What moves an axis or a path: counters, goal, limits, and the train that is on its way.
//!
//! The [feet](crate::foot) of its ramps are lent to it by whoever has room for them: a path takes those of one of
//! its axes, which rests meanwhile.

use crate::axis::{Goal, Stop};
use crate::block;
use crate::foot::Feet;
use crate::plan::{self, Kind, Limits, Now, Piece, Run, Shape, Wish};
use crate::room::Room;
use crate::scurve::{self, Course};
use crate::speed::{MAX_SPEED, Pace, Speed, SpeedSquared};
use crate::train::{Direction, FRACTION_BITS, Moment, Ticks, Train};
use crate::wide::quotient;

/// One whole pulse in 2⁻³².
const WHOLE: u64 = 1 << 32;

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

/// An axis without its feet.
#[derive(Clone, Debug)]
pub(crate) struct Mover {
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
    course: Room<Course>,
}

impl Mover {
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
            course: Room::EMPTY,
        }
    }

    /// Begins anew: an axis at rest at position 0, at the end of clock `now`.
    pub fn restart(&mut self, limits: Limits, now: Ticks) {
        *self = Self::new(limits);
        self.now = now;
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
    pub fn set_position(&mut self, position: i32, feet: &mut Feet) {
        match self.goal {
            Goal::Position(_) => self.change(feet, |mover| mover.position = position),
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
    pub fn set_goal(&mut self, goal: Goal, feet: &mut Feet) {
        if goal != self.goal {
            self.change(feet, |mover| mover.goal = goal);
        }
    }

    /// Changes the limits. A motion goes on at its speed, also when the scale changes.
    pub fn set_limits(&mut self, limits: Limits, feet: &mut Feet) {
        let limits = limits.clamped();
        if limits != self.limits {
            self.change(feet, |mover| {
                let (old, new) = (mover.limits.scale.bits(), limits.scale.bits());
                let speed = u64::from(mover.pace.speed);
                if new != old && speed != 0 {
                    let speed = if new > old { speed << (new - old) } else { speed >> (old - new) };
                    let speed = speed.clamp(limits.scale.slowest().into(), MAX_SPEED.into());
                    mover.pace = Pace::of(speed as Speed);
                }
                mover.limits = limits;
            });
        }
    }

    /// Blocks a direction or frees it. A motion into it ends as the stop says; one that was held goes on
    /// when the direction is freed and the goal still lies there.
    pub fn set_blocked(&mut self, direction: Direction, stop: Option<Stop>, feet: &mut Feet) {
        if self.blocked[direction as usize] != stop {
            self.change(feet, |mover| mover.blocked[direction as usize] = stop);
        }
    }

    /// Stands still at once and wants nothing else.
    pub fn halt(&mut self) {
        self.assert_present();
        self.since = Moment::at(self.now + 1);
        self.rest();
        self.goal = Goal::Speed(self.direction, 0);
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
    pub fn room(&self, direction: Direction) -> i64 {
        let rooms = [self.window, self.marks].map(|window| window.room(self.odometer, direction));
        rooms.into_iter().filter(|room| *room > 0).min().unwrap_or(0)
    }

    /// The pulses on their way.
    pub fn train(&self) -> Option<&Train> {
        self.leg.as_ref().map(|leg| &leg.train)
    }

    /// Counts pulses that others made with an axis at rest. It wants to stay where they take it.
    pub fn carry(&mut self, direction: Direction, pulses: u32) {
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
    pub fn before(&self, pulses: u64) -> Ticks {
        let top = match (self.goal, self.wish(), self.limits.shape) {
            // Jerk-limited ramps may go on speeding up for a while, and the end of a braking ramp is not looked
            // for.
            (_, _, Shape::SCurve { .. }) | (_, None | Some(Wish::Brake), _) => return 0,
            (Goal::Speed(_, speed), ..) => speed,
            (Goal::Position(_), ..) => self.limits.top,
        };
        let fastest = top.max(self.limits.start).max(self.pace.speed);
        let span = match self.wish() {
            Some(Wish::To(left)) if left <= pulses => {
                let now = Now { squared: self.pace.squared, rest: self.rest };
                plan::least_way(&self.limits, now, left, fastest)
            }
            _ => plan::least_cruise(&self.limits, pulses, fastest),
        };
        // Ramps round their spacings.
        let span = (span - (span >> 10)) >> FRACTION_BITS;
        self.since.ticks.saturating_add(span.min(Ticks::MAX.into()) as Ticks)
    }

    /// Time has come to the end of clock `now`. Its pulses are [`ready`](Self::ready), train by train, and last
    /// those of a train that goes on ([`cut`](Self::cut)).
    ///
    /// # Panics
    /// If `now` is earlier than the last time.
    #[inline]
    pub fn pass(&mut self, now: Ticks) {
        assert!(now >= self.now, "time moves forward");
        self.now = now;
    }

    /// The train on its way, if all its pulses are made. Then [`go_on`](Self::go_on).
    #[inline]
    pub fn ready(&self) -> Option<&Train> {
        self.leg.as_ref().filter(|leg| leg.last.ticks <= self.now).map(|leg| &leg.train)
    }

    /// From the end of a train to the next one.
    #[inline]
    pub fn go_on(&mut self, feet: &mut Feet) {
        if let Some(leg) = &self.leg {
            let Train { count, direction, .. } = leg.train;
            self.since = leg.last;
            self.pace = leg.end;
            self.rest = WHOLE;
            self.count(direction, count);
            self.leg = None;
            self.plan(feet);
        }
    }

    /// The pulses of the train on its way that are made, while others are to come.
    #[inline]
    pub fn cut(&mut self) -> Option<Train> {
        let leg = self.leg.as_ref()?;
        if leg.train.first_slot() <= self.now { self.cut_inside() } else { None }
    }

    #[cold]
    fn cut_inside(&mut self) -> Option<Train> {
        let leg = self.leg?;
        let done = leg.train.count_until(self.now);
        let (head, tail) = leg.train.split(done);
        self.since = tail.start;
        self.pace = self.pace_after(&leg, done);
        self.rest = WHOLE;
        self.count(head.direction, done);
        self.leg = Some(Leg { train: tail, ..leg });
        Some(head)
    }

    /// Whoever changes something has taken all pulses that were made before.
    fn assert_present(&self) {
        let past = self.leg.as_ref().is_some_and(|leg| leg.train.first_slot() <= self.now);
        assert!(!past, "pulses in the past belong out before a change");
    }

    /// Puts a change into effect at the end of the present clock.
    fn change(&mut self, feet: &mut Feet, change: impl FnOnce(&mut Self)) {
        self.assert_present();
        let before = (self.leg, self.pace, self.rest, self.since);
        if let Some(leg) = self.leg.take() {
            let (speed, rest) = self.progress(&leg);
            self.pace = Pace::of(speed);
            self.rest = rest;
        }
        self.since = Moment::at(self.now + 1);
        change(self);
        if self.keeps_course() {
            (self.leg, self.pace, self.rest, self.since) = before;
        } else {
            self.course.clear();
            self.run = Run::NONE;
            self.plan(feet);
        }
    }

    /// Speed and rest of the pulse at the end of the present clock.
    fn progress(&self, leg: &Leg) -> (Speed, u64) {
        let spacing = leg.train.interval;
        let gone = Moment::at(self.now + 1).since(leg.train.start).unwrap_or(0).min(spacing - 1);
        let [from, to] = [self.pace, self.pace_after(leg, 1)].map(|pace| i64::from(pace.speed));
        // Over one pulse the speed is taken as linear in time; way is speed by time.
        let share = quotient(u128::from(gone) << 32, spacing.into()) as i64;
        let speed = from + (((to - from) * share) >> 32);
        let [twice, ends] = [from + speed, from + to].map(|speed| speed as u128);
        let way = quotient(share as u128 * twice, ends) as u64;
        let left = ((u128::from(self.rest) * u128::from(WHOLE - way.min(WHOLE - 1))) >> 32) as u64;
        (speed as Speed, left.max(1))
    }

    /// Whether the course on its way is still right, so that a curve need not start anew.
    fn keeps_course(&self) -> bool {
        let now = Now { squared: self.pace.squared, rest: self.rest };
        match (self.course.get(), self.limits.bend(), self.wish()) {
            (Some(course), Some(bend), Some(wish)) => course.serves(&self.limits, bend, now, wish),
            _ => false,
        }
    }

    /// The speed after some pulses of the leg.
    fn pace_after(&self, leg: &Leg, pulses: u32) -> Pace {
        match (self.course.get(), leg.kind) {
            (Some(course), Kind::Curve(_)) => Pace::of(course.speed_at(pulses)),
            _ => leg.pace_after(self.pace, pulses),
        }
    }

    fn count(&mut self, direction: Direction, pulses: u32) {
        if let Some(course) = self.course.get_mut() {
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
        self.course.clear();
    }

    /// Finds the next leg, or comes to rest.
    #[inline]
    fn plan(&mut self, feet: &mut Feet) {
        match self.run.next(self.pace.squared) {
            Some(Piece { count, end, kind: Kind::Foot(at) }) => {
                self.go_on_foot(at as u32, count, end, feet);
            }
            Some(piece) => self.go(piece, feet),
            None => self.plan_anew(feet),
        }
    }

    /// The same where nothing was decided beforehand.
    #[inline(never)]
    fn plan_anew(&mut self, feet: &mut Feet) {
        // Twice at the most: coming to rest may be the start of a motion the other way.
        for _ in 0..2 {
            if self.pace == Pace::STILL && !self.start() {
                return;
            }
            match self.next_piece(feet) {
                Some(piece) => return self.go(piece, feet),
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
    fn next_piece(&mut self, feet: &mut Feet) -> Option<Piece> {
        let wish = self.wish()?;
        let now = Now { squared: self.pace.squared, rest: self.rest };
        if let Some(bend) = self.limits.bend() {
            return self.curved_piece(bend, now, wish);
        }
        if let Some((key, piece, run)) = plan::foot(&self.limits, now, wish) {
            feet.suit(key);
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

    /// The same with S-curves, which take more of the stack.
    #[inline(never)]
    fn curved_piece(&mut self, bend: Speed, now: Now, wish: Wish) -> Option<Piece> {
        if self.course.get().is_none() {
            self.course.set(Course::new(&self.limits, bend, now, wish));
        }
        self.course.get_mut()?.piece(self.rest)
    }

    /// Sets out on a piece.
    fn go(&mut self, piece: Piece, feet: &mut Feet) {
        let Piece { count, end, kind } = piece;
        let (scale, start, direction) = (self.limits.scale, self.since, self.direction);
        if let Kind::Foot(at) = kind {
            return self.go_on_foot(at as u32, count, end, feet);
        }
        let from = self.pace.complete();
        let end = match (kind, self.course.get()) {
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
    fn go_on_foot(&mut self, at: u32, count: u32, end: SpeedSquared, feet: &mut Feet) {
        let foot = feet.of(end > self.pace.squared);
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
        let between = |from: u64, to: u64| {
            let all = u128::from(from.abs_diff(to)) * u128::from(pulses);
            let change = quotient(all, self.train.count.into()) as u64;
            if to < from { from - change } else { from + change }
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
