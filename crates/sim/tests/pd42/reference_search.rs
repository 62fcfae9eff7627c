//! Reference searches and their axis parameters (manual, section 7.1).

use crate::rig::Rig;
use protocol::tmcl::Status;

const INVALID_VALUE: u8 = Status::INVALID_VALUE.0;

/// End switches at −1000 and 2000, home from −200 to 0; the axis starts at 500.
fn stage() -> Rig {
    let mut rig = Rig::with(|axis| {
        (axis.negative_limit, axis.positive_limit) = (-1000, 2000);
    });
    rig.move_to(500);
    rig.until_rest();
    rig
}

fn search(rig: &mut Rig, mode: i32) {
    rig.sap(193, mode);
    rig.ok(13, 0, 0, 0);
    assert_ne!(rig.ok(13, 2, 0, 0), 0, "a search is on");
    for _ in 0..60_000 {
        rig.pass_ms(1);
        if rig.ok(13, 2, 0, 0) == 0 {
            assert_eq!((rig.gap(0), rig.gap(1), rig.gap(3)), (0, 0, 0), "mode {mode} ends at zero");
            return;
        }
    }
    panic!("mode {mode} does not end");
}

#[test]
fn ap_193_reference_search_modes() {
    for (mode, zero) in [
        (1, -1000),
        (2, -1000),
        (3, -1000),
        (4, -1000),
        (5, -100),
        (6, -100),
        (7, -100),
        (65, 2000),
        (66, 2000),
        (67, 1999),
        (68, 1999),
    ] {
        let mut rig = stage();
        search(&mut rig, mode);
        assert_eq!(rig.shaft(), zero, "mode {mode}");
    }
    // Mode 8 looks ahead only, and finds home from below.
    let mut rig = stage();
    rig.move_to(-500);
    rig.until_rest();
    search(&mut rig, 8);
    assert_eq!(rig.shaft(), -100);
    // An inverted home switch is off from -200 to 0.
    for mode in [133, 134, 135, 136] {
        let mut rig = stage();
        rig.pin("HOME", true);
        rig.sap(193, mode);
        rig.ok(13, 0, 0, 0);
        rig.pass_ms(50);
        assert_ne!(rig.gap(3), 0, "mode {mode} seeks an open switch");
        rig.pin("HOME", false);
        rig.pass_ms(5);
        rig.pin("HOME", true);
        rig.pass_ms(5);
        rig.ok(13, 1, 0, 0);
        assert_eq!((rig.gap(3), rig.ok(13, 2, 0, 0)), (0, 0), "stopped at once");
    }
    let mut rig = Rig::new();
    for mode in [0, 9, 64, 69, 127, 128, 132, 137] {
        assert_eq!(rig.send(5, 193, 0, mode).0, INVALID_VALUE, "mode {mode}");
    }
}

#[test]
fn ap_194_and_195_search_speeds() {
    let mut rig = stage();
    rig.sap(194, 321);
    rig.sap(195, 12);
    rig.sap(193, 1);
    rig.ok(13, 0, 0, 0);
    rig.pass_ms(30);
    assert_eq!(rig.gap(3), -321);
    for _ in 0..200 {
        rig.pass_ms(1);
        if rig.gap(11) == 1 {
            break;
        }
    }
    rig.pass_ms(1);
    assert!((1..=12).contains(&rig.gap(3)), "slowly off the switch: {}", rig.gap(3));
}

#[test]
fn ap_196_end_switch_distance() {
    for mode in [2, 3, 66] {
        let mut rig = stage();
        search(&mut rig, mode);
        assert_eq!(rig.gap(196), 3000, "mode {mode}");
    }
}

#[test]
fn ap_197_last_reference() {
    let mut rig = stage();
    search(&mut rig, 1);
    assert_eq!(rig.gap(197), -1000);
    search(&mut rig, 2);
    assert_eq!(rig.gap(197), 0);
}

#[test]
fn searches_ignore_disabled_switches_and_end_with_motion_commands() {
    let mut rig = stage();
    rig.sap(13, 1);
    search(&mut rig, 1);
    assert_eq!(rig.shaft(), -1000);
    rig.ok(13, 0, 0, 0);
    rig.move_to(100);
    assert_eq!(rig.ok(13, 2, 0, 0), 0);
    rig.until_rest();
    assert_eq!(rig.gap(1), 100);
}
