//! StepNLoop and homing.

use crate::rig::Rig;

#[test]
fn homing_with_the_loop_keeps_zero() {
    let mut rig = Rig::with(|axis| {
        axis.home = [1000, 1100];
        axis.encoder_ratio = 2.0;
    });
    rig.ok("SLRX=0.5 SLX=1 HSPD=4000 LSPD=400 ACC=100 HX+");
    rig.until_rest();
    rig.pass_ms(50);
    assert_eq!(rig.get("PX"), 2 * (rig.shaft("X") as i32 - 1000));
    assert_eq!((rig.get("EX"), rig.get("SLSX")), (rig.get("PX"), 0));
    rig.ok("X0");
    rig.until_rest();
    assert_eq!(rig.shaft("X"), 1000);
}
