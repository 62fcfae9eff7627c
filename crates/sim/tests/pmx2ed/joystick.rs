//! Which axes follow their joysticks.

use crate::ascii::joystick::with_joystick;

/// Bit 10 of an axis' status.
const FOLLOWS: i32 = 1024;

#[test]
fn joysticks_of_all_axes() {
    let mut rig = with_joystick();
    rig.ok("JO");
    assert_eq!((rig.get("MSTX") & FOLLOWS, rig.get("MSTY") & FOLLOWS), (FOLLOWS, FOLLOWS));
    rig.ok("JF");
    assert_eq!((rig.get("MSTX") & FOLLOWS, rig.get("MSTY") & FOLLOWS), (0, 0));
}

#[test]
fn joysticks_of_some_axes() {
    let mut rig = with_joystick();
    rig.ok("JO=1");
    assert_eq!((rig.get("MSTX") & FOLLOWS, rig.get("MSTY") & FOLLOWS), (FOLLOWS, 0));
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
