//! Inputs and outputs, motor power, polarities, encoders.

use crate::ascii::io::{inputs, outputs};
use crate::controller::AXES;
use crate::rig::Rig;
use sim::PinValue;

/// The factory's polarity word.
const POL: i32 = 2 << 11 | 2 << 15;

#[test]
fn digital_inputs() {
    let mut rig = Rig::new();
    inputs(&mut rig, 4);
    rig.ok("DIP=1");
    rig.check("DI", "15");
    rig.pin("DI2", true);
    rig.check("DI", "13");
    rig.check("DI2", "0");
    rig.check("DI0", "?Invalid Index");
    rig.check("DI5", "?Invalid Index");
    rig.check("DI=3", "?Unknown Command: DI=3");
}

#[test]
fn digital_outputs() {
    let mut rig = Rig::new();
    outputs(&mut rig, 4);
    rig.ok("DO=5");
    let levels = |rig: &Rig| [1, 2, 3, 4].map(|bit| rig.level(&format!("DO{bit}")));
    assert_eq!(levels(&rig), [true, false, true, false]);
    rig.ok("DOP=1");
    assert_eq!(levels(&rig), [false, true, false, true]);
    rig.check("DO", "5");
    for wrong in ["DO=16", "DO=-1", "DO1=2", "DO=", "DO0=1", "DO5=1", "DO5"] {
        rig.check(wrong, "?Invalid Index");
    }
    rig.check("DO", "5");
}

#[test]
fn configurable_io() {
    let mut rig = Rig::new();
    rig.check("IOCFG", "0");
    rig.check("IO", "0");
    // All are inputs.
    for bit in [1, 2, 16, 31, 32] {
        let input = format!("IO{bit}");
        rig.pin(&input, true);
        rig.check(&input, "1");
        rig.check("IO", &(1i32 << (bit - 1)).to_string());
        rig.pin(&input, false);
    }
    // The upper half are outputs.
    rig.ok("IOCFG=-65536 IO=-1");
    rig.check("IO", "-65536");
    assert!(rig.level("IO17") && rig.level("IO32") && !rig.level("IO16"));
    assert!(rig.device.drive_pin("IO17", PinValue::Level(false)).is_err());
    rig.pin("IO3", true);
    rig.check("IO", "-65532");
    rig.ok("IO=0 IO17=1");
    rig.check("IO", "65540");
    rig.check("IO17", "1");
    rig.check("IO18", "0");
    assert!(rig.level("IO17") && !rig.level("IO18"));
    // An input remembers what it is to be, and is it once it is an output.
    rig.pin("IO3", false);
    rig.ok("IO5=1");
    rig.check("IO5", "0");
    rig.ok("IOCFG=16");
    rig.check("IO", "16");
    assert!(rig.level("IO5") && !rig.level("IO17"));
    // Each direction has a logic of its own.
    rig.ok("IOP=1");
    rig.check("IO", "-1");
    assert!(rig.level("IO5"));
    rig.ok("IOP=2");
    rig.check("IO", "16");
    assert!(!rig.level("IO5"));
    rig.ok("IOP=0");
    for wrong in ["IO0", "IO33", "IO33=1", "IO5=2", "IO=4294967296", "IOP=4", "IO="] {
        rig.check(wrong, "?Invalid Index");
    }
    rig.check("IO", "16");
}

/// The setting of PWM1 is how long it is low, that of PWM2 how long it is high.
#[test]
fn pwm_outputs() {
    let mut rig = Rig::new();
    rig.pass_ms(1);
    let duty = |rig: &Rig, name| rig.device.read_pin(name).expect("a pin");
    assert_eq!(duty(&rig, "PWM1"), PinValue::Number(50.0));
    rig.ok("PWM1=20 PWM2=30");
    assert_eq!(duty(&rig, "PWM1"), PinValue::Number(80.0));
    assert_eq!(duty(&rig, "PWM2"), PinValue::Number(30.0));
    rig.check("PWM1", "20");
    for wrong in ["PWM1=0", "PWM2=100", "PWM0=5", "PWM3", "PWM1="] {
        rig.check(wrong, "?Invalid Index");
    }
    assert!(rig.device.drive_pin("PWM1", PinValue::Number(1.0)).is_err());
}

#[test]
fn boot_values() {
    let mut rig = Rig::new();
    rig.ok("DOBOOT=9 EOBOOT=2 IOBOOT=-1 IOCFG=3");
    rig.check("DO", "0");
    rig.check("IO", "0");
    rig.power_cycle();
    rig.check("DO", "0");
    rig.check("EO", "0");
    rig.ok("DOBOOT=9 EOBOOT=2 IOBOOT=-1 IOCFG=3 STORE");
    rig.power_cycle();
    rig.pass_ms(1);
    assert!(rig.level("DO1") && rig.level("DO4") && !rig.level("DO2"));
    assert!(!rig.level("EO1") && rig.level("EO2"));
    assert!(rig.level("IO1") && rig.level("IO2") && !rig.level("IO3"));
    rig.check("DO", "9");
    rig.check("EO", "2");
    rig.check("IO", "3");
    // It is for those that were outputs at power-up.
    rig.ok("IOCFG=7");
    rig.check("IO", "3");
}

/// The bits of table 2-17 that invert inputs, by the bits of the status word that show them.
#[test]
fn polarities() {
    let mut rig = Rig::new();
    rig.check("POLX", &POL.to_string());
    // Away from home and index.
    for axis in AXES {
        rig.run(&format!("{axis}1000"));
        let mut check = |bit: u32, status: i32| {
            const SHOWN: i32 = 0b0010_1000_1111_1000;
            let before = rig.get(&format!("MST{axis}")) & SHOWN;
            rig.ok(&format!("POL{axis}={}", POL | 1 << bit));
            assert_eq!(rig.get(&format!("MST{axis}")) & SHOWN, before ^ status, "bit {bit}");
            rig.ok(&format!("POL{axis}={POL}"));
            assert_eq!(rig.get(&format!("MST{axis}")) & SHOWN, before);
        };
        check(3, 1 << 4 | 1 << 5);
        check(4, 1 << 6);
        check(5, 1 << 3);
        check(6, 1 << 7);
        check(7, 1 << 11);
        check(13, 1 << 13);
        for other in [0, 1, 2, 8, 9, 10, 14] {
            check(other, 0);
        }
    }
    // Of one axis only.
    rig.ok(&format!("POLX={}", POL | 1 << 3));
    assert_eq!((rig.get("MSTX") & 48, rig.get("MSTY") & 48), (48, 0));
    // The outputs: error clear and enable. EO 1 is motor power in any case.
    rig.ok(&format!("POLX={}", POL | 1 << 8 | 1 << 9));
    assert!(rig.level("ERCX") && !rig.level("ERCY"));
    assert!(!rig.level("EO1") && rig.level("EO2"));
    rig.run("X1100");
    assert_eq!(rig.shaft("X"), 1100);
    rig.check("EO", "15");
}

/// Bits 0 to 2: a driver that was wired for mode 0 turns the other way where direction or phases are inverted.
#[test]
fn pulse_output_modes() {
    let mut rig = Rig::new();
    rig.ok("INC");
    for (mode, way) in [(0, 1), (1, 1), (2, -1), (3, -1), (4, 1), (5, 1), (6, -1), (7, 1)] {
        rig.ok(&format!("POLY={}", POL | mode));
        let before = rig.shaft("Y");
        rig.run("Y100");
        assert_eq!(rig.shaft("Y") - before, 100 * way, "mode {mode}");
    }
}

#[test]
fn encoder_inputs() {
    let mut rig = Rig::new();
    // The machine has a count a pulse at fourfold counting.
    let mut check = |mode: i32, counts: i32| {
        rig.ok(&format!("POLZ={mode} EZ=0 INC"));
        rig.run("Z1000");
        assert_eq!(rig.get("EZ"), counts, "mode {mode}");
        // The other way round.
        rig.ok(&format!("POLZ={} EZ=0", mode | 1 << 10));
        rig.run("Z-1000");
        assert_eq!(rig.get("EZ"), counts, "mode {mode}");
    };
    check(0, 250);
    check(1 << 11, 500);
    check(2 << 11, 1000);
    check(3 << 11, 1000);
    // Another way of counting goes on from where the counter is.
    rig.ok(&format!("POLZ={POL} EZ=100 POLZ=0"));
    rig.check("EZ", "100");
    rig.run("Z-400");
    rig.check("EZ", "0");
    rig.ok("EZ=134217727");
    rig.check("EZ", "134217727");
    rig.check("EZ=134217728", "?Invalid Index");
    // The way of counting is a setting.
    rig.ok(&format!("POLZ={} STORE", 1 << 10 | 1 << 11));
    rig.power_cycle();
    rig.ok("EO=15");
    rig.run("Z-1000");
    rig.check("EZ", "500");
}

#[test]
fn positions_are_set_and_read() {
    let mut rig = Rig::new();
    rig.check("PP", "0:0:0:0");
    rig.ok("PX=1 PY=-2 PZ=134217727 PU=-134217728 EX=5 EY=-6 EZ=7 EU=-8");
    rig.check("PP", "1:-2:134217727:-134217728");
    rig.check("EP", "5:-6:7:-8");
    rig.ok("PZ=0");
    rig.run("X11");
    rig.check("PP", "11:-2:0:-134217728");
    rig.check("EP", "15:-6:7:-8");
    // Axes go no further than their counters, which have 28 bits.
    for command in ["X134217728", "X-134217729", "PX=134217728", "X0Y200000000", "CIRXYP134217728:0"] {
        rig.check(command, "?Invalid Index");
    }
    rig.ok("BO");
    rig.check("I0:0:134217728:1000", "?Invalid Index");
    rig.ok("BF INC");
    rig.check("X134217717", "?Invalid Index");
    // The counter is that of the pulses; the shaft knows nothing of it.
    assert_eq!(rig.shaft("X"), 10);
}
