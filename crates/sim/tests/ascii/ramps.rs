//! Ramps: how long they take, and their shapes.

use super::rig::Rig;
use crate::controller::USE_DECELERATION;

/// Milliseconds from the start until the speed no longer rises.
pub fn rise(rig: &mut Rig) -> u64 {
    (1..)
        .find(|_| {
            rig.pass_ms(1);
            rig.get("MSTX") & 1 == 0
        })
        .unwrap_or(0)
}

/// Milliseconds of the ramp down to rest.
pub fn fall(rig: &mut Rig) -> u64 {
    while rig.get("MSTX") & 2 == 0 {
        rig.pass_ms(1);
    }
    rig.until_rest()
}

#[track_caller]
pub fn near(value: u64, expected: u64) {
    assert!(value.abs_diff(expected) <= 2 + expected / 50, "{value}, expected {expected}");
}

/// Rules 1 to 3 of the manuals' sections on ramps of positional moves.
#[test]
fn short_moves_are_symmetric() {
    let mut rig = Rig::new();
    // 200 ms and 600 ms from 1000 to 10,000 pps: 1,100 and 3,300 pulses.
    rig.ok(USE_DECELERATION);
    rig.ok("HSPD=10000 LSPD=1000 ACC=200 DEC=600 X6700");
    near(rise(&mut rig), 200);
    near(fall(&mut rig), 600);
    // The ramp down alone is longer than half the way.
    rig.ok("X300");
    near(rise(&mut rig), 200);
    near(fall(&mut rig), 200);
    // The ramp up alone is: a triangle with its top in the middle.
    rig.ok("ACC=600 DEC=200 X4300");
    let up = rise(&mut rig);
    assert!((1990..=2310).contains(&(rig.get("PX") - 300)), "{}", rig.get("PX"));
    near(fall(&mut rig), up);
    rig.check("PX", "4300");
}

#[test]
fn s_curves() {
    let mut rig = Rig::new();
    rig.check("SCVX", "0");
    // How much of the gain in speed is made in the first quarter of the ramp.
    let mut first = |command: &str| {
        rig.ok(command);
        rig.ok("HSPD=9000 LSPD=1000 ACC=400 JX+");
        rig.pass_ms(100);
        let gained = rig.get("PSX") - 1000;
        rig.pass_ms(305);
        rig.check("PSX", "9000");
        rig.ok("ABORT");
        gained
    };
    let straight = first("SCVX=0");
    assert!((1950..=2050).contains(&straight), "{straight}");
    // A quarter of the time is half of the bend: an eighth of the gain.
    let curved = first("SCVX=1");
    assert!((950..=1050).contains(&curved), "{curved}");
    rig.run("X0");
    rig.check("PX", "0");
}
