//! Supply (manual, section 12.1, V1.35).

use crate::rig::{Rig, program};
use protocol::tmcl::Status;

#[test]
fn too_little_supply_stops_motor_and_program() {
    let mut rig = Rig::new();
    program(&mut rig, "ROR 0, 500\nLoop: CALCV ADD, 0, 1\nJA Loop");
    rig.sgp(77, 0, 1);
    rig.ok(129, 1, 0, 0);
    rig.pass_ms(300);
    assert_eq!(rig.gap(3), 500);
    rig.analog("SUPPLY", 8.4);
    assert_eq!((rig.gap(3), rig.ggp(128, 0)), (0, 0));
    assert_eq!(rig.send(4, 0, 0, 100).0, Status::NOT_AVAILABLE.0);
    assert_eq!(rig.send(129, 1, 0, 0).0, Status::NOT_AVAILABLE.0);
    rig.analog("SUPPLY", 9.0);
    rig.pass_ms(100);
    assert_eq!(rig.gap(3), 0, "not enough yet");
    rig.analog("SUPPLY", 9.6);
    rig.pass_ms(300);
    assert_eq!((rig.gap(3), rig.ggp(128, 0)), (500, 1), "the program starts again");
}

#[test]
fn without_autostart_the_program_stays_stopped() {
    let mut rig = Rig::new();
    program(&mut rig, "Loop: JA Loop");
    rig.ok(129, 1, 0, 0);
    rig.analog("SUPPLY", 5.0);
    rig.analog("SUPPLY", 24.0);
    rig.pass_ms(100);
    assert_eq!(rig.ggp(128, 0), 0);
    rig.move_to(100);
    rig.until_rest();
    assert_eq!(rig.gap(1), 100, "but the motor can be moved");
}
