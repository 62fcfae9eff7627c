//! The axis parameters of the driver stage: currents, steps, load, CoolStep, error flags (manual, table 16,
//! sections 7.2 and 7.3).

use crate::rig::{Rig, running};
use devices::pd42::axis_parameters as ap;
use protocol::tmcl::Status;

fn driver_current(rig: &Rig) -> u8 {
    rig.device.drive("0").expect("there is one axis").current
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

/// The load is a part of the torque that is left at the speed: 0.4 of all at standstill, of half at 500 full steps
/// a second, and more than there is at 900.
#[test]
fn the_load_value_follows_the_torque_at_the_speed() {
    let mut rig = Rig::with(|axis| {
        axis.pull_out = vec![[0.0, 1.0], [1000.0, 0.0]];
        axis.load = 0.4;
    });
    rig.sap(6, 255);
    rig.sap(154, 0);
    rig.sap(5, 500);
    let mut reading = |full_steps: i32| {
        // Pulses of 1/256 of a full step, and 244.14 of them a second for each unit.
        rig.ok(1, 0, 0, full_steps * 256 * 4096 / 1_000_000);
        rig.pass_ms(3000);
        rig.gap(206)
    };
    let readings = [100, 300, 500, 900].map(&mut reading);
    for (reading, expected) in readings.into_iter().zip([284, 219, 102, 0]) {
        assert!((reading - expected).abs() <= 4, "{readings:?}");
    }
    let (position, shaft) = (rig.device.axis(0).position, rig.shaft());
    assert!(i64::from(position) > shaft + 100_000, "it has stalled: {position}, {shaft}");
}
