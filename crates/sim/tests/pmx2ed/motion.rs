//! Moves, jogs, stops, lines, limits.

use crate::ascii::ramps::phases;
use crate::rig::Rig;

#[test]
fn absolute_and_incremental_moves() {
    let mut rig = Rig::new();
    rig.check("MM", "0");
    rig.run("X1000");
    rig.check("PX", "1000");
    rig.run("X-500");
    rig.check("PX", "-500");
    rig.run("Y20");
    rig.check("PY", "20");
    rig.ok("INC");
    rig.check("MM", "1");
    rig.run("X100");
    rig.check("PX", "-400");
    rig.run("Y-120");
    rig.check("PY", "-100");
    rig.ok("ABS");
    rig.run("X0");
    rig.check("PX", "0");
    assert_eq!(rig.shaft("X"), 0);
    assert_eq!(rig.shaft("Y"), -100);
    // No way to go is no move.
    rig.ok("X0");
    assert!(!rig.moves("X"));
    for wrong in ["X", "X+", "Xabc", "X1.5", "X1X2", "XV1", "Z100", "X10Y"] {
        rig.check(wrong, &format!("?{wrong}"));
    }
    rig.check("X2147483648", "?Invalid Answer");
    assert!(!rig.moves("X"));
}

#[test]
fn moves_are_refused_while_moving() {
    let mut rig = Rig::new();
    rig.ok("X5000");
    rig.pass_ms(100);
    for refused in
        ["X100", "X100Y100", "I1:2", "JX+", "J-", "HX+", "LX-", "ZX+", "ZHX-", "HLX+", "PX=0", "SLX=1"]
    {
        rig.check(refused, "?Moving");
    }
    // The other axis is free.
    rig.ok("Y100");
    rig.until_rest();
    rig.check("PX", "5000");
    rig.check("PY", "100");
}

#[test]
fn jogging() {
    let mut rig = Rig::new();
    rig.ok("HSPD=2000 ACC=100 JX+");
    rig.pass_ms(1000);
    rig.check("PSX", "2000");
    assert!(rig.get("PX") > 1500);
    rig.check("JX-", "?Moving");
    rig.ok("STOPX");
    rig.until_rest();
    rig.ok("JY-");
    rig.pass_ms(1000);
    assert!(rig.get("PY") < -1500);
    rig.ok("STOP");
    rig.until_rest();
    // Both at the same clock.
    rig.ok("PX=0 PY=0 J+");
    rig.pass_ms(777);
    assert_eq!(rig.get("PX"), rig.get("PY"));
    assert!(rig.get("PX") > 1000);
    rig.check("J-", "?Moving");
    rig.ok("ABORT");
    rig.check("JX", "?JX");
    rig.check("J*", "?J*");
}

#[test]
fn stopping() {
    let mut rig = Rig::new();
    rig.ok("HSPD=10000 LSPD=1000 ACC=200 JX+ JY+");
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
    let ms = rig.until_rest();
    assert!((195..=205).contains(&ms), "{ms}");
    let way = rig.get("PY") - before;
    assert!((1090..=1110).contains(&way), "{way}");
    // All axes.
    rig.ok("JX+ JY-");
    rig.pass_ms(300);
    rig.ok("STOP");
    assert!(rig.moves("X") && rig.moves("Y"));
    rig.until_rest();
    rig.ok("JX+ JY-");
    rig.pass_ms(300);
    rig.ok("ABORT");
    assert!(!rig.moves("X") && !rig.moves("Y"));
    // Nothing to stop is fine.
    rig.ok("STOP STOPX ABORT ABORTY");
    rig.ok("X0");
    rig.until_rest();
    rig.check("PX", "0");
}

#[test]
fn interpolated_moves() {
    let mut rig = Rig::new();
    rig.ok("HSPD=5000 LSPD=500 ACC=100");
    rig.ok("I3000:-1000");
    // Both are on the line all the way.
    while rig.moves("X") {
        let (x, y) = (rig.get("PX"), rig.get("PY"));
        assert!((x + 3 * y).abs() * 2 <= 3, "{x} {y}");
        assert_eq!(rig.moves("X"), rig.moves("Y"));
        rig.pass_ms(7);
    }
    assert_eq!((rig.get("PX"), rig.get("PY")), (3000, -1000));
    assert_eq!((rig.shaft("X"), rig.shaft("Y")), (3000, -1000));
    rig.run("X0Y0");
    assert_eq!((rig.get("PX"), rig.get("PY")), (0, 0));
    rig.ok("INC");
    rig.run("I100:200");
    rig.run("Y-50X7");
    assert_eq!((rig.get("PX"), rig.get("PY")), (107, 150));
    rig.ok("ABS");
    // Only one of them has a way to go.
    rig.run("I107:1000");
    assert_eq!((rig.get("PX"), rig.get("PY")), (107, 1000));
    rig.run("I107:1000");
    // The longest axis has the high speed.
    rig.ok("I100107:51000");
    rig.pass_ms(500);
    rig.check("PS", "5000:2500");
    rig.check("PSX", "5000");
    rig.check("PSY", "2500");
    // Stopping one stops both, on the line.
    rig.ok("STOPY");
    rig.until_rest();
    let (x, y) = (rig.get("PX") - 107, rig.get("PY") - 1000);
    assert!(x > 2000 && (x - 2 * y).abs() <= 1, "{x} {y}");
    rig.ok("I0:0");
    rig.pass_ms(300);
    rig.ok("ABORTX");
    assert!(!rig.moves("X") && !rig.moves("Y"));
    for wrong in ["I100", "I100:", "I1:2:3", "I:5", "I"] {
        rig.check(wrong, &format!("?{wrong}"));
    }
}

#[test]
fn positions_are_set_and_read() {
    let mut rig = Rig::new();
    rig.run("X1234");
    rig.ok("PX=-77");
    rig.check("PX", "-77");
    rig.check("EX", "1234");
    rig.run("X0");
    assert_eq!(rig.shaft("X"), 1311);
    rig.ok("PY=2147483647");
    rig.check("PY", "2147483647");
    rig.ok("INC");
    rig.run("Y1");
    rig.check("PY", "-2147483648");
    rig.check("PX=", "?Invalid Answer");
    rig.check("PX=2147483648", "?Invalid Answer");
    rig.check("PZ", "?PZ");
}

#[test]
fn the_status_word() {
    let mut rig = Rig::with(|axis| axis.positive_limit = 5000);
    // The axis stands on the home switch and on the index.
    rig.check("MSTX", "576");
    rig.check("MST", "576:576:0:0");
    rig.ok("INC");
    rig.check("MST", "576:576:0:1");
    rig.ok("ABS HSPD=5000 LSPD=100 ACC=200 X2000");
    // Accelerates, runs at constant speed, decelerates.
    assert_eq!(phases(&mut rig), [1, 4, 2]);
    rig.check("MSTX", "0");
    rig.run("X9000");
    rig.check("MSTX", "144");
    rig.check("MSTY", "576");
    rig.check("MST3", "?MST3");
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
    rig.check("MSTX", "144");
    for refused in ["X0", "X0Y0", "I0:0", "JX-", "J-", "HX-", "LX-"] {
        rig.check(refused, "?State Error");
    }
    rig.ok("CLRX");
    rig.check("MSTX", "16");
    // Into the limit again: not a pulse, and the error again.
    rig.ok("JX+");
    rig.check("PX", "3000");
    rig.check("MSTX", "144");
    rig.ok("CLRX");
    rig.run("X-9000");
    rig.check("PX", "-2000");
    rig.check("MSTX", "288");
    rig.ok("CLRX");
    rig.run("X1000");
    rig.check("MSTX", "0");
    // A line stops with its axis; the error is that axis' only.
    rig.run("I2000:9000");
    rig.check("PY", "3000");
    assert!((1330..=1340).contains(&rig.get("PX")));
    rig.check("MSTX", "0");
    rig.check("MSTY", "144");
    rig.ok("CLRY");
    // Ignored errors: the motor stops all the same.
    rig.ok("IERR=1");
    rig.run("X9000");
    rig.check("PX", "3000");
    rig.check("MSTX", "16");
    rig.run("X0");
    rig.check("PX", "0");
    rig.check("CLR", "?CLR");
    rig.check("IERR=2", "?Invalid Answer");
}

/// A switch that is pressed by hand stops the axis within the clock.
#[test]
fn a_limit_by_hand() {
    let mut rig = Rig::new();
    rig.ok("HSPD=5000 JX+");
    rig.pass_ms(1000);
    rig.pin("-LX", true);
    assert!(rig.moves("X"));
    rig.pin("-LX", false);
    rig.pin("+LX", true);
    assert!(!rig.moves("X"));
    assert_eq!(rig.get("MSTX") & 0x1B0, 0x90);
}
