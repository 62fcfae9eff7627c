//! The homing modes of appendix A and `ZMOVE` on the machine. Their timing is held by snapshots in `motion`.

use crate::controller::AXES;
use crate::rig::Rig;
use sim::AxisConfig;

/// The modes that seek the home switch. The others seek the limit.
const BY_HOME: [usize; 9] = [0, 1, 2, 3, 4, 5, 9, 10, 11];

/// How far the motor goes while it brakes from 4,000 to 400 pulses a second over 50 ms: 110 pulses, and it
/// stands on the next one.
pub const BRAKING: i64 = 111;

/// Bits of the status word.
pub const LIMIT_ERRORS: i32 = 0x300;

/// Home from 1010 to 1190, limits at ±3000, an index mark every 400 pulses.
pub fn stage(axis: &mut AxisConfig) {
    axis.home = [1010, 1190];
    axis.positive_limit = 3000;
    axis.negative_limit = -3000;
    axis.index_every = 400;
}

pub fn rig() -> Rig {
    rig_with(|_| ())
}

/// The same with changes.
pub fn rig_with(change: impl Fn(&mut AxisConfig)) -> Rig {
    let mut rig = Rig::with(|axis| {
        stage(axis);
        change(axis);
    });
    rig.ok("HSPD=4000 LSPD=400 ACC=50 DEC=50");
    rig
}

/// A routine of an axis to its end: the pulses from the start to its zero, and the position where it stands.
#[track_caller]
pub fn home(rig: &mut Rig, axis: &str, command: &str) -> (i64, i64) {
    rig.run(command);
    let position = i64::from(rig.get(&format!("P{axis}")));
    assert_eq!(i64::from(rig.get(&format!("E{axis}"))), position, "{command}: the encoder's counter follows");
    (rig.shaft(axis) - position, position)
}

/// It ends at a limit, with its error latched; `CLR` lets the axis move away.
#[track_caller]
fn ends_at_limit(rig: &mut Rig, axis: &str, command: &str, limit: i64) {
    rig.run(command);
    assert_eq!(rig.shaft(axis), limit, "{command}");
    let error = if limit > 1000 { 0x100 } else { 0x200 };
    assert_eq!(rig.get(&format!("MST{axis}")) & LIMIT_ERRORS, error, "{command}");
    let away = if limit > 1000 { "-" } else { "+" };
    rig.check(&format!("J{axis}{away}"), "?Error Moving");
    rig.ok(&format!("CLR{axis}"));
    assert_eq!(rig.get(&format!("MST{axis}")) & LIMIT_ERRORS, 0, "{command}");
}

/// Operation 1 of every drawing, in both directions, each mode on another axis.
#[test]
fn homing_modes() {
    let expected = [
        // Started at 0 upwards, home comes on at 1010 and the motor turns at 1121; downwards from 2000 it comes
        // on at 1190, and the motor turns at 1079.
        (0, (1010, BRAKING), (1190, -BRAKING)),
        (1, (1010, 0), (1190, 0)),
        (2, (1200, 0), (800, 0)),
        (3, (1200, BRAKING), (800, -BRAKING)),
        (4, (800, 0), (1200, 0)),
        (5, (800, -BRAKING), (1200, BRAKING)),
        // The limit goes off one pulse before it.
        (6, (2999, 0), (-2999, 0)),
        (7, (2800, 0), (-2800, 0)),
        (8, (2800, -BRAKING), (-2800, BRAKING)),
        (9, (1010, 0), (1190, 0)),
        (10, (1200, 0), (800, 0)),
        (11, (800, 0), (1200, 0)),
        (12, (2800, 0), (-2800, 0)),
    ];
    for (mode, up, down) in expected {
        let mut rig = rig();
        let axis = AXES[mode % 4];
        assert_eq!(home(&mut rig, axis, &format!("H{axis}+{mode}")), up, "mode {mode} upwards");
        assert_eq!(rig.get(&format!("MST{axis}")) & LIMIT_ERRORS, 0, "mode {mode}: no error");
        let target = 2000 - up.0;
        rig.run(&format!("{axis}{target}"));
        assert_eq!(rig.shaft(axis), 2000);
        assert_eq!(home(&mut rig, axis, &format!("H{axis}-{mode}")), down, "mode {mode} downwards");
        assert_eq!(rig.get(&format!("MST{axis}")) & LIMIT_ERRORS, 0, "mode {mode}: no error");
    }
}

/// Operations 2 and 3 of the drawings of modes 0 to 5 and 9 to 11: started on the home switch or beyond it, the
/// motor runs into the limit.
#[test]
fn operations_2_and_3() {
    for mode in BY_HOME {
        let axis = AXES[mode % 4];
        let mut rig = rig();
        for start in [1010, 1100, 1190, 2000] {
            rig.run(&format!("{axis}{start}"));
            ends_at_limit(&mut rig, axis, &format!("H{axis}+{mode}"), 3000);
            // Nothing was found: positions are what they were.
            assert_eq!(rig.get(&format!("P{axis}")), 3000, "mode {mode}");
        }
        for start in [1190, 1100, 1010, 0] {
            rig.run(&format!("{axis}{start}"));
            ends_at_limit(&mut rig, axis, &format!("H{axis}-{mode}"), -3000);
        }
        // With the switch missing it is the same.
        rig.run(&format!("{axis}0"));
        rig.pin(&format!("H{axis}"), false);
        ends_at_limit(&mut rig, axis, &format!("H{axis}+{mode}"), 3000);
    }
}

#[test]
fn started_on_a_limit() {
    for mode in BY_HOME {
        let mut rig = rig_with(|axis| axis.positive_limit = 2000);
        rig.ok("IERR=1");
        rig.run("X9000");
        // Into the limit no motion sets out; away from it homing does, and finds the other edge.
        rig.check(&format!("HX+{mode}"), "?Error +Limit");
        rig.run(&format!("HX-{mode}"));
        let zero = rig.shaft("X") - i64::from(rig.get("PX"));
        let expected = match mode {
            0 | 1 | 9 => 1190,
            2 | 3 | 10 => 800,
            _ => 1200,
        };
        assert_eq!(zero, expected, "mode {mode}");
    }
    for (mode, zero) in [(6, 1999), (7, 1600), (8, 1600), (12, 1600)] {
        let mut rig = rig_with(|axis| axis.positive_limit = 2000);
        rig.ok("IERR=1");
        rig.run("X9000");
        // The limit that it seeks is found already.
        rig.ok("IERR=0");
        let (got, _) = home(&mut rig, "X", &format!("HX+{mode}"));
        assert_eq!(got, zero, "mode {mode}");
        assert_eq!(rig.get("MSTX") & LIMIT_ERRORS, 0, "mode {mode}");
    }
}

/// A limit that the mode does not seek, met while it brakes or goes back.
#[test]
fn limits_on_the_way() {
    // Home comes on 40 pulses before the limit: modes 0 and 9 have their zero already.
    for mode in BY_HOME {
        let mut rig = rig_with(|axis| (axis.home, axis.index_every) = ([2960, 2970], 100_000));
        ends_at_limit(&mut rig, "X", &format!("HX+{mode}"), 3000);
        let zeroed = matches!(mode, 0 | 9);
        assert_eq!(rig.get("PX"), if zeroed { 40 } else { 3000 }, "mode {mode}");
    }
    // Behind, where the index is sought and there is none.
    for mode in [4, 5, 7, 8, 11, 12] {
        let mut rig = rig_with(|axis| (axis.negative_limit, axis.index_every) = (500, 100_000));
        rig.run("X600");
        ends_at_limit(&mut rig, "X", &format!("HX+{mode}"), 500);
    }
    // Behind, after the index, while the motor brakes there.
    for (mode, index) in [(5, 800), (8, 2800), (11, 800), (12, 2800)] {
        let mut rig = rig_with(|axis| axis.negative_limit = index - 50);
        rig.run(&format!("X{}", index - 10));
        rig.pin("HX", false);
        rig.ok(&format!("HX+{mode}"));
        rig.pass_ms(5);
        rig.device.release_pin("HX").unwrap();
        rig.until_rest();
        assert_eq!((rig.shaft("X"), rig.get("PX")), (index - 50, -50), "mode {mode}");
        assert_eq!(rig.get("MSTX") & LIMIT_ERRORS, 0x200, "mode {mode}");
    }
    // With IERR the axis stops as well, and may go on.
    let mut rig = rig();
    rig.ok("IERR=1");
    rig.run("X2000");
    rig.run("HX+0");
    assert_eq!((rig.shaft("X"), rig.get("MSTX") & LIMIT_ERRORS), (3000, 0));
    assert_eq!(home(&mut rig, "X", "HX-1"), (1190, 0));
}

/// An error of an axis has to be cleared before it homes.
#[test]
fn conditions() {
    let mut rig = rig();
    rig.run("X5000");
    rig.check("HX-1", "?Error Moving");
    rig.ok("CLRX HX-1");
    rig.check("HX-1", "?Error Moving");
    rig.ok("HY-6");
    rig.until_rest();
    for command in ["HX", "HX+", "HX1", "H+1", "HV+1"] {
        rig.check(command, &format!("?Unknown Command: {command}"));
    }
    for command in ["HX+13", "HX-99"] {
        rig.check(command, "?Invalid Index");
    }
    rig.pin("CEMG", true);
    rig.check("HX+1", "?Error ESTOP");

    // Not while something else moves the axis.
    let mut rig = self::rig();
    for (on, off) in [("JENA=1", "JENA=0"), ("MPEX=1", "MPEX=0")] {
        rig.ok(on);
        rig.check("HX+1", "?Error Moving");
        rig.ok(off);
    }
    rig.pin("ALMX", true);
    rig.check("HX+1", "?Error Alarm");
    rig.pin("ALMX", false);
    assert_eq!(home(&mut rig, "X", "HX+1"), (1010, 0));
}

/// Homing waits for the external start as any motion does, and for the driver at its end.
#[test]
fn homing_waits() {
    let mut rig = rig();
    rig.ok("EXST=1 HX+1 HY-6");
    rig.pass_ms(50);
    assert_eq!((rig.shaft("X"), rig.get("MSTX") >> 19 & 1), (0, 1));
    for on in [true, false, true] {
        rig.pin("CSTA", on);
    }
    rig.until_rest();
    assert_eq!(["X", "Y"].map(|axis| rig.shaft(axis)), [1010, -2999]);

    let mut rig = self::rig();
    rig.ok("INPX=1 ERCX=2");
    assert_eq!(home(&mut rig, "X", "HX+9"), (1010, 0));
    assert_eq!(rig.get("MSTX") >> 18 & 1, 1);
    rig.check("X0", "?Error Moving");
    rig.pin("INPX", true);
    assert_eq!(rig.get("MSTX") >> 18 & 1, 0);
    rig.run("X500");
}

#[test]
fn index_marks_are_counted() {
    let mut rig = rig_with(|axis| axis.index_every = 40);
    rig.check("ZCNTX", "0");
    rig.check("ZCNTX=16", "?Invalid Index");
    rig.check("ZCNTX=-1", "?Invalid Index");
    // Mode 2 counts from where the motor is down to low speed, at 1121; 4, 5 and 11 from the turn there.
    let check = |rig: &mut Rig, marks: i64, zeros: [(usize, i64); 9]| {
        for (mode, zero) in zeros {
            rig.ok(&format!("ZCNTX={}", marks - 1));
            let target = -rig.shaft("X") + i64::from(rig.get("PX"));
            rig.run(&format!("X{target}"));
            let got = home(rig, "X", &format!("HX+{mode}"));
            assert_eq!(got.0, zero, "mode {mode}, {marks} marks");
        }
    };
    check(
        &mut rig,
        1,
        [
            (2, 1160),
            (3, 1040),
            (4, 1120),
            (5, 1120),
            (7, 2960),
            (8, 2960),
            (10, 1040),
            (11, 1120),
            (12, 2960),
        ],
    );
    check(
        &mut rig,
        3,
        [
            (2, 1240),
            (3, 1120),
            (4, 1040),
            (5, 1040),
            (7, 2880),
            (8, 2880),
            (10, 1120),
            (11, 1040),
            (12, 2880),
        ],
    );
    check(
        &mut rig,
        16,
        [(2, 1760), (3, 1640), (4, 520), (5, 520), (7, 2360), (8, 2360), (10, 1640), (11, 520), (12, 2360)],
    );
    // The others do not look at it.
    rig.ok("ZCNTX=15");
    let target = -rig.shaft("X") + i64::from(rig.get("PX"));
    rig.run(&format!("X{target}"));
    assert_eq!(home(&mut rig, "X", "HX+1"), (1010, 0));
}

#[test]
fn index_moves() {
    for (count, up, down) in [(0, 400, -400), (1, 800, -800), (3, 1600, -1600)] {
        let mut rig = rig();
        rig.ok(&format!("ZCNTU={count}"));
        // It stands on a mark, which is none to come.
        rig.run("ZMOVEU+");
        assert_eq!((rig.shaft("U"), rig.get("PU")), (up + BRAKING, (up + BRAKING) as i32), "no zero is set");
        rig.run("U0");
        rig.run("ZMOVEU-");
        assert_eq!(rig.shaft("U"), down - BRAKING);
    }
    // Without a mark it runs into the limit.
    let mut rig = rig_with(|axis| axis.index_every = 100_000);
    ends_at_limit(&mut rig, "Z", "ZMOVEZ-", -3000);
    rig.run("Z2000");
    rig.ok("ZMOVEZ+");
    rig.pass_ms(100);
    rig.ok("STOPZ");
    rig.until_rest();
    assert!((2000..3000).contains(&rig.shaft("Z")));
}

/// A routine is over with any stop, and nothing is zeroed later.
#[test]
fn stops_end_a_routine() {
    for (stop, clear) in [("STOPX", ""), ("ABORTX", ""), ("STOP", ""), ("ABORT", ""), ("ESTOP", "CLRX")] {
        for mode in 0..13 {
            let mut rig = rig();
            rig.ok(&format!("HX+{mode}"));
            rig.pass_ms(200);
            rig.check("SSPDX=500", "?Override Failed");
            rig.check("TX500", "?Override Failed");
            rig.check("X0", "?Error Moving");
            rig.ok(stop);
            rig.until_rest();
            assert!((1..1010).contains(&rig.shaft("X")), "{stop}, mode {mode}");
            rig.ok(clear);
            rig.run("X2000");
            assert_eq!(rig.shaft("X"), 2000, "{stop}, mode {mode}: positions are what they were");
        }
    }
}

/// `SLS` tells homing by the home switch, by the index and by a limit apart (table 27).
#[test]
fn closed_loop() {
    for mode in 0..14 {
        let mut rig = rig();
        rig.ok("SLRX=1 SLTX=2 SLEX=100 SLAX=3 SLX=1");
        rig.check("SLSX", "0");
        let command = if mode == 13 { "ZMOVEX+".to_owned() } else { format!("HX+{mode}") };
        rig.ok(&command);
        let mut seen = Vec::new();
        while rig.moves("X") {
            let status = rig.get("SLSX");
            if seen.last() != Some(&status) {
                seen.push(status);
            }
            rig.pass_ms(1);
        }
        let expected = match mode {
            0 | 1 | 9 => 6,
            6 | 7 | 8 | 12 => 13,
            _ => 7,
        };
        assert_eq!(seen, [expected], "{command}");
        rig.pass_ms(5);
        rig.check("SLSX", "0");
        assert!(rig.get("DX").abs() <= 2, "{command}");
        // Positions count from the zero point, in counts of the encoder.
        let zero = rig.shaft("X") - i64::from(rig.get("EX"));
        if mode < 13 {
            rig.run("X-300");
            rig.pass_ms(5);
            assert_eq!(rig.shaft("X") - zero, -300, "{command}");
        }
    }
}

#[test]
fn closed_loop_errors_while_homing() {
    // The shaft is held: the distance grows beyond SLE.
    let mut rig = rig();
    rig.ok("SLRX=1 SLTX=2 SLEX=50 SLAX=3 SLX=1");
    rig.ok("HX+1");
    rig.pass_ms(100);
    rig.device.set_load("X", 2.0).unwrap();
    rig.until_rest();
    rig.check("SLSX", "10");
    rig.check("HX+1", "?Error SNL");
    rig.device.set_load("X", 0.0).unwrap();
    rig.ok("CLRX");
    assert_eq!(home(&mut rig, "X", "HX+1").0, 1010);
    // At a limit that is not sought StepNLoop has the limit's error.
    rig.pass_ms(5);
    rig.run("X1500");
    rig.pass_ms(5);
    rig.run("HX+1");
    rig.check("SLSX", "11");
    rig.ok("CLRX");
    rig.check("SLSX", "0");
}

/// In counts of an encoder that counts twice as fast.
#[test]
fn encoder_counts() {
    let mut rig = rig_with(|axis| axis.encoder_ratio = 2.0);
    rig.ok("SLRX=0.5 SLTX=2 SLEX=1000 SLAX=3 SLX=1 HSPD=8000 LSPD=800");
    rig.run("HX+1");
    rig.pass_ms(5);
    assert_eq!((rig.get("EX"), rig.shaft("X")), (0, 1010));
    rig.run("X-600");
    rig.pass_ms(5);
    assert_eq!(rig.shaft("X"), 710);
}

/// With ramps as S-curves zero is the same.
#[test]
fn s_curves() {
    for mode in 0..13 {
        let mut rig = rig();
        rig.ok("SCVX=1");
        let (zero, position) = home(&mut rig, "X", &format!("HX+{mode}"));
        let expected = match mode {
            0 | 1 | 9 => 1010,
            2 | 3 | 10 => 1200,
            4 | 5 | 11 => 800,
            6 => 2999,
            _ => 2800,
        };
        assert_eq!(zero, expected, "mode {mode}");
        let brakes = match mode {
            0 | 3 => 105..=115,
            5 | 8 => -115..=-105,
            _ => 0..=0,
        };
        assert!(brakes.contains(&position), "mode {mode}: {position}");
    }
}

/// Several axes home at once, each on its own.
#[test]
fn all_axes_at_once() {
    let mut rig = rig();
    rig.ok("HX+1 HY-6 HZ+10 HU+0");
    rig.until_rest();
    let zeros = AXES.map(|axis| rig.shaft(axis) - i64::from(rig.get(&format!("P{axis}"))));
    assert_eq!(zeros, [1010, -2999, 1200, 1010]);
    rig.check("PP", &format!("0:0:0:{BRAKING}"));
}

/// Polarities of home, limits and index.
#[test]
fn polarities() {
    let mut rig = rig();
    rig.ok("POLX=28696");
    rig.pin("+LX", true);
    rig.pin("-LX", true);
    rig.pin("HX", true);
    rig.ok("HX+0");
    rig.pass_ms(100);
    rig.pin("HX", false);
    rig.until_rest();
    let position = rig.get("PX");
    // It comes on between two pulses.
    assert!((BRAKING..=BRAKING + 1).contains(&position.into()), "{position}");
    assert_eq!(rig.get("MSTX") & (LIMIT_ERRORS | 0x40), 0x40);
}
