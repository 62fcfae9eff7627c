//! Random moves: what is asked of an axis, in the units of the manual.

use crate::random::Random;
use motion::{Direction, Goal, Limits, Shape, Stop, tmc429};

/// Limits in internal units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    pub pulse_div: u32,
    pub ramp_div: u32,
    pub top: u32,
    pub start: u32,
    pub stop: u32,
    pub acceleration: u32,
    pub deceleration: u32,
    pub shape: Shape,
}

impl Units {
    pub fn limits(&self) -> Limits {
        Limits {
            scale: tmc429::scale(self.pulse_div),
            top: tmc429::speed(self.top),
            start: tmc429::speed(self.start),
            stop: tmc429::speed(self.stop),
            growth: tmc429::growth(self.acceleration, self.pulse_div, self.ramp_div),
            fall: tmc429::growth(self.deceleration, self.pulse_div, self.ramp_div),
            shape: self.shape,
        }
    }

    /// The same as a Rust expression.
    pub fn source(&self) -> String {
        let Self { pulse_div, ramp_div, top, start, stop, acceleration, deceleration, shape } = self;
        format!(
            "Limits {{ scale: tmc429::scale({pulse_div}), top: tmc429::speed({top}), start: tmc429::speed({start}), \
             stop: tmc429::speed({stop}), growth: tmc429::growth({acceleration}, {pulse_div}, {ramp_div}), \
             fall: tmc429::growth({deceleration}, {pulse_div}, {ramp_div}), shape: Shape::{shape:?} }}"
        )
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Op {
    /// A target so far from the present position.
    Target(i32),
    /// A goal speed in internal units.
    Speed(Direction, u32),
    /// Other limits. Divisors change only where the speed stays within the range of the registers.
    Limits(Units),
    /// Overwrites the position with one so far away.
    Shift(i32),
    Block(Direction, Option<Stop>),
    Halt,
}

/// When an op happens: so many pulses after the one before (or at rest), and then that part of the way,
/// in time, to the next pulse.
#[derive(Clone, Copy, Debug)]
pub struct Wait {
    pub pulses: u32,
    pub part: u8,
}

#[derive(Clone, Debug)]
pub struct Scenario {
    pub seed: u64,
    pub units: Units,
    pub position: i32,
    pub ops: Vec<(Wait, Op)>,
}

fn direction(random: &mut Random) -> Direction {
    if random.chance(50) { Direction::Positive } else { Direction::Negative }
}

fn internal(random: &mut Random) -> u32 {
    if random.chance(50) { random.spread(2047) } else { random.between(1, 2047) }
}

fn units(random: &mut Random) -> Units {
    let top = internal(random);
    // Near each other the divisors give ramps of some dozens to thousands of pulses.
    let pulse_div = random.below(14);
    let ramp_div = if random.chance(60) {
        (pulse_div + random.below(7)).saturating_sub(2).min(13)
    } else {
        random.below(14)
    };
    let acceleration = internal(random);
    Units {
        pulse_div,
        ramp_div,
        top,
        start: if random.chance(80) { 1 } else { random.spread(top) },
        stop: if random.chance(60) { 1 } else { random.spread(2047) },
        acceleration,
        deceleration: if random.chance(50) { acceleration } else { internal(random) },
        shape: if random.chance(25) { Shape::Soft } else { Shape::Trapezoid },
    }
}

fn changed(random: &mut Random, old: Units) -> Units {
    let fresh = units(random);
    match random.below(6) {
        0 | 1 => Units { top: fresh.top, ..old },
        2 | 3 => Units { acceleration: fresh.acceleration, deceleration: fresh.deceleration, ..old },
        4 => match random.below(4) {
            0 => Units { start: fresh.start, ..old },
            1 => Units { stop: fresh.stop, ..old },
            2 => Units { shape: fresh.shape, ..old },
            _ => Units { ramp_div: fresh.ramp_div, ..old },
        },
        _ => fresh,
    }
}

fn distance(random: &mut Random) -> i32 {
    let longest = match random.below(1000) {
        0 => 1 << 20,
        1..20 => 1 << 14,
        20..300 => 1 << 10,
        _ => 1 << 7,
    };
    let pulses = random.spread(longest) as i32;
    if random.chance(50) { pulses } else { -pulses }
}

fn goal(random: &mut Random) -> Op {
    match random.below(10) {
        0..7 => Op::Target(distance(random)),
        7 => Op::Speed(direction(random), 0),
        _ => Op::Speed(direction(random), internal(random)),
    }
}

fn change(random: &mut Random, units: &mut Units) -> Op {
    match random.below(20) {
        0..8 => goal(random),
        8..14 => {
            *units = changed(random, *units);
            Op::Limits(*units)
        }
        14 | 15 => Op::Shift(distance(random)),
        16..19 => {
            let stop = [None, Some(Stop::Hard), Some(Stop::Soft)][random.below(3) as usize];
            Op::Block(direction(random), stop)
        }
        _ => Op::Halt,
    }
}

fn wait(random: &mut Random) -> Wait {
    let pulses = match random.below(10) {
        0..3 => random.below(4),
        3..9 => random.spread(400),
        _ => u32::MAX,
    };
    let part = match random.below(4) {
        0 => 0,
        1 => 255,
        _ => random.below(256) as u8,
    };
    Wait { pulses, part }
}

impl Scenario {
    pub fn random(seed: u64) -> Self {
        let random = &mut Random::new(seed);
        let first = units(random);
        let position = match random.below(4) {
            0 => 0,
            1 => i32::MAX - random.below(5000) as i32,
            2 => i32::MIN + random.below(5000) as i32,
            _ => random.below(u32::MAX) as i32,
        };
        let now = Wait { pulses: 0, part: random.below(256) as u8 };
        let mut ops = vec![(now, goal(random))];
        let mut units = first;
        if random.chance(60) {
            for _ in 0..random.spread(8) {
                ops.push((wait(random), change(random, &mut units)));
            }
            // What was held may go on, and at the end most axes stand on a target.
            for way in [Direction::Positive, Direction::Negative] {
                ops.push((wait(random), Op::Block(way, None)));
            }
            ops.push((wait(random), Op::Target(distance(random))));
        }
        Self { seed, units: first, position, ops }
    }

    /// Scenarios a little simpler than this one.
    pub fn simpler(&self) -> Vec<Self> {
        let mut all = Vec::new();
        for at in 0..self.ops.len() {
            let mut ops = self.ops.clone();
            ops.remove(at);
            all.push(Self { ops, ..self.clone() });
        }
        if self.position != 0 {
            all.push(Self { position: 0, ..self.clone() });
        }
        for units in smaller_units(self.units) {
            all.push(Self { units, ..self.clone() });
        }
        for (at, &(wait, op)) in self.ops.iter().enumerate() {
            let mut with = |wait, op| {
                let mut ops = self.ops.clone();
                ops[at] = (wait, op);
                all.push(Self { ops, ..self.clone() });
            };
            if wait.pulses > 0 {
                with(Wait { pulses: wait.pulses / 2, ..wait }, op);
                with(Wait { pulses: wait.pulses - 1, ..wait }, op);
            }
            if wait.part > 0 {
                with(Wait { part: 0, ..wait }, op);
            }
            match op {
                Op::Target(way) if way.abs() > 1 => {
                    with(wait, Op::Target(way / 2));
                    with(wait, Op::Target(way - way.signum()));
                }
                Op::Shift(way) if way.abs() > 1 => with(wait, Op::Shift(way / 2)),
                Op::Speed(way, speed) if speed > 1 => with(wait, Op::Speed(way, speed / 2)),
                Op::Limits(units) => smaller_units(units).into_iter().for_each(|u| with(wait, Op::Limits(u))),
                _ => {}
            }
        }
        all
    }
}

fn smaller_units(units: Units) -> Vec<Units> {
    let mut all = vec![
        Units { start: 1, ..units },
        Units { stop: 1, ..units },
        Units { stop: (units.stop / 2).max(1), ..units },
        Units { top: (units.top / 2).max(1), ..units },
        Units { acceleration: (units.acceleration / 2).max(1), ..units },
        Units { deceleration: (units.deceleration / 2).max(1), ..units },
        Units { deceleration: units.acceleration, ..units },
        Units { shape: Shape::Trapezoid, ..units },
        Units { ramp_div: units.ramp_div.saturating_sub(1), ..units },
    ];
    all.retain(|smaller| *smaller != units);
    all
}

/// A goal as a Rust expression.
pub fn goal_source(goal: Goal) -> String {
    match goal {
        Goal::Position(target) => format!("Goal::Position({target})"),
        Goal::Speed(way, speed) => format!("Goal::Speed(Direction::{way:?}, tmc429::speed({}))", speed >> 20),
    }
}
