//! Axes that follow a joystick.

use super::rig::Rig;
use crate::controller::{
    FULL_SCALE_MV, JOYSTICKS, POSITIVE_LIMIT, QUICK_JOYSTICKS, WHILE_FOLLOWING, follow, soft_limit,
};

/// With 5000 and 4000 pps at the ends; X changes quickly and has a zone of a tenth, Y neither.
pub fn with_joystick() -> Rig {
    let mut rig = Rig::new();
    rig.ok(JOYSTICKS);
    rig
}

/// The voltage at so many thousandths of the scale.
fn mv(thousandths: u32) -> f64 {
    FULL_SCALE_MV * f64::from(thousandths) / 1000.0
}

/// The speed of an axis in pulses a second, once it has settled.
pub fn speed(rig: &mut Rig, input: &str, mv: f64) -> i64 {
    rig.analog(input, mv);
    rig.pass_ms(1000);
    let axis = if input == "AI1" { 0 } else { 1 };
    (rig.device.axis(axis).speed_mpps + 500).div_euclid(1000)
}

#[test]
fn joystick_control() {
    let mut rig = with_joystick();
    rig.ok(&follow(3));
    // Nothing moves in the zone of a tenth around the middle.
    for place in [500, 400, 600] {
        assert_eq!(speed(&mut rig, "AI1", mv(place)), 0, "{place}");
    }
    assert_eq!(speed(&mut rig, "AI1", mv(1000)), 5000);
    assert_eq!(speed(&mut rig, "AI1", mv(800)), 2500);
    assert_eq!(speed(&mut rig, "AI1", mv(200)), -2500);
    assert_eq!(speed(&mut rig, "AI1", mv(0)), -5000);
    assert_eq!(speed(&mut rig, "AI2", mv(750)), 2000);
    assert_eq!(speed(&mut rig, "AI1", mv(500)), 0);
    // The greatest change: 10 pps each millisecond.
    rig.analog("AI2", mv(500));
    rig.pass_ms(1000);
    rig.analog("AI2", mv(1000));
    rig.pass_ms(100);
    let after = rig.get("PSY");
    assert!((980..=1020).contains(&after), "{after}");
    // Motion commands have to wait, and StepNLoop stays off.
    let (refused, error) = WHILE_FOLLOWING;
    for command in refused {
        rig.check(command, error);
    }
    assert!(rig.moves("Y"));
    rig.ok(&follow(0));
    rig.until_rest();
    rig.run("X100");
    rig.check("PX", "100");
}

#[test]
fn the_joysticks_soft_limits() {
    for (axis, input, first, mask) in [("X", "AI1", 1, 1), ("Y", "AI2", 5, 2)] {
        let mut rig = with_joystick();
        for (place, limit) in (first..).zip([-3000, -1000, 1000, 3000]) {
            rig.ok(&soft_limit(place, limit));
        }
        rig.ok(QUICK_JOYSTICKS);
        rig.ok(&follow(mask));
        rig.analog(input, mv(1000));
        // Beyond the inner limit the speed falls with the way that is left.
        let mut slowed = false;
        for _ in 0..5000 {
            rig.pass_ms(1);
            let (position, speed) = (rig.get(&format!("P{axis}")), rig.get(&format!("PS{axis}")));
            if position > 1100 && position < 2900 {
                let most = 5000 * (3000 - position) / 2000;
                assert!(speed <= most + 50, "{speed} at {position}");
                slowed = true;
            }
        }
        assert!(slowed);
        rig.check(&format!("P{axis}"), "3000");
        rig.check(&format!("PS{axis}"), "0");
        // The way in is free.
        rig.analog(input, mv(0));
        rig.pass_ms(5000);
        rig.check(&format!("P{axis}"), "-3000");
    }
}

#[test]
fn a_joystick_runs_into_a_limit() {
    let mut rig = Rig::with(|axis| axis.positive_limit = 500);
    rig.ok(QUICK_JOYSTICKS);
    rig.ok(&follow(1));
    rig.analog("AI1", mv(1000));
    rig.pass_ms(2000);
    rig.check("PX", "500");
    assert_eq!(rig.get("MSTX") & POSITIVE_LIMIT, POSITIVE_LIMIT);
    // It stands until the error is cleared.
    rig.analog("AI1", mv(0));
    rig.pass_ms(100);
    rig.check("PX", "500");
    rig.ok("CLRX");
    rig.pass_ms(100);
    assert!(rig.get("PX") < 450);
}
