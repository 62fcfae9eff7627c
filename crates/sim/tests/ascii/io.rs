//! Inputs and outputs, and power to the motors.

use super::rig::Rig;
use crate::controller::{AXES, FULL_SCALE_MV, INDEX, VALUE};

/// So many digital inputs, each with its bit.
#[track_caller]
pub fn inputs(rig: &mut Rig, count: u32) {
    for bit in 1..=count {
        let input = format!("DI{bit}");
        rig.check(&input, "0");
        rig.pin(&input, true);
        rig.check(&input, "1");
        rig.check("DI", &(1 << (bit - 1)).to_string());
        rig.pin(&input, false);
        rig.check("DI", "0");
    }
}

/// So many digital outputs, each with its bit.
#[track_caller]
pub fn outputs(rig: &mut Rig, count: u32) {
    for bit in 1..=count {
        let output = format!("DO{bit}");
        rig.ok(&format!("{output}=1"));
        assert!(rig.level(&output));
        rig.check("DO", &(1 << (bit - 1)).to_string());
        rig.check(&output, "1");
        rig.ok(&format!("{output}=0"));
        assert!(!rig.level(&output));
    }
}

#[test]
fn analog_inputs() {
    let mut rig = Rig::new();
    rig.analog("AI1", 1234.0);
    rig.analog("AI2", FULL_SCALE_MV);
    rig.check("AI1", "1234");
    rig.check("AI2", &FULL_SCALE_MV.to_string());
    rig.analog("AI2", 0.0);
    rig.check("AI2", "0");
    rig.check("AI3", INDEX);
    rig.check("AI0", INDEX);
}

/// Without power the counter counts and the shaft stands still.
#[test]
fn motor_power() {
    let mut rig = Rig::new();
    let all = (1 << AXES.len()) - 1;
    for (bit, axis) in AXES.into_iter().enumerate() {
        let state =
            |rig: &mut Rig| (rig.get(&format!("P{axis}")), rig.get(&format!("E{axis}")), rig.shaft(axis));
        rig.run(&format!("{axis}1000"));
        assert_eq!(state(&mut rig), (1000, 1000, 1000));
        let output = format!("EO{}", bit + 1);
        rig.ok(&format!("{output}=0"));
        rig.check("EO", &(all - (1 << bit)).to_string());
        for other in 0..AXES.len() {
            assert_eq!(rig.level(&format!("EO{}", other + 1)), other != bit);
        }
        rig.run(&format!("{axis}3000"));
        assert_eq!(state(&mut rig), (3000, 1000, 1000));
        rig.ok(&format!("{output}=1"));
        rig.check(&output, "1");
        assert!(rig.level(&output));
        rig.run(&format!("{axis}2000"));
        assert_eq!(state(&mut rig), (2000, 0, 0));
    }
    rig.check(&format!("EO={}", all + 1), VALUE);
    rig.check(&format!("EO{}=1", AXES.len() + 1), INDEX);
}
