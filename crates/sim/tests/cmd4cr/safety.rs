//! Slowdown inputs and servo drivers that are in position or not.

use crate::rig::Rig;

const SLOW: i32 = 1 << 7;
const STOPPED: i32 = 1 << 17;

fn rig() -> Rig {
    let mut rig = Rig::new();
    rig.ok("HSPD=5000 LSPD=500 ACC=100 DEC=100");
    rig
}

#[test]
fn slowdown_inputs() {
    let mut rig = rig();
    // Off it is only seen.
    rig.ok("JX+");
    rig.pass_ms(300);
    rig.pin("SDX", true);
    rig.pass_ms(300);
    assert_eq!((rig.get("PSX"), rig.get("MSTX") & SLOW), (5000, SLOW));
    rig.pin("SDX", false);
    // On: low speed while it is on, in either direction, of axes by themselves.
    rig.ok("SDEX=1");
    for command in ["", "ABORTX JX-", "ABORTX X900000"] {
        rig.ok(command);
        rig.pass_ms(300);
        rig.check("PSX", "5000");
        rig.pin("SDX", true);
        rig.pass_ms(200);
        rig.check("PSX", "500");
        rig.pin("SDX", false);
        rig.pass_ms(200);
        rig.check("PSX", "5000");
    }
    assert_eq!(rig.get("MSTX") & STOPPED, 0);
    // Latched: low speed until the end of the motion.
    rig.ok("SDEX=3");
    rig.pin("SDX", true);
    rig.pin("SDX", false);
    rig.pass_ms(1000);
    rig.check("PSX", "500");
    rig.ok("ABORTX JX+");
    rig.pass_ms(300);
    rig.check("PSX", "5000");
    rig.ok("ABORTX SDEX=2 JX+");
    // The latch alone is nothing.
    rig.pin("SDX", true);
    rig.pass_ms(300);
    rig.check("PSX", "5000");
    rig.ok("ABORT");
}

#[test]
fn slowdown_inputs_that_stop() {
    let mut rig = rig();
    rig.ok("SDEY=1 SDCY=1 JY+");
    rig.pass_ms(300);
    let before = rig.get("PY");
    rig.pin("SDY", true);
    let ms = rig.until_rest();
    // With the ramp: (5000 + 500) / 2 pps over 100 ms.
    assert!((95..=105).contains(&ms), "{ms}");
    assert!((rig.get("PY") - before - 275).abs() <= 10);
    assert_eq!(rig.get("MSTY") & STOPPED, STOPPED);
    rig.pin("SDY", false);
    // The flag is in nobody's way, and stays until it is cleared.
    rig.run("Y0");
    rig.check("PY", "0");
    assert_eq!(rig.get("MSTY") & STOPPED, STOPPED);
    rig.ok("CLRY");
    assert_eq!(rig.get("MSTY") & STOPPED, 0);
}

/// One axis' slowdown input acts on all that are interpolated with it (manual, C.6).
#[test]
fn slowdown_inputs_of_interpolated_moves() {
    let mut rig = rig();
    rig.ok("SDEZ=1");
    for command in ["X90000Z45000", "CIRXZP90000:0"] {
        rig.ok(command);
        rig.pass_ms(300);
        rig.pin("SDZ", true);
        rig.pass_ms(300);
        let speed = f64::hypot(f64::from(rig.get("PSX")), f64::from(rig.get("PSZ")));
        assert!((495.0..565.0).contains(&speed), "{command}: {speed}");
        rig.pin("SDZ", false);
        rig.pass_ms(300);
        assert!(rig.get("PSX").max(rig.get("PSZ")) >= 4900, "{command}");
        rig.ok("ABORTX");
        assert!(!rig.moves("Z"));
    }
    rig.ok("SDCZ=1 X0Z0");
    rig.pass_ms(300);
    rig.pin("SDZ", true);
    rig.until_rest();
    assert!(rig.get("PX") != 0);
    assert_eq!((rig.get("MSTX") & STOPPED, rig.get("MSTZ") & STOPPED), (0, STOPPED));
}

/// `INP`: a motion is over when the driver says so.
#[test]
fn in_position_inputs() {
    const IN_POSITION: i32 = 1 << 11;
    const WAITS: i32 = 1 << 18;
    let mut rig = Rig::with(|axis| axis.in_position_ms = Some(50));
    rig.ok("HSPD=5000 LSPD=500 ACC=100 DEC=100");
    assert_eq!(rig.get("MSTX") & IN_POSITION, IN_POSITION);
    // It is not waited for.
    rig.run("X1000");
    assert_eq!(rig.get("MSTX") & (IN_POSITION | WAITS), 0);
    rig.ok("INPX=1 X2000");
    while rig.moves("X") {
        assert_eq!(rig.get("MSTX") & (IN_POSITION | WAITS), 0);
        rig.pass_ms(1);
    }
    assert_eq!(rig.get("MSTX") & (IN_POSITION | WAITS), WAITS);
    rig.check("X0", "?Error Moving");
    rig.pass_ms(45);
    rig.check("X0", "?Error Moving");
    rig.pass_ms(10);
    assert_eq!(rig.get("MSTX") & (IN_POSITION | WAITS), IN_POSITION);
    // Interpolated moves and programs wait too.
    rig.run("X0Y0");
    assert_eq!((rig.get("MSTX") & WAITS, rig.get("MSTY") & WAITS), (WAITS, 0));
    rig.pass_ms(60);
    rig.start(0, "X100\nWAITX\nV1=MSTX\nEND");
    rig.pass_ms(500);
    assert_eq!(rig.get("V1") & (IN_POSITION | WAITS), IN_POSITION);
    // A stop is an end as any other.
    rig.ok("JX+");
    rig.pass_ms(100);
    rig.ok("ABORTX");
    rig.check("JX+", "?Error Moving");
    rig.pass_ms(60);
    rig.ok("JX+ ABORTX");
}
