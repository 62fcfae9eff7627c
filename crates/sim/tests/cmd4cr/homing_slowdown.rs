//! Homing with the slowdown switch: the second half of the drawings of appendix A, and section 2.1.3.1.1.2.

use crate::homing::{BRAKING, LIMIT_ERRORS, home, rig, rig_with};
use crate::rig::Rig;
use std::ops::RangeInclusive;

/// Low speed, as it is read.
const LOW: i32 = 400;

/// The slowdown input has stopped the axis.
const STOPPED_BY_SD: i32 = 1 << 17;

/// Home from 1010 to 1190 within the switch.
const AROUND_HOME: [i64; 2] = [800, 1250];

fn rig_slow(zone: [i64; 2]) -> Rig {
    let mut rig = rig_with(|axis| axis.slowdown = [Some(zone), None]);
    rig.ok("SDEX=1");
    rig
}

/// A motion of X to its end; the highest speed read while the shaft was in a range.
#[track_caller]
fn fastest(rig: &mut Rig, command: &str, range: RangeInclusive<i64>) -> i32 {
    rig.ok(command);
    let mut fastest = 0;
    while rig.moves("X") {
        if range.contains(&rig.shaft("X")) {
            fastest = fastest.max(rig.get("PSX").abs());
        }
        rig.pass_ms(1);
    }
    fastest
}

/// The four operations of the drawing of mode 0 with the switch.
#[test]
fn operations_of_mode_0() {
    // 1: fast, slow from the switch on, stops at home.
    let mut rig = rig_slow(AROUND_HOME);
    assert!(fastest(&mut rig, "HX+0", 0..=800) > 3900);
    assert_eq!((rig.shaft("X"), rig.get("PX")), (1010, 0));
    let mut rig = rig_slow(AROUND_HOME);
    assert_eq!(fastest(&mut rig, "HX+0", 800 + BRAKING..=1010), LOW);
    // 2: started on the switch: slow all the way.
    let mut rig = rig_slow(AROUND_HOME);
    rig.run("X850");
    assert_eq!(rig.get("MSTX") & 0x80, 0x80, "the input can be read");
    assert_eq!(fastest(&mut rig, "HX+0", 0..=3000), LOW);
    assert_eq!((rig.shaft("X"), rig.get("PX")), (1010, 0));
    // 3: started on the switch, away from home: slow until it is off, then fast, into the limit.
    for range in [1220..=1250, 1400..=2990] {
        let mut rig = rig_slow(AROUND_HOME);
        rig.run("X1220");
        let on_switch = *range.end() <= 1250;
        let speed = fastest(&mut rig, "HX+0", range);
        assert!(if on_switch { speed == LOW } else { speed > 3900 }, "{speed}");
        assert_eq!((rig.shaft("X"), rig.get("MSTX") & LIMIT_ERRORS), (3000, 0x100));
    }
    // 4: started beyond both.
    let mut rig = rig_slow(AROUND_HOME);
    rig.run("X2000");
    assert!(fastest(&mut rig, "HX+0", 2200..=2990) > 3900);
    assert_eq!((rig.shaft("X"), rig.get("MSTX") & LIMIT_ERRORS), (3000, 0x100));
}

/// Every mode on a switch that is always on: slow, and without anything to brake it ends at zero.
#[test]
fn every_mode_is_slow_on_the_switch() {
    let zeros = [1010, 1010, 1200, 1200, 800, 800, 2999, 2800, 2800, 1010, 1200, 800, 2800];
    for (mode, zero) in zeros.into_iter().enumerate() {
        let mut rig = rig_slow([-5000, 5000]);
        assert_eq!(fastest(&mut rig, &format!("HX+{mode}"), -5000..=5000), LOW, "mode {mode}");
        assert_eq!((rig.shaft("X"), rig.get("PX")), (zero, 0), "mode {mode}");
    }
    let mut rig = rig_slow([-5000, 5000]);
    assert_eq!(fastest(&mut rig, "ZMOVEX+", -5000..=5000), LOW);
    assert_eq!(rig.shaft("X"), 400);
}

/// Every mode with the switch around home: zero is where it is without, but for the turn, which comes sooner.
#[test]
fn every_mode_with_a_switch_around_home() {
    let expected = [
        (1010, 0),
        (1010, 0),
        (1200, 0),
        (1200, 0),
        (800, 0),
        // It is at low speed where the index comes, or nearly.
        (800, 0),
        (2999, 0),
        (2800, 0),
        (2800, -BRAKING),
        (1010, 0),
        (1200, 0),
        (800, 0),
        (2800, 0),
    ];
    for (mode, expected) in expected.into_iter().enumerate() {
        let mut rig = rig_slow(AROUND_HOME);
        assert_eq!(home(&mut rig, "X", &format!("HX+{mode}")), expected, "mode {mode}");
    }
    // The return to zero of modes 9 to 12 obeys it too.
    let mut rig = rig_slow([1060, 1300]);
    rig.ok("HX+9");
    let (mut farthest, mut back) = (0, 0);
    while rig.moves("X") {
        farthest = farthest.max(rig.shaft("X"));
        if (1060..farthest).contains(&rig.shaft("X")) {
            back = back.max(rig.get("PSX"));
        }
        rig.pass_ms(1);
    }
    assert_eq!((farthest, back), (1010 + BRAKING, LOW));
    assert_eq!((rig.shaft("X"), rig.get("PX")), (1010, 0));
}

#[test]
fn the_switch_is_enabled_and_latched() {
    let mut rig = rig();
    rig.check("SDEX", "0");
    rig.check("SDEX=4", "?Invalid Index");
    // Passed at 300 to 350: disabled, enabled, a latch that is not enabled, latched.
    for (value, slow) in [(0, false), (1, false), (2, false), (3, true)] {
        let mut rig = rig_slow([300, 500]);
        rig.ok(&format!("SDEX={value}"));
        let speed = fastest(&mut rig, "HX+0", 750..=1000);
        assert!(if slow { speed == LOW } else { speed > 2500 }, "SDE={value}: {speed}");
        let position = rig.get("PX");
        assert_eq!((rig.shaft("X") - i64::from(position), position == 0), (1010, slow), "SDE={value}");
        // A latch holds for one motion.
        assert!(fastest(&mut rig, "X1500", 1500..=2000) > 3900, "SDE={value}");
    }
}

/// With `SDC` the routine is over where the switch comes on.
#[test]
fn the_switch_stops() {
    for mode in 0..13 {
        let mut rig = rig_slow([300, 500]);
        rig.ok("SDCX=1");
        rig.run(&format!("HX+{mode}"));
        assert_eq!((rig.shaft("X"), rig.get("PX")), (300 + BRAKING, 300 + BRAKING as i32), "mode {mode}");
        assert_eq!(rig.get("MSTX") & (STOPPED_BY_SD | LIMIT_ERRORS), STOPPED_BY_SD, "mode {mode}");
        // It stands on the switch and may leave it, slowly; the flag stays until it is cleared.
        assert_eq!(fastest(&mut rig, &format!("HX+{mode}"), 0..=500), LOW, "mode {mode}");
        let zero = rig.shaft("X") - i64::from(rig.get("PX"));
        assert!(zero > 500, "mode {mode} has found its zero: {zero}");
        assert_eq!(rig.get("MSTX") & STOPPED_BY_SD, STOPPED_BY_SD, "mode {mode}");
        rig.ok("CLRX");
        assert_eq!(rig.get("MSTX") & STOPPED_BY_SD, 0, "mode {mode}");
    }
}

#[test]
fn the_polarity_of_the_switch() {
    let mut rig = rig_slow([300, 500]);
    rig.ok("POLX=36928");
    assert_eq!(rig.get("MSTX") & 0x80, 0x80);
    assert_eq!(fastest(&mut rig, "HX+0", 0..=299), LOW);
    let mut rig = rig_slow([300, 500]);
    rig.ok("POLX=36928");
    assert!(fastest(&mut rig, "HX+0", 300..=500) > 1000);
    assert_eq!((rig.shaft("X"), rig.get("PX")), (1010, 0));
}
