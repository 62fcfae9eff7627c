//! Control commands: 128 to 139 and 255 (manual, sections 3.7.52 and 3.7.53).

use crate::rig::{Rig, program, start};
use devices::Port;
use protocol::tmcl::{Request, Status};

const WRONG_TYPE: u8 = Status::WRONG_TYPE.0;
const INVALID_VALUE: u8 = Status::INVALID_VALUE.0;

fn raw(rig: &mut Rig, opcode: u8, kind: u8, value: i32) -> Vec<u8> {
    rig.bytes(Port::Usb, &Request { address: 1, opcode, kind, motor: 0, value }.emit().0)
}

#[test]
fn version() {
    let mut rig = Rig::new();
    assert_eq!(raw(&mut rig, 136, 0, 0), b"\x021140V147");
    assert_eq!(rig.ok(136, 1, 0, 0), 0x0474_012F);
    assert_eq!(rig.send(136, 2, 0, 0).0, WRONG_TYPE);
}

#[test]
fn running_stopping_and_stepping() {
    let mut rig = Rig::new();
    program(&mut rig, "SGP 0, 2, 1\nSGP 1, 2, 2\nSGP 2, 2, 3\nSTOP\nSGP 3, 2, 4\nSTOP");
    rig.ok(130, 0, 0, 0);
    rig.pass_ms(1);
    assert_eq!((rig.ggp(0, 2), rig.ggp(1, 2)), (1, 0), "one step");
    assert_eq!(rig.ok(135, 1, 0, 0), 2 << 24 | 1);
    rig.ok(130, 0, 0, 0);
    rig.pass_ms(1);
    assert_eq!((rig.ggp(1, 2), rig.ggp(2, 2)), (2, 0));
    rig.ok(129, 0, 0, 0);
    rig.pass_ms(1);
    assert_eq!(rig.ggp(2, 2), 3, "on from the present address");
    assert_eq!(rig.ok(135, 1, 0, 0) >> 24, 0, "stopped by itself");
    rig.ok(129, 1, 0, 4);
    rig.pass_ms(1);
    assert_eq!(rig.ggp(3, 2), 4, "from an address");
    for value in [-1, 2048] {
        assert_eq!(rig.send(129, 1, 0, value).0, INVALID_VALUE);
    }
    assert_eq!(rig.send(129, 2, 0, 0).0, WRONG_TYPE);
}

#[test]
fn stop_and_reset() {
    let mut rig = Rig::new();
    start(&mut rig, "CALC LOAD, 7\nCALCX LOAD\nLoop: JA Loop");
    rig.pass_ms(5);
    assert_eq!(rig.ok(135, 1, 0, 0), 1 << 24 | 2);
    rig.ok(128, 0, 0, 0);
    assert_eq!(rig.ok(135, 1, 0, 0), 2);
    assert_eq!((rig.ok(135, 2, 0, 0), rig.ok(135, 3, 0, 0)), (7, 7));
    rig.ok(131, 0, 0, 0);
    assert_eq!(rig.ok(135, 1, 0, 0), 3 << 24);
    assert_eq!((rig.ok(135, 2, 0, 0), rig.ok(135, 3, 0, 0)), (0, 0));
    assert_eq!(rig.send(135, 4, 0, 0).0, WRONG_TYPE);
}

#[test]
fn a_pending_wait_shows() {
    let mut rig = Rig::new();
    start(&mut rig, "WAIT TICKS, 0, 100\nSTOP");
    rig.pass_ms(10);
    assert_eq!(rig.ok(135, 0, 0, 0), 1 << 24 | 1 << 16);
    rig.pass_ms(1000);
    assert_eq!(rig.ok(135, 0, 0, 0), 0);
}

#[test]
fn downloading() {
    let mut rig = Rig::new();
    rig.ok(132, 0, 0, 5);
    assert_eq!(rig.send(9, 1, 2, 9), (101, 0));
    // The vendor's IDE sends an empty command before it leaves.
    assert_eq!(rig.send(0, 0, 0, 0), (101, 0));
    assert_eq!(rig.ok(135, 0, 0, 0), 7, "where the next would go");
    rig.ok(133, 0, 0, 0);
    assert_eq!(raw(&mut rig, 134, 0, 5), [2, 9, 1, 2, 0, 0, 0, 9, 21]);
    assert_eq!(rig.ggp(1, 2), 0, "stored, not executed");
    rig.device.power_cycle();
    assert_eq!(raw(&mut rig, 134, 0, 5), [2, 9, 1, 2, 0, 0, 0, 9, 21], "for good");
    for value in [-1, 2048] {
        assert_eq!(rig.send(132, 0, 0, value).0, INVALID_VALUE);
        assert_eq!(rig.send(134, 0, 0, value).0, INVALID_VALUE);
    }
}

#[test]
fn the_memory_ends_at_2048() {
    let mut rig = Rig::new();
    rig.ok(132, 0, 0, 2047);
    assert_eq!(rig.send(28, 0, 0, 0).0, 101);
    assert_eq!(rig.send(28, 0, 0, 0).0, INVALID_VALUE);
    rig.ok(133, 0, 0, 0);
}

#[test]
fn a_whole_memory_of_commands() {
    let mut rig = Rig::new();
    rig.ok(132, 0, 0, 0);
    for address in 0..2048 {
        assert_eq!(rig.send(45, 0, 0, address).0, 101);
    }
    rig.ok(133, 0, 0, 0);
    rig.device.power_cycle();
    for address in [0, 1, 1023, 2047] {
        let [.., a, b, c, d, _] = raw(&mut rig, 134, 0, address)[..] else { panic!("nine bytes") };
        assert_eq!(i32::from_be_bytes([a, b, c, d]), address);
    }
}

#[test]
fn factory_settings() {
    let mut rig = Rig::new();
    rig.sap(4, 555);
    rig.ok(7, 4, 0, 0);
    rig.sgp(3, 2, 33);
    rig.ok(11, 3, 2, 0);
    assert_eq!(rig.send(137, 0, 0, 1).0, INVALID_VALUE);
    assert_eq!(rig.gap(4), 555);
    assert_eq!(raw(&mut rig, 137, 0, 1234), [0; 0], "no reply");
    rig.device.power_cycle();
    assert_eq!((rig.gap(4), rig.ggp(3, 2)), (1000, 0));
}

#[test]
fn software_reset() {
    let mut rig = Rig::new();
    rig.sap(4, 555);
    rig.ok(14, 0, 2, 1);
    rig.ok(1, 0, 0, 500);
    rig.pass_ms(300);
    assert_eq!(rig.send(255, 0, 0, 0).0, INVALID_VALUE);
    rig.ok(255, 0, 0, 1234);
    assert_eq!((rig.gap(4), rig.gap(3), rig.gap(1), rig.ok(15, 0, 2, 0)), (1000, 0, 0, 0));
    let shaft = rig.shaft();
    rig.move_to(100);
    rig.until_rest();
    assert_eq!((rig.gap(1), rig.gap(209), rig.shaft()), (100, 100, shaft + 100));
}

#[test]
fn position_reached_events() {
    let mut rig = Rig::new();
    let event = [2, 1, 128, 138, 0, 0, 0, 1, 14];
    let reached = |rig: &mut Rig| -> Vec<u8> {
        drop(rig.device.drain_sent());
        rig.pass_ms(2000);
        rig.device.drain_sent().flat_map(|sent| sent.bytes).collect()
    };
    rig.move_to(1000);
    assert_eq!(reached(&mut rig), [0; 0], "nobody asked");
    rig.ok(138, 0, 0, 1);
    rig.move_to(2000);
    assert_eq!(reached(&mut rig), event);
    rig.move_to(3000);
    assert_eq!(reached(&mut rig), [0; 0], "once only");
    rig.ok(138, 1, 0, 1);
    for target in [4000, 5000, 5000] {
        let request = Request { address: 1, opcode: 4, kind: 0, motor: 0, value: target };
        let mut sent = rig.bytes(Port::Usb, &request.emit().0);
        sent.extend(reached(&mut rig));
        assert_eq!(sent.split_off(9), event, "every time, {target}");
    }
    rig.sap(0, 6000);
    assert_eq!(reached(&mut rig), [0; 0], "only after MVP");
    assert_eq!(rig.send(138, 2, 0, 1).0, WRONG_TYPE);
    assert_eq!(rig.send(138, 1, 0, 2).0, INVALID_VALUE);
}

#[test]
fn position_reached_events_on_can() {
    let mut rig = Rig::new();
    rig.bytes(Port::Can, &[0, 1, 138, 1, 0, 0, 0, 0, 1, 0]);
    rig.bytes(Port::Can, &[0, 1, 4, 0, 0, 0, 0, 0, 50, 0]);
    rig.pass_ms(1000);
    let sent: Vec<_> = rig.device.drain_sent().collect();
    assert_eq!((sent.len(), sent[0].port), (1, Port::Can));
    assert_eq!(sent[0].bytes, [0, 2, 1, 128, 138, 0, 0, 0, 1, 0]);
}
