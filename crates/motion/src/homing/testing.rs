//! A stage with switches and an encoder's index, for the tests of homing.

use super::routine::{Homing, Inputs, Occasion, Outcome, Settings, Step};
use crate::pps::{self, Profile};
use crate::{Axis, Direction, Scale, Ticks};
use std::fmt::Write;
use std::ops::Range;

const CLOCK_HZ: u32 = 1_000_000;
const SCALE: Scale = pps::scale(2000, CLOCK_HZ);

/// The counter where a routine starts.
pub const START: i32 = 7777;

/// Between the regular samples of a course.
const SAMPLE: Ticks = 100_000;

/// Settings of the tests: braking takes 100 pulses, 99 and the part of one that is left at the trigger.
pub fn settings() -> Settings {
    let profile =
        Profile { low_pps: 100, high_pps: 1000, acceleration_ms: 180, deceleration_ms: 180, s_curve: false };
    Settings {
        limits: profile.limits(SCALE, CLOCK_HZ),
        slow: pps::speed(profile.low_pps, SCALE, CLOCK_HZ),
        correction: 150,
        index_marks: 1,
        return_to_zero: false,
    }
}

/// The same with jerk-limited ramps.
pub fn s_settings() -> Settings {
    let profile =
        Profile { low_pps: 100, high_pps: 1000, acceleration_ms: 180, deceleration_ms: 180, s_curve: true };
    Settings { limits: profile.limits(SCALE, CLOCK_HZ), ..settings() }
}

/// Where the switches are, in the stage's own positions; a routine runs towards the higher ones.
#[derive(Clone, Debug)]
pub struct Stage {
    pub home: Range<i64>,
    /// The limits are on at and beyond these.
    pub limits: [i64; 2],
    /// Marks of a pulse's width at the multiples of this.
    pub index: i64,
    /// Where the slowdown switch is on.
    pub slowdown: Range<i64>,
    /// Whether it counts as on once it was.
    pub latch: bool,
}

/// The stage of the tests.
pub const STAGE: Stage =
    Stage { home: 500..560, limits: [-400, 1000], index: 350, slowdown: 0..0, latch: false };

/// What a routine did.
#[derive(Debug, PartialEq)]
pub struct Record {
    pub outcome: Outcome,
    /// Where the stage stands at the end.
    pub at: i64,
    /// What the counter says at the end.
    pub position: i64,
    /// Regularly, and whenever the routine changes something.
    course: Vec<Sample>,
    /// The occasions to clear the drive's counter, and where the stage stood.
    pub clears: Vec<(Occasion, i64)>,
    /// The speed at every pulse, in pulses a second.
    speeds: Vec<(i64, i64)>,
}

#[derive(Debug, PartialEq)]
struct Sample {
    ms: Ticks,
    phase: char,
    position: i64,
    pps: i64,
    clear: Option<Occasion>,
}

impl Record {
    /// Its course as a table.
    pub fn table(&self) -> String {
        let mut table = String::new();
        for Sample { ms, phase, position, pps, clear } in &self.course {
            write!(table, "{ms:6} ms  {phase}  {position:5}  {pps:5} pps").unwrap();
            match clear {
                Some(occasion) => writeln!(table, "  {occasion:?}").unwrap(),
                None => writeln!(table).unwrap(),
            }
        }
        table
    }

    /// The highest speed in a range of the stage, one way.
    pub fn fastest(&self, way: Direction, range: Range<i64>) -> i64 {
        let inside = self.speeds.iter().filter(|(at, _)| range.contains(at));
        inside.map(|&(_, pps)| pps * way.sign()).max().unwrap_or(0)
    }
}

/// Runs a routine in both directions. It is the same.
#[track_caller]
pub fn home(stage: &Stage, steps: &'static [Step], from: i64, settings: Settings) -> Record {
    let record = run(stage, steps, from, settings, Direction::Positive);
    assert_eq!(run(stage, steps, from, settings, Direction::Negative), record);
    record
}

/// Everything in the record is as if the way was positive.
fn run(stage: &Stage, steps: &'static [Step], from: i64, settings: Settings, way: Direction) -> Record {
    let ahead = |value: i64| value * way.sign();
    let mut axis = Axis::new(settings.limits);
    axis.set_position(ahead(START.into()) as i32);
    axis.halt();
    let mut homing = Homing::new(steps, way, settings);
    let mut course = Vec::new();
    let mut clears = Vec::new();
    let mut speeds = Vec::new();
    let mut slowed = false;
    let mut now = 0;
    let mut known = None;
    for _ in 0..100_000 {
        let at = from + ahead(axis.odometer());
        let mut inputs = stage.inputs(at, way);
        slowed = inputs.slowdown || slowed && stage.latch;
        inputs.slowdown = slowed;
        let mut news = now % SAMPLE == 0;
        let mut outcome = None;
        let mut clear = None;
        // The routine hears of the start, of rest, and of changes of what it watches.
        if known != Some(watched(inputs, &homing)) || !axis.is_moving() {
            let state = |homing: &Homing, axis: &Axis| (homing.phase(), axis.position(), axis.goal());
            let before = state(&homing, &axis);
            outcome = homing.poll(&mut axis, inputs);
            clear = homing.take_clear();
            clears.extend(clear.map(|clear| (clear, at)));
            news |= before != state(&homing, &axis) || outcome.is_some();
            known = Some(watched(inputs, &homing));
        }
        let position = ahead(axis.position().into());
        let pps = i64::from(pps::pps(axis.speed(), SCALE, CLOCK_HZ));
        let pps = ahead(axis.direction().sign() * pps);
        speeds.push((at, pps));
        if news {
            course.push(Sample { ms: now / 1000, phase: homing.phase(), position, pps, clear });
        }
        if let Some(outcome) = outcome {
            assert!(!axis.is_moving());
            let outcome = match outcome {
                Outcome::Limit(limit) => Outcome::Limit(seen(limit, way)),
                Outcome::Found => outcome,
            };
            return Record { outcome, at, position, course, clears, speeds };
        }
        axis.set_window(axis.odometer() - 1, axis.odometer() + 1);
        let wake = axis.wake().expect("a routine under way moves");
        now = wake.min((now / SAMPLE + 1) * SAMPLE);
        axis.advance(now, |_| ());
    }
    panic!("the routine from {from} does not end");
}

impl Stage {
    /// Inputs at a position, when ahead is this way.
    fn inputs(&self, at: i64, way: Direction) -> Inputs {
        let mut limits = [false; 2];
        limits[way.reversed() as usize] = at <= self.limits[0];
        limits[way as usize] = at >= self.limits[1];
        Inputs {
            home: self.home.contains(&at),
            limits,
            index: at.rem_euclid(self.index) == 0,
            slowdown: self.slowdown.contains(&at),
        }
    }
}

fn watched(inputs: Inputs, homing: &Homing) -> Inputs {
    Inputs { index: inputs.index && homing.watches_index(), ..inputs }
}

/// A direction as it looks to one that goes this way.
fn seen(direction: Direction, way: Direction) -> Direction {
    if way == Direction::Positive { direction } else { direction.reversed() }
}
