//! One test for each axis parameter or group of them (manual, table 16).

use crate::rig::{MS, Rig, running};
use devices::{Parameter, pd42::axis_parameters as ap};
use protocol::tmcl::Status;

const WRONG_TYPE: u8 = Status::WRONG_TYPE.0;
const INVALID_VALUE: u8 = Status::INVALID_VALUE.0;

/// Pulses a second of a speed in internal units with pulse divisor 2.
fn pps(speed: i32) -> f64 {
    16e6 * f64::from(speed) / 4.0 / 65_536.0
}

#[test]
fn every_parameter_has_its_default_range_and_access() {
    for entry in ap::TABLE {
        let mut rig = Rig::new();
        let number = entry.number;
        // The measured ones are what the machine says.
        if entry.access.writable() {
            assert_eq!(rig.gap(number), entry.default, "{number}");
        }
        let outside = [entry.low.checked_sub(1), entry.high.checked_add(1)].into_iter().flatten();
        for value in outside.filter(|_| entry.access.writable()) {
            assert_eq!(rig.send(5, number, 0, value), (INVALID_VALUE, 0), "SAP {number} {value}");
            assert_eq!(rig.gap(number), entry.default, "a refused value changes nothing: {number}");
        }
        let expected = if entry.access.writable() { 100 } else { WRONG_TYPE };
        // Position registers start motions at their limits; those have tests of their own.
        if !(0..=2).contains(&number) {
            assert_eq!(rig.send(5, number, 0, entry.default).0, expected, "SAP {number}");
        }
        let expected = if entry.access.storable() { 100 } else { WRONG_TYPE };
        assert_eq!(rig.send(7, number, 0, 0).0, expected, "STAP {number}");
        assert_eq!(rig.send(8, number, 0, 0).0, expected, "RSAP {number}");
        assert_eq!(rig.send(6, number, 1, 0), (INVALID_VALUE, 0), "there is no motor 1: {number}");
    }
}

#[test]
fn other_numbers_are_a_wrong_type() {
    let mut rig = Rig::new();
    for number in (0..=255).filter(|&number| ap::TABLE.find(number).is_none()) {
        for opcode in [5, 6, 7, 8, 34] {
            assert_eq!(rig.send(opcode, number, 0, 0), (WRONG_TYPE, 0), "{opcode} {number}");
        }
    }
}

#[test]
fn every_storable_parameter_survives_a_restart() {
    let mut rig = Rig::new();
    let entries = || ap::TABLE.iter().filter(|entry| entry.access.storable());
    let other = |entry: &Parameter| if entry.default == entry.high { entry.low } else { entry.default + 1 };
    for entry in entries() {
        rig.sap(entry.number, other(entry));
        rig.ok(7, entry.number, 0, 0);
        rig.sap(entry.number, entry.default);
        rig.ok(8, entry.number, 0, 0);
        assert_eq!(rig.gap(entry.number), other(entry), "RSAP {}", entry.number);
        rig.sap(entry.number, entry.default);
    }
    rig.device.power_cycle();
    for entry in entries() {
        assert_eq!(rig.gap(entry.number), other(entry), "after a restart: {}", entry.number);
    }
}

#[test]
fn ap_0_target_position() {
    let mut rig = Rig::new();
    rig.sap(0, 20_000);
    assert_eq!((rig.gap(0), rig.gap(138), rig.gap(8)), (20_000, 0, 0));
    rig.until_rest();
    assert_eq!((rig.gap(1), rig.gap(8), rig.shaft()), (20_000, 1, 20_000));
}

#[test]
fn ap_1_actual_position() {
    let mut rig = Rig::new();
    rig.sap(1, -5000);
    assert_eq!((rig.gap(0), rig.gap(1)), (-5000, -5000));
    rig.pass_ms(1000);
    assert_eq!(rig.shaft(), 0, "setting the position moves nothing");
    rig.move_to(-4000);
    rig.until_rest();
    assert_eq!((rig.gap(1), rig.shaft()), (-4000, 1000));
}

#[test]
fn ap_2_target_speed() {
    let mut rig = Rig::new();
    rig.sap(2, -700);
    assert_eq!((rig.gap(2), rig.gap(138)), (-700, 2));
    rig.pass_ms(500);
    assert_eq!(rig.gap(3), -700);
    rig.sap(2, 0);
    rig.until_rest();
    assert!(rig.gap(1) < -10_000);
}

#[test]
fn ap_3_actual_speed() {
    let mut rig = running(1000);
    let from = rig.shaft();
    rig.pass_ms(1000);
    let moved = (rig.shaft() - from) as f64;
    assert!((moved - pps(1000)).abs() <= 1.0, "{moved}");
    rig.ok(2, 0, 0, 1000);
    rig.pass_ms(200);
    assert_eq!(rig.gap(3), -1000);
}

#[test]
fn ap_4_limits_positioning() {
    for speed in [250, 1000, 2047] {
        let mut rig = Rig::new();
        rig.sap(4, speed);
        rig.sap(5, 2047);
        rig.move_to(2_000_000);
        rig.pass_ms(1000);
        assert_eq!(rig.gap(3), speed);
        // It takes effect during the motion too.
        rig.sap(4, 300);
        rig.pass_ms(100);
        assert_eq!(rig.gap(3), 300);
        rig.move_to(2_000_000);
    }
}

#[test]
fn ap_5_acceleration() {
    for (acceleration, ramp_div) in [(500, 3), (100, 5), (2047, 7)] {
        let mut rig = Rig::new();
        rig.sap(5, acceleration);
        rig.sap(153, ramp_div);
        rig.ok(1, 0, 0, 2000);
        // v = a·t: half the speed after half the time.
        let per_second = 16e6 * f64::from(acceleration) / f64::from(1 << (ramp_div + 13));
        let half = (1000.0 / per_second * 16e6) as u64;
        let until = rig.device.now() + half;
        rig.device.advance(until);
        let speed = rig.gap(3);
        assert!((speed - 1000).abs() <= 3, "{speed} at half time of {acceleration}");
    }
}

#[test]
fn ap_8_position_reached() {
    let mut rig = Rig::new();
    assert_eq!(rig.gap(8), 1);
    rig.move_to(1000);
    assert_eq!(rig.gap(8), 0);
    rig.until_rest();
    assert_eq!(rig.gap(8), 1);
}

#[test]
fn ap_9_home_switch() {
    let mut rig = Rig::new();
    assert_eq!(rig.gap(9), 1, "home lies from -200 to 0");
    rig.move_to(1);
    rig.until_rest();
    assert_eq!(rig.gap(9), 0);
    rig.move_to(-200);
    rig.until_rest();
    assert_eq!(rig.gap(9), 1);
    rig.move_to(-201);
    rig.until_rest();
    assert_eq!(rig.gap(9), 0);
    rig.pin("HOME", true);
    assert_eq!(rig.gap(9), 1);
}

#[test]
fn ap_10_and_11_stop_switches() {
    let mut rig = Rig::new();
    assert_eq!((rig.gap(10), rig.gap(11)), (0, 0));
    rig.pin("STOP_R", true);
    assert_eq!((rig.gap(10), rig.gap(11)), (1, 0));
    rig.pin("STOP_L", true);
    assert_eq!((rig.gap(10), rig.gap(11)), (1, 1));
}

#[test]
fn stop_switches_block_their_direction_only() {
    let mut rig = Rig::with(|axis| (axis.negative_limit, axis.positive_limit) = (-3000, 5000));
    rig.ok(1, 0, 0, 1000);
    rig.pass_ms(1000);
    assert_eq!((rig.gap(1), rig.gap(3), rig.gap(10)), (5000, 0, 1), "at the pulse of the switch");
    rig.ok(1, 0, 0, 1000);
    rig.pass_ms(100);
    assert_eq!(rig.gap(1), 5000, "blocked");
    rig.ok(2, 0, 0, 1000);
    rig.pass_ms(2000);
    assert_eq!((rig.gap(1), rig.gap(11)), (-3000, 1), "the other way is free, up to the other end");
}

#[test]
fn ap_12_and_13_disable_switches() {
    let mut rig = Rig::with(|axis| (axis.negative_limit, axis.positive_limit) = (-3000, 5000));
    rig.sap(12, 1);
    rig.move_to(8000);
    rig.until_rest();
    assert_eq!((rig.gap(1), rig.gap(10)), (8000, 1));
    rig.move_to(-8000);
    rig.until_rest();
    assert_eq!(rig.gap(1), -3000);
    rig.sap(13, 1);
    rig.until_rest();
    assert_eq!(rig.gap(1), -8000, "freed, the move goes on");
}

#[test]
fn ap_130_stop_speed() {
    // The end of a ramp may be as fast as this, and so the move is shorter.
    let mut times = [1, 800].map(|stop| {
        let mut rig = Rig::new();
        rig.sap(130, stop);
        rig.sap(5, 20);
        rig.move_to(20_000);
        let time = rig.until_rest();
        assert_eq!(rig.gap(1), 20_000);
        time
    });
    times.reverse();
    assert!(times[0] + 50 < times[1], "{times:?}");
}

#[test]
fn ap_135_actual_acceleration() {
    let mut rig = Rig::new();
    rig.sap(5, 50);
    rig.ok(1, 0, 0, 1000);
    rig.pass_ms(20);
    assert_eq!(rig.gap(135), 50);
    rig.pass_ms(1000);
    assert_eq!(rig.gap(135), 0);
    rig.ok(3, 0, 0, 0);
    rig.pass_ms(20);
    assert_eq!(rig.gap(135), -50);
}

#[test]
fn ap_138_ramp_mode() {
    let mut rig = Rig::new();
    rig.ok(1, 0, 0, 100);
    assert_eq!(rig.gap(138), 2);
    rig.move_to(10_000);
    assert_eq!(rig.gap(138), 0);
    let trapezoid = rig.until_rest();
    rig.ok(3, 0, 0, 0);
    assert_eq!(rig.gap(138), 2);
    rig.sap(1, 0);
    rig.sap(138, 1);
    rig.move_to(10_000);
    assert_eq!(rig.gap(138), 1, "the soft approach stays selected");
    let soft = rig.until_rest();
    assert_eq!(rig.gap(1), 10_000);
    assert!(soft > trapezoid, "{soft} {trapezoid}");
}

#[test]
fn ap_140_microsteps() {
    for resolution in 0..=8 {
        let mut rig = Rig::new();
        rig.sap(140, resolution);
        rig.move_to(100);
        rig.until_rest();
        assert_eq!((rig.gap(1), rig.shaft()), (100, 100 << (8 - resolution)));
    }
}

#[test]
fn ap_149_soft_stop() {
    for (soft, beyond) in [(0, false), (1, true)] {
        let mut rig = Rig::with(|axis| axis.positive_limit = 20_000);
        rig.sap(149, soft);
        rig.ok(1, 0, 0, 1000);
        rig.until_rest();
        assert_eq!(rig.gap(1) > 20_000, beyond, "{}", rig.gap(1));
        assert_eq!(rig.gap(1) == 20_000, !beyond);
    }
}

#[test]
fn ap_153_and_154_divisors() {
    let mut rig = running(1000);
    rig.sap(154, 3);
    rig.pass_ms(100);
    let from = rig.shaft();
    rig.pass_ms(1000);
    let moved = (rig.shaft() - from) as f64;
    assert!((moved - pps(1000) / 2.0).abs() <= 1.0, "half the speed: {moved}");
    assert_eq!(rig.gap(3), 1000);
    // Sixteen times the ramp divisor's exponent step: sixteen times the time.
    let ramp = |divisor| {
        let mut rig = Rig::new();
        rig.sap(153, divisor);
        rig.ok(1, 0, 0, 1000);
        (1..).find(|_| {
            rig.pass_ms(1);
            rig.gap(3) == 1000
        })
    };
    let (fast, slow) = (ramp(5).unwrap(), ramp(9).unwrap());
    assert!((fast * 16_u64).abs_diff(slow) <= 16, "{fast} {slow}");
}

#[test]
fn ap_201_external_null_channel() {
    // A null every 4000 counts, one at 0; the motor stands behind it.
    let run = |functions| {
        let mut rig = Rig::new();
        rig.move_to(100);
        rig.until_rest();
        rig.sap(201, functions);
        rig.move_to(9000);
        rig.until_rest();
        rig.gap(216)
    };
    assert_eq!(run(0), 9000);
    let high = 16;
    assert!((4998..=5001).contains(&run(4 | high)), "cleared at the first null: {}", run(4 | high));
    assert!((998..=1001).contains(&run(4 | 8 | high)), "and at every one: {}", run(4 | 8 | high));
}

#[test]
fn ap_209_and_210_encoder() {
    let mut rig = Rig::new();
    rig.move_to(51_200);
    rig.until_rest();
    assert_eq!(rig.gap(209), 51_200, "a turn of 1024 counts, times 50");
    rig.sap(209, 7);
    assert_eq!(rig.gap(209), 7);
    rig.sap(210, 512);
    rig.move_to(0);
    rig.until_rest();
    assert_eq!(rig.gap(209), 7 - 1024, "counts as they are");
    // Other resolutions with their prescaler (manual, table 21).
    for (resolution, prescaler) in [(7, 12_800), (4, 1600), (2, 400)] {
        let mut rig = Rig::new();
        rig.sap(140, resolution);
        rig.sap(210, prescaler);
        rig.move_to(200 << resolution);
        rig.until_rest();
        assert_eq!(rig.gap(209), 200 << resolution);
    }
    // Clear on null: the shaft passes its absolute zero at each turn.
    let mut rig = Rig::new();
    rig.move_to(10_000);
    rig.until_rest();
    rig.sap(210, 25_600 + 4);
    rig.move_to(2 * 51_200 + 1000);
    rig.until_rest();
    assert_eq!(rig.gap(209), 1000);
}

#[test]
fn ap_212_deviation() {
    let mut rig = Rig::new();
    rig.sap(212, 500);
    rig.ok(1, 0, 0, 500);
    rig.pass_ms(500);
    assert_eq!(rig.gap(3), 500, "no deviation, no stop");
    // The shaft stalls.
    rig.device.set_load("0", 1.5).unwrap();
    rig.pass_ms(100);
    assert_eq!((rig.gap(3), rig.gap(207)), (0, 2));
    rig.sap(212, 0);
    rig.ok(1, 0, 0, 500);
    rig.pass_ms(100);
    assert_eq!(rig.gap(3), 500, "switched off");
}

#[test]
fn ap_215_absolute_value() {
    let mut rig = Rig::new();
    for (position, value) in [(0, 0), (25_600, 512), (51_200, 0), (51_150, 1023), (-50, 1023)] {
        rig.move_to(position);
        rig.until_rest();
        assert_eq!(rig.gap(215), value, "at {position}");
    }
    rig.sap(210, 512);
    rig.sap(209, 77);
    assert_eq!(rig.gap(215), 1023, "whatever the counter says");
}

#[test]
fn ap_216_and_217_external_encoder() {
    let mut rig = Rig::new();
    rig.move_to(3000);
    rig.until_rest();
    assert_eq!(rig.gap(216), 3000);
    rig.sap(216, 0);
    rig.sap(217, 64);
    rig.move_to(1000);
    rig.until_rest();
    assert_eq!(rig.gap(216), -500);
}

#[test]
fn ap_218_external_deviation() {
    let mut rig = Rig::new();
    rig.sap(218, 300);
    rig.ok(1, 0, 0, 500);
    rig.pass_ms(300);
    rig.device.push("0", -400).unwrap();
    let until = rig.device.now() + 2 * MS;
    rig.device.advance(until);
    assert_eq!((rig.gap(3), rig.gap(207)), (0, 2));
}
