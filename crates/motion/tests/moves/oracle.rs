//! The judge of a move. It knows the formulas of the manual and Newton, and nothing of how the kernel
//! plans: it looks at the exact moment of every pulse and asks whether a body whose acceleration is
//! bounded could have moved like that, no faster than allowed and no slower than need be.
//!
//! The mean speeds of two neighbouring spacings are at most the acceleration times the distance of the
//! spacings' middles apart, whatever the speed does in between: this makes the check of acceleration
//! sound, also across changes. Speeds have an upper bound (`ceiling`) that is carried from pulse to
//! pulse: it falls with full deceleration where the axis must get slower.

use crate::scenario::Units;
use motion::{Axis, Direction, Goal, Moment, Shape, Stop, Train, train::MAX_DURATION};

/// How fast speed may rise and fall.
#[derive(Clone, Copy)]
struct Rates {
    up: f64,
    down: f64,
}

impl Rates {
    fn max(self, other: Self) -> Self {
        Self { up: self.up.max(other.up), down: self.down.max(other.down) }
    }
}

/// The limits in pulses and clocks.
#[derive(Clone, Copy)]
pub struct Physics {
    pub top: f64,
    start: f64,
    stop: f64,
    rates: Rates,
    shape: Shape,
    /// One unit of velocity with its 8 fraction bits, and one of acceleration.
    quantum: f64,
    growth_quantum: f64,
}

/// 2^−`exponent`.
fn part(exponent: u32) -> f64 {
    1.0 / (1u64 << exponent) as f64
}

/// An internal velocity in pulses a clock: `v / (2^pulse_div · 2048 · 32)`.
pub fn velocity(internal: u32, pulse_div: u32) -> f64 {
    f64::from(internal) * part(pulse_div + 11 + 5)
}

impl From<&Units> for Physics {
    fn from(units: &Units) -> Self {
        let growth_quantum = part(units.ramp_div + units.pulse_div + 29);
        Self {
            top: velocity(units.top, units.pulse_div),
            start: velocity(units.start, units.pulse_div),
            stop: velocity(units.stop, units.pulse_div),
            rates: Rates {
                up: f64::from(units.acceleration) * growth_quantum,
                down: f64::from(units.deceleration) * growth_quantum,
            },
            shape: units.shape,
            quantum: velocity(1, units.pulse_div) / 256.0,
            growth_quantum,
        }
    }
}

/// The time of a way that begins and ends at these speeds, with constant acceleration up and down.
fn trapezoid_time(from: f64, to: f64, top: f64, rates: Rates, way: f64) -> f64 {
    let (from, to) = (from.min(top), to.min(top));
    let Rates { up, down } = rates;
    let ramps = |peak: f64| (peak * peak - from * from) / (2.0 * up) + (peak * peak - to * to) / (2.0 * down);
    let peak = ((way - ramps(0.0)) * 2.0 * up * down / (up + down)).sqrt().min(top);
    (peak - from) / up + (peak - to) / down + (way - ramps(peak)).max(0.0) / peak
}

/// The numbers that show how near the kernel comes to the bounds.
#[derive(Clone, Copy, Default, Debug)]
pub struct Extremes {
    /// Speed above the limit, in quanta.
    pub speed: f64,
    /// Acceleration above the limit, in quanta.
    pub acceleration: f64,
    /// Time lost or gained against the reference, in spacings.
    pub time: f64,
}

impl Extremes {
    pub fn merge(&mut self, other: &Self) {
        self.speed = self.speed.max(other.speed);
        self.acceleration = self.acceleration.max(other.acceleration);
        self.time = self.time.max(other.time);
    }
}

/// An undisturbed move from standstill, pulse by pulse: v² grows by 2a with each pulse and has to be
/// back at the stop speed at the target.
struct Reference {
    begin: Moment,
    from: f64,
    to: f64,
    top: f64,
    growth: f64,
    fall: f64,
    /// Speed a pulse by which a soft approach gets slower; 0 for a trapezoid.
    decay: f64,
    pulses: u64,
    /// Of how many, where there is a target.
    way: Option<u64>,
    /// Speed and time after `pulses`, with the approach of a trapezoid and of the asked shape.
    fast: (f64, f64),
    slow: (f64, f64),
}

impl Reference {
    fn next(&mut self) {
        self.pulses += 1;
        let up = self.from * self.from + self.growth * self.pulses as f64;
        let (mut fast, mut gentle) = (up.sqrt().min(self.top), f64::INFINITY);
        if let Some(way) = self.way {
            let left = (way - self.pulses) as f64;
            fast = fast.min((self.to * self.to + self.fall * left).sqrt());
            if self.decay != 0.0 {
                gentle = (self.decay * left).max(self.to);
            }
        }
        let slow = fast.min(gentle);
        self.fast = (fast, self.fast.1 + 2.0 / (self.fast.0 + fast));
        self.slow = (slow, self.slow.1 + 2.0 / (self.slow.0 + slow));
    }
}

/// A motion from standstill to standstill in one direction.
struct Motion {
    /// The last pulse, or the moment in which it began.
    since: Moment,
    /// The spacing before `since`; `None` for the first pulse.
    spacing: Option<u64>,
    /// Upper bound of the speed at `since`.
    ceiling: f64,
    /// What the speed would be with full deceleration from the beginning: starting faster than the stop
    /// speed may leave too little way.
    unavoidable: f64,
    start: f64,
    /// Since the last pulse: whether anything was changed, the greatest rates and quanta in force,
    /// the highest limit and the highest speed from which the target could be met.
    changed: bool,
    rates: Rates,
    quantum: f64,
    growth_quantum: f64,
    limit: f64,
    cap: f64,
    /// The rates of the spacing before, and their quantum.
    rates_before: Rates,
    growth_quantum_before: f64,
    changed_before: bool,
    reference: Option<Reference>,
}

impl Motion {
    /// In the spacing before `since` and after.
    fn greatest_rates(&self) -> Rates {
        self.rates.max(self.rates_before)
    }

    fn greatest_growth_quantum(&self) -> f64 {
        self.growth_quantum.max(self.growth_quantum_before)
    }
}

/// What the present direction has before it.
enum Ahead {
    /// A limit, and the highest speed from which the axis can still meet its target.
    Free { limit: f64, cap: f64 },
    /// Nothing: the axis has to stop.
    Wrong,
    /// A switch that allows no further pulse.
    Closed,
}

pub struct Oracle {
    units: Units,
    physics: Physics,
    goal: Goal,
    blocked: [Option<Stop>; 2],
    pub position: i32,
    pub odometer: i64,
    pub steps: u64,
    now: u64,
    direction: Direction,
    motion: Option<Motion>,
    /// By then the goal is reached.
    deadline: f64,
    pub extremes: Extremes,
}

fn ensure(holds: bool, message: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(message()) }
}

/// 2⁻³² clocks in a clock.
const WHOLE: f64 = 4_294_967_296.0;

fn clocks(span: u64) -> f64 {
    span as f64 / WHOLE
}

/// How exact a spacing is, in 2⁻³² clocks: a millionth of a clock. This counts only where acceleration
/// is so low that it changes spacings by less.
const RESOLUTION: u64 = 1 << 12;

/// A change finds the axis at a speed that is off by this part of a velocity quantum.
const KICK: f64 = 1.0 / 32.0;

/// The part of a pulse by which the way to a stop may be too short.
const MISS: f64 = 1.0 / 4096.0;

/// Rounding of the oracle itself.
const EXACT: f64 = 1.0 + 1e-9;

/// Where the axis gets slower, its spacings may be off by this part: a block of pulses is a polynomial.
const NEARLY: f64 = 1.005;

impl Oracle {
    pub fn new(units: Units) -> Self {
        Self {
            units,
            physics: (&units).into(),
            goal: Goal::Position(0),
            blocked: [None; 2],
            position: 0,
            odometer: 0,
            steps: 0,
            now: 0,
            direction: Direction::Positive,
            motion: None,
            deadline: 0.0,
            extremes: Extremes::default(),
        }
    }

    /// A goal speed in pulses a clock.
    fn goal_speed(&self, speed: u32) -> f64 {
        velocity(motion::tmc429::internal(speed) as u32, self.units.pulse_div)
    }

    fn ahead(&self, direction: Direction) -> Ahead {
        match self.blocked[direction as usize] {
            Some(Stop::Hard) => return Ahead::Closed,
            Some(Stop::Soft) => return Ahead::Wrong,
            None => {}
        }
        let Physics { top, stop, rates, .. } = self.physics;
        match self.goal {
            Goal::Position(target) => {
                let way = i64::from(target.wrapping_sub(self.position)) * direction.sign();
                if way <= 0 {
                    return Ahead::Wrong;
                }
                // At the end of the next pulse.
                let cap = (stop * stop + 2.0 * rates.down * (way - 1) as f64).sqrt();
                Ahead::Free { limit: top, cap }
            }
            Goal::Speed(way, speed) if way == direction && speed != 0 => {
                let limit = self.goal_speed(speed);
                Ahead::Free { limit, cap: limit }
            }
            Goal::Speed(..) => Ahead::Wrong,
        }
    }

    /// Whether an axis at rest may stay so.
    fn met(&self) -> bool {
        match self.goal {
            Goal::Position(target) => {
                let way = target.wrapping_sub(self.position);
                way == 0 || self.blocked[Direction::of(way.into()) as usize].is_some()
            }
            Goal::Speed(way, speed) => speed == 0 || self.blocked[way as usize].is_some(),
        }
    }

    /// What the axis says between pulses.
    pub fn look(&mut self, axis: &Axis) -> Result<(), String> {
        let told = (axis.position(), axis.odometer(), axis.steps());
        let counted = (self.position, self.odometer, self.steps);
        ensure(told == counted, || format!("position, odometer, steps {told:?}, counted {counted:?}"))?;
        ensure(axis.is_moving() == axis.wake().is_some(), || "moving without a wake, or the reverse".into())?;
        if !axis.is_moving() {
            if let Some(motion) = self.motion.take() {
                self.check_end(&motion, motion.since)?;
            }
            ensure(axis.speed() == 0, || "speed at rest".into())?;
            return ensure(self.met(), || format!("stands at {} although {:?}", self.position, self.goal));
        }
        if axis.direction() != self.direction {
            // Reversed at the last pulse.
            let Some(motion) = self.motion.take() else { return Err("turned at rest".into()) };
            self.check_end(&motion, motion.since)?;
            self.direction = axis.direction();
            self.begin(motion.since, false)?;
        }
        let wake = axis.wake().unwrap_or(0);
        ensure(wake > self.now, || format!("wake {wake} is over at {}", self.now))?;
        if !matches!((self.goal, self.ahead(self.direction)), (Goal::Speed(..), Ahead::Free { .. })) {
            ensure(self.now as f64 <= self.deadline, || format!("not there at {}", self.deadline))?;
        }
        let Some(Motion { since, spacing: Some(spacing), quantum, .. }) = self.motion else { return Ok(()) };
        let steepest = self.motion.as_ref().map(Motion::greatest_rates).map_or(0.0, |r| r.up.max(r.down));
        let growth_quantum = self.motion.as_ref().map_or(0.0, Motion::greatest_growth_quantum);
        let told = f64::from(axis.speed()) * part(36 + self.units.pulse_div);
        let mean = 1.0 / clocks(spacing);
        let gone = clocks(Moment::at(self.now + 1).since(since).unwrap_or(0));
        let room = (steepest + growth_quantum) * (clocks(spacing) / 2.0 + gone) + quantum;
        ensure((told - mean).abs() <= room, || format!("says {told} pulses a clock after {mean}"))
    }

    /// A train that came out while time moved to the end of clock `now`.
    pub fn train(&mut self, train: &Train, now: u64) -> Result<(), String> {
        ensure(train.count > 0, || "empty train".into())?;
        ensure(train.end() <= now, || format!("{train:?} ends after {now}"))?;
        ensure(train.end() - train.start.ticks < MAX_DURATION, || format!("{train:?} is too long"))?;
        let mut edges = train.edges();
        for k in 1..=train.count {
            let at = train.moment(k);
            ensure(edges.next() == Some(at.ticks), || format!("pulse {k} of {train:?}: edges differ"))?;
            self.pulse(at, train.direction)
                .map_err(|error| format!("pulse {} ({k} of {train:?}): {error}", self.steps))?;
        }
        Ok(())
    }

    /// Time has moved to the end of clock `now`, and its trains are out.
    pub fn passed(&mut self, now: u64) {
        self.now = now;
    }

    fn pulse(&mut self, at: Moment, direction: Direction) -> Result<(), String> {
        ensure(at.ticks > self.now, || {
            format!("pulse at {} although it was {} already", at.ticks, self.now)
        })?;
        if direction != self.direction {
            let Some(motion) = self.motion.take() else { return Err("pulse at rest".into()) };
            self.check_end(&motion, motion.since)?;
            self.direction = direction;
            self.begin(motion.since, false)?;
        }
        let ahead = self.ahead(direction);
        let Some(mut motion) = self.motion.take() else { return Err("pulse at rest".into()) };
        let Some(spacing) = at.since(motion.since).filter(|spacing| *spacing > 0) else {
            return Err(format!("{at:?} is not after {:?}", motion.since));
        };
        let time = clocks(spacing);
        let mean = 1.0 / time;
        let rates = motion.rates;
        let quantum = motion.quantum;

        // Acceleration, between the middles of this spacing and the one before.
        if let Some(before) = motion.spacing {
            let Rates { up, down } = motion.greatest_rates();
            let allowed = if spacing > before { down } else { up };
            let difference = clocks(spacing.abs_diff(before).saturating_sub(RESOLUTION));
            let seconds = clocks(before);
            let kick = if motion.changed || motion.changed_before { quantum * KICK } else { 0.0 };
            let found = (difference / (time * seconds) - kick) * 2.0 / (time + seconds);
            let unit = motion.greatest_growth_quantum();
            let excess = (found / EXACT - allowed) / unit;
            self.extremes.acceleration = self.extremes.acceleration.max(excess);
            ensure(excess <= 1.0, || format!("acceleration {excess} quanta above {}", allowed / unit))?;
        } else {
            let first = mean - rates.up * time / 2.0;
            ensure(first <= motion.start * EXACT + quantum, || {
                format!("started with {first} pulses a clock instead of {}", motion.start)
            })?;
        }

        // Speed.
        let fall = 2.0 * self.physics.rates.down;
        let slower = (motion.ceiling * motion.ceiling - fall).max(0.0).sqrt();
        // Stopping may take whole pulses: no faster than what ends with the last of them.
        let stop = self.physics.stop;
        let stopping = || {
            let way = (motion.ceiling * motion.ceiling - stop * stop).max(0.0) / fall;
            (stop * stop + fall * ((way - 1e-6).ceil() - 1.0).max(0.0)).sqrt().min(motion.ceiling)
        };
        let (limit, mut ceiling) = if motion.changed {
            (motion.limit.max(motion.ceiling), motion.cap.min(motion.limit).max(motion.ceiling))
        } else {
            motion.unavoidable = (motion.unavoidable * motion.unavoidable - fall).max(0.0).sqrt();
            match ahead {
                Ahead::Free { limit, cap } => {
                    // A soft approach is left for braking earlier.
                    let ceiling = if slower > cap {
                        stopping()
                    } else if self.physics.shape == Shape::Soft {
                        stopping().max(cap.min(limit))
                    } else {
                        slower.max(cap.min(limit))
                    };
                    let mean = (motion.ceiling + ceiling) / 2.0;
                    (if motion.ceiling > limit { limit.max(mean * NEARLY) } else { limit }, ceiling)
                }
                Ahead::Wrong => {
                    ensure(motion.ceiling * NEARLY + quantum > stop, || {
                        "goes on where it could stop".into()
                    })?;
                    let ceiling = stopping();
                    ((motion.ceiling + ceiling) / 2.0 * NEARLY, ceiling)
                }
                Ahead::Closed => return Err("pulse into a switch".into()),
            }
        };
        let excess = (mean / EXACT - limit) / quantum;
        self.extremes.speed = self.extremes.speed.max(excess);
        ensure(excess <= 1.0, || {
            format!("speed {} is {excess} quanta above {}", mean / quantum, limit / quantum)
        })?;
        let between = f64::midpoint(motion.ceiling.max(slower), ceiling) * NEARLY + quantum;
        ensure(motion.changed || mean <= between.max(motion.ceiling), || {
            format!("speed {} too high to stop in time, {} would do", mean / quantum, between / quantum)
        })?;
        ceiling = ceiling.min(mean + (rates.up + motion.growth_quantum) * time / 2.0);

        // Not slower than need be.
        if let (Goal::Speed(way, speed), false) = (self.goal, motion.changed) {
            let wanted = self.goal_speed(speed);
            let settled = motion.since.ticks as f64 > self.deadline && way == direction && speed != 0;
            ensure(!settled || (mean - wanted).abs() <= quantum, || {
                format!("speed {} instead of {}", mean / quantum, wanted / quantum)
            })?;
        }
        if let Some(reference) = &mut motion.reference {
            reference.next();
            let fraction = (f64::from(at.fraction) - f64::from(reference.begin.fraction)) / WHOLE;
            let elapsed = (at.ticks - reference.begin.ticks) as f64 + fraction;
            let (early, late) = (reference.fast.1 - elapsed, elapsed - reference.slow.1);
            let off = early.max(late) / time;
            self.extremes.time = self.extremes.time.max(off);
            let room = if reference.decay == 0.0 { 0.01 } else { 1.5 } + 1e-6 * elapsed / time;
            ensure(off <= room, || format!("{off} spacings off the ideal ramp"))?;
        }

        // On to the next.
        self.position = self.position.wrapping_add(direction.sign() as i32);
        self.odometer += direction.sign();
        self.steps += 1;
        motion.spacing = Some(spacing);
        motion.since = at;
        motion.ceiling = ceiling;
        motion.rates_before = rates;
        motion.changed_before = motion.changed;
        motion.changed = false;
        motion.rates = self.physics.rates;
        motion.quantum = self.physics.quantum;
        motion.growth_quantum_before = motion.growth_quantum;
        motion.growth_quantum = self.physics.growth_quantum;
        (motion.limit, motion.cap) = match self.ahead(direction) {
            Ahead::Free { limit, cap } => (limit, cap),
            _ => (0.0, 0.0),
        };
        self.motion = Some(motion);
        Ok(())
    }

    /// A motion begins.
    fn begin(&mut self, since: Moment, fresh: bool) -> Result<(), String> {
        let Ahead::Free { limit, cap } = self.ahead(self.direction) else {
            return Err(format!("starts {:?} towards nothing", self.direction));
        };
        let Physics { top, stop, rates, shape, quantum, growth_quantum, .. } = self.physics;
        let start = self.physics.start.min(limit);
        let [growth, fall] = [2.0 * rates.up, 2.0 * rates.down];
        let way = match self.goal {
            Goal::Position(target) => Some(target.wrapping_sub(self.position).unsigned_abs().into()),
            Goal::Speed(..) => None,
        };
        let stops = way.is_none_or(|way| start * start <= stop * stop + fall * way as f64);
        let reference = (fresh && stops).then(|| Reference {
            begin: since,
            from: start,
            to: stop,
            top: limit,
            growth,
            fall,
            decay: if shape == Shape::Soft { rates.down / top } else { 0.0 },
            pulses: 0,
            way,
            fast: (start, 0.0),
            slow: (start, 0.0),
        });
        self.motion = Some(Motion {
            since,
            spacing: None,
            ceiling: start,
            unavoidable: start,
            start,
            changed: false,
            rates,
            quantum,
            limit,
            cap,
            growth_quantum,
            rates_before: rates,
            growth_quantum_before: growth_quantum,
            changed_before: false,
            reference,
        });
        Ok(())
    }

    /// The motion has ended at `at`.
    fn check_end(&self, motion: &Motion, at: Moment) -> Result<(), String> {
        ensure(!matches!(self.ahead(self.direction), Ahead::Free { .. }), || "stops on its way".into())?;
        let Some(spacing) = motion.spacing else { return Ok(()) };
        let allowed = motion.greatest_rates().down + motion.greatest_growth_quantum();
        let gone = at.since(motion.since).map_or(0.0, clocks);
        let speed = 1.0 / clocks(spacing) - allowed * (clocks(spacing) / 2.0 + gone);
        let stop = self.physics.stop.max(motion.unavoidable);
        let limit = (stop * stop + 2.0 * allowed * MISS).sqrt() * NEARLY + motion.quantum;
        ensure(speed <= limit, || format!("stands still from {speed} pulses a clock, {limit} at the most"))
    }

    /// Upper bound of the speed at the end of the present clock.
    pub fn speed_at_most(&self) -> f64 {
        let Some(motion) = &self.motion else { return 0.0 };
        let bound = motion.ceiling.max(motion.cap.min(motion.limit));
        let Some(spacing) = motion.spacing else { return bound };
        let gone = Moment::at(self.now + 1).since(motion.since).map_or(0.0, clocks);
        bound.min(1.0 / clocks(spacing) + motion.greatest_rates().up * (clocks(spacing) / 2.0 + gone))
    }

    /// Something is changed at the end of the present clock; `axis` has been told.
    pub fn changed(&mut self, change: impl FnOnce(&mut Settings), axis: &Axis) -> Result<(), String> {
        let speed = self.speed_at_most();
        let mut settings = Settings {
            units: self.units,
            goal: self.goal,
            blocked: self.blocked,
            position: self.position,
            halted: false,
        };
        change(&mut settings);
        self.units = settings.units;
        self.physics = (&settings.units).into();
        self.goal = settings.goal;
        self.blocked = settings.blocked;
        self.position = settings.position;

        let at = Moment::at(self.now + 1);
        if let Some(mut motion) = self.motion.take() {
            let ahead = self.ahead(self.direction);
            let hard = settings.halted || matches!(ahead, Ahead::Closed);
            let goes_on = axis.is_moving() && axis.direction() == self.direction;
            ensure(!hard || !goes_on, || "goes on after a hard stop".into())?;
            motion.rates = motion.rates.max(self.physics.rates);
            motion.quantum = motion.quantum.max(self.physics.quantum);
            motion.growth_quantum = motion.growth_quantum.max(self.physics.growth_quantum);
            if goes_on {
                motion.changed = true;
                motion.reference = None;
                if let Ahead::Free { limit, cap } = ahead {
                    motion.limit = motion.limit.max(limit);
                    motion.cap = motion.cap.max(cap);
                }
                self.motion = Some(motion);
            } else if !hard {
                self.check_end(&motion, at)?;
            }
        }
        if axis.is_moving() && self.motion.is_none() {
            self.direction = axis.direction();
            self.begin(at, true)?;
        }
        self.deadline = self.now as f64 + self.time_to_settle(speed);
        self.look(axis)
    }

    /// Enough time to do what is asked, from at most this speed in any direction.
    fn time_to_settle(&self, speed: f64) -> f64 {
        let Physics { top, start, stop, rates, shape, .. } = self.physics;
        let brake = speed / rates.down;
        let pulses = 4.0 / start.min(top) + 4.0 / stop.min(top);
        let go = match self.goal {
            Goal::Position(target) => {
                let way = f64::from(target.wrapping_sub(self.position)).abs() + speed * brake / 2.0 + 2.0;
                let soft = if shape == Shape::Soft {
                    top / rates.down * (2.0 + (top / stop).ln().max(0.0))
                } else {
                    0.0
                };
                // On its way it may be slower than the start speed.
                let from = if self.motion.is_some() { 0.0 } else { start };
                trapezoid_time(from, stop, top, rates, way) + soft
            }
            Goal::Speed(_, speed) => self.goal_speed(speed) / rates.up,
        };
        brake + pulses + go * NEARLY
    }

    /// Pulses that a full ramp may take.
    pub fn way_of_ramp(&self) -> f64 {
        let (speed, Rates { up, down }) = (self.speed_at_most(), self.physics.rates);
        speed * speed / (2.0 * up.min(down))
    }
}

/// What a change may change.
pub struct Settings {
    pub units: Units,
    pub goal: Goal,
    pub blocked: [Option<Stop>; 2],
    pub position: i32,
    pub halted: bool,
}
