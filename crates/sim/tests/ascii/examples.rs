//! The example programs that both manuals have.

use super::rig::Rig;

/// Where the X axis comes to rest in some time.
pub fn turns(rig: &mut Rig, ms: u64) -> Vec<i32> {
    let mut turns = Vec::new();
    let mut moved = false;
    // A program's lines are a tenth of a millisecond apart.
    for _ in 0..20 * ms {
        rig.pass_us(50);
        let state = rig.device.axis(0);
        let moving = state.speed_mpps != 0;
        if moved && !moving {
            turns.push(state.position);
        }
        moved = moving;
    }
    turns
}

#[track_caller]
pub fn there_and_back(source: &str) {
    let mut rig = Rig::new();
    rig.motors(false);
    rig.start(0, source);
    assert_eq!(turns(&mut rig, 2000), [1000, 0]);
    for (command, value) in
        [("HSPD", "20000"), ("LSPD", "1000"), ("ACC", "300"), ("EO", "1"), ("SASTAT0", "0")]
    {
        rig.check(command, value);
    }
    assert_eq!((rig.shaft("X"), rig.get("EX")), (0, 0));
}

#[track_caller]
pub fn endless_moves(number: u8, source: &str) {
    let mut rig = Rig::new();
    rig.start(number, source);
    let turns = turns(&mut rig, 10_000);
    assert!(turns.len() > 20, "{turns:?}");
    assert!(turns.chunks_exact(2).all(|pair| pair == [1000, 0]), "{turns:?}");
    rig.check(&format!("SASTAT{number}"), "1");
}

#[track_caller]
pub fn counted_moves(number: u8, source: &str) {
    let mut rig = Rig::new();
    rig.start(number, source);
    let turns = turns(&mut rig, 10_000);
    // The first move leads to where the axis is.
    assert_eq!(turns.iter().filter(|&&turn| turn == 1000).count(), 10);
    assert_eq!(turns.iter().filter(|&&turn| turn == 0).count(), 9);
    assert_eq!((rig.get("V1"), rig.get("PX"), rig.get(&format!("SASTAT{number}"))), (10, 1000, 0));
}

#[track_caller]
pub fn moves_on_input(number: u8, source: &str) {
    let mut rig = Rig::new();
    rig.start(number, source);
    assert_eq!(turns(&mut rig, 1000), [0; 0]);
    rig.pin("DI1", true);
    assert!(turns(&mut rig, 3000).len() > 5);
    rig.pin("DI1", false);
    // It finishes its round.
    turns(&mut rig, 2000);
    assert_eq!(turns(&mut rig, 1000), [0; 0]);
    rig.check("PX", "1000");
}

#[track_caller]
pub fn step_on_edge(source: &str) {
    let mut rig = Rig::new();
    rig.start(0, source);
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

/// Program 1 stops and starts program 0.
#[track_caller]
pub fn stop_by_input(source: &str) {
    let mut rig = Rig::new();
    rig.start(1, source);
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
