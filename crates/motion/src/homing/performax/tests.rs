//! A stage with switches and an index, homed.

use super::Routine;
use crate::homing::Homing;
use crate::homing::routine::{Inputs, Outcome, Settings};
use crate::pps::{self, Profile};
use crate::{Axis, Direction, Scale, Stop, Ticks};
use std::fmt::Write;
use std::ops::Range;

const CLOCK_HZ: u32 = 1_000_000;
const SCALE: Scale = pps::scale(2000, CLOCK_HZ);
const PROFILE: Profile =
    Profile { low_pps: 100, high_pps: 1000, acceleration_ms: 180, deceleration_ms: 180, s_curve: false };

/// Where the switches are, on a stage that counts its own positions.
#[derive(Clone, Debug)]
struct World {
    home: Range<i64>,
    /// The limits are on at and beyond these.
    limits: [i64; 2],
    /// Marks of one pulse's width at the multiples of this.
    index: i64,
    mirrored: bool,
}

const STAGE: World = World { home: 500..560, limits: [-400, 1000], index: 350, mirrored: false };

impl World {
    fn inputs(&self, at: i64) -> Inputs {
        let at = if self.mirrored { -at } else { at };
        let [low, high] = self.limits;
        let mut limits = [at <= low, at >= high];
        if self.mirrored {
            limits.reverse();
        }
        Inputs { home: self.home.contains(&at), limits, index: at.rem_euclid(self.index) == 0 }
    }
}

struct Record {
    outcome: Outcome,
    /// Where the stage stands at the end.
    at: i64,
    position: i32,
    /// Regularly, and whenever the routine changes something.
    course: Vec<Sample>,
}

#[derive(Debug, PartialEq)]
struct Sample {
    ms: Ticks,
    phase: char,
    position: i64,
    pps: i64,
}

const POSITION_AT_START: i32 = 7777;
const SAMPLE: Ticks = 100_000;

fn home(world: &World, routine: Routine, from: i64, settings: Settings) -> Record {
    let sign = if world.mirrored { -1 } else { 1 };
    let mut axis = Axis::new(settings.limits);
    axis.set_position(sign as i32 * POSITION_AT_START);
    axis.halt();
    let mut homing = Homing::new(routine.steps(), Direction::of(sign), settings);
    let mut course = Vec::new();
    let mut now = 0;
    let mut last = None;
    for _ in 0..100_000 {
        let at = sign * from + axis.odometer();
        let inputs = world.inputs(at);
        for way in [Direction::Negative, Direction::Positive] {
            axis.set_blocked(way, inputs.limits[way as usize].then_some(Stop::Hard));
        }
        let position = axis.position();
        let outcome = homing.poll(&mut axis, inputs);
        let shown = (homing.phase(), axis.position() == position, axis.is_moving());
        if now % SAMPLE == 0 || last != Some(shown) {
            let pps = i64::from(pps::pps(axis.speed(), SCALE, CLOCK_HZ));
            course.push(Sample {
                ms: now / 1000,
                phase: homing.phase(),
                position: sign * i64::from(axis.position()),
                pps: sign * axis.direction().sign() * pps,
            });
        }
        last = Some((shown.0, true, shown.2));
        if let Some(outcome) = outcome {
            assert!(!axis.is_moving());
            return Record { outcome, at: sign * at, position: axis.position(), course };
        }
        axis.set_window(axis.odometer() - 1, axis.odometer() + 1);
        let wake = axis.wake().expect("a routine under way moves");
        now = wake.min((now / SAMPLE + 1) * SAMPLE);
        axis.advance(now, |_| ());
    }
    panic!("{routine:?} from {from} does not end");
}

fn settings() -> Settings {
    Settings {
        limits: PROFILE.limits(SCALE, CLOCK_HZ),
        slow: pps::speed(PROFILE.low_pps, SCALE, CLOCK_HZ),
        correction: 150,
        index_marks: 1,
        return_to_zero: false,
    }
}

/// Where it ends and what the counter then says, both ways.
#[track_caller]
fn check(world: &World, routine: Routine, from: i64, at: i64, position: i32) {
    for mirrored in [false, true] {
        let sign = if mirrored { -1 } else { 1 };
        for return_to_zero in [false, true] {
            let settings = Settings { return_to_zero, ..settings() };
            let world = World { mirrored, ..world.clone() };
            let record = home(&world, routine, from, settings);
            assert_eq!(record.outcome, Outcome::Found);
            let (at, position) = if return_to_zero { (at - i64::from(position), 0) } else { (at, position) };
            assert_eq!((record.at, record.position), (at, sign * position), "{routine:?} from {from}");
        }
    }
}

/// It ends at this limit.
#[track_caller]
fn check_limit(world: &World, routine: Routine, from: i64, limit: Direction) {
    for mirrored in [false, true] {
        let world = World { mirrored, ..world.clone() };
        let record = home(&world, routine, from, Settings { return_to_zero: true, ..settings() });
        let end = world.limits[limit as usize];
        let limit = if mirrored { limit.reversed() } else { limit };
        assert_eq!((record.outcome, record.at), (Outcome::Limit(limit), end), "{routine:?} from {from}");
    }
}

#[test]
fn every_routine_finds_its_zero() {
    for from in [-400, -399, 0, 399, 499] {
        check(&STAGE, Routine::HomeLow, from, 500, 0);
        check(&STAGE, Routine::HomeIndex, from, 700, 0);
    }
    // Braking from high speed takes 99 pulses and a part of one.
    check(&STAGE, Routine::Home, 0, 600, 100);
    check(&STAGE, Routine::Home, 499, 502, 2);
    for from in [-400, 0, 520, 999] {
        check(&STAGE, Routine::Limit, from, 850, 0);
    }
    check(&STAGE, Routine::Index, -1, 0, 0);
    check(&STAGE, Routine::Index, 0, 350, 0);
}

#[test]
fn a_limit_in_the_way_ends_it() {
    for routine in [Routine::Home, Routine::HomeIndex, Routine::HomeLow] {
        // On the home switch, beyond it, on the limit.
        for from in [500, 559, 560, 900, 1000] {
            check_limit(&STAGE, routine, from, Direction::Positive);
        }
    }
    check_limit(&STAGE, Routine::Index, 700, Direction::Positive);
}

/// The course of a routine; it is the same the other way.
fn course(routine: Routine, from: i64, return_to_zero: bool) -> String {
    let settings = Settings { return_to_zero, ..settings() };
    let Record { course, .. } = home(&STAGE, routine, from, settings);
    assert_eq!(home(&World { mirrored: true, ..STAGE }, routine, from, settings).course, course);
    let mut table = String::new();
    for Sample { ms, phase, position, pps } in course {
        writeln!(table, "{ms:6} ms  {phase}  {position:5}  {pps:5} pps").unwrap();
    }
    table
}

#[test]
fn home_at_high_speed() {
    insta::assert_snapshot!(course(Routine::Home, 0, false));
}

#[test]
fn home_at_high_speed_and_return() {
    insta::assert_snapshot!(course(Routine::Home, 0, true));
}

#[test]
fn limit() {
    insta::assert_snapshot!(course(Routine::Limit, 500, false));
}

#[test]
fn home_then_index() {
    insta::assert_snapshot!(course(Routine::HomeIndex, 0, false));
}

#[test]
fn index() {
    insta::assert_snapshot!(course(Routine::Index, 300, false));
}

#[test]
fn home_at_high_speed_then_low() {
    insta::assert_snapshot!(course(Routine::HomeLow, 0, false));
}
