//! The nine command sequences of section 4.3 and what they do.

use crate::rig::Rig;

/// Numbers with `:` between.
fn numbers(rig: &mut Rig, command: &str) -> Vec<i32> {
    let reply = rig.say(command);
    reply.split(':').map(|number| number.parse().expect("a number")).collect()
}

#[test]
fn sequence_1_jogs() {
    let mut rig = Rig::new();
    rig.ok("EO=0 LSPDX=500 HSPDX=5000 ACCX=200 DECX=200 EO1=1 JX-");
    rig.pass_ms(1000);
    assert_eq!((rig.get("PSX"), rig.get("MSTX") & 7), (5000, 4));
    rig.ok("STOPX");
    let before = rig.get("PX");
    assert!(rig.until_rest().abs_diff(200) <= 1);
    // From 5000 to 500 pulses a second in 200 ms.
    assert!((before - rig.get("PX") - 550).abs() < 10, "{before} {}", rig.get("PX"));
    assert_eq!(rig.shaft("X"), i64::from(rig.get("PX")));
}

#[test]
fn sequence_2_moves_axes_by_themselves() {
    let mut rig = Rig::new();
    rig.ok("EO=0 LSPD=500 HSPD=5000 ACC=200 DEC=200 EO=3 ABS X-20000 Y15000");
    rig.pass_ms(1000);
    // Both at the high speed, in their directions.
    assert_eq!((rig.get("PSX"), rig.get("PSY")), (5000, 5000));
    let took = 1000 + rig.until_rest();
    rig.check("PP", "-20000:15000:0:0");
    // 550 pulses in each ramp of 200 ms.
    assert!(took.abs_diff(400 + (20_000 - 1100) / 5) <= 2, "{took}");
    assert_eq!((rig.shaft("X"), rig.shaft("Y")), (-20_000, 15_000));
}

/// The counters are cleared when the status word says that the axis stands without an error.
#[test]
fn sequence_3_clears_counters() {
    let mut rig = Rig::new();
    rig.ok("X1234");
    rig.pass_ms(500);
    assert!(rig.get("PX") > 0 && rig.get("EX") > 0);
    assert_ne!(rig.say("MSTX"), "0");
    rig.until_rest();
    rig.check("PX", "1234");
    rig.check("EX", "1234");
    rig.check("MSTX", "0");
    rig.ok("PX=0 EX=0");
    rig.check("PX", "0");
    rig.check("EX", "0");
}

#[test]
fn sequence_4_homes() {
    let mut rig = Rig::with(|axis| axis.home = [-5000, -4000]);
    rig.ok("LSPDY=500 HSPDY=5000 ACCY=200 DECY=200 EO2=1 HY-1");
    rig.until_rest();
    // Zero is where the switch comes on, and the motor stands there (manual, A.2).
    rig.check("PY", "0");
    assert_eq!((rig.shaft("Y"), rig.get("MSTY") & 7), (-4000, 0));
}

#[test]
fn sequence_5_moves_along_a_line() {
    let mut rig = Rig::new();
    rig.ok("LSPD=500 HSPD=5000 ACC=200 DEC=200 EO=3 ABS EINT=1 X-20000Y15000");
    while rig.moves("X") {
        let at = numbers(&mut rig, "PP");
        // Half a pulse beside the line is at most: 4 y + 3 x = 0.
        assert!((4 * at[1] + 3 * at[0]).abs() <= 4, "{at:?}");
        rig.pass_ms(10);
    }
    rig.check("PP", "-20000:15000:0:0");
}

#[test]
fn sequence_6_moves_around_a_circle() {
    let mut rig = Rig::new();
    rig.ok("LSPD=500 HSPD=5000 ACC=200 DEC=200 EO=3 ABS EINT=1 CIRXYP1000:0");
    let mut passed = Vec::new();
    while rig.moves("X") {
        let at = numbers(&mut rig, "PP");
        let radius = f64::hypot(f64::from(at[0] - 1000), f64::from(at[1]));
        assert!((radius - 1000.0).abs() <= 0.71, "{at:?}");
        let quadrant = (at[0] > 1000, at[1] > 0);
        if passed.last() != Some(&quadrant) && at[0] != 1000 && at[1] != 0 {
            passed.push(quadrant);
        }
        rig.pass_ms(5);
    }
    // Clockwise from the left: up, right, down.
    assert_eq!(passed, [(false, true), (true, true), (true, false), (false, false)]);
    rig.check("PP", "0:0:0:0");
    assert_eq!((rig.shaft("X"), rig.shaft("Y")), (0, 0));
}

#[test]
fn sequence_7_changes_the_speed() {
    let mut rig = Rig::new();
    rig.ok("LSPDX=1000 HSPDX=50000 JX-");
    rig.pass_ms(1000);
    rig.check("PSX", "50000");
    rig.ok("SSPDM=2 SSPD=70000");
    rig.pass_ms(1000);
    assert!(rig.get("PSX").abs_diff(70_000) <= 2, "{}", rig.get("PSX"));
    assert!(rig.shaft("X") < -100_000);
}

#[test]
fn sequence_8_synchronises_an_output() {
    let mut rig = Rig::new();
    rig.ok("LSPDX=100 HSPDX=1000 SYNCX=1 SYNPX=5000 SYNO");
    rig.check("SYNSX", "1");
    rig.ok("X5000");
    while rig.moves("X") {
        assert_eq!(rig.level("DO1"), rig.get("PX") == 5000);
        rig.pass_ms(10);
    }
    assert!(rig.level("DO1"));
    rig.check("SYNSX", "2");
    rig.check("DO", "1");
}

#[test]
fn sequence_9_follows_an_input() {
    let mut rig = Rig::new();
    rig.ok("IOCFG=262144");
    for on in [true, false, true] {
        rig.pin("IO5", on);
        let command = if rig.say("IO5") == "1" { "IO19=1" } else { "IO19=0" };
        rig.ok(command);
        assert_eq!(rig.level("IO19"), on);
    }
}
