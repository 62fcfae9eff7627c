//! The eight programs of section 10.2 and what they do.

use crate::ascii::examples::{self, turns};
use crate::rig::Rig;

macro_rules! example {
    ($name:literal) => {
        include_str!(concat!("../../../../examples/ascript/performax/", $name, ".prg"))
    };
}

#[test]
fn example_1_there_and_back() {
    examples::there_and_back(example!("there_and_back"));
}

#[test]
fn example_2_endless_moves() {
    examples::endless_moves(0, example!("endless_moves"));
}

#[test]
fn example_3_counted_moves() {
    examples::counted_moves(0, example!("counted_moves"));
}

#[test]
fn example_4_moves_on_input() {
    examples::moves_on_input(0, example!("moves_on_input"));
}

#[test]
fn example_5_step_on_edge() {
    examples::step_on_edge(example!("step_on_edge"));
}

#[test]
fn example_6_positions_by_input() {
    let mut rig = Rig::with(|axis| axis.home = [-700, -600]);
    rig.start(0, example!("positions_by_input"));
    for (input, position) in [("DI1", 1000), ("DI2", 2000), ("DI3", 3000), ("DI1", 1000)] {
        rig.pin(input, true);
        rig.pass_ms(2000);
        rig.pin(input, false);
        rig.pass_ms(10);
        rig.check("PX", &position.to_string());
        rig.check("DO", "0");
    }
    // DI5 homes in negative direction: zero is at the switch.
    rig.pin("DI5", true);
    rig.pass_ms(10);
    rig.pin("DI5", false);
    rig.pass_ms(3000);
    assert_eq!(rig.shaft("X") - i64::from(rig.get("PX")), -600);
    // DO1 is on while the axis moves by a host's command.
    rig.ok("JX+");
    rig.pass_ms(10);
    rig.check("DO1", "1");
    rig.ok("ABORTX");
    rig.pass_ms(10);
    rig.check("DO1", "0");
}

#[test]
fn example_7_stop_by_input() {
    examples::stop_by_input(example!("stop_by_input"));
}

#[test]
fn example_8_watchdog() {
    let mut rig = Rig::new();
    rig.download(example!("watchdog"));
    rig.ok("SR0=1 SR1=1");
    // A host that talks every two seconds.
    for _ in 0..5 {
        rig.pass_ms(2000);
        rig.check("SASTAT0", "1");
        rig.check("TOC", "5000");
    }
    assert_eq!(rig.get("DO"), 0);
    // Silence: after five seconds all stops for three, then it goes on, with DO1 on.
    rig.pass_ms(4900);
    let moving = |rig: &mut Rig, ms: u64| !turns(rig, ms).is_empty();
    rig.pass_ms(150);
    assert_eq!(rig.device.program(0).unwrap().run, devices::ProgramRun::Idle);
    let stood = rig.device.axis(0).position;
    rig.pass_ms(2800);
    assert_eq!(rig.device.axis(0).position, stood);
    assert!(!rig.level("DO1"));
    rig.pass_ms(200);
    assert!(rig.level("DO1"));
    assert_eq!(rig.device.program(0).unwrap().run, devices::ProgramRun::Running);
    // Nobody talks yet, so it stops again, over and over, until somebody does.
    rig.check("DO1", "1");
    assert!(moving(&mut rig, 4500));
}
