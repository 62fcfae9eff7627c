//! One test for each axis parameter or group of them (manual, table 16).

use crate::rig::{MS, Rig};
use devices::{Parameter, pd42::axis_parameters as ap};
use protocol::tmcl::Status;

const WRONG_TYPE: u8 = Status::WRONG_TYPE.0;
const INVALID_VALUE: u8 = Status::INVALID_VALUE.0;

/// Pulses a second of a speed in internal units with pulse divisor 2.
fn pps(speed: i32) -> f64 {
    16e6 * f64::from(speed) / 4.0 / 65_536.0
}

fn driver_current(rig: &Rig) -> u8 {
    rig.device.drive("0").expect("there is one axis").current
}

/// A module whose motor runs at a steady speed.
fn running(speed: i32) -> Rig {
    let mut rig = Rig::new();
    rig.sap(5, 2000);
    rig.ok(1, 0, 0, speed);
    rig.pass_ms(200);
    assert_eq!(rig.gap(3), speed);
    rig
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
fn ap_6_run_current() {
    for (value, current) in [(0, 1), (7, 1), (8, 2), (100, 13), (128, 17), (255, 32)] {
        let mut rig = Rig::new();
        rig.sap(6, value);
        rig.ok(1, 0, 0, 500);
        rig.pass_ms(100);
        assert_eq!(driver_current(&rig), current, "{value}");
        assert_eq!(rig.gap(180), i32::from(current) - 1);
    }
}

#[test]
fn ap_7_standby_current() {
    let mut rig = Rig::new();
    rig.sap(7, 64);
    rig.sap(214, 30);
    rig.ok(1, 0, 0, 500);
    rig.pass_ms(500);
    rig.ok(3, 0, 0, 0);
    rig.until_rest();
    rig.pass_ms(297);
    assert_eq!(driver_current(&rig), 32, "still the run current");
    rig.pass_ms(5);
    assert_eq!(driver_current(&rig), 9, "standby");
    rig.ok(1, 0, 0, 500);
    assert_eq!(driver_current(&rig), 32);
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
fn ap_150_end_switch_power_down() {
    for (mode, current) in [(0, 32), (1, 5)] {
        let mut rig = Rig::with(|axis| axis.positive_limit = 5000);
        rig.sap(150, mode);
        rig.sap(214, 1);
        rig.ok(1, 0, 0, 1000);
        rig.until_rest();
        rig.pass_ms(100);
        assert_eq!(driver_current(&rig), current, "mode {mode}");
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
fn ap_160_and_161_steps() {
    let mut rig = Rig::new();
    rig.sap(140, 4);
    rig.sap(160, 1);
    assert_eq!(rig.device.drive("0").unwrap().parts, 16, "16 microsteps, each in 16 parts");
    rig.move_to(100);
    rig.until_rest();
    assert_eq!(rig.shaft(), 1600, "the way is the same");
    rig.sap(161, 1);
    rig.move_to(200);
    rig.until_rest();
    assert_eq!((rig.gap(1), rig.shaft()), (200, 1600 + 3200), "each microstep twice");
    rig.sap(140, 8);
    assert_eq!(rig.device.drive("0").unwrap().parts, 1, "interpolation needs 16 microsteps");
}

#[test]
fn chopper_parameters_are_kept() {
    let mut rig = Rig::new();
    for number in [162, 163, 164, 165, 166, 175, 176, 178, 184] {
        let entry = ap::TABLE.find(number).unwrap();
        for value in [entry.low, entry.high] {
            rig.sap(number, value);
            assert_eq!(rig.gap(number), value);
        }
    }
    assert_eq!(rig.gap(179), 1);
}

#[test]
fn ap_167_off_time_zero_frees_the_motor() {
    let mut rig = Rig::new();
    rig.sap(167, 0);
    assert_eq!(driver_current(&rig), 0);
    rig.move_to(1000);
    rig.until_rest();
    assert_eq!((rig.gap(1), rig.shaft()), (1000, 0), "pulses without a shaft");
    rig.sap(167, 5);
    assert_eq!(driver_current(&rig), 32);
}

#[test]
fn coolstep_follows_the_load() {
    let mut rig = running(1000);
    rig.sap(172, 4);
    rig.sap(170, 1);
    rig.sap(169, 3);
    rig.sap(171, 3);
    rig.pass_ms(500);
    assert_eq!(rig.gap(180), 15, "without load down to a half");
    rig.sap(168, 1);
    rig.pass_ms(500);
    assert_eq!(rig.gap(180), 7, "or a quarter");
    rig.device.set_load("0", 0.24).unwrap();
    rig.pass_ms(500);
    let loaded = rig.gap(180);
    assert!((8..=31).contains(&loaded), "more current with load: {loaded}");
    rig.device.set_load("0", 0.0).unwrap();
    rig.pass_ms(500);
    assert_eq!(rig.gap(180), 7);
    rig.sap(172, 0);
    rig.pass_ms(10);
    assert_eq!(rig.gap(180), 31, "off");
}

#[test]
fn ap_173_filter() {
    let mut rig = running(10);
    rig.sap(173, 1);
    rig.pass_ms(10_000);
    let before = rig.gap(206);
    rig.device.set_load("0", 0.5).unwrap();
    // One full step of 256 pulses at 610 a second: the mean moves by a quarter.
    rig.pass_ms(430);
    let after = rig.gap(206);
    assert!(before - after == 64, "{before} {after}");
}

#[test]
fn ap_174_threshold() {
    let mut rig = running(500);
    let zero = rig.gap(206);
    rig.sap(174, 20);
    rig.pass_ms(50);
    assert!(rig.gap(206) > zero, "less sensitive");
    rig.sap(174, -20);
    rig.pass_ms(50);
    assert!(rig.gap(206) < zero, "more sensitive");
}

#[test]
fn ap_181_stop_on_stall() {
    let mut rig = running(1000);
    rig.sap(181, 500);
    rig.pass_ms(100);
    assert_eq!(rig.gap(3), 1000, "no load, no stall");
    rig.device.set_load("0", 1.0).unwrap();
    rig.pass_ms(20);
    assert_eq!((rig.gap(3), rig.gap(207)), (0, 1));
    assert_eq!(rig.gap(207), 0, "read once");
    // Below the speed the motor goes on.
    rig.ok(1, 0, 0, 400);
    rig.pass_ms(200);
    assert_eq!(rig.gap(3), 400);
}

#[test]
fn ap_182_and_183_slow_run() {
    let mut rig = Rig::new();
    rig.sap(182, 300);
    rig.sap(183, 64);
    rig.ok(1, 0, 0, 200);
    rig.pass_ms(100);
    assert_eq!(rig.gap(180), 8, "slow run current");
    rig.ok(1, 0, 0, 600);
    rig.pass_ms(100);
    assert_eq!(rig.gap(180), 31);
}

/// End switches at −1000 and 2000, home from −200 to 0; the axis starts at 500.
fn stage() -> Rig {
    let mut rig = Rig::with(|axis| {
        (axis.negative_limit, axis.positive_limit) = (-1000, 2000);
    });
    rig.move_to(500);
    rig.until_rest();
    rig
}

fn search(rig: &mut Rig, mode: i32) {
    rig.sap(193, mode);
    rig.ok(13, 0, 0, 0);
    assert_ne!(rig.ok(13, 2, 0, 0), 0, "a search is on");
    for _ in 0..60_000 {
        rig.pass_ms(1);
        if rig.ok(13, 2, 0, 0) == 0 {
            assert_eq!((rig.gap(0), rig.gap(1), rig.gap(3)), (0, 0, 0), "mode {mode} ends at zero");
            return;
        }
    }
    panic!("mode {mode} does not end");
}

#[test]
fn ap_193_reference_search_modes() {
    for (mode, zero) in [
        (1, -1000),
        (2, -1000),
        (3, -1000),
        (4, -1000),
        (5, -100),
        (6, -100),
        (7, -100),
        (65, 2000),
        (66, 2000),
        (67, 1999),
        (68, 1999),
    ] {
        let mut rig = stage();
        search(&mut rig, mode);
        assert_eq!(rig.shaft(), zero, "mode {mode}");
    }
    // Mode 8 looks ahead only, and finds home from below.
    let mut rig = stage();
    rig.move_to(-500);
    rig.until_rest();
    search(&mut rig, 8);
    assert_eq!(rig.shaft(), -100);
    // An inverted home switch is off from -200 to 0.
    for mode in [133, 134, 135, 136] {
        let mut rig = stage();
        rig.pin("HOME", true);
        rig.sap(193, mode);
        rig.ok(13, 0, 0, 0);
        rig.pass_ms(50);
        assert_ne!(rig.gap(3), 0, "mode {mode} seeks an open switch");
        rig.pin("HOME", false);
        rig.pass_ms(5);
        rig.pin("HOME", true);
        rig.pass_ms(5);
        rig.ok(13, 1, 0, 0);
        assert_eq!((rig.gap(3), rig.ok(13, 2, 0, 0)), (0, 0), "stopped at once");
    }
    let mut rig = Rig::new();
    for mode in [0, 9, 64, 69, 127, 128, 132, 137] {
        assert_eq!(rig.send(5, 193, 0, mode).0, INVALID_VALUE, "mode {mode}");
    }
}

#[test]
fn ap_194_and_195_search_speeds() {
    let mut rig = stage();
    rig.sap(194, 321);
    rig.sap(195, 12);
    rig.sap(193, 1);
    rig.ok(13, 0, 0, 0);
    rig.pass_ms(30);
    assert_eq!(rig.gap(3), -321);
    for _ in 0..200 {
        rig.pass_ms(1);
        if rig.gap(11) == 1 {
            break;
        }
    }
    rig.pass_ms(1);
    assert!((1..=12).contains(&rig.gap(3)), "slowly off the switch: {}", rig.gap(3));
}

#[test]
fn ap_196_end_switch_distance() {
    for mode in [2, 3, 66] {
        let mut rig = stage();
        search(&mut rig, mode);
        assert_eq!(rig.gap(196), 3000, "mode {mode}");
    }
}

#[test]
fn ap_197_last_reference() {
    let mut rig = stage();
    search(&mut rig, 1);
    assert_eq!(rig.gap(197), -1000);
    search(&mut rig, 2);
    assert_eq!(rig.gap(197), 0);
}

#[test]
fn searches_ignore_disabled_switches_and_end_with_motion_commands() {
    let mut rig = stage();
    rig.sap(13, 1);
    search(&mut rig, 1);
    assert_eq!(rig.shaft(), -1000);
    rig.ok(13, 0, 0, 0);
    rig.move_to(100);
    assert_eq!(rig.ok(13, 2, 0, 0), 0);
    rig.until_rest();
    assert_eq!(rig.gap(1), 100);
}

#[test]
fn ap_200_boost_current() {
    let mut rig = Rig::new();
    rig.sap(6, 128);
    rig.sap(200, 255);
    rig.sap(5, 20);
    rig.ok(1, 0, 0, 1000);
    rig.pass_ms(20);
    assert_eq!(driver_current(&rig), 32, "while the speed changes");
    rig.pass_ms(2000);
    assert_eq!(driver_current(&rig), 17, "at constant speed");
    rig.ok(3, 0, 0, 0);
    rig.pass_ms(10);
    assert_eq!(driver_current(&rig), 32);
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
fn ap_204_freewheeling() {
    let mut rig = Rig::new();
    rig.sap(204, 50);
    rig.ok(1, 0, 0, 500);
    rig.pass_ms(100);
    rig.ok(3, 0, 0, 0);
    rig.until_rest();
    rig.pass_ms(490);
    assert_ne!(driver_current(&rig), 0);
    rig.pass_ms(20);
    assert_eq!(driver_current(&rig), 0);
}

#[test]
fn ap_206_load_value() {
    let mut rig = running(1000);
    let values: Vec<_> = [0.0, 0.25, 0.5, 0.75, 1.0]
        .map(|load| {
            rig.device.set_load("0", load).unwrap();
            rig.pass_ms(50);
            rig.gap(206)
        })
        .into();
    assert!(values.is_sorted_by(|a, b| a > b), "{values:?}");
    assert_eq!(values[4], 0);
}

#[test]
fn ap_207_extended_errors() {
    let mut rig = running(1000);
    rig.sap(181, 1);
    rig.device.set_load("0", 1.0).unwrap();
    rig.pass_ms(20);
    rig.device.set_load("0", 0.0).unwrap();
    rig.move_to(0);
    assert_eq!(rig.gap(207), 0, "a motion command clears it");
}

#[test]
fn ap_208_driver_flags() {
    let mut rig = Rig::new();
    rig.pass_ms(100);
    assert_eq!(rig.gap(208), 0x80, "standstill");
    let mut rig = running(1000);
    assert_eq!(rig.gap(208), 0);
    rig.device.set_load("0", 1.0).unwrap();
    rig.pass_ms(10);
    assert_eq!(rig.gap(208), 0x01, "stall");
    rig.device.set_load("0", 0.0).unwrap();
    rig.analog("TEMPERATURE", 120.0);
    rig.pass_ms(10);
    assert_eq!(rig.gap(208), 0x04, "warm");
    rig.analog("TEMPERATURE", 151.0);
    rig.pass_ms(100);
    assert_eq!(rig.gap(208), 0x86, "hot: the driver is off and the motor stands");
    assert_eq!(driver_current(&rig), 0);
    assert_eq!(rig.send(1, 0, 0, 100).0, Status::NOT_AVAILABLE.0);
    rig.analog("TEMPERATURE", 60.0);
    rig.ok(1, 0, 0, 100);
    rig.pass_ms(100);
    assert_eq!(rig.gap(208) & 0x80, 0);
    rig.sap(167, 0);
    rig.pass_ms(10);
    assert_eq!(rig.gap(208) & 0x60, 0x60, "no current flows");
}

#[test]
fn ap_177_short_protection() {
    for (pin, bit) in [("SHORT_A", 8), ("SHORT_B", 16)] {
        let mut rig = running(500);
        rig.pin(pin, true);
        rig.pass_ms(1);
        assert_eq!((rig.gap(3), rig.gap(208) & 0x7F, driver_current(&rig)), (0, bit, 0), "{pin}");
        assert_eq!(rig.send(1, 0, 0, 500).0, Status::NOT_AVAILABLE.0);
        rig.sap(177, 1);
        rig.ok(1, 0, 0, 500);
        rig.pass_ms(200);
        assert_eq!((rig.gap(3), rig.gap(208)), (500, 0), "not protected: {pin}");
        rig.sap(177, 0);
        assert_eq!(rig.gap(3), 0);
        rig.pin(pin, false);
        rig.ok(1, 0, 0, 500);
    }
}

#[test]
fn open_loads_show_while_the_motor_turns() {
    for (pin, bit) in [("OPEN_A", 0x20), ("OPEN_B", 0x40)] {
        let mut rig = Rig::new();
        rig.pin(pin, true);
        assert_eq!(rig.gap(208) & 0x60, 0, "{pin}");
        rig.ok(1, 0, 0, 500);
        rig.pass_ms(100);
        assert_eq!(rig.gap(208), bit, "{pin}");
    }
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
