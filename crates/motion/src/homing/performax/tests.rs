//! The five routines on a stage.

use super::Routine::{self, Home, HomeIndex, HomeLow, Index, Limit};
use crate::Direction::{self, Negative, Positive};
use crate::homing::routine::{Outcome, Settings};
use crate::homing::testing::{STAGE, START, Stage, home, s_settings, settings};

/// Where it ends and what the counter then says, without return to zero and with it.
#[track_caller]
fn check_with(stage: &Stage, settings: Settings, routine: Routine, from: i64, at: i64, position: i64) {
    for (return_to_zero, [at, position]) in [(false, [at, position]), (true, [at - position, 0])] {
        let record = home(stage, routine.steps(), from, Settings { return_to_zero, ..settings });
        assert_eq!((record.outcome, record.at, record.position), (Outcome::Found, at, position));
    }
}

#[track_caller]
fn check(routine: Routine, from: i64, at: i64, position: i64) {
    check_with(&STAGE, settings(), routine, from, at, position);
}

/// It ends at this limit, where the counter says this.
#[track_caller]
fn check_limit(
    stage: &Stage,
    settings: Settings,
    routine: Routine,
    from: i64,
    limit: Direction,
    position: i64,
) {
    for return_to_zero in [false, true] {
        let record = home(stage, routine.steps(), from, Settings { return_to_zero, ..settings });
        let at = stage.limits[limit as usize];
        assert_eq!((record.outcome, record.at, record.position), (Outcome::Limit(limit), at, position));
    }
}

#[test]
fn zero_is_at_the_trigger() {
    for from in [-400, -399, 0, 399] {
        check(Home, from, 600, 100);
        check(HomeLow, from, 500, 0);
        check(HomeIndex, from, 700, 0);
    }
    // Hardly under way: two pulses are enough to brake.
    check(Home, 499, 502, 2);
    check(HomeIndex, 499, 700, 0);
    check(HomeLow, 499, 500, 0);
    for from in [-400, 0, 520, 999] {
        check(Limit, from, 850, 0);
    }
    check(Index, -1, 0, 0);
    check(Index, 1, 350, 0);
}

#[test]
fn what_is_on_at_the_start_is_no_trigger() {
    let start = i64::from(START);
    for routine in [Home, HomeIndex, HomeLow] {
        // On the home switch, and beyond it.
        for from in [500, 559, 560, 900] {
            check_limit(&STAGE, settings(), routine, from, Positive, start + 1000 - from);
        }
    }
    check(Index, 350, 700, 0);
}

#[test]
fn started_on_a_limit() {
    check(Limit, 1000, 850, 0);
    check(Limit, 1005, 855, 0);
    for routine in [Home, HomeIndex, Index, HomeLow] {
        check_limit(&STAGE, settings(), routine, 1000, Positive, START.into());
    }
}

#[test]
fn a_limit_in_the_way() {
    // While the motor brakes behind the trigger: the counter is already set.
    let late = Stage { home: 950..960, ..STAGE };
    check_limit(&late, settings(), Home, 0, Positive, 50);
    check_limit(&late, settings(), HomeLow, 0, Positive, 50);
    // While it seeks the index.
    let far = Stage { index: 5000, ..STAGE };
    check_limit(&far, settings(), HomeIndex, 0, Positive, i64::from(START) + 1000);
    check_limit(&far, settings(), Index, 900, Positive, i64::from(START) + 100);
    // Behind, while it moves back by the amount.
    let much = Settings { correction: 2000, ..settings() };
    check_limit(&STAGE, much, HomeLow, 0, Negative, -900);
    check_limit(&STAGE, much, Limit, 0, Negative, i64::from(START) - 400);
    // At the trigger's own pulse.
    let same = Stage { home: 1000..1001, ..STAGE };
    check_limit(&same, settings(), Home, 0, Positive, i64::from(START) + 1000);
}

#[test]
fn the_motor_may_come_to_rest_beyond_the_home_switch() {
    for width in [1, 2, 99, 100, 101] {
        let stage = Stage { home: 500..500 + width, ..STAGE };
        check_with(&stage, settings(), HomeLow, 0, 500, 0);
    }
}

#[test]
fn correction_amounts() {
    // Also where the motor cannot brake within them.
    for correction in [0, 1, 50, 99, -150] {
        let settings = Settings { correction, ..settings() };
        check_with(&STAGE, settings, HomeLow, 0, 500, 0);
        check_with(&STAGE, settings, Limit, 0, 1000 - i64::from(correction.abs()), 0);
    }
    let settings = Settings { correction: i32::MIN, ..settings() };
    check_limit(&STAGE, settings, HomeLow, 0, Negative, -900);
}

#[test]
fn zero_does_not_depend_on_the_way_there() {
    let mut seed = 1u64;
    let mut random = move |range: std::ops::Range<i64>| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        range.start + (seed >> 33) as i64 % (range.end - range.start)
    };
    for _ in 0..50 {
        let (zero, width, amount) = (random(300..700), random(1..200), random(0..300));
        let stage = Stage { home: zero..zero + width, ..STAGE };
        let settings = Settings { correction: amount as i32, ..settings() };
        let from = random(-400..zero);
        check_with(&stage, settings, HomeLow, from, zero, 0);
        check_with(&stage, settings, Limit, from, 1000 - amount, 0);
    }
}

#[test]
fn marks_count_at_low_speed() {
    // The mark at 550 passes while the motor still brakes, the one at 610 when it is down.
    check_with(&Stage { index: 275, ..STAGE }, settings(), HomeIndex, 0, 825, 0);
    check_with(&Stage { index: 610, ..STAGE }, settings(), HomeIndex, 0, 610, 0);
    check_with(&STAGE, Settings { index_marks: 3, ..settings() }, Index, -399, 350, 0);
    check_with(&STAGE, Settings { index_marks: 0, ..settings() }, Index, -399, -350, 0);
}

#[test]
fn with_s_curves() {
    check_with(&STAGE, s_settings(), HomeLow, 0, 500, 0);
    check_with(&STAGE, s_settings(), HomeIndex, 0, 700, 0);
    check_with(&STAGE, s_settings(), Limit, 0, 850, 0);
    check_with(&STAGE, s_settings(), Index, 300, 350, 0);
    check_with(&STAGE, s_settings(), Home, 0, 599, 99);
}

/// The course of a routine: time, phase, position, speed.
fn course(routine: Routine, from: i64, return_to_zero: bool) -> String {
    home(&STAGE, routine.steps(), from, Settings { return_to_zero, ..settings() }).table()
}

#[test]
fn home_at_high_speed() {
    insta::assert_snapshot!(course(Home, 0, false));
}

#[test]
fn home_at_high_speed_and_return() {
    insta::assert_snapshot!(course(Home, 0, true));
}

#[test]
fn limit() {
    insta::assert_snapshot!(course(Limit, 500, false));
}

#[test]
fn home_then_index() {
    insta::assert_snapshot!(course(HomeIndex, 0, false));
}

#[test]
fn index() {
    insta::assert_snapshot!(course(Index, 300, false));
}

#[test]
fn home_at_high_speed_then_low() {
    insta::assert_snapshot!(course(HomeLow, 0, false));
}
