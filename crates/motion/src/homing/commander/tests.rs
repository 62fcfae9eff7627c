//! The modes on a stage.

use super::{MODES, Z_MOVE};
use crate::Direction::{self, Negative, Positive};
use crate::homing::routine::{Occasion, Outcome, Settings};
use crate::homing::testing::{Record, STAGE, START, Stage, home, s_settings, settings};
use std::ops::Range;

/// The modes whose drawings show the home input, and the ones that show the limit.
const BY_HOME: [usize; 9] = [0, 1, 2, 3, 4, 5, 9, 10, 11];
const BY_LIMIT: [usize; 4] = [6, 7, 8, 12];

/// It ends here, and the counter says this.
#[track_caller]
fn check_with(stage: &Stage, settings: Settings, mode: usize, from: i64, at: i64, position: i64) {
    let record = home(stage, MODES[mode], from, settings);
    assert_eq!((record.outcome, record.at, record.position), (Outcome::Found, at, position), "mode {mode}");
    check_clears(mode, &record, stage);
}

/// A pulse at the limit that is sought, and one at the end.
#[track_caller]
fn check_clears(mode: usize, record: &Record, stage: &Stage) {
    let end = (Occasion::Home, record.at);
    let stop = (Occasion::Stop, stage.limits[1]);
    let expected: &[_] = if BY_LIMIT.contains(&mode) { &[stop, end] } else { &[end] };
    assert_eq!(record.clears, expected, "mode {mode}");
}

#[track_caller]
fn check(mode: usize, from: i64, at: i64, position: i64) {
    check_with(&STAGE, settings(), mode, from, at, position);
}

/// It ends at this limit, where the counter says this.
#[track_caller]
fn check_limit(stage: &Stage, settings: Settings, mode: usize, from: i64, limit: Direction, position: i64) {
    let record = home(stage, MODES[mode], from, settings);
    let at = stage.limits[limit as usize];
    let expected = (Outcome::Limit(limit), at, position);
    assert_eq!((record.outcome, record.at, record.position), expected, "mode {mode}");
    assert!(!record.clears.iter().any(|&(occasion, _)| occasion == Occasion::Home), "mode {mode}");
}

#[test]
fn zero_is_at_the_trigger() {
    for from in [-400, -399, 0, 399] {
        check(0, from, 600, 100);
        check(1, from, 500, 0);
        check(2, from, 700, 0);
        check(3, from, 800, 100);
        check(4, from, 350, 0);
        check(5, from, 250, -100);
        check(9, from, 500, 0);
        check(10, from, 700, 0);
        check(11, from, 350, 0);
    }
    for from in [-400, 0, 520, 999] {
        check(6, from, 999, 0);
        check(7, from, 700, 0);
        check(8, from, 600, -100);
        check(12, from, 700, 0);
    }
    // Hardly under way: two pulses are enough to brake.
    check(0, 499, 502, 2);
    check(1, 499, 500, 0);
    check(4, 499, 350, 0);
    check(9, 499, 500, 0);
}

#[test]
fn started_on_the_home_switch_or_beyond() {
    for mode in BY_HOME {
        for from in [500, 559, 560, 900] {
            check_limit(&STAGE, settings(), mode, from, Positive, i64::from(START) + 1000 - from);
        }
    }
}

#[test]
fn started_on_a_limit() {
    for mode in BY_HOME {
        check_limit(&STAGE, settings(), mode, 1000, Positive, START.into());
    }
    check(6, 1000, 999, 0);
    check(7, 1000, 700, 0);
    check(8, 1000, 600, -100);
    check(12, 1000, 700, 0);
    // The one behind is in nobody's way.
    check(0, -400, 600, 100);
}

#[test]
fn a_limit_in_the_way() {
    // While the motor brakes behind the trigger: the counter is already set in some modes.
    let late = Stage { home: 950..960, index: 5000, ..STAGE };
    for mode in [0, 9] {
        check_limit(&late, settings(), mode, 0, Positive, 50);
    }
    // In mode 2, 3 and 10 there is no index before the limit, in the others none after it.
    for mode in [1, 2, 3, 4, 5, 10, 11] {
        check_limit(&late, settings(), mode, 0, Positive, i64::from(START) + 1000);
    }
    // Behind, in search of the index.
    let far = Stage { limits: [100, 1000], index: 5000, ..STAGE };
    for mode in [4, 5, 7, 8, 11, 12] {
        check_limit(&far, settings(), mode, 200, Negative, i64::from(START) - 100);
    }
    // Behind, braking after the index.
    let behind = Stage { limits: [300, 1000], ..STAGE };
    for mode in [5, 11] {
        check_limit(&behind, settings(), mode, 400, Negative, -50);
    }
    // At the trigger's own pulse.
    let same = Stage { home: 1000..1001, ..STAGE };
    for mode in BY_HOME {
        check_limit(&same, settings(), mode, 0, Positive, i64::from(START) + 1000);
    }
}

#[test]
fn the_motor_may_come_to_rest_beyond_the_home_switch() {
    for width in [1, 2, 99, 100, 101] {
        let stage = Stage { home: 500..500 + width, ..STAGE };
        check_with(&stage, settings(), 1, 0, 500, 0);
    }
}

#[test]
fn index_marks() {
    let marks = |index_marks| Settings { index_marks, ..settings() };
    let stage = Stage { index: 20, ..STAGE };
    // In mode 2 the mark at 600 is the first, where the motor has just come down.
    for (count, [two, three, four, seven]) in [(1, [600, 520, 580, 980]), (16, [900, 820, 280, 680])] {
        check_with(&stage, marks(count), 2, 0, two, 0);
        check_with(&stage, marks(count), 10, 0, three, 0);
        check_with(&stage, marks(count), 4, 0, four, 0);
        check_with(&stage, marks(count), 11, 0, four, 0);
        check_with(&stage, marks(count), 7, 0, seven, 0);
        check_with(&stage, marks(count), 12, 0, seven, 0);
    }
    check_with(&stage, marks(16), 3, 0, 920, 100);
    check_with(&stage, marks(16), 5, 0, 180, -100);
    check_with(&stage, marks(16), 8, 0, 580, -100);
    // Only 20 pulses to get going, and the part of one that is left to brake.
    check_with(&stage, marks(1), 8, 0, 959, -21);
    // A mark at the home edge, and one at the turn, do not count.
    check_with(&Stage { index: 250, ..STAGE }, settings(), 10, 0, 750, 0);
    check_with(&Stage { index: 200, ..STAGE }, settings(), 4, 0, 400, 0);
}

/// A slowdown switch between the start and home.
const SLOW: Stage = Stage { slowdown: 250..280, ..STAGE };

/// Over the whole way.
const SLOW_ALL: Stage = Stage { slowdown: -500..1100, ..STAGE };

#[test]
fn down_to_low_speed_before_home() {
    // Modes that brake after the trigger then end at zero.
    let wide = Stage { slowdown: 250..600, ..STAGE };
    let latched = Stage { latch: true, ..SLOW };
    for stage in [&wide, &latched, &SLOW_ALL] {
        // Before the switch and on it.
        for from in [0, 260] {
            check_with(stage, settings(), 0, from, 500, 0);
            check_with(stage, settings(), 1, from, 500, 0);
            check_with(stage, settings(), 4, from, 350, 0);
            check_with(stage, settings(), 9, from, 500, 0);
            check_with(stage, settings(), 10, from, 700, 0);
            check_with(stage, settings(), 11, from, 350, 0);
        }
    }
    for stage in [&latched, &SLOW_ALL] {
        check_with(stage, settings(), 2, 0, 700, 0);
        check_with(stage, settings(), 3, 0, 700, 0);
        check_with(stage, settings(), 5, 0, 350, 0);
        check_with(stage, settings(), 6, 0, 999, 0);
        check_with(stage, settings(), 7, 0, 700, 0);
        check_with(stage, settings(), 8, 0, 700, 0);
        check_with(stage, settings(), 12, 0, 700, 0);
    }
    // Without a latch the motor is fast again where the switch is off: mode 3 after home, mode 5 on its way back.
    check_with(&wide, settings(), 3, 0, 800, 100);
    check_with(&Stage { slowdown: 400..600, ..STAGE }, settings(), 5, 0, 300, -50);
    check_with(&SLOW, settings(), 0, 0, 600, 100);
    // Too short a way to come down: home finds the motor braking.
    check_with(&Stage { slowdown: 450..600, ..STAGE }, settings(), 0, 0, 550, 50);
}

#[test]
fn slowed_down_on_the_way_to_the_limit() {
    for stage in [&SLOW, &SLOW_ALL, &Stage { latch: true, ..SLOW }] {
        check_limit(stage, settings(), 0, 600, Positive, i64::from(START) + 400);
    }
    // Started on the switch beyond home: low speed until it is off, then fast (operation 3 of mode 0 with SD).
    let beyond = Stage { slowdown: 600..650, ..STAGE };
    let record = home(&beyond, MODES[0], 620, settings());
    assert_eq!(record.outcome, Outcome::Limit(Positive));
    assert_eq!(record.fastest(Positive, 620..651), 100);
    assert_eq!(record.fastest(Positive, 651..1001), 1000);
}

#[test]
fn nothing_is_faster_than_low_speed_while_the_switch_is_on() {
    for (mode, steps) in MODES.into_iter().enumerate() {
        let record = home(&SLOW_ALL, steps, 0, settings());
        for way in [Positive, Negative] {
            assert!(record.fastest(way, -500..1100) <= 100, "mode {mode}");
        }
    }
    // Also on the way back: 100 pulses after the switch has come on the motor is down.
    for mode in [5, 8, 11, 12] {
        let stage = Stage { slowdown: 150..420, limits: [100, 1000], index: 5000, ..STAGE };
        let record = home(&stage, MODES[mode], 450, settings());
        assert_eq!(record.outcome, Outcome::Limit(Negative));
        assert!(record.fastest(Negative, 420..600) > 900, "mode {mode}");
        assert_eq!(record.fastest(Negative, 150..320), 100, "mode {mode}");
        assert!(record.fastest(Negative, 100..150) > 600, "mode {mode}");
    }
    // And on the return to zero.
    let record = home(&Stage { slowdown: 540..700, ..STAGE }, MODES[9], 0, settings());
    assert_eq!((record.outcome, record.at), (Outcome::Found, 500));
    assert_eq!(record.fastest(Negative, 540..700), 100);
    assert!(record.fastest(Negative, 500..540) > 300);
}

/// The n-th multiple of `period` beyond a place, or before it.
fn mark(place: i64, period: i64, count: i64) -> i64 {
    if count > 0 {
        (place.div_euclid(period) + count) * period
    } else {
        ((place - 1).div_euclid(period) + 1 + count) * period
    }
}

fn random_numbers() -> impl FnMut(Range<i64>) -> i64 {
    let mut seed = 1u64;
    move |range| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        range.start + (seed >> 33) as i64 % (range.end - range.start)
    }
}

#[test]
fn zero_does_not_depend_on_the_way_there() {
    let mut random = random_numbers();
    for _ in 0..40 {
        let (edge, width, index, count) = (random(300..700), random(1..200), random(2..60), random(1..17));
        let (limit, braking) = (2500 + random(0..100), 100);
        let stage = Stage {
            home: edge..edge + width,
            limits: [-2000, limit],
            index,
            slowdown: 0..random(0..200),
            latch: false,
        };
        let marks = Settings { index_marks: count as u8, ..settings() };
        let from = random(-400..edge - 250);
        let turn = edge + braking;
        let zeros = [
            edge,
            edge,
            // The mark where the motor is just down counts.
            mark(turn - 1, index, count),
            mark(edge, index, count),
            mark(turn, index, -count),
            mark(turn, index, -count),
            limit - 1,
            mark(limit, index, -count),
            mark(limit, index, -count),
            edge,
            mark(edge, index, count),
            mark(turn, index, -count),
            mark(limit, index, -count),
        ];
        for (mode, zero) in zeros.into_iter().enumerate() {
            let record = home(&stage, MODES[mode], from, marks);
            assert_eq!((record.outcome, record.at - record.position), (Outcome::Found, zero), "mode {mode}");
            let way = match mode {
                0 | 3 => 1..=braking,
                5 | 8 => -braking..=-1,
                _ => 0..=0,
            };
            assert!(way.contains(&record.position), "mode {mode} ends at {}", record.position);
            check_clears(mode, &record, &stage);
        }
    }
}

#[test]
fn every_stage_comes_to_an_end() {
    let mut random = random_numbers();
    let mut outcomes = [0; 3];
    for _ in 0..40 {
        let (edge, width, slow) = (random(-400..700), random(1..300), random(-400..700));
        let stage = Stage {
            home: edge..edge + width,
            limits: [-300 - random(0..100), 300 + random(0..300)],
            index: random(2..900),
            slowdown: slow..slow + random(0..300),
            latch: random(0..2) == 1,
        };
        let from = random(stage.limits[0]..stage.limits[1] + 1);
        let settings = Settings { index_marks: random(1..17) as u8, ..settings() };
        for (mode, steps) in MODES.into_iter().enumerate() {
            let record = home(&stage, steps, from, settings);
            let zero = record.at - record.position;
            match record.outcome {
                Outcome::Found => {
                    let expected = match mode {
                        0 | 1 | 9 => zero == edge,
                        6 => zero == stage.limits[1] - 1,
                        _ => zero % stage.index == 0,
                    };
                    assert!(expected, "mode {mode} has its zero at {zero} of {stage:?}");
                    check_clears(mode, &record, &stage);
                    outcomes[2] += 1;
                }
                Outcome::Limit(limit) => {
                    assert_eq!(record.at, stage.limits[limit as usize], "mode {mode} on {stage:?}");
                    outcomes[limit as usize] += 1;
                }
            }
        }
    }
    assert!(outcomes.iter().all(|&count| count > 10), "{outcomes:?}");
}

#[test]
fn with_s_curves() {
    let slow = Stage { latch: true, ..SLOW };
    for (mode, (at, position)) in (0..).zip([
        (599, 99),
        (500, 0),
        (700, 0),
        (800, 100),
        (350, 0),
        (250, -100),
        (999, 0),
        (700, 0),
        (600, -100),
        (500, 0),
        (700, 0),
        (350, 0),
        (700, 0),
    ]) {
        check_with(&STAGE, s_settings(), mode, 0, at, position);
        check_with(&slow, s_settings(), mode, 0, at - position, 0);
    }
}

/// `ZMOVE` leaves the counter alone and asks for no pulse.
#[test]
fn z_move() {
    let check = |stage: &Stage, index_marks, from, outcome, at| {
        let record = home(stage, Z_MOVE, from, Settings { index_marks, ..settings() });
        assert_eq!((record.outcome, record.at), (outcome, at));
        assert_eq!(record.position, i64::from(START) + at - from);
        assert_eq!(record.clears, []);
    };
    check(&STAGE, 1, 0, Outcome::Found, 450);
    check(&STAGE, 2, 0, Outcome::Found, 800);
    check(&STAGE, 1, 348, Outcome::Found, 353);
    check(&STAGE, 3, 0, Outcome::Limit(Positive), 1000);
    check(&SLOW_ALL, 2, 0, Outcome::Found, 700);
}

/// The course of a mode: time, phase, position, speed, and when the ERC pulse is due.
macro_rules! course {
    ($name:ident, $stage:expr, $steps:expr, $from:expr) => {
        #[test]
        fn $name() {
            insta::assert_snapshot!(home(&$stage, $steps, $from, settings()).table());
        }
    };
}

course!(course_of_mode_0, STAGE, MODES[0], 0);
course!(course_of_mode_0_with_slowdown, Stage { slowdown: 250..600, ..STAGE }, MODES[0], 0);
course!(course_of_mode_1, STAGE, MODES[1], 0);
course!(course_of_mode_2, STAGE, MODES[2], 0);
course!(course_of_mode_3, STAGE, MODES[3], 0);
course!(course_of_mode_4, STAGE, MODES[4], 0);
course!(course_of_mode_5, STAGE, MODES[5], 0);
course!(course_of_mode_6, STAGE, MODES[6], 500);
course!(course_of_mode_7, STAGE, MODES[7], 500);
course!(course_of_mode_8, STAGE, MODES[8], 500);
course!(course_of_mode_9, STAGE, MODES[9], 0);
course!(course_of_mode_10, STAGE, MODES[10], 0);
course!(course_of_mode_11, STAGE, MODES[11], 0);
course!(course_of_mode_12, STAGE, MODES[12], 500);
course!(course_of_z_move, STAGE, Z_MOVE, 0);
course!(course_started_on_the_home_switch, STAGE, MODES[0], 520);
