//! One test for each global parameter or group of them (manual, tables 18 to 20).

use crate::rig::{Rig, program};
use devices::{Parameter, Port, pd42::global_parameters as gp};
use protocol::tmcl::{Frame, Request, Status};

const WRONG_TYPE: u8 = Status::WRONG_TYPE.0;
const INVALID_VALUE: u8 = Status::INVALID_VALUE.0;

#[test]
fn every_parameter_of_the_module_has_its_default_range_and_access() {
    for entry in gp::module::TABLE {
        let mut rig = Rig::new();
        let number = entry.number;
        if entry.access.writable() && number != gp::module::RANDOM {
            assert_eq!(rig.ggp(number, 0), entry.default, "{number}");
        }
        for value in [entry.low.checked_sub(1), entry.high.checked_add(1)].into_iter().flatten() {
            let expected = if entry.access.writable() { INVALID_VALUE } else { WRONG_TYPE };
            assert_eq!(rig.send(9, number, 0, value), (expected, 0), "SGP {number} {value}");
        }
        // Stored when written, or not at all: never on command.
        assert_eq!(rig.send(11, number, 0, 0).0, WRONG_TYPE, "STGP {number}");
        assert_eq!(rig.send(12, number, 0, 0).0, WRONG_TYPE, "RSGP {number}");
    }
}

#[test]
fn automatic_parameters_survive_a_restart() {
    let mut rig = Rig::new();
    let entries = || gp::module::TABLE.iter().filter(|entry| entry.access.automatic());
    let other = |entry: &Parameter| if entry.default == entry.high { entry.low } else { entry.default + 1 };
    for entry in entries() {
        // Those that change how the module is reached have tests of their own.
        if !matches!(entry.number, gp::module::HOST_ADDRESS | gp::module::ASCII_MODE) {
            rig.sgp(entry.number, 0, other(entry));
        }
    }
    rig.device.power_cycle();
    for entry in entries() {
        if !matches!(entry.number, gp::module::HOST_ADDRESS | gp::module::ASCII_MODE) {
            assert_eq!(rig.ggp(entry.number, 0), other(entry), "{}", entry.number);
        }
    }
    // Factory settings forget them, and answer nothing.
    let request = Request { address: 1, opcode: 137, kind: 0, motor: 0, value: 1234 };
    assert_eq!(rig.bytes(Port::Usb, &request.emit().0), [0; 0]);
    for entry in entries() {
        assert_eq!(rig.ggp(entry.number, 0), entry.default, "{}", entry.number);
    }
}

#[test]
fn other_numbers_and_banks() {
    let mut rig = Rig::new();
    for number in (0..=255).filter(|&number| gp::module::TABLE.find(number).is_none()) {
        for opcode in [9, 10, 35] {
            assert_eq!(rig.send(opcode, number, 0, 0).0, WRONG_TYPE, "{opcode} {number}");
        }
    }
    for bank in [1, 4, 255] {
        for opcode in [9, 10, 11, 12, 35] {
            assert_eq!(rig.send(opcode, 66, bank, 0).0, INVALID_VALUE, "{opcode} bank {bank}");
        }
    }
    assert_eq!(rig.send(9, 3, 3, 0).0, WRONG_TYPE);
}

#[test]
fn gp_65_and_69_rates() {
    let mut rig = Rig::new();
    rig.sgp(65, 0, 7);
    rig.sgp(69, 0, 2);
    rig.device.power_cycle();
    assert_eq!((rig.ggp(65, 0), rig.ggp(69, 0)), (7, 2));
}

/// Sends `GGP 66, 0` to an address over RS-485; the reply's bytes.
fn ask(rig: &mut Rig, address: u8) -> Vec<u8> {
    let request = Request { address, opcode: 10, kind: 66, motor: 0, value: 0 };
    rig.bytes(Port::Rs485, &request.emit().0)
}

#[test]
fn gp_66_serial_address() {
    let mut rig = Rig::new();
    assert_eq!(ask(&mut rig, 1), [2, 1, 100, 10, 0, 0, 0, 1, 114]);
    assert_eq!(ask(&mut rig, 3), [0; 0]);
    rig.sgp(66, 0, 3);
    assert_eq!(ask(&mut rig, 1), [0; 0]);
    assert_eq!(ask(&mut rig, 3), [2, 3, 100, 10, 0, 0, 0, 3, 118]);
    // USB is point to point.
    assert_eq!(rig.ggp(66, 0), 3);
}

#[test]
fn gp_67_ascii_mode() {
    for (value, answer) in
        [(1, &b"AGAP 1, 0\rBA 100 0\r"[..]), (0x11, b"AGAP 1, 0\rBA 100 0\r"), (0x21, b"BA 100 0\r")]
    {
        let mut rig = Rig::new();
        rig.sgp(67, 0, value);
        rig.device.power_cycle();
        assert_eq!(rig.bytes(Port::Usb, b"AGAP 1, 0\r"), answer, "{value}");
        assert!(rig.bytes(Port::Usb, b"ABIN\r").ends_with(b"BA 100 0\r"));
        assert_eq!(rig.gap(1), 0, "binary again");
    }
}

#[test]
fn gp_68_serial_heartbeat() {
    let mut rig = Rig::new();
    rig.sgp(68, 0, 100);
    rig.ok(1, 0, 0, 500);
    for _ in 0..10 {
        rig.pass_ms(90);
        assert_ne!(rig.gap(3), 0, "commands keep it going");
    }
    rig.pass_ms(150);
    assert_eq!(rig.device.axis(0).speed_mpps, 0, "silence stops it");
    rig.ok(1, 0, 0, 500);
    rig.pass_ms(50);
    assert_ne!(rig.gap(3), 0, "the next command works again");
}

#[test]
fn gp_70_and_71_can_ids() {
    let mut rig = Rig::new();
    let mvp = [0, 1, 6, 4, 0, 0, 0, 0, 0];
    assert_eq!(rig.bytes(Port::Can, &mvp), [0, 2, 1, 100, 6, 0, 0, 3, 232]);
    rig.sgp(70, 0, 0x123);
    rig.sgp(71, 0, 0x456);
    assert_eq!(rig.bytes(Port::Can, &mvp), [0; 0]);
    let mvp = [4, 0x56, 6, 4, 0, 0, 0, 0, 0, 9];
    assert_eq!(rig.bytes(Port::Can, &mvp), [1, 0x23, 0x56, 100, 6, 0, 0, 3, 232, 0]);
}

#[test]
fn gp_75_telegram_pause() {
    let mut rig = Rig::new();
    rig.sgp(75, 0, 15);
    let request = Request { address: 1, opcode: 6, kind: 1, motor: 0, value: 0 }.emit().0;
    for (port, pause) in [(Port::Rs485, 15), (Port::Usb, 0)] {
        rig.device.receive(port, &request);
        let sent: Vec<_> = rig.device.drain_sent().collect();
        assert_eq!((sent.len(), sent[0].delay_ms), (1, pause));
    }
}

#[test]
fn gp_76_host_address() {
    let mut rig = Rig::new();
    let set = Request { address: 1, opcode: 9, kind: 76, motor: 0, value: 9 };
    assert_eq!(rig.bytes(Port::Usb, &set.emit().0)[0], 9);
    assert_eq!(ask(&mut rig, 1)[0], 9);
}

#[test]
fn gp_77_auto_start() {
    let mut rig = Rig::new();
    program(&mut rig, "SGP 1, 2, 77\nSTOP");
    rig.sgp(77, 0, 1);
    rig.device.power_cycle();
    rig.pass_ms(1);
    assert_eq!(rig.ggp(1, 2), 77);
    rig.sgp(77, 0, 0);
    rig.device.power_cycle();
    rig.pass_ms(1);
    assert_eq!(rig.ggp(1, 2), 0);
}

#[test]
fn gp_79_switch_polarity() {
    let mut rig = Rig::new();
    rig.sgp(79, 0, 1);
    assert_eq!((rig.gap(10), rig.gap(11)), (1, 1));
    rig.move_to(100);
    rig.pass_ms(500);
    assert_eq!(rig.gap(1), 0, "both directions are blocked");
    rig.pin("STOP_R", true);
    rig.until_rest();
    assert_eq!((rig.gap(10), rig.gap(1)), (0, 100));
}

#[test]
fn gp_81_code_protection() {
    let mut rig = Rig::new();
    program(&mut rig, "SGP 1, 2, 5\nSTOP");
    let read = Request { address: 1, opcode: 134, kind: 0, motor: 0, value: 0 }.emit().0;
    let word = [2, 9, 1, 2, 0, 0, 0, 5, 17];
    assert_eq!(rig.bytes(Port::Usb, &read), word);
    for protection in [1, 3] {
        rig.sgp(81, 0, protection);
        assert_eq!(rig.send(134, 0, 0, 0).0, Status::NOT_AVAILABLE.0, "{protection}");
    }
    assert_eq!(rig.send(132, 0, 0, 0).0, Status::LOCKED.0);
    rig.sgp(81, 0, 1);
    assert_eq!(rig.send(132, 0, 0, 100).0, 100);
    rig.ok(133, 0, 0, 0);
    rig.sgp(81, 0, 2);
    assert_eq!(rig.bytes(Port::Usb, &read), [2, 0, 0, 0, 0, 0, 0, 0, 0], "erased with the protection");
    assert_eq!(rig.send(132, 0, 0, 0).0, Status::LOCKED.0);
    rig.device.power_cycle();
    assert_eq!(rig.bytes(Port::Usb, &read), [2, 0, 0, 0, 0, 0, 0, 0, 0], "for good");
}

#[test]
fn gp_82_can_heartbeat() {
    let mut rig = Rig::new();
    rig.sgp(82, 0, 200);
    let rotate = [0, 1, 1, 0, 0, 0, 0, 1, 0xF4];
    assert_eq!(rig.bytes(Port::Can, &rotate)[3], 100);
    rig.pass_ms(150);
    assert_ne!(rig.gap(3), 0);
    rig.pass_ms(100);
    assert_eq!(rig.gap(3), 0, "USB does not count");
}

#[test]
fn gp_83_secondary_can_id() {
    let mut rig = Rig::new();
    rig.sgp(83, 0, 0x77);
    assert_eq!(rig.bytes(Port::Can, &[0, 0x77, 9, 5, 2, 0, 0, 0, 44]), [0; 0]);
    assert_eq!(rig.ggp(5, 2), 44, "executed without a word");
}

#[test]
fn gp_84_coordinate_storage() {
    for (storage, after) in [(0, 0), (1, 123)] {
        let mut rig = Rig::new();
        rig.sgp(84, 0, storage);
        rig.ok(30, 3, 0, 123);
        rig.ok(30, 0, 0, 99);
        rig.device.power_cycle();
        assert_eq!(rig.ok(31, 3, 0, 0), after);
        assert_eq!(rig.ok(31, 0, 0, 0), 0, "the first is never stored");
    }
}

#[test]
fn gp_85_do_not_restore() {
    let mut rig = Rig::new();
    rig.sgp(7, 2, 70);
    rig.ok(11, 7, 2, 0);
    rig.device.power_cycle();
    assert_eq!(rig.ggp(7, 2), 70);
    rig.sgp(85, 0, 1);
    rig.device.power_cycle();
    assert_eq!(rig.ggp(7, 2), 0);
    rig.ok(12, 7, 2, 0);
    assert_eq!(rig.ggp(7, 2), 70, "restored on command");
}

#[test]
fn gp_87_secondary_address() {
    let mut rig = Rig::new();
    rig.sgp(87, 0, 200);
    let set = Request { address: 200, opcode: 9, kind: 5, motor: 2, value: 44 };
    assert_eq!(rig.bytes(Port::Rs485, &set.emit().0), [0; 0]);
    assert_eq!(rig.ggp(5, 2), 44, "executed without a word");
    // Not even a wrong checksum is answered there.
    let mut bad = set.emit().0;
    bad[8] ^= 1;
    assert_eq!(rig.bytes(Port::Rs485, &bad), [0; 0]);
}

#[test]
fn gp_90_reverse_shaft() {
    let mut rig = Rig::new();
    rig.sgp(90, 0, 1);
    rig.move_to(51_200);
    rig.until_rest();
    assert_eq!((rig.gap(1), rig.shaft(), rig.gap(209), rig.gap(216)), (51_200, -51_200, 51_200, 51_200));
}

#[test]
fn gp_128_to_130_program() {
    let mut rig = Rig::new();
    assert_eq!((rig.ggp(128, 0), rig.ggp(129, 0), rig.ggp(130, 0)), (0, 0, 0));
    program(&mut rig, "SGP 0, 2, 1\nLoop: JA Loop");
    rig.ok(129, 1, 0, 0);
    rig.pass_ms(1);
    assert_eq!((rig.ggp(128, 0), rig.ggp(130, 0)), (1, 1));
    rig.ok(130, 0, 0, 0);
    assert_eq!(rig.ggp(128, 0), 2);
    rig.ok(131, 0, 0, 0);
    assert_eq!((rig.ggp(128, 0), rig.ggp(130, 0)), (3, 0));
    rig.ok(132, 0, 0, 0);
    // A command that is not a control command is stored now.
    assert_eq!(rig.send(10, 129, 0, 0).0, 101);
    rig.ok(133, 0, 0, 0);
    assert_eq!(rig.ggp(129, 0), 0);
}

#[test]
fn gp_132_tick_timer() {
    let mut rig = Rig::new();
    rig.pass_ms(1234);
    assert_eq!(rig.ggp(132, 0), 1234);
    rig.sgp(132, 0, 50);
    rig.pass_ms(7);
    assert_eq!(rig.ggp(132, 0), 57);
}

#[test]
fn gp_133_random() {
    let mut rig = Rig::new();
    let draw = |rig: &mut Rig| -> Vec<i32> { (0..8).map(|_| rig.ggp(133, 0)).collect() };
    rig.sgp(133, 0, 42);
    let first = draw(&mut rig);
    assert!(first.iter().all(|&number| number >= 0));
    assert!(first.windows(2).any(|pair| pair[0] != pair[1]));
    assert_ne!(draw(&mut rig), first);
    rig.sgp(133, 0, 42);
    assert_eq!(draw(&mut rig), first, "the seed decides");
}

#[test]
fn gp_255_suppress_reply() {
    let mut rig = Rig::new();
    let quiet = Request { address: 1, opcode: 9, kind: 255, motor: 0, value: 1 };
    assert_eq!(rig.bytes(Port::Usb, &quiet.emit().0), [0; 0]);
    let silent = Request { address: 1, opcode: 3, kind: 0, motor: 0, value: 0 };
    assert_eq!(rig.bytes(Port::Usb, &silent.emit().0), [0; 0]);
    assert_eq!(rig.gap(1), 0);
    assert_eq!(rig.ggp(255, 0), 1);
    assert_eq!(rig.ok(15, 0, 1, 0), 0);
    let loud = Request { address: 1, opcode: 9, kind: 255, motor: 0, value: 0 };
    let reply: [u8; 9] = rig.bytes(Port::Usb, &loud.emit().0).try_into().expect("a reply");
    assert_eq!(Frame(reply).0[2], 100);
    rig.bytes(Port::Usb, &quiet.emit().0);
    rig.device.power_cycle();
    assert_eq!(rig.ok(3, 0, 0, 0), 0, "0 again after a restart");
}

#[test]
fn user_variables() {
    let mut rig = Rig::new();
    for number in 0..=255 {
        rig.sgp(number, 2, i32::from(number) * -7);
        let storable = number < 56;
        let expected = if storable { 100 } else { WRONG_TYPE };
        assert_eq!(rig.send(11, number, 2, 0).0, expected, "STGP {number}");
        assert_eq!(rig.send(12, number, 2, 0).0, expected, "RSGP {number}");
    }
    rig.device.power_cycle();
    for number in 0..=255 {
        let kept = if number < 56 { i32::from(number) * -7 } else { 0 };
        assert_eq!(rig.ggp(number, 2), kept, "{number}");
    }
}

#[test]
fn bank_3_timers() {
    for timer in 0..3 {
        let mut rig = Rig::new();
        program(
            &mut rig,
            &format!(
                "VECT {timer}, Handler\nSGP {timer}, 3, 100\nEI {timer}\nEI 255\nLoop: JA Loop\n\
                 Handler: CALCV ADD, 9, 1\nRETI"
            ),
        );
        rig.ok(129, 1, 0, 0);
        rig.pass_ms(1050);
        assert_eq!(rig.ggp(9, 2), 10, "timer {timer}");
        assert_eq!(rig.ggp(timer, 3), 100);
        rig.sgp(timer, 3, 0);
        rig.pass_ms(1000);
        assert_eq!(rig.ggp(9, 2), 10, "off");
    }
}

#[test]
fn bank_3_triggers() {
    let pins = [(27, "STOP_L"), (28, "STOP_R"), (40, "STOP_L"), (41, "STOP_R"), (42, "HOME")];
    for (interrupt, pin) in pins {
        for (trigger, expected) in [(0, 0), (1, 1), (2, 1), (3, 2)] {
            let mut rig = Rig::new();
            rig.pin(pin, false);
            program(
                &mut rig,
                &format!(
                    "VECT {interrupt}, Handler\nSGP {interrupt}, 3, {trigger}\nEI {interrupt}\nEI 255\n\
                     Loop: WAIT TICKS, 0, 100\nJA Loop\nHandler: CALCV ADD, 9, 1\nRETI"
                ),
            );
            rig.ok(129, 1, 0, 0);
            rig.pass_ms(10);
            for on in [true, false] {
                rig.pin(pin, on);
                rig.pass_ms(10);
            }
            assert_eq!(rig.ggp(9, 2), expected, "interrupt {interrupt} trigger {trigger}");
        }
    }
    let mut rig = Rig::new();
    program(
        &mut rig,
        "VECT 39, Handler\nSGP 39, 3, 1\nEI 39\nEI 255\nLoop: JA Loop\nHandler: CALCV ADD, 9, 1\nRETI",
    );
    rig.ok(129, 1, 0, 0);
    rig.pass_ms(10);
    rig.analog("AIN0", 3000.0);
    rig.pass_ms(10);
    rig.analog("AIN0", 100.0);
    rig.pass_ms(10);
    assert_eq!(rig.ggp(9, 2), 1, "the analog input read digitally");
    assert_eq!(rig.ok(15, 0, 1, 0), 100);
}
