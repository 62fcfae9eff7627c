//! Standalone programs in time: waits, flags, interrupts.

use crate::rig::{Rig, start};

#[test]
fn waits_for_ticks() {
    let mut rig = Rig::new();
    start(
        &mut rig,
        "WAIT TICKS, 0, 50\nGGP 132, 0\nAGP 0, 2\nCALC LOAD, 30\nWAIT TICKS, 0, -1\nGGP 132, 0\nAGP 1, 2\nSTOP",
    );
    rig.pass_ms(2000);
    assert_eq!((rig.ggp(0, 2), rig.ggp(1, 2)), (500, 800));
}

#[test]
fn waits_for_the_axis_and_its_switches() {
    let mut rig = Rig::with(|axis| axis.positive_limit = 30_000);
    start(
        &mut rig,
        "MVP ABS, 0, 20000\nWAIT POS, 0, 0\nGAP 1, 0\nAGP 0, 2\n\
         MVP ABS, 0, 40000\nWAIT LIMSW, 0, 0\nGAP 1, 0\nAGP 1, 2\n\
         ROL 0, 500\nWAIT REFSW, 0, 0\nGAP 1, 0\nAGP 2, 2\nMST 0\n\
         SAP 193, 0, 7\nRFS START, 0\nWAIT RFS, 0, 0\nGAP 197, 0\nAGP 3, 2\nSTOP",
    );
    rig.pass_ms(60_000);
    assert_eq!(rig.ggp(128, 0), 0, "ended");
    assert_eq!((rig.ggp(0, 2), rig.ggp(1, 2)), (20_000, 30_000));
    // A command takes 50 µs, in which the motor goes on a little.
    let home = rig.ggp(2, 2);
    assert!((-4..=0).contains(&home), "{home}");
    assert_eq!(rig.ggp(3, 2), -100);
}

#[test]
fn waits_time_out() {
    for wait in ["POS", "LIMSW", "RFS", "REFSW"] {
        let mut rig = Rig::new();
        rig.pin("HOME", false);
        start(
            &mut rig,
            &format!(
                "SAP 193, 0, 7\nRFS START, 0\nCOMP 0\nJC EQ, Go\nGo: WAIT {wait}, 0, 20\nJC ETO, Late\n\
                 SGP 0, 2, 1\nSTOP\nLate: SGP 0, 2, 2\nCLE ETO\nJC ETO, Still\nSGP 1, 2, 1\nStill: STOP"
            ),
        );
        if wait == "POS" {
            rig.sap(0, 9_000_000);
        }
        rig.pass_ms(1000);
        assert_eq!((rig.ggp(0, 2), rig.ggp(1, 2)), (2, 1), "{wait}");
    }
}

#[test]
fn flags_of_the_axis() {
    let jumps = |flag: &str| format!("JC {flag}, Yes\nSGP 0, 2, 1\nSTOP\nYes: SGP 0, 2, 2\nSTOP");
    // A stop switch ends the move off its target.
    let mut rig = Rig::with(|axis| axis.positive_limit = 1000);
    start(&mut rig, &format!("MVP ABS, 0, 5000\nWAIT TICKS, 0, 100\n{}", jumps("EPO")));
    rig.pass_ms(2000);
    assert_eq!(rig.ggp(0, 2), 2, "EPO");
    let mut rig = Rig::new();
    start(&mut rig, &format!("MVP ABS, 0, 500\nWAIT POS, 0, 0\n{}", jumps("EPO")));
    rig.pass_ms(2000);
    assert_eq!(rig.ggp(0, 2), 1, "no EPO");
    // The shaft stalls: deviation.
    let mut rig = Rig::with(|axis| axis.load = 1.5);
    start(&mut rig, &format!("SAP 212, 0, 100\nROR 0, 500\nWAIT TICKS, 0, 100\n{}", jumps("EDV")));
    rig.pass_ms(2000);
    assert_eq!(rig.ggp(0, 2), 2, "EDV");
    let mut rig = Rig::new();
    start(&mut rig, &format!("ROR 0, 500\nWAIT TICKS, 0, 100\n{}", jumps("ESD")));
    rig.analog("TEMPERATURE", 160.0);
    rig.pass_ms(2000);
    assert_eq!(rig.ggp(0, 2), 2, "ESD");
    let mut rig = Rig::new();
    start(&mut rig, &jumps("EAL"));
    rig.pass_ms(10);
    assert_eq!(rig.ggp(0, 2), 1, "there is no alarm input");
}

#[test]
fn interrupts_of_the_axis() {
    let program = |interrupt: u8, motion: &str| {
        format!(
            "VECT {interrupt}, Handler\nEI {interrupt}\nEI 255\n{motion}\nLoop: WAIT TICKS, 0, 1000\nJA Loop\n\
             Handler: GAP 1, 0\nAGP 0, 2\nCALCV ADD, 1, 1\nRETI"
        )
    };
    let mut rig = Rig::new();
    start(&mut rig, &program(3, "MVP ABS, 0, 1234"));
    rig.pass_ms(3000);
    assert_eq!((rig.ggp(0, 2), rig.ggp(1, 2)), (1234, 1), "target reached");
    let mut rig = Rig::new();
    rig.sap(181, 100);
    start(&mut rig, &program(15, "ROR 0, 500"));
    rig.pass_ms(300);
    rig.device.set_load("0", 1.0).unwrap();
    rig.pass_ms(300);
    assert_eq!(rig.ggp(1, 2), 1, "stall");
    let mut rig = Rig::with(|axis| axis.load = 1.5);
    rig.sap(212, 100);
    start(&mut rig, &program(21, "ROR 0, 500"));
    rig.pass_ms(300);
    assert_eq!(rig.ggp(1, 2), 1, "deviation");
}

#[test]
fn interrupts_keep_the_program_as_it_was() {
    let mut rig = Rig::new();
    start(
        &mut rig,
        "VECT 0, Handler\nSGP 0, 3, 1\nEI 0\nEI 255\nSGP 1, 2, 20000\n\
         Loop: CALC LOAD, 5\nCALCX LOAD\nCALC LOAD, 3\nCALCX ADD\nCOMP 8\nJC NE, Broken\nDJNZ 1, Loop\n\
         SGP 2, 2, 1\nSTOP\nBroken: SGP 2, 2, 2\nSTOP\n\
         Handler: CALC LOAD, 99\nCALCX LOAD\nCOMP 1\nCALCV ADD, 3, 1\nRETI",
    );
    rig.pass_ms(10_000);
    assert_eq!(rig.ggp(2, 2), 1);
    assert!(rig.ggp(3, 2) > 1000, "{}", rig.ggp(3, 2));
}

#[test]
fn the_host_and_a_program_share_variables() {
    let mut rig = Rig::new();
    start(&mut rig, "Loop: GGP 10, 2\nCOMP 0\nJC EQ, Loop\nCALC MUL, 2\nAGP 11, 2\nSGP 10, 2, 0\nJA Loop");
    for value in [21, -4] {
        rig.sgp(10, 2, value);
        rig.pass_ms(2);
        assert_eq!(rig.ggp(11, 2), 2 * value);
    }
}

#[test]
fn a_program_ends_at_an_empty_word() {
    let mut rig = Rig::new();
    rig.ok(132, 0, 0, 0);
    rig.send(9, 0, 2, 1);
    rig.ok(133, 0, 0, 0);
    rig.ok(129, 1, 0, 0);
    rig.pass_ms(1);
    assert_eq!((rig.ggp(0, 2), rig.ggp(128, 0)), (1, 0));
}

#[test]
fn a_wait_for_another_motor_is_passed_over() {
    let mut rig = Rig::new();
    start(&mut rig, "WAIT POS, 1, 0\nSGP 0, 2, 1\nSTOP");
    rig.pass_ms(1);
    assert_eq!(rig.ggp(0, 2), 1);
    // Ticks have no motor.
    start(&mut rig, "WAIT TICKS, 3, 10\nSGP 0, 2, 2\nSTOP");
    rig.pass_ms(50);
    assert_eq!(rig.ggp(0, 2), 1);
    rig.pass_ms(60);
    assert_eq!(rig.ggp(0, 2), 2);
}

#[test]
fn a_lost_heartbeat_keeps_programs_from_moving() {
    let mut rig = Rig::new();
    rig.sgp(68, 0, 200);
    start(&mut rig, "Loop: ROR 0, 500\nWAIT TICKS, 0, 10\nJA Loop");
    rig.pass_ms(150);
    assert_ne!(rig.device.axis(0).speed_mpps, 0);
    rig.pass_ms(1000);
    assert_eq!(rig.device.axis(0).speed_mpps, 0);
    rig.gap(3);
    rig.pass_ms(150);
    assert_ne!(rig.device.axis(0).speed_mpps, 0, "any valid command lets it go on");
}

/// A motor that a program wakes from freewheeling is stopped by its switch, however far time is let pass in
/// one go.
#[test]
fn a_program_wakes_a_motor_that_runs_into_a_switch() {
    let mut rig = Rig::with(|axis| axis.positive_limit = 5000);
    start(&mut rig, "SAP 204, 0, 10\nWAIT TICKS, 0, 100\nMVP ABS, 0, 200000\nWAIT TICKS, 0, 100\nSTOP");
    rig.pass_ms(20_000);
    assert_eq!(rig.gap(1), 5000);
    assert_eq!(rig.shaft(), 5000);
}
