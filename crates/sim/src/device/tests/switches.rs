//! Switches that are moved while the machine runs.

use super::*;

#[test]
fn switches_are_moved_while_the_machine_runs() {
    let mut device = device(small());
    order(&mut device, Order::Watch(1 << STOP_L | 1 << STOP_R | 1 << HOME));
    let mut check = |switches: Switches, target: i64, expected: &[(usize, bool, i64)]| {
        device.move_switches("0", &switches).unwrap();
        let mut reports = go(&mut device, target);
        reports.retain(|(pin, ..)| *pin != INDEX);
        assert_eq!(reports, expected);
    };
    let limit = |at| Switches { positive_limit: Some(at), ..Switches::default() };
    let home = |home| Switches { home: Some(home), ..Switches::default() };
    check(limit(300), 400, &[(STOP_R, false, 300)]);
    // It comes off where the axis stands, and on again.
    check(limit(500), 400, &[(STOP_R, true, 400)]);
    check(limit(400), 400, &[(STOP_R, false, 400)]);
    check(home([350, 450]), 460, &[(HOME, true, 400), (HOME, false, 451)]);
    let negative = Switches { negative_limit: Some(340), ..limit(1000) };
    check(negative, 340, &[(STOP_R, true, 460), (HOME, true, 450), (HOME, false, 349), (STOP_L, true, 340)]);
    let machine = device.config().axis("0");
    assert_eq!((machine.negative_limit, machine.positive_limit, machine.home), (340, 1000, [350, 450]));
}

#[test]
fn switches_that_cannot_be_moved_stay() {
    let mut straight = device(small());
    let before = straight.config().axis("0");
    let mut check = |negative: Option<i64>, positive: Option<i64>, home: Option<[i64; 2]>, why: &str| {
        let switches = Switches { negative_limit: negative, positive_limit: positive, home };
        assert_eq!(straight.move_switches("0", &switches).unwrap_err().to_string(), why);
        assert_eq!(straight.config().axis("0"), before);
    };
    check(None, None, None, "`negative_limit`, `positive_limit` or `home` says where a switch goes");
    check(Some(1000), None, None, "the negative limit 1000 must lie below the positive limit 1000");
    check(Some(5), Some(4), Some([0, 1]), "the negative limit 5 must lie below the positive limit 4");
    check(Some(-5), None, Some([1, 0]), "home: 1 must not lie above 0");
    check(None, Some(i64::MAX), None, "9223372036854775807 is not between -1099511627776 and 1099511627776");
    check(
        None,
        None,
        Some([i64::MIN, 0]),
        "-9223372036854775808 is not between -1099511627776 and 1099511627776",
    );
    let round = AxisConfig { circumference: Some(4000), ..small() };
    let mut round = device(round);
    let limit = Switches { positive_limit: Some(10), ..Switches::default() };
    assert_eq!(round.move_switches("0", &limit), Err(SwitchError::Round));
    assert!(matches!(round.move_switches("X", &limit), Err(SwitchError::Axis(_))));
    // Home comes again with each turn.
    order(&mut round, Order::Watch(1 << HOME));
    round.move_switches("0", &Switches { home: Some([100, 120]), ..Switches::default() }).unwrap();
    let mut reports = go(&mut round, 4200);
    reports.retain(|(pin, ..)| *pin == HOME);
    let expected = [(HOME, true, 100), (HOME, false, 121), (HOME, true, 4100), (HOME, false, 4121)];
    assert_eq!(reports, expected);
}
