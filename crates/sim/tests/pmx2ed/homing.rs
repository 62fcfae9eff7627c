//! The five homing routines on the machine. Their timing is held by snapshots in `motion`.

use crate::rig::Rig;

/// Home from 1000 to 1200, limits at ±3000, an index mark every 400 pulses.
fn rig() -> Rig {
    let mut rig = Rig::with(|axis| {
        axis.home = [1000, 1200];
        axis.positive_limit = 3000;
        axis.negative_limit = -3000;
        axis.index_every = 400;
    });
    rig.ok("HSPD=4000 LSPD=400 ACC=50");
    rig
}

/// Runs a routine to its end and gives the position; the pulses from the start to zero.
#[track_caller]
fn home(rig: &mut Rig, command: &str) -> (i32, i64) {
    rig.run(command);
    let position = rig.get("PX");
    (position, rig.shaft("X") - i64::from(position))
}

#[test]
fn homing_at_high_speed() {
    let mut rig = rig();
    // Braking from 4000 to 400 pps over 50 ms takes 110 pulses, and ends on the next one.
    assert_eq!(home(&mut rig, "HX+"), (111, 1000));
    assert_eq!(rig.get("EX"), 111);
    rig.run("X1000");
    // From the other side the switch comes on at its other edge.
    let (position, zero) = home(&mut rig, "HX-");
    assert_eq!((position, zero), (-111, 1200));
    // A limit on the way is an error.
    rig.run("X-600");
    rig.run("HX-");
    assert_eq!(rig.get("MSTX") & 0x120, 0x120);
    assert_eq!(rig.shaft("X"), -3000);
    rig.check("H+", "?H+");
    rig.check("HX", "?HX");
}

#[test]
fn homing_by_a_limit() {
    let mut rig = rig();
    rig.ok("LCA=250");
    assert_eq!(home(&mut rig, "LX-"), (0, -2750));
    assert_eq!(rig.get("MSTX") & 0x1A0, 0);
    rig.ok("LCAX=100");
    assert_eq!(home(&mut rig, "LX+"), (0, 2900));
    // It starts on the limit: it moves away and is there.
    rig.ok("LCAX=0 IERR=1");
    rig.run("X9000");
    assert_eq!(home(&mut rig, "LX+"), (0, 2750));
    assert_eq!(rig.get("EX"), 0);
}

#[test]
fn homing_by_home_and_index() {
    let mut rig = rig();
    // The first index mark after the motor is down to low speed.
    assert_eq!(home(&mut rig, "ZHX+"), (0, 1200));
    rig.run("X1000");
    assert_eq!(home(&mut rig, "ZHX-"), (0, 800));
}

#[test]
fn homing_by_the_index() {
    let mut rig = rig();
    // The axis stands on a mark; the next one is it.
    assert_eq!(home(&mut rig, "ZX+"), (0, 400));
    let start = rig.device.now();
    assert_eq!(home(&mut rig, "ZX-"), (0, 0));
    // At low speed all the way: 400 pulses at 400 pps.
    let ms = (rig.device.now() - start) / crate::controller::MS;
    assert!((990..=1010).contains(&ms), "{ms}");
}

#[test]
fn homing_high_and_low_speed() {
    let mut rig = rig();
    rig.ok("HCA=150");
    assert_eq!(home(&mut rig, "HLX+"), (0, 1000));
    rig.run("X1500");
    assert_eq!(home(&mut rig, "HLX-"), (0, 1200));
    rig.run("X-1000");
    rig.ok("HCAX=20");
    assert_eq!(home(&mut rig, "HLX+"), (0, 1000));
    assert_eq!(rig.get("EX"), 0);
}

#[test]
fn homing_returns_to_zero() {
    let mut rig = rig();
    rig.check("RZ", "0");
    rig.ok("RZ=1");
    assert_eq!(home(&mut rig, "HX+"), (0, 1000));
    rig.run("X1000");
    assert_eq!(home(&mut rig, "HX-"), (0, 1200));
    rig.check("RZ=2", "?Invalid Answer");
}

/// Stops end a routine.
#[test]
fn homing_can_be_stopped() {
    let mut rig = rig();
    rig.ok("HX+");
    rig.pass_ms(200);
    rig.check("X0", "?Moving");
    rig.check("SSPDX=500", "?SSPD Mode not Initialized");
    rig.ok("STOPX");
    rig.until_rest();
    assert!(rig.shaft("X") < 1000);
    rig.ok("HX+");
    rig.pass_ms(100);
    rig.ok("ABORTX");
    assert!(!rig.moves("X"));
    rig.run("X0");
    rig.check("PX", "0");
}
