//! Ramps: how long they take, their shapes, and targets that change on the way.

use super::rig::Rig;
use crate::controller::{AXES, USE_DECELERATION};

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

/// The bits of acceleration, deceleration and constant speed, in the order in which X has them until it rests.
pub fn phases(rig: &mut Rig) -> Vec<i32> {
    let mut seen = Vec::new();
    while rig.moves("X") {
        let bits = rig.get("MSTX") & 7;
        if seen.last() != Some(&bits) {
            seen.push(bits);
        }
        rig.pass_ms(1);
    }
    seen
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

#[test]
fn on_the_fly_target() {
    let mut rig = Rig::new();
    let (number, axis) = (AXES.len() - 1, AXES[AXES.len() - 1]);
    let (position, target) = (format!("P{axis}"), format!("T{axis}"));
    rig.ok("HSPD=5000 LSPD=500 ACC=100 DEC=100");
    rig.ok(&format!("{axis}10000"));
    rig.pass_ms(500);
    rig.ok(&format!("{target}20000"));
    rig.until_rest();
    rig.check(&position, "20000");
    // A target that lies behind is reached by turning round.
    rig.ok(&format!("{axis}40000"));
    rig.pass_ms(1000);
    rig.ok(&format!("{target}20500"));
    let turned = (0..1000).any(|_| {
        rig.pass_ms(1);
        rig.device.axis(number).speed_mpps < 0
    });
    assert!(turned);
    rig.until_rest();
    rig.check(&position, "20500");
    // Counted from the start of the move in incremental mode.
    rig.ok(&format!("INC {axis}1000"));
    rig.pass_ms(100);
    rig.ok(&format!("{target}3000"));
    rig.until_rest();
    rig.check(&position, "23500");
}
