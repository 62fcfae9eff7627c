//! The eight programs of section 10.2 and what they do.

use crate::controller::MS;
use crate::rig::Rig;

macro_rules! example {
    ($name:literal) => {
        include_str!(concat!("../../../../examples/ascript/performax/", $name, ".prg"))
    };
}

/// Where the X axis comes to rest in some time.
fn turns(rig: &mut Rig, ms: u64) -> Vec<i32> {
    let mut turns = Vec::new();
    let mut moved = false;
    // A program's lines are a tenth of a millisecond apart.
    for _ in 0..20 * ms {
        let until = rig.device.now() + MS / 20;
        rig.device.advance(until);
        let moving = rig.device.axis(0).speed_mpps != 0;
        if moved && !moving {
            turns.push(rig.device.axis(0).position);
        }
        moved = moving;
    }
    turns
}

#[test]
fn example_1_there_and_back() {
    let mut rig = Rig::new();
    rig.ok("EO=0");
    rig.start(0, example!("there_and_back"));
    assert_eq!(turns(&mut rig, 2000), [1000, 0]);
    for (command, value) in
        [("HSPD", "20000"), ("LSPD", "1000"), ("ACC", "300"), ("EO", "1"), ("SASTAT0", "0")]
    {
        rig.check(command, value);
    }
    assert_eq!((rig.shaft("X"), rig.get("EX")), (0, 0));
}

#[test]
fn example_2_endless_moves() {
    let mut rig = Rig::new();
    rig.start(0, example!("endless_moves"));
    let turns = turns(&mut rig, 10_000);
    assert!(turns.len() > 20, "{turns:?}");
    assert!(turns.chunks_exact(2).all(|pair| pair == [1000, 0]), "{turns:?}");
    rig.check("SASTAT0", "1");
}

#[test]
fn example_3_counted_moves() {
    let mut rig = Rig::new();
    rig.start(0, example!("counted_moves"));
    let turns = turns(&mut rig, 10_000);
    // The first move leads to where the axis is.
    assert_eq!(turns.iter().filter(|&&turn| turn == 1000).count(), 10);
    assert_eq!(turns.iter().filter(|&&turn| turn == 0).count(), 9);
    assert_eq!((rig.get("V1"), rig.get("PX"), rig.get("SASTAT0")), (10, 1000, 0));
}

#[test]
fn example_4_moves_on_input() {
    let mut rig = Rig::new();
    rig.start(0, example!("moves_on_input"));
    assert_eq!(turns(&mut rig, 1000), []);
    rig.pin("DI1", true);
    assert!(turns(&mut rig, 3000).len() > 5);
    rig.pin("DI1", false);
    // It finishes its round.
    turns(&mut rig, 2000);
    assert_eq!(turns(&mut rig, 1000), []);
    rig.check("PX", "1000");
}

#[test]
fn example_5_step_on_edge() {
    let mut rig = Rig::new();
    rig.start(0, example!("step_on_edge"));
    // The first target is 0, where the axis is.
    for target in [0, 1000, 2000, 3000] {
        rig.pin("DI1", true);
        rig.pass_ms(1000);
        rig.check("PX", &target.to_string());
        rig.check("V1", &(target + 1000).to_string());
        rig.pin("DI1", false);
        rig.pass_ms(100);
    }
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
    let mut rig = Rig::new();
    rig.download(example!("stop_by_input"));
    rig.ok("SR1=1");
    assert!(turns(&mut rig, 5000).len() > 5);
    rig.check("SASTAT0", "1");
    rig.pin("DI1", true);
    rig.pass_ms(10);
    rig.check("SASTAT0", "0");
    assert!(!rig.moves("X"));
    rig.pass_ms(1000);
    assert!(!rig.moves("X"));
    rig.check("SASTAT1", "1");
    rig.pin("DI1", false);
    assert!(turns(&mut rig, 5000).len() > 5);
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
