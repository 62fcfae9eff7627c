//! What happens outside reaches the controller, once.

use crate::script::{Act, Script};
use crate::session::{Main, cmd4cr, commands, pass, session};
use devices::Controller;

type Told = (&'static str, usize, i32);

/// The script's controller is told this in 100 ms.
fn check(script: Script, change: impl FnOnce(&mut Main<'_, '_, Script, 2, 25_000_000>), expected: &[Told]) {
    let heard = session::<_, 2, 25_000_000>(script, |main| {
        pass(main, 20_000);
        change(main);
        pass(main, 20_000);
    });
    assert_eq!(heard.tap.told, expected);
}

#[test]
fn levels_are_told_when_they_change() {
    check(Script::default(), |_| (), &[]);
    check(
        Script::default(),
        |main| {
            // Pins 0 to 2 can be told, 3 is an output. Pin 1 rests at 1.
            main.hardware().inputs.extend([(0, 1), (1, 1), (2, 1), (3, 1)]);
            pass(main, 5000);
            main.hardware().inputs.extend([(0, 0), (1, 0)]);
        },
        &[("input", 0, 1), ("input", 2, 1), ("input", 0, 0), ("input", 1, 0)],
    );
}

/// As soon as the next tick.
#[test]
fn switches_are_told_at_once() {
    session::<_, 2, 25_000_000>(Script::default(), |main| {
        pass(main, 20_000);
        main.hardware().inputs.insert(0, 1);
        let before = main.figures().advances;
        pass(main, 300);
        assert_eq!(main.figures().advances, before + 1, "it was advanced to be told");
    });
}

#[test]
fn ports_that_are_outputs_are_not_inputs() {
    let ms = 16_000;
    let acts = [(20 * ms, Act::Output(2, false)), (30 * ms, Act::Release(2))];
    check(
        Script::new(&acts),
        |main| {
            pass(main, 2000);
            main.hardware().inputs.insert(2, 1);
            pass(main, 5000);
        },
        &[("input", 2, 1)],
    );
    // What was there when it became an output and is there afterwards is no news.
    check(
        Script::new(&acts),
        |main| {
            pass(main, 2000);
            main.hardware().inputs.insert(2, 1);
            pass(main, 5000);
            main.hardware().inputs.insert(2, 0);
        },
        &[],
    );
}

#[test]
fn analog_values_are_told_where_they_are_watched() {
    check(
        Script::default(),
        |main| {
            for value in [701, 702, 702] {
                main.hardware().inputs.extend([(4, value), (5, value)]);
                pass(main, 3000);
            }
        },
        &[("analog", 4, 701), ("analog", 4, 702)],
    );
}

#[test]
fn encoders_are_told_of_at_their_windows() {
    check(
        Script { window: Some(10), ..Script::default() },
        |main| {
            for count in [9, 10, 15, 19, 20, 0, i32::MIN, i32::MAX] {
                main.hardware().encoders.insert(0, count);
                pass(main, 1000);
            }
        },
        &[("encoder", 0, 10), ("encoder", 0, 20), ("encoder", 0, 0), ("encoder", 0, i32::MIN)],
    );
}

#[test]
fn counts_of_pulsers_are_told_where_they_matter() {
    let turn = |main: &mut Main<'_, '_, Script, 2, 25_000_000>| {
        for count in [i32::MAX, i32::MIN, i32::MIN + 5, i32::MIN + 2] {
            main.hardware().pulsers.extend([(0, count), (1, count)]);
            pass(main, 1000);
        }
    };
    let expected = [("pulser", 1, i32::MAX), ("pulser", 1, 1), ("pulser", 1, 5), ("pulser", 1, -3)];
    check(Script { follows: true, ..Script::default() }, turn, &expected);
    check(Script::default(), turn, &[]);
}

/// What is not at rest at power-up is told before clock 0 is over; a limit switch stops an axis.
#[test]
fn switches_stop_axes() {
    let limit = cmd4cr().pins().iter().position(|pin| pin.name == "+LX").unwrap();
    let heard = session::<_, 4, 25_000_000>(cmd4cr(), |main| {
        commands(main, "EO=15 HSPD=5000 JX+");
        pass(main, 500_000);
        main.hardware().inputs.insert(limit, 1);
        pass(main, 2_000_000);
    });
    assert_eq!(heard.tap.told, [("input", limit, 1)]);
    let played = heard.check_ticks();
    assert!((1500..4000).contains(&played), "{played}");
}

/// A controller at rest is hardly looked at, and nothing is late for it.
#[test]
fn idle_controllers_cost_little() {
    let heard = session::<_, 4, 25_000_000>(cmd4cr(), |main| {
        pass(main, 10_000_000);
        assert_eq!(main.hardware().feeds, 10_000);
        assert!(main.figures().advances < 150, "{:?}", main.figures());
        commands(main, "EO=15 X100");
        pass(main, 2_000_000);
    });
    assert_eq!(heard.check_ticks(), 100);
}
