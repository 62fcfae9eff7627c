//! Commands that a host sends and a program executes (manual, section 3.7).

use crate::rig::{Rig, start};
use protocol::tmcl::Status;

const INVALID_COMMAND: u8 = Status::INVALID_COMMAND.0;
const WRONG_TYPE: u8 = Status::WRONG_TYPE.0;
const INVALID_VALUE: u8 = Status::INVALID_VALUE.0;
const NOT_AVAILABLE: u8 = Status::NOT_AVAILABLE.0;

#[test]
fn rotating_left_and_right() {
    let mut rig = Rig::new();
    for (opcode, speed, actual) in [(1, 500, 500), (2, 500, -500), (1, -300, -300), (2, -300, 300)] {
        rig.ok(opcode, 0, 0, speed);
        rig.pass_ms(300);
        assert_eq!((rig.gap(3), rig.gap(2), rig.gap(138)), (actual, actual, 2));
    }
    for opcode in [1, 2] {
        for value in [2048, -2048, i32::MIN, i32::MAX] {
            assert_eq!(rig.send(opcode, 0, 0, value), (INVALID_VALUE, 0));
        }
        assert_eq!(rig.send(opcode, 0, 1, 100), (INVALID_VALUE, 0));
        rig.ok(opcode, 7, 0, 0);
    }
}

#[test]
fn rotation_is_not_bound_by_the_positioning_speed() {
    let mut rig = Rig::new();
    rig.sap(4, 100);
    rig.ok(1, 0, 0, 900);
    rig.pass_ms(300);
    assert_eq!(rig.gap(3), 900);
    rig.move_to(1_000_000);
    rig.pass_ms(300);
    assert_eq!(rig.gap(3), 100);
}

#[test]
fn stopping_takes_the_ramp() {
    let mut rig = Rig::new();
    rig.sap(5, 20);
    rig.ok(1, 0, 0, 1000);
    rig.pass_ms(2000);
    let before = rig.gap(1);
    rig.ok(3, 0, 0, 0);
    rig.pass_ms(10);
    assert!(rig.gap(3) > 0);
    rig.until_rest();
    assert!(rig.gap(1) > before + 1000);
    assert_eq!(rig.send(3, 0, 1, 0).0, INVALID_VALUE);
}

#[test]
fn moving_to_positions() {
    let mut rig = Rig::new();
    rig.ok(4, 0, 0, 1000);
    rig.until_rest();
    rig.ok(4, 1, 0, -300);
    rig.until_rest();
    assert_eq!((rig.gap(0), rig.gap(1)), (700, 700));
    rig.ok(30, 4, 0, -50);
    rig.ok(4, 2, 0, 4);
    rig.until_rest();
    assert_eq!(rig.gap(1), -50);
    assert_eq!(rig.send(4, 3, 0, 0).0, WRONG_TYPE);
    assert_eq!(rig.send(4, 2, 0, 21).0, INVALID_VALUE);
    assert_eq!(rig.send(4, 2, 0, -1).0, INVALID_VALUE);
    assert_eq!(rig.send(4, 0, 1, 0).0, INVALID_VALUE);
}

#[test]
fn a_relative_move_counts_from_the_actual_position() {
    let mut rig = Rig::new();
    rig.move_to(50_000);
    rig.pass_ms(300);
    let from = rig.gap(1);
    rig.ok(4, 1, 0, 0);
    assert_eq!(rig.gap(0), from);
    rig.until_rest();
    assert_eq!(rig.gap(1), from, "back after overshooting");
}

#[test]
fn positions_wrap_and_the_shorter_way_is_taken() {
    let mut rig = Rig::new();
    rig.sap(1, i32::MAX - 500);
    rig.move_to(i32::MIN + 500);
    rig.until_rest();
    assert_eq!((rig.gap(1), rig.shaft()), (i32::MIN + 500, 1001));
}

#[test]
fn changing_the_target_in_motion() {
    let mut rig = Rig::new();
    rig.move_to(100_000);
    rig.pass_ms(300);
    rig.move_to(-20_000);
    rig.pass_ms(1);
    assert!(rig.gap(3) > 0, "it must slow down first");
    rig.until_rest();
    assert_eq!((rig.gap(1), rig.shaft()), (-20_000, -20_000));
}

#[test]
fn coordinates() {
    let mut rig = Rig::new();
    for number in 0..=20 {
        rig.ok(30, number, 0, i32::from(number) * 1000 - 7);
        assert_eq!(rig.ok(31, number, 0, 0), i32::from(number) * 1000 - 7);
    }
    for opcode in [30, 31, 32, 39] {
        assert_eq!(rig.send(opcode, 21, 0, 0).0, WRONG_TYPE, "{opcode}");
        assert_eq!(rig.send(opcode, 1, 1, 0).0, INVALID_VALUE, "{opcode}");
    }
    rig.move_to(321);
    rig.until_rest();
    rig.ok(32, 3, 0, 0);
    assert_eq!(rig.ok(31, 3, 0, 0), 321, "captured");
    rig.ok(19, 9, 0, 77);
    rig.ok(39, 5, 0, 0);
    assert_eq!(rig.ok(31, 5, 0, 0), 77, "from the accumulator");
}

#[test]
fn coordinates_to_and_from_eeprom() {
    let mut rig = Rig::new();
    for number in 0..=20 {
        rig.ok(30, number, 0, 100 + i32::from(number));
    }
    rig.ok(30, 2, 255, 0);
    rig.device.power_cycle();
    assert_eq!(rig.ok(31, 2, 0, 0), 0, "in RAM only what is copied");
    rig.ok(31, 2, 255, 0);
    assert_eq!((rig.ok(31, 1, 0, 0), rig.ok(31, 2, 0, 0)), (0, 102));
    for number in 0..=20 {
        rig.ok(30, number, 0, 200 + i32::from(number));
    }
    rig.ok(30, 0, 255, 0);
    rig.device.power_cycle();
    rig.ok(31, 0, 255, 0);
    assert_eq!(rig.ok(31, 0, 0, 0), 0, "coordinate 0 is never stored");
    for number in 1..=20 {
        assert_eq!(rig.ok(31, number, 0, 0), 200 + i32::from(number));
    }
    assert_eq!(rig.send(30, 0, 255, 1).0, INVALID_VALUE);
}

#[test]
fn outputs() {
    let mut rig = Rig::new();
    for port in 0..2 {
        for value in [1, 0] {
            rig.ok(14, port, 2, value);
            assert_eq!(rig.ok(15, port, 2, 0), value);
            let name = format!("OUT{port}");
            assert_eq!(rig.device.read_pin(&name), Ok(sim::PinValue::Level(value == 1)));
        }
    }
    rig.ok(14, 255, 2, 3);
    assert_eq!((rig.ok(15, 0, 2, 0), rig.ok(15, 1, 2, 0)), (1, 1));
    rig.ok(19, 9, 0, 2);
    rig.ok(14, 255, 2, -1);
    assert_eq!((rig.ok(15, 0, 2, 0), rig.ok(15, 1, 2, 0)), (0, 1), "from the accumulator");
    for value in [0, 1] {
        rig.ok(14, 0, 0, value);
        assert_eq!(rig.device.read_pin("PULLUPS"), Ok(sim::PinValue::Level(value == 1)));
    }
    for (port, bank, value, status) in [
        (2, 2, 1, WRONG_TYPE),
        (1, 0, 1, WRONG_TYPE),
        (0, 2, 2, INVALID_VALUE),
        (0, 2, -1, INVALID_VALUE),
        (255, 2, 256, INVALID_VALUE),
        (255, 2, -2, INVALID_VALUE),
        (0, 1, 1, INVALID_VALUE),
        (0, 3, 1, INVALID_VALUE),
    ] {
        assert_eq!(rig.send(14, port, bank, value), (status, 0), "SIO {port}, {bank}, {value}");
    }
}

#[test]
fn inputs() {
    let mut rig = Rig::new();
    for pin in ["STOP_L", "STOP_R", "HOME"] {
        rig.pin(pin, false);
    }
    assert_eq!(rig.ok(15, 255, 0, 0), 0);
    for (port, pin) in [(1, "STOP_L"), (2, "STOP_R"), (3, "HOME")] {
        rig.pin(pin, true);
        assert_eq!((rig.ok(15, port, 0, 0), rig.ok(15, 255, 0, 0)), (1, 1 << port), "{pin}");
        rig.pin(pin, false);
    }
    rig.analog("AIN0", 2500.0);
    assert_eq!((rig.ok(15, 0, 1, 0), rig.ok(15, 0, 0, 0), rig.ok(15, 255, 0, 0)), (2500, 1, 1));
    rig.analog("AIN0", 302.0);
    assert_eq!((rig.ok(15, 0, 1, 0), rig.ok(15, 0, 0, 0)), (302, 0));
    assert_eq!((rig.ok(15, 8, 1, 0), rig.ok(15, 9, 1, 0)), (240, 25), "24.0 V, 25 °C");
    rig.analog("SUPPLY", 12.3);
    rig.analog("TEMPERATURE", 61.0);
    assert_eq!((rig.ok(15, 8, 1, 0), rig.ok(15, 9, 1, 0)), (123, 61));
    assert_eq!(rig.ok(15, 11, 0, 0), 1, "the shaft stands at its absolute zero");
    rig.move_to(10_000);
    rig.until_rest();
    assert_eq!(rig.ok(15, 11, 0, 0), 0);
    for (port, bank, status) in
        [(4, 0, WRONG_TYPE), (1, 1, WRONG_TYPE), (2, 2, WRONG_TYPE), (0, 3, INVALID_VALUE)]
    {
        assert_eq!(rig.send(15, port, bank, 0), (status, 0), "GIO {port}, {bank}");
    }
}

#[test]
fn from_the_accumulator() {
    let mut rig = Rig::new();
    rig.ok(19, 9, 0, 432);
    rig.ok(51, 0, 0, 0);
    rig.pass_ms(200);
    assert_eq!(rig.gap(3), 432);
    rig.ok(50, 0, 0, 0);
    rig.pass_ms(200);
    assert_eq!(rig.gap(3), -432);
    rig.ok(46, 0, 0, 0);
    rig.until_rest();
    assert_eq!(rig.gap(1), 432);
    rig.ok(46, 1, 0, 0);
    rig.until_rest();
    assert_eq!(rig.gap(1), 864);
    rig.ok(34, 4, 0, 0);
    assert_eq!(rig.gap(4), 432);
    rig.ok(35, 200, 2, 0);
    assert_eq!(rig.ggp(200, 2), 432);
    rig.ok(19, 9, 0, 2048);
    for opcode in [50, 51] {
        assert_eq!(rig.send(opcode, 0, 0, 0).0, INVALID_VALUE, "{opcode}");
    }
    assert_eq!(rig.send(46, 2, 0, 0).0, INVALID_VALUE, "no such coordinate");
    assert_eq!(rig.send(34, 4, 0, 0).0, INVALID_VALUE);
    assert_eq!(rig.gap(4), 432, "nothing changed");
}

#[test]
fn reading_in_direct_mode_leaves_the_accumulator_alone() {
    let mut rig = Rig::new();
    rig.ok(19, 9, 0, 55);
    rig.gap(4);
    rig.ggp(66, 0);
    rig.ok(15, 8, 1, 0);
    assert_eq!(rig.ok(135, 2, 0, 0), 55);
}

#[test]
fn calculating_in_direct_mode() {
    let mut rig = Rig::new();
    assert_eq!(rig.ok(19, 9, 0, 100), 100, "the operand comes back");
    rig.ok(19, 2, 0, -5000);
    assert_eq!(rig.ok(135, 2, 0, 0), -500_000);
    rig.ok(33, 9, 0, 0);
    assert_eq!(rig.ok(135, 3, 0, 0), -500_000, "X register");
    rig.ok(45, 9, 8, 12);
    rig.ok(45, 0, 8, 30);
    assert_eq!(rig.ggp(8, 2), 42);
}

#[test]
fn refused_everywhere() {
    let mut rig = Rig::new();
    for opcode in [0, 16, 17, 18, 29, 47, 52, 53, 54, 58, 63, 72, 79, 81, 127, 140, 254] {
        assert_eq!(rig.send(opcode, 0, 0, 0), (INVALID_COMMAND, 0), "{opcode}");
    }
    // Only in programs, or not in this firmware.
    for opcode in [21, 22, 23, 24, 27, 28, 38, 48, 49, 80].into_iter().chain(64..=71) {
        assert_eq!(rig.send(opcode, 0, 0, 0), (NOT_AVAILABLE, 0), "{opcode}");
    }
}

#[test]
fn reference_search_commands() {
    let mut rig = Rig::new();
    assert_eq!(rig.ok(13, 2, 0, 0), 0);
    rig.ok(13, 0, 0, 0);
    assert_ne!(rig.ok(13, 2, 0, 0), 0);
    rig.pass_ms(100);
    assert_ne!(rig.gap(3), 0);
    rig.ok(13, 1, 0, 0);
    assert_eq!((rig.ok(13, 2, 0, 0), rig.gap(3)), (0, 0));
    assert_eq!(rig.send(13, 3, 0, 0).0, WRONG_TYPE);
    assert_eq!(rig.send(13, 0, 1, 0).0, INVALID_VALUE);
    for (opcode, value) in [(3, 0), (1, 10), (2, 10), (4, 0)] {
        rig.ok(13, 0, 0, 0);
        rig.ok(opcode, 0, 0, value);
        assert_eq!(rig.ok(13, 2, 0, 0), 0, "ended by command {opcode}");
    }
}

#[test]
fn failing_commands_of_a_program_are_passed_over() {
    let mut rig = Rig::new();
    start(&mut rig, "SAP 5, 0, 10000\nSIO 3, 2, 1\nROL 0, 51200\nSGP 1, 2, 7\nSTOP");
    rig.pass_ms(1);
    assert_eq!((rig.ggp(1, 2), rig.gap(5), rig.gap(3)), (7, 500, 0));
}
