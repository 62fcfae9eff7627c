//! Inputs and outputs, motor power, polarities, encoders.

use crate::ascii::io::{inputs, outputs};
use crate::rig::Rig;

#[test]
fn digital_inputs_and_outputs() {
    let mut rig = Rig::new();
    inputs(&mut rig, 8);
    outputs(&mut rig, 8);
    rig.ok("DO=165");
    rig.check("DO", "165");
    rig.check("DO1", "1");
    rig.check("DO2", "0");
    for wrong in ["DO=256", "DO=-1", "DO1=2", "DO=", "DO=x"] {
        rig.check(wrong, "?Invalid Answer");
    }
    for wrong in ["DI0", "DI9", "DO0", "DO9", "DO9=1", "AI0", "AI3"] {
        rig.check(wrong, "?Index out of Range");
    }
    rig.check("DI=3", "?DI=3");
    rig.check("DO", "165");
}

#[test]
fn boot_values() {
    let mut rig = Rig::new();
    rig.ok("DOBOOT=129 EOBOOT=2");
    rig.check("DOBOOT", "129");
    rig.check("EOBOOT", "2");
    rig.check("DO", "0");
    rig.check("DOBOOT=256", "?Invalid Answer");
    rig.check("EOBOOT=4", "?Invalid Answer");
    rig.power_cycle();
    rig.check("DO", "0");
    rig.check("EO", "0");
    rig.ok("DOBOOT=129 EOBOOT=2 STORE");
    rig.power_cycle();
    rig.pass_ms(1);
    assert!(rig.level("DO1") && rig.level("DO8") && !rig.level("DO2"));
    assert!(!rig.level("EO1") && rig.level("EO2"));
    rig.check("DO", "129");
    rig.check("EO", "2");
}

#[test]
fn polarities() {
    let mut rig = Rig::new();
    rig.check("POLX", "512");
    // Away from home and index.
    rig.run("X1000");
    let word = |bit: u32| 512 | 1 << bit;
    // Home, limits and index of an axis are its own.
    let mut check = |bit: u32, status: i32| {
        rig.ok(&format!("POLX={}", word(bit)));
        let with = rig.get("MSTX");
        assert_eq!(with & 0x270, status, "bit {bit}");
        rig.ok("POLX=512");
        assert_eq!(rig.get("MSTX") & 0x270, 0);
    };
    check(5, 1 << 6);
    check(6, 1 << 4 | 1 << 5);
    check(7, 1 << 9);
    check(0, 0);
    // Inputs, outputs and the return rule belong to both axes.
    rig.ok("POLX=1536");
    rig.check("DI", "255");
    rig.check("POLY", "1536");
    rig.ok("POLX=512 DO=1");
    assert!(rig.level("DO1") && !rig.level("DO2"));
    rig.ok("POLY=2560");
    assert!(!rig.level("DO1") && rig.level("DO2"));
    rig.check("POLX", "2560");
    rig.check("DO", "1");
    rig.ok("POLX=512 SAP=1");
    rig.check("POLX", "8704");
    rig.check("POLY", "8704");
    rig.ok("POLY=512");
    rig.check("SAP", "0");
    // The enable output.
    rig.ok("POLX=4608");
    assert!(!rig.level("EO1") && rig.level("EO2"));
    rig.ok("POLX=512");
    // The direction of the motor.
    let before = rig.shaft("X");
    rig.ok("POLX=514");
    rig.run("X1100");
    assert_eq!(rig.shaft("X"), before - 100);
    rig.check("POLX=16384", "?Invalid Answer");
    rig.check("POLX=-1", "?Invalid Answer");
    rig.check("POLX", "514");
}

#[test]
fn encoder_decoding_and_polarity() {
    let mut rig = Rig::new();
    // The machine has a count a pulse at fourfold decoding.
    let mut check = |word: i32, counts: i32| {
        rig.ok(&format!("POLX={word}"));
        rig.ok("EX=0 INC");
        rig.run("X1000");
        assert_eq!(rig.get("EX"), counts, "word {word}");
    };
    check(0, 250);
    check(1 << 8, 500);
    check(2 << 8, 1000);
    check(3 << 8, 1000);
    rig.ok("POLX=512 EX=-5");
    rig.check("EX", "-5");
    // Another decoding goes on from where the counter is.
    rig.ok("EX=100 POLX=0");
    rig.check("EX", "100");
    rig.run("X-400");
    rig.check("EX", "0");
    rig.ok("EX=2147483647");
    rig.check("EX", "2147483647");
    rig.check("EX=2147483648", "?Invalid Answer");
    // It begins at 0, wherever the shaft is.
    assert_ne!(rig.shaft("X"), 0);
    rig.power_cycle();
    rig.check("EX", "0");
}
