//! StepNLoop of four axes, and circles with it.

use crate::controller::AXES;
use crate::rig::Rig;

/// Two counts a pulse: the shaft turns a circle in pulses whose centre is in counts.
#[test]
fn closed_loop_circles_in_encoder_counts() {
    let mut rig = Rig::with(|axis| axis.encoder_ratio = 2.0);
    rig.ok("SLRX=0.5 SLRY=0.5 SLTX=5 SLEX=400 SLAX=3 HSPD=4000 LSPD=400 ACC=100 DEC=100 SLX=1 SLY=1");
    rig.run("X10500Y5000");
    rig.pass_ms(100);
    assert_eq!((rig.shaft("X"), rig.shaft("Y")), (5250, 2500));
    rig.ok("CIRXYP10500:4000");
    rig.pass_ms(300);
    assert!(rig.moves("X"));
    rig.until_rest();
    rig.pass_ms(100);
    assert_eq!((rig.get("SLSX"), rig.get("EX"), rig.get("EY")), (0, 10_500, 5000));
}

/// A setting of one axis is none of another.
#[test]
fn loops_of_all_axes() {
    let mut rig = Rig::with(|axis| axis.encoder_ratio = 0.5);
    for axis in AXES {
        rig.ok(&format!("SLR{axis}=2 SLT{axis}=2 SL{axis}=1 {axis}100"));
        rig.until_rest();
        rig.pass_ms(50);
        assert_eq!((rig.get(&format!("E{axis}")), rig.shaft(axis)), (100, 200));
        // A push of ten counts is taken back.
        rig.device.push(axis, 20).unwrap();
        rig.pass_ms(500);
        assert_eq!((rig.get(&format!("E{axis}")), rig.get(&format!("SLS{axis}"))), (100, 0));
    }
}
