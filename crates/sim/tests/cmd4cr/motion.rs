//! Moves, jogs, stops, speeds, changes on the fly, status words.

use crate::ascii::ramps::{fall, near, phases, rise};
use crate::controller::AXES;
use crate::rig::Rig;

#[test]
fn absolute_and_incremental_moves() {
    let mut rig = Rig::new();
    rig.check("MM", "0");
    for axis in AXES {
        let mut check = |commands: &str, position: &str| {
            rig.ok(commands);
            rig.until_rest();
            rig.check(&format!("P{axis}"), position);
        };
        check(&format!("{axis}1000"), "1000");
        check(&format!("{axis}-500"), "-500");
        check(&format!("INC {axis}100"), "-400");
        check(&format!("{axis}-120"), "-520");
        check(&format!("ABS {axis}30"), "30");
        assert_eq!(rig.shaft(axis), 30);
    }
    rig.ok("INC");
    rig.check("MM", "1");
    rig.ok("ABS");
    // No way to go is no move.
    rig.ok("X30");
    assert!(!rig.moves("X"));
    for wrong in ["X", "X+", "Xabc", "X1.5", "X1X2", "XV1", "X10Y"] {
        rig.check(wrong, &format!("?Unknown Command: {wrong}"));
    }
    assert!(!rig.moves("X"));
}

#[test]
fn jogging() {
    let mut rig = Rig::new();
    rig.ok("HSPD=2000 ACC=100");
    for (axis, way) in [("X", "+"), ("Y", "-"), ("Z", "+"), ("U", "-")] {
        rig.ok(&format!("J{axis}{way}"));
        rig.pass_ms(1000);
        rig.check(&format!("PS{axis}"), "2000");
        let position = rig.get(&format!("P{axis}"));
        assert!(position.abs() > 1500 && (position > 0) == (way == "+"), "{position}");
    }
    // All of them go on by themselves.
    assert!(AXES.iter().all(|axis| rig.moves(axis)));
    rig.ok("STOP");
    rig.until_rest();
}

#[test]
fn stopping() {
    let mut rig = Rig::new();
    rig.ok("HSPD=10000 LSPD=1000 ACC=200 DEC=200 JX+ JY+ JZ- JU-");
    rig.pass_ms(500);
    // At once, one axis only.
    rig.ok("ABORTX");
    assert!(!rig.moves("X") && rig.moves("Y"));
    let stood = rig.get("PX");
    rig.pass_ms(50);
    assert_eq!(rig.get("PX"), stood);
    // With the ramp: (10000 + 1000) / 2 pps over 200 ms.
    let before = rig.get("PY");
    rig.ok("STOPY");
    assert!(rig.moves("Y"));
    rig.pass_ms(205);
    assert!(!rig.moves("Y") && rig.moves("Z") && rig.moves("U"));
    let way = rig.get("PY") - before;
    assert!((1090..=1110).contains(&way), "{way}");
    // All axes.
    rig.ok("STOP");
    assert!(rig.moves("Z") && rig.moves("U"));
    near(rig.until_rest(), 200);
    rig.ok("JX+ JU-");
    rig.pass_ms(300);
    rig.ok("ABORT");
    assert!(AXES.iter().all(|axis| !rig.moves(axis)));
    // Nothing to stop is fine.
    rig.ok("STOP STOPX ABORT ABORTU");
    // An axis stops what it is interpolated with.
    for (command, stop) in [("X90000Y-90000Z9", "STOPZ"), ("CIRUXP90000:0", "ABORTX")] {
        rig.ok(command);
        rig.pass_ms(300);
        assert!(rig.moves("X"));
        rig.ok(stop);
        rig.pass_ms(210);
        assert!(AXES.iter().all(|axis| !rig.moves(axis)), "{stop}");
    }
}

#[test]
fn accelerations_and_decelerations() {
    let mut rig = Rig::new();
    for (command, default) in [("ACC", 300), ("DEC", 300), ("ACCX", 0), ("DECY", 0)] {
        assert_eq!(rig.get(command), default, "{command}");
    }
    rig.ok("HSPD=10000 LSPD=1000 ACC=200 DEC=600 X20000");
    near(rise(&mut rig), 200);
    near(fall(&mut rig), 600);
    // Those of the axis come first.
    rig.ok("ACCX=400 DECX=100 X0");
    near(rise(&mut rig), 400);
    near(fall(&mut rig), 100);
    rig.ok("ACCX=0 DECX=0 X20000");
    near(rise(&mut rig), 200);
    near(fall(&mut rig), 600);
    // Below the table's range it is brought into it and reads as written.
    rig.ok("ACC=0 JX+");
    rig.check("ACC", "0");
    near(rise(&mut rig), 2);
    rig.ok("ABORT");
    // Beyond it too (B.1): at 2,000 pps the gentlest ramp is 1,900 / 50 s.
    rig.ok("HSPD=2000 LSPD=100 ACC=2147483647 JX-");
    rig.pass_ms(19_000);
    let speed = rig.get("PSX");
    assert!((1040..=1060).contains(&speed), "{speed}");
    rig.check("ACC", "2147483647");
    rig.ok("ABORT");
}

#[test]
fn global_and_individual_speeds() {
    let mut rig = Rig::new();
    for (command, default) in [("HSPD", 1000), ("LSPD", 100), ("HSPDX", 0), ("LSPDU", 0)] {
        assert_eq!(rig.get(command), default, "{command}");
    }
    rig.ok("HSPD=10000 HSPDZ=2000 LSPD=300 ACC=300 JX+ JZ+");
    rig.pass_ms(600);
    assert_eq!((rig.get("PSX"), rig.get("PSZ")), (10_000, 2000));
    rig.ok("ABORT HSPDZ=0 JZ+");
    rig.pass_ms(600);
    rig.check("PSZ", "10000");
    // Interpolated moves have the global ones.
    rig.ok("ABORT HSPDX=50 HSPDY=60 INC X9000Y9000");
    rig.pass_ms(500);
    assert_eq!((rig.get("PSX"), rig.get("PSY")), (10_000, 10_000));
    // Motion begins at the low speed.
    rig.ok("ABORT HSPDY=0 LSPDY=5000 JY+");
    rig.pass_ms(1);
    assert!(rig.get("PSY") >= 5000);
    rig.ok("ABORT");
}

#[test]
fn speeds_are_read_while_moving() {
    let mut rig = Rig::new();
    for axis in AXES {
        rig.check(&format!("PS{axis}"), "0");
    }
    rig.ok("HSPD=7777 ACC=50 JX- JU+");
    rig.pass_ms(200);
    assert_eq!((rig.get("PSX"), rig.get("PSY"), rig.get("PSU")), (7777, 0, 7777));
    // The highest speed of the table.
    rig.ok("ABORT HSPD=6553500 LSPD=6553500 JX-");
    rig.pass_ms(20);
    rig.check("PSX", "6553500");
    rig.ok("ABORT");
}

#[test]
fn on_the_fly_speed() {
    let mut rig = Rig::new();
    rig.ok("HSPD=50000 LSPD=1000 ACC=100 SSPDMX=2 X1000000");
    rig.pass_ms(300);
    for speed in [100_000, 20_000, 70_000] {
        rig.ok(&format!("SSPDX={speed}"));
        rig.pass_ms(500);
        let found = rig.get("PSX");
        assert!((found - speed).abs() <= 2, "{found}");
    }
    rig.until_rest();
    rig.check("PX", "1000000");
    // Not while it slows down.
    rig.ok("HSPD=5000 DEC=500 SSPDMX=1 X0");
    rig.pass_ms(300);
    rig.ok("STOPX");
    rig.check("SSPDX=2000", "?Override Failed");
    rig.until_rest();
}

#[test]
fn the_status_word() {
    let mut rig = Rig::with(|axis| axis.positive_limit = 5000);
    // The axis stands on the home switch and on the index.
    for axis in AXES {
        rig.check(&format!("MST{axis}"), "8256");
    }
    rig.ok("HSPD=5000 LSPD=100 ACC=200 DEC=200 X2000");
    // Accelerates, runs at constant speed, decelerates.
    assert_eq!(phases(&mut rig), [1, 4, 2]);
    rig.check("MSTX", "0");
    // Inputs of the axis.
    for (pin, bit) in [("ALMX", 3), ("+LX", 4), ("-LX", 5), ("HX", 6), ("SDX", 7), ("INPX", 11), ("ZX", 13)] {
        rig.pin(pin, true);
        assert_eq!(rig.get("MSTX"), 1 << bit, "{pin}");
        rig.device.release_pin(pin).expect("an input");
        rig.check("MSTX", "0");
    }
    // Inputs that all axes share.
    for (pin, bit) in [("CSTA", 14), ("CEMG", 15)] {
        rig.pin(pin, true);
        for axis in AXES {
            assert_eq!(rig.get(&format!("MST{axis}")) & 0xC000, 1 << bit, "{pin}");
        }
        rig.pin(pin, false);
    }
    rig.run("X9000");
    rig.check("MSTX", "272");
    rig.check("MSTY", "8256");
}

/// The errors of an axis are its own, and `CLR` clears them all.
#[test]
fn errors_are_cleared_axis_by_axis() {
    const ERRORS: i32 = 0x3_0700;
    let mut rig = Rig::new();
    rig.ok("SDEX=1 SDCX=1");
    let mut check = |pin: &str, command: &str, error: i32| {
        rig.ok(&format!("{command} JY+"));
        rig.pass_ms(100);
        rig.pin(pin, true);
        rig.pass_ms(500);
        rig.pin(pin, false);
        assert_eq!(rig.get("MSTX") & ERRORS, error, "{pin}");
        rig.ok("ABORTY CLRY");
        assert_eq!(rig.get("MSTX") & ERRORS, error, "{pin}");
        rig.ok("CLRX");
        assert_eq!(rig.get("MSTX") & ERRORS, 0, "{pin}");
        rig.run("X0");
    };
    check("+LX", "JX+", 1 << 8);
    check("-LX", "JX-", 1 << 9);
    check("ALMX", "JX+", 1 << 10);
    check("CEMG", "JX+", 1 << 16);
    check("SDX", "JX-", 1 << 17);
}

/// `IERR`: the motor stops all the same.
#[test]
fn errors_can_be_ignored() {
    let mut rig = Rig::new();
    rig.ok("IERR=1");
    for pin in ["+LX", "ALMX", "CEMG"] {
        rig.ok("JX+");
        rig.pass_ms(100);
        rig.pin(pin, true);
        assert!(!rig.moves("X"), "{pin}");
        rig.pin(pin, false);
        assert_eq!(rig.get("MSTX") & 0x1_0700, 0, "{pin}");
        rig.run("X0");
    }
    rig.pin("CEMG", true);
    rig.check("X100", "?Error ESTOP");
    rig.pin("CEMG", false);
    rig.run("X100");
    rig.check("PX", "100");
}

#[test]
fn limits_latch_errors() {
    let mut rig = Rig::with(|axis| {
        axis.positive_limit = 3000;
        axis.negative_limit = -2000;
    });
    rig.ok("HSPD=5000 LSPD=100 ACC=100");
    rig.run("X10000");
    // At once, at the switch.
    rig.check("PX", "3000");
    rig.check("MSTX", "272");
    rig.check("X0", "?Error Moving");
    rig.ok("CLRX");
    rig.check("MSTX", "16");
    rig.check("JX+", "?Error +Limit");
    rig.check("PX", "3000");
    rig.run("X-9000");
    rig.check("PX", "-2000");
    rig.check("MSTX", "544");
    rig.ok("CLRX");
    rig.run("X1000");
    rig.check("MSTX", "0");
    // A line stops with its axis; the error is that axis' only (manual, C.6).
    rig.run("X2000Y9000Z3000");
    rig.check("PY", "3000");
    assert!((1330..=1340).contains(&rig.get("PX")));
    rig.check("MSTX", "0");
    rig.check("MSTY", "272");
    rig.ok("CLRY");
    // So does an arc.
    rig.run("X0Y0Z0");
    rig.run("CIRXYP1000:2500");
    rig.check("PY", "3000");
    rig.check("MSTY", "272");
    assert_eq!(rig.get("MSTX") & 0x300, 0);
}

#[test]
fn emergency_stop() {
    let mut rig = Rig::new();
    for stop in ["ESTOP", "CEMG"] {
        rig.ok("HSPD=5000 JX+ Y9000Z-9000");
        rig.pass_ms(300);
        if stop == "ESTOP" {
            rig.ok("ESTOP");
        } else {
            rig.pin("CEMG", true);
            rig.pin("CEMG", false);
        }
        assert!(AXES.iter().all(|axis| !rig.moves(axis)), "{stop}");
        // An error of those that moved.
        let errors = AXES.map(|axis| rig.get(&format!("MST{axis}")) >> 16 & 1);
        assert_eq!(errors, [1, 1, 1, 0], "{stop}");
        rig.check("X0", "?Error Moving");
        rig.check("X0Y0", "?Error Moving");
        rig.run("U10");
        rig.ok("CLRX CLRY CLRZ");
        rig.run("X0Y0Z0U0");
        rig.check("PP", "0:0:0:0");
    }
}

/// Speeds are those of 16-bit registers times a magnification; they read back as they were written.
#[test]
fn speeds_of_the_registers() {
    let mut rig = Rig::with(|axis| axis.positive_limit = i64::MAX / 4);
    let mut check = |asked: i32, speed: i32| {
        rig.ok(&format!("LSPDX=200 ACCX=1 DECX=1 HSPDX={asked} JX+"));
        rig.pass_ms(400);
        assert_eq!((rig.get("PSX"), rig.get("HSPDX")), (speed, asked));
        rig.ok("ABORTX");
    };
    check(65_535, 65_535);
    check(65_537, 65_536);
    check(131_070, 131_070);
    check(131_074, 131_070);
    check(655_357, 655_340);
    check(3_276_751, 3_276_700);
    check(6_553_500, 6_553_500);
}
