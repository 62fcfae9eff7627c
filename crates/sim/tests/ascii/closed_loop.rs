//! StepNLoop on the machine.

use super::rig::Rig;
use crate::controller::{CLEAR_LOOP, HOMING, LOOP_ERROR, MOTIONS, MOVING, STATE, VALUE, line};

/// Two counts a pulse: 0.5 pulses a count.
fn rig() -> Rig {
    let mut rig = Rig::with(|axis| axis.encoder_ratio = 2.0);
    rig.ok("SLRX=0.500 SLRY=0.5 SLTX=5 SLEX=400 SLAX=3 HSPD=4000 LSPD=400 ACC=100 DEC=100");
    rig
}

/// Lets time pass until StepNLoop has nothing to do; its status then.
#[track_caller]
fn settled(rig: &mut Rig) -> i32 {
    for _ in 0..20_000 {
        rig.pass_ms(1);
        let status = rig.get("SLSX");
        if matches!(status, 0 | 8..=12) {
            return status;
        }
    }
    panic!("StepNLoop does not settle");
}

#[test]
fn closed_loop_moves_in_encoder_counts() {
    let mut rig = rig();
    rig.check("SLRX", "0.500");
    rig.check("SLX", "0");
    rig.run("X100");
    rig.ok("SLX=1");
    // It stays where the encoder is.
    assert_eq!((rig.get("PX"), rig.get("EX"), rig.get("DX")), (200, 200, 0));
    rig.ok("X3000");
    rig.pass_ms(400);
    // Speeds are counts a second.
    rig.check("PSX", "4000");
    assert!((-5..=5).contains(&rig.get("DX")));
    assert_eq!(settled(&mut rig), 0);
    assert_eq!((rig.get("PX"), rig.get("EX"), rig.shaft("X")), (3000, 3000, 1500));
    rig.ok("INC X-500");
    assert_eq!(settled(&mut rig), 0);
    rig.check("PX", "2500");
    // Lines have targets in counts, and speeds in pulses.
    rig.ok(&format!("ABS SLY=1 {}", line(10_500, 5000)));
    rig.pass_ms(500);
    rig.check("PSX", "4000");
    assert_eq!(settled(&mut rig), 0);
    rig.until_rest();
    assert_eq!((rig.get("EX"), rig.get("EY")), (10_500, 5000));
    assert_eq!((rig.shaft("X"), rig.shaft("Y")), (5250, 2500));
    // The counters cannot be set apart.
    rig.check("PX=0", STATE);
    rig.ok("EX=0");
    assert_eq!((rig.get("PX"), rig.get("EX"), rig.get("DX")), (0, 0, 0));
    rig.check("SLRX=1", STATE);
    rig.ok("SLX=0");
    rig.check("PX", "5250");
    rig.check("SLSX", "12");
    rig.check("SLX=2", VALUE);
    rig.ok("JX+");
    rig.check("SLX=1", MOVING);
    rig.ok("ABORT");
}

#[test]
fn a_slip_is_corrected() {
    let mut rig = rig();
    rig.ok("SLX=1 X2000");
    rig.pass_ms(300);
    // 30 pulses are lost on the way: 60 counts.
    rig.device.push("X", -30).unwrap();
    assert_eq!(rig.get("SLSX"), 1);
    assert_eq!(settled(&mut rig), 0);
    assert_eq!((rig.get("PX"), rig.get("EX"), rig.shaft("X")), (2000, 2000, 1000));
    // Pushed at rest: within the tolerance nothing happens, beyond it it comes back.
    rig.device.push("X", 2).unwrap();
    rig.pass_ms(200);
    assert_eq!((rig.get("EX"), rig.get("DX"), rig.get("SLSX")), (2004, -4, 0));
    rig.device.push("X", 40).unwrap();
    let corrected = (0..200).any(|_| {
        rig.pass_ms(1);
        rig.get("SLSX") == 2
    });
    assert!(corrected);
    assert_eq!(settled(&mut rig), 0);
    assert_eq!((rig.get("PX"), rig.get("EX")), (2000, 2000));
    // The motor is off and on again.
    rig.motors(false);
    rig.ok("X2100");
    rig.pass_ms(20);
    rig.motors(true);
    assert_eq!(settled(&mut rig), 0);
    rig.check("EX", "2100");
}

#[test]
fn a_stall_is_an_error_until_it_is_cleared() {
    let mut rig = rig();
    rig.check("SLEX", "400");
    rig.ok("SLX=1 X20000");
    rig.pass_ms(300);
    rig.device.set_load("X", 2.0).unwrap();
    assert_eq!(settled(&mut rig), 10);
    assert!(!rig.moves("X"));
    let delta = rig.get("DX");
    assert!((401..=420).contains(&delta), "{delta}");
    rig.check("X0", LOOP_ERROR);
    rig.device.set_load("X", 0.0).unwrap();
    rig.ok(CLEAR_LOOP);
    rig.check("SLSX", "0");
    rig.check("DX", "0");
    rig.ok("X0");
    assert_eq!(settled(&mut rig), 0);
    rig.check("EX", "0");
    // A jog is watched too, and what clears the axis clears its loop.
    rig.ok("JX+");
    rig.pass_ms(200);
    rig.check("SLSX", "5");
    rig.device.set_load("X", 2.0).unwrap();
    assert_eq!(settled(&mut rig), 10);
    rig.ok("CLRX");
    rig.check("SLSX", "0");
    // So is a line; both axes stop.
    rig.device.set_load("X", 0.0).unwrap();
    rig.ok(&line(90_000, 90_000));
    rig.pass_ms(300);
    rig.device.set_load("X", 2.0).unwrap();
    assert_eq!(settled(&mut rig), 10);
    assert!(!rig.moves("X") && !rig.moves("Y"));
    // The other one was only stopped.
    rig.ok("CLRX SLY=1");
    rig.device.set_load("X", 0.0).unwrap();
    for stop in ["STOPX", "ABORTX"] {
        rig.ok(&line(0, 0));
        rig.pass_ms(200);
        rig.ok(stop);
        rig.until_rest();
        rig.pass_ms(100);
        assert_eq!((rig.get("SLSX"), rig.get("SLSY")), (0, 0), "{stop}");
        assert_ne!(rig.get("EY"), 0);
    }
}

#[test]
fn corrections_that_do_not_help() {
    let mut rig = rig();
    rig.ok("SLX=1 X1000");
    assert_eq!(settled(&mut rig), 0);
    rig.device.push("X", -50).unwrap();
    rig.device.set_load("X", 2.0).unwrap();
    rig.pass_ms(1);
    assert_eq!(settled(&mut rig), 0, "the shaft has time to settle");
    let tried = (0..3000).any(|_| {
        rig.pass_ms(1);
        rig.get("SLSX") == 9
    });
    assert!(tried);
    rig.check("X0", LOOP_ERROR);
}

#[test]
fn the_status_of_the_closed_loop() {
    let mut rig = Rig::with(|axis| {
        axis.positive_limit = 5000;
        axis.negative_limit = -5000;
        axis.home = [2000, 2100];
        axis.index_every = 100_000;
    });
    rig.ok("HSPD=4000 LSPD=100 ACC=200 DEC=200");
    rig.check("SLSX", "12");
    rig.check("DX", "0");
    rig.ok("SLX=1");
    rig.check("SLSX", "0");
    let mut check = |command: &str, status: i32| {
        rig.ok(command);
        rig.pass_ms(100);
        rig.check("SLSX", &status.to_string());
    };
    check("X9000", 1);
    check("STOPX", 3);
    rig.until_rest();
    rig.pass_ms(20);
    rig.ok("JX+");
    rig.pass_ms(300);
    rig.ok("ABORTX");
    rig.check("SLSX", "4");
    rig.pass_ms(20);
    rig.check("SLSX", "0");
    let mut check = |command: &str, status: i32| {
        rig.ok(command);
        rig.pass_ms(50);
        rig.check("SLSX", &status.to_string());
        rig.ok("ABORT");
        rig.pass_ms(20);
    };
    check("JX-", 5);
    for (command, status) in HOMING {
        check(command, *status);
    }
    // A limit is an error of the loop too.
    rig.run("X90000");
    rig.check("SLSX", "11");
    rig.check("X0", STATE);
    rig.ok("CLRX");
    rig.check("SLSX", "0");
    // Beyond the range at rest.
    rig.ok("SLEX=100");
    rig.device.push("X", -200).unwrap();
    rig.pass_ms(50);
    rig.check("SLSX", "8");
}

#[test]
fn a_loop_in_error_does_not_move() {
    let mut rig = Rig::new();
    rig.motors(false);
    rig.ok("SLX=1 SLEX=50");
    rig.run("X1000");
    rig.check("SLSX", "10");
    for line in MOTIONS {
        rig.check(line, LOOP_ERROR);
    }
    assert!(!rig.moves("X") && !rig.moves("Y"));
    rig.motors(true);
    rig.ok(CLEAR_LOOP);
    rig.run("X100");
    rig.check("PX", "100");
}
