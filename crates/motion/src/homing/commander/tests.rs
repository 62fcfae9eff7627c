//! The modes on a stage.

use super::MODES;
use crate::homing::routine::{Occasion, Outcome, Settings};
use crate::homing::testing::{STAGE, Stage, home, settings};

/// It ends here, and the counter says this.
#[track_caller]
fn check_with(stage: &Stage, settings: Settings, mode: usize, from: i64, at: i64, position: i64) {
    let record = home(stage, MODES[mode], from, settings);
    assert_eq!((record.outcome, record.at, record.position), (Outcome::Found, at, position), "mode {mode}");
    assert_eq!(record.clears.last(), Some(&(Occasion::Home, at)), "mode {mode}");
}

#[track_caller]
fn check(mode: usize, from: i64, at: i64, position: i64) {
    check_with(&STAGE, settings(), mode, from, at, position);
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
        check(6, from, 999, 0);
        check(7, from, 700, 0);
        check(8, from, 600, -100);
        check(9, from, 500, 0);
        check(10, from, 700, 0);
        check(11, from, 350, 0);
        check(12, from, 700, 0);
    }
}
