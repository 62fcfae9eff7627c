//! Speeds, ramps, speed windows, on-the-fly changes.

use crate::ascii::ramps::{fall, near, rise};
use crate::rig::Rig;

#[test]
fn accelerations_and_decelerations() {
    let mut rig = Rig::new();
    for (command, default) in [("ACC", 300), ("DEC", 300), ("ACCX", 0), ("DECY", 0), ("EDEC", 0)] {
        assert_eq!(rig.get(command), default, "{command}");
    }
    rig.ok("HSPD=10000 LSPD=1000 ACC=200 DEC=600 X20000");
    near(rise(&mut rig), 200);
    near(fall(&mut rig), 200);
    rig.ok("EDEC=1 X0");
    near(rise(&mut rig), 200);
    near(fall(&mut rig), 600);
    // Those of the axis come first.
    rig.ok("ACCX=400 DECX=100 X20000");
    near(rise(&mut rig), 400);
    near(fall(&mut rig), 100);
    rig.ok("ACCX=0 DECX=0 X0");
    near(rise(&mut rig), 200);
    near(fall(&mut rig), 600);
    // What is beyond the table's range is brought into it and reads as written: at 10,000 pps the
    // gentlest is 9,000 / 300 s.
    rig.ok("ACC=2147483647");
    rig.check("ACC", "2147483647");
    rig.ok("ACC=0 EDEC=0 JX+");
    near(rise(&mut rig), 1);
    rig.ok("ABORT");
    for wrong in ["ACC=-1", "DEC=2147483648", "EDEC=2", "ACCX=1.5"] {
        rig.check(wrong, "?Invalid Answer");
    }
}

#[test]
fn global_and_individual_speeds() {
    let mut rig = Rig::new();
    for (command, default) in [("HSPD", 1000), ("LSPD", 100), ("HSPDX", 0), ("LSPDY", 0)] {
        assert_eq!(rig.get(command), default, "{command}");
    }
    // The example of section 7.1.
    rig.ok("HSPD=10000 HSPDX=2000 LSPD=300 ACCX=500 ACC=300 DEC=300 JX+ JY+");
    rig.pass_ms(600);
    rig.check("PS", "2000:10000");
    rig.ok("ABORT HSPDX=0 JX+");
    rig.pass_ms(600);
    rig.check("PSX", "10000");
    rig.ok("ABORT");
    // Lines have the global ones.
    rig.ok("HSPDX=50 HSPDY=50 INC I5000:5000");
    rig.pass_ms(400);
    rig.check("PS", "10000:10000");
    rig.ok("ABORT HSPDX=2000 HSPDY=0");
    for wrong in ["LSPD=0", "LSPD=10001", "LSPDX=2001"] {
        rig.check(wrong, "?Low speed out of range");
    }
    for wrong in ["HSPD=0", "HSPD=6000001", "HSPDX=-1", "LSPD=-1"] {
        rig.check(wrong, "?Invalid Answer");
    }
    rig.check("HSPD", "10000");
    rig.check("LSPD", "300");
    // Motion begins at the low speed.
    rig.ok("LSPDY=5000 JY+");
    rig.pass_ms(1);
    assert!(rig.get("PSY") >= 5000);
    rig.ok("ABORT LSPDY=0");
}

#[test]
fn speeds_are_read_while_moving() {
    let mut rig = Rig::new();
    rig.check("PS", "0:0");
    rig.ok("HSPD=7777 ACC=50 JX- JY+");
    rig.pass_ms(200);
    rig.check("PS", "7777:7777");
    rig.check("PSX", "7777");
    rig.ok("ABORTX");
    rig.check("PS", "0:7777");
    // The highest speed of the table.
    rig.ok("ABORT HSPD=6000000 LSPD=6000000 JX-");
    rig.pass_ms(20);
    rig.check("PSX", "6000000");
    rig.ok("ABORT");
}

/// Moves end where they shall on S-curves too.
#[test]
fn moves_on_s_curves() {
    let mut rig = Rig::new();
    rig.ok("SCVX=1 HSPD=9000 LSPD=1000 ACC=400");
    rig.run("X12345");
    rig.check("PX", "12345");
    rig.run("I0:777");
    assert_eq!((rig.get("PX"), rig.get("PY")), (0, 777));
    rig.check("SCVX=2", "?Invalid Answer");
    rig.check("SCV", "?SCV");
}

#[test]
fn on_the_fly_speed() {
    let mut rig = Rig::new();
    rig.check("SSPDX=500", "?SSPD Mode not Initialized");
    rig.ok("SSPDMX=1");
    rig.check("SSPDMX", "1");
    rig.check("SSPDX=500", "?State Error");
    rig.ok("HSPD=2000 LSPD=100 ACC=100 JX+");
    rig.pass_ms(300);
    rig.check("SSPDMX=2", "?Moving");
    rig.ok("SSPDX=16000");
    rig.pass_ms(1500);
    rig.check("PSX", "16000");
    for out in ["SSPDX=16001", "SSPDX=0"] {
        rig.check(out, "?Speed out of range");
    }
    rig.ok("SSPDX=500");
    rig.pass_ms(1500);
    rig.check("PSX", "500");
    rig.ok("ABORT");
    // A target is still reached.
    rig.ok("PX=0 X20000");
    rig.pass_ms(500);
    rig.ok("SSPDX=12000");
    rig.until_rest();
    rig.check("PX", "20000");
    // The speed of the move lies outside the window.
    rig.ok("HSPD=20000 JX-");
    rig.pass_ms(300);
    rig.check("SSPDX=500", "?Speed out of range");
    rig.ok("ABORT SSPDMX=2 JX-");
    rig.pass_ms(300);
    rig.ok("SSPDX=32000");
    rig.check("SSPDX=1", "?Speed out of range");
    rig.ok("ABORT SSPDMX=0 JX+");
    rig.check("SSPDX=5000", "?SSPD Mode not Initialized");
    rig.ok("ABORT SSPDMX=2 SCVX=1 JX+");
    rig.check("SSPDX=5000", "?S-curve on");
    rig.ok("ABORT SCVX=0 I0:0");
    rig.pass_ms(10);
    rig.check("SSPDX=5000", "?ICommandOn");
    rig.ok("ABORT");
    rig.check("SSPDMX=10", "?Invalid Answer");
    rig.check("SSPDX", "?SSPDX");
}
