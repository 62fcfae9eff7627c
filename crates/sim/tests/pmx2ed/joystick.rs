//! Joystick control.

use crate::rig::Rig;

fn rig() -> Rig {
    let mut rig = Rig::new();
    for setting in ["JV1=5000", "JV2=4000", "JV3=100", "JV4=10", "JV5=500", "JV6=0"] {
        rig.ok(setting);
    }
    rig
}

/// The speed of an axis in pulses a second, once it has settled.
fn speed(rig: &mut Rig, input: &str, mv: f64) -> i64 {
    rig.analog(input, mv);
    rig.pass_ms(1000);
    let axis = if input == "AI1" { 0 } else { 1 };
    (rig.device.axis(axis).speed_mpps + 500).div_euclid(1000)
}

#[test]
fn joystick_control() {
    let mut rig = rig();
    rig.ok("JO");
    assert_eq!((rig.get("MSTX") & 1024, rig.get("MSTY") & 1024), (1024, 1024));
    // Nothing moves in the zone of 500 mV around the middle.
    for mv in [2500.0, 2000.0, 3000.0] {
        assert_eq!(speed(&mut rig, "AI1", mv), 0, "{mv}");
    }
    assert_eq!(speed(&mut rig, "AI1", 5000.0), 5000);
    assert_eq!(speed(&mut rig, "AI1", 4000.0), 2500);
    assert_eq!(speed(&mut rig, "AI1", 1000.0), -2500);
    assert_eq!(speed(&mut rig, "AI1", 0.0), -5000);
    assert_eq!(speed(&mut rig, "AI2", 3750.0), 2000);
    assert_eq!(speed(&mut rig, "AI1", 2500.0), 0);
    // The greatest change: 10 pps each millisecond.
    rig.analog("AI2", 2500.0);
    rig.pass_ms(1000);
    rig.analog("AI2", 5000.0);
    rig.pass_ms(100);
    let after = rig.get("PSY");
    assert!((980..=1020).contains(&after), "{after}");
    // Motion commands have to wait.
    for refused in ["X100", "JX+", "HX-", "I0:0", "SLX=1"] {
        rig.check(refused, "?State Error");
    }
    rig.ok("JF");
}

#[test]
fn joysticks_of_some_axes() {
    let mut rig = rig();
    rig.ok("JO=1");
    assert_eq!((rig.get("MSTX") & 1024, rig.get("MSTY") & 1024), (1024, 0));
    rig.run("Y100");
    rig.check("X100", "?State Error");
    rig.ok("JF");
    rig.run("X100");
    rig.check("PX", "100");
    // It switches StepNLoop off.
    rig.ok("SLX=1 SLY=1 JO=2");
    rig.check("SLX", "1");
    rig.check("SLY", "0");
    rig.ok("JX+");
    rig.check("JO=3", "?Moving");
    rig.check("JO=4", "?Invalid Answer");
    rig.ok("ABORT JF");
}

#[test]
fn the_joysticks_soft_limits() {
    let mut rig = rig();
    for (place, limit) in (1..).zip([-3000, -1000, 1000, 3000]) {
        rig.ok(&format!("JL{place}={limit}"));
    }
    rig.ok("JO");
    rig.analog("AI1", 5000.0);
    // Beyond the inner limit the speed falls with the way that is left.
    let mut slowed = false;
    for _ in 0..5000 {
        rig.pass_ms(1);
        let (position, speed) = (rig.get("PX"), rig.get("PSX"));
        if position > 1100 && position < 2900 {
            let most = 5000 * (3000 - position) / 2000;
            assert!(speed <= most + 50, "{speed} at {position}");
            slowed = true;
        }
    }
    assert!(slowed);
    rig.check("PX", "3000");
    rig.check("PSX", "0");
    // The way in is free.
    rig.analog("AI1", 0.0);
    rig.pass_ms(5000);
    rig.check("PX", "-3000");
}

#[test]
fn a_joystick_runs_into_a_limit() {
    let mut rig = Rig::with(|axis| axis.positive_limit = 500);
    for setting in ["JV1=5000", "JV3=100", "JO=1"] {
        rig.ok(setting);
    }
    rig.analog("AI1", 5000.0);
    rig.pass_ms(2000);
    rig.check("PX", "500");
    assert_eq!(rig.get("MSTX") & 0x90, 0x90);
    rig.analog("AI1", 0.0);
    rig.pass_ms(100);
    rig.check("PX", "500");
    rig.ok("CLRX");
    rig.pass_ms(100);
    assert!(rig.get("PX") < 450);
}
