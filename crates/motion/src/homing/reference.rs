//! The reference searches 1 to 8 of TMCL modules (PD42-1140 firmware manual, section 7.1).
//!
//! The first approach is fast. An end switch is then left slowly until it is released and entered again
//! slowly; where "both sides" are asked for, the zero point is the middle of these two switching points,
//! otherwise the second. A home switch is crossed slowly, and the zero point is its middle.

use super::Pace;
use super::search::{Mark, Step, Switch, Zero};
use crate::train::Direction::{self, Negative, Positive};

/// The steps of a search mode, 1 to 8.
pub const fn steps(mode: u8) -> Option<&'static [Step]> {
    Some(match mode {
        1 => LEFT,
        2 => RIGHT_THEN_LEFT,
        3 => RIGHT_THEN_LEFT_BOTH_SIDES,
        4 => LEFT_BOTH_SIDES,
        5 => HOME_NEGATIVE_TURNING,
        6 => HOME_POSITIVE_TURNING,
        7 => HOME_NEGATIVE,
        8 => HOME_POSITIVE,
        _ => return None,
    })
}

/// Mode 1: the left end switch.
const LEFT: &[Step] = &[
    fast(Negative, Switch::Negative),
    slow(Positive, Switch::Negative, false, None),
    slow(Negative, Switch::Negative, true, Some(Mark::A)),
    Step::Finish(Zero::AtA),
];

/// Mode 2: the right end switch, then the left one, which is the zero point.
const RIGHT_THEN_LEFT: &[Step] = &[
    far(),
    fast(Negative, Switch::Negative),
    slow(Positive, Switch::Negative, false, None),
    slow(Negative, Switch::Negative, true, Some(Mark::A)),
    Step::Finish(Zero::AtA),
];

/// Mode 3: the right end switch, then the left one from both sides.
const RIGHT_THEN_LEFT_BOTH_SIDES: &[Step] = &[
    far(),
    fast(Negative, Switch::Negative),
    slow(Positive, Switch::Negative, false, Some(Mark::A)),
    slow(Negative, Switch::Negative, true, Some(Mark::B)),
    Step::Finish(Zero::Middle),
];

/// Mode 4: the left end switch from both sides.
const LEFT_BOTH_SIDES: &[Step] = &[
    fast(Negative, Switch::Negative),
    slow(Positive, Switch::Negative, false, Some(Mark::A)),
    slow(Negative, Switch::Negative, true, Some(Mark::B)),
    Step::Finish(Zero::Middle),
];

/// Mode 5: the home switch in negative direction, turning at the left end switch.
const HOME_NEGATIVE_TURNING: &[Step] = &home_turning(Negative);

/// Mode 6: the home switch in positive direction, turning at the right end switch.
const HOME_POSITIVE_TURNING: &[Step] = &home_turning(Positive);

/// Mode 7: the home switch in negative direction, past any end switch.
const HOME_NEGATIVE: &[Step] = &home(Negative, None);

/// Mode 8: the home switch in positive direction, past any end switch.
const HOME_POSITIVE: &[Step] = &home(Positive, None);

const fn fast(way: Direction, switch: Switch) -> Step {
    Step::Seek { way, pace: Pace::Fast, switch, pressed: true, mark: None, turn: None }
}

const fn far() -> Step {
    let (way, switch) = (Positive, Switch::Positive);
    Step::Seek { way, pace: Pace::Fast, switch, pressed: true, mark: Some(Mark::Far), turn: None }
}

const fn slow(way: Direction, switch: Switch, pressed: bool, mark: Option<Mark>) -> Step {
    Step::Seek { way, pace: Pace::Slow, switch, pressed, mark, turn: None }
}

/// Into the home switch, out on its far side, and back across it.
const fn home(way: Direction, turn: Option<usize>) -> [Step; 5] {
    let switch = Switch::Home;
    [
        Step::Seek { way, pace: Pace::Fast, switch, pressed: true, mark: None, turn },
        slow(way, switch, false, Some(Mark::A)),
        slow(way.reversed(), switch, true, None),
        slow(way.reversed(), switch, false, Some(Mark::B)),
        Step::Finish(Zero::Middle),
    ]
}

const fn home_turning(way: Direction) -> [Step; 10] {
    let [a, b, c, d, e] = home(way, Some(5));
    let [f, g, h, i, j] = home(way.reversed(), None);
    [a, b, c, d, e, f, g, h, i, j]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::homing::{Found, Search, Switches};
    use crate::{Axis, Limits, Shape, tmc429};

    /// A stage with end switches pressed at and beyond −1000 and 2000 and a home switch from −200 to 0.
    fn search(mode: u8, mirrored: bool, from: i32) -> (Found, Axis) {
        let limits = Limits {
            scale: tmc429::scale(2),
            top: tmc429::speed(2000),
            start: tmc429::speed(1),
            stop: tmc429::speed(1),
            growth: tmc429::growth(500, 2, 5),
            fall: tmc429::growth(500, 2, 5),
            shape: Shape::Trapezoid,
        };
        let mut axis = Axis::new(limits);
        axis.set_position(from);
        axis.set_goal(crate::Goal::Position(from));
        let speeds = [tmc429::speed(500), tmc429::speed(50)];
        let mut search = Search::new(steps(mode).unwrap(), mirrored, false, speeds, limits);
        for _ in 0..100_000 {
            let at = axis.position();
            let switches =
                Switches { negative: at <= -1000, positive: at >= 2000, home: (-200..=0).contains(&at) };
            if let Some(found) = search.poll(&mut axis, switches) {
                return (found, axis);
            }
            // A pulse at a time, so that no switch is passed unseen.
            axis.set_window(axis.odometer() - 1, axis.odometer() + 1);
            let next = axis.wake().expect("a search under way moves");
            axis.advance(next, |_| ());
        }
        panic!("the search of mode {mode} does not end");
    }

    fn check(mode: u8, mirrored: bool, zero: i32, distance: Option<i32>) {
        for from in [-1200, -1000, -500, -201, -200, -100, 0, 1, 500, 2000, 2100] {
            // Modes that ignore the end switches only find what lies ahead.
            if mode == 7 && from < -200 || mode == 8 && from > 0 {
                continue;
            }
            let (found, axis) = search(mode, mirrored, from);
            assert_eq!(found.zero, zero, "mode {mode} from {from}");
            assert_eq!(axis.position(), zero, "mode {mode} from {from}");
            if (-1000..=2000).contains(&from) {
                assert_eq!(found.distance, distance, "mode {mode} from {from}");
            }
        }
    }

    #[test]
    fn end_switches_are_the_zero_point() {
        check(1, false, -1000, None);
        check(1, true, 2000, None);
        check(4, false, -1000, None);
        // From outside the switch opens at 1999 and closes at 2000; the middle is rounded down.
        check(4, true, 1999, None);
    }

    #[test]
    fn both_end_switches_give_the_distance() {
        check(2, false, -1000, Some(3000));
        check(2, true, 2000, Some(-3000));
        check(3, false, -1000, Some(3000));
        check(3, true, 1999, Some(-2999));
    }

    #[test]
    fn the_middle_of_the_home_switch_is_the_zero_point() {
        // It opens at −201 and at 1.
        for mode in 5..=8 {
            check(mode, false, -100, None);
        }
    }

    #[test]
    fn there_is_no_ninth_mode() {
        assert_eq!(steps(0), None);
        assert_eq!(steps(9), None);
    }
}
