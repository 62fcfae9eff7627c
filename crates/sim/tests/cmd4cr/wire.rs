//! Framing, identity, identification numbers, and every command by its wire form.

use crate::controller::AXES;
use crate::rig::Rig;
use devices::Port;

#[test]
fn identity() {
    let mut rig = Rig::new();
    rig.check("ID", "01");
    rig.check("VER", "V126BL");
}

#[test]
fn framing() {
    let mut rig = Rig::new();
    let mut check = |bytes: &[u8], reply: &[u8]| {
        assert_eq!(rig.bytes(Port::Usb, bytes), reply, "{}", bytes.escape_ascii());
    };
    check(b"ID\r", b"01\r");
    check(b"ID\n", b"01\r");
    check(b"ID\0\0\0", b"01\r");
    check(b"@01ID\r", b"01\r");
    check(b"@00ID\r", b"");
    check(b"\r\n\r\n", b"");
    check(b"EO=3\rEO\r\n", b"OK\r3\r");
    check(b"id\r", b"?Unknown Command: id\r");
    // The manual's examples (3.2.2).
    check(b"@01POLX=7\r", b"OK\r");
    check(b"@01POLX\r", b"7\r");
    check(b"@01STORE\r", b"OK\r");
    // What is no text cannot be repeated.
    check(b"I\x07D\r", b"?Unknown Command: \r");
    check(&[b'V'; 200], b"");
    check(b"\r", b"?Unknown Command: \r");
    check(b"VER\r", b"V126BL\r");
}

/// On RS-485 only what is addressed to the device counts.
#[test]
fn identification_numbers() {
    let mut rig = Rig::new();
    assert_eq!(rig.bytes(Port::Rs485, b"ID\r"), b"");
    assert_eq!(rig.bytes(Port::Rs485, b"@01ID\r"), b"01\r");
    for wrong in ["ID=100", "ID=-1", "ID=", "ID=x", "ID=1.0"] {
        rig.check(wrong, "?Invalid Index");
    }
    rig.ok("ID=07");
    rig.check("ID", "07");
    // It takes effect at power-up, and only if it was stored.
    assert_eq!(rig.bytes(Port::Rs485, b"@07ID\r"), b"");
    assert_eq!(rig.bytes(Port::Rs485, b"@01ID\r"), b"07\r");
    rig.power_cycle();
    rig.check("ID", "01");
    rig.ok("ID=7 STORE");
    rig.power_cycle();
    rig.check("ID", "07");
    assert_eq!(rig.bytes(Port::Rs485, b"@07ID\r"), b"07\r");
    assert_eq!(rig.bytes(Port::Rs485, b"@01ID\r"), b"");
    assert_eq!(rig.bytes(Port::Usb, b"@01ID\r"), b"");
    assert_eq!(rig.bytes(Port::Usb, b"ID\r"), b"07\r");
}

/// Every setting of table 4-40 that is a number by itself: its default, two numbers that it takes, and two that
/// it does not. What each does is held by other tests.
#[test]
fn settings_by_their_wire_form() {
    const MAX: i64 = i32::MAX as i64;
    const MIN: i64 = i32::MIN as i64;
    const GLOBAL: &[(&str, i64, [i64; 2], [i64; 2])] = &[
        ("ACC", 300, [0, MAX], [-1, MAX + 1]),
        ("DB", 1, [1, 5], [0, 6]),
        ("DEC", 300, [0, MAX], [-1, MAX + 1]),
        ("DIP", 0, [0, 1], [-1, 2]),
        ("DO", 0, [0, 15], [-1, 16]),
        ("DOBOOT", 0, [0, 15], [-1, 16]),
        ("DOP", 0, [0, 1], [-1, 2]),
        ("EINT", 1, [0, 1], [-1, 2]),
        ("EO", 15, [0, 15], [-1, 16]),
        ("EOBOOT", 0, [0, 15], [-1, 16]),
        ("EXST", 0, [0, 1], [-1, 2]),
        ("HSPD", 1000, [1, 6_553_500], [0, 6_553_501]),
        ("IERR", 0, [0, 1], [-1, 2]),
        ("IO", 0, [MIN, MAX], [MIN - 1, MAX + 1]),
        ("IOBOOT", 0, [MIN, MAX], [MIN - 1, MAX + 1]),
        ("IOP", 0, [0, 3], [-1, 4]),
        ("JENA", 0, [0, 3], [-1, 4]),
        ("LSPD", 100, [1, 6_553_500], [0, 6_553_501]),
        ("PWM1", 50, [1, 99], [0, 100]),
        ("PWM2", 50, [1, 99], [0, 100]),
        ("SAP", 0, [0, 1], [-1, 2]),
        ("SLOAD", 0, [0, 15], [-1, 16]),
        ("SLOAD0", 0, [0, 1], [-1, 2]),
        ("SLOAD3", 0, [0, 1], [-1, 2]),
        ("V0", 0, [MIN, MAX], [MIN - 1, MAX + 1]),
        ("V99", 0, [MIN, MAX], [MIN - 1, MAX + 1]),
        ("JLIM1", 0, [MIN, MAX], [MIN - 1, MAX + 1]),
        ("JLIM8", 0, [MIN, MAX], [MIN - 1, MAX + 1]),
    ];
    const OF_AXES: &[(&str, i64, [i64; 2], [i64; 2])] = &[
        ("ACC", 0, [0, MAX], [-1, MAX + 1]),
        ("DEC", 0, [0, MAX], [-1, MAX + 1]),
        ("E", 0, [-134_217_728, 134_217_727], [-134_217_729, 134_217_728]),
        ("ERC", 0, [0, 3], [-1, 4]),
        ("ERCD", 0, [0, 3], [-1, 4]),
        ("ERCP", 0, [0, 6], [-1, 7]),
        ("HSPD", 0, [0, 6_553_500], [-1, 6_553_501]),
        ("INP", 0, [0, 1], [-1, 2]),
        ("LSPD", 0, [0, 6_553_500], [-1, 6_553_501]),
        ("MP", 0, [MIN, MAX], [MIN - 1, MAX + 1]),
        ("MPD", 2048, [1, 2048], [0, 2049]),
        ("MPE", 0, [0, 1], [-1, 2]),
        ("MPM", 1, [1, 32], [0, 33]),
        ("P", 0, [-134_217_728, 134_217_727], [-134_217_729, 134_217_728]),
        ("POL", 69_632, [0, 131_071], [-1, 131_072]),
        ("SCV", 0, [0, 1], [-1, 2]),
        ("SDC", 0, [0, 1], [-1, 2]),
        ("SDE", 0, [0, 3], [-1, 4]),
        ("SL", 0, [0, 1], [-1, 2]),
        ("SLA", 10, [0, MAX], [-1, MAX + 1]),
        ("SLE", 1000, [0, MAX], [-1, MAX + 1]),
        ("SLT", 10, [0, MAX], [-1, MAX + 1]),
        ("SSPDM", 0, [0, 7], [-1, 8]),
        ("SYNC", 0, [4, 12], [5, 13]),
        ("SYNC", 4, [3, 0], [-1, 7]),
        ("SYNMAX", 0, [MIN, MAX], [MIN - 1, MAX + 1]),
        ("SYNMIN", 0, [MIN, MAX], [MIN - 1, MAX + 1]),
        ("SYNP", 0, [MIN, MAX], [MIN - 1, MAX + 1]),
        ("ZCNT", 0, [0, 15], [-1, 16]),
    ];
    const JOYSTICK: &[(&str, i64, [i64; 2], [i64; 2])] = &[
        ("JDEL", 0, [0, 6_553_500], [-1, 6_553_501]),
        ("JMAX", 3300, [0, 3300], [-1, 3301]),
        ("JMIN", 0, [0, 3300], [-1, 3301]),
        ("JSPD", 0, [0, 6_553_500], [-1, 6_553_501]),
        ("JTOL", 0, [0, 3300], [-1, 3301]),
    ];
    let mut rig = Rig::new();
    rig.ok("IOCFG=-1");
    let mut check = |name: &str, default: i64, good: [i64; 2], bad: [i64; 2]| {
        rig.check(name, &default.to_string());
        for value in good.into_iter().rev() {
            rig.ok(&format!("{name}={value}"));
            rig.check(name, &value.to_string());
        }
        for value in bad {
            rig.check(&format!("{name}={value}"), "?Invalid Index");
        }
        for nonsense in ["", "x", "1.5", "0x1", "1 "] {
            rig.check(&format!("{name}={nonsense}"), "?Invalid Index");
        }
        rig.check(name, &good[0].to_string());
        rig.ok(&format!("{name}={}", if (good[0]..=good[1]).contains(&default) { default } else { good[0] }));
    };
    for &(name, default, good, bad) in GLOBAL {
        check(name, default, good, bad);
    }
    for axis in AXES {
        for &(name, default, good, bad) in OF_AXES {
            check(&format!("{name}{axis}"), default, good, bad);
        }
    }
    for axis in ["X", "Y"] {
        for &(name, default, good, bad) in JOYSTICK {
            check(&format!("{name}{axis}"), default, good, bad);
        }
    }
    for name in ["JMAXZ", "JSPDU", "JTOLZ=1"] {
        rig.check(name, &format!("?Unknown Command: {name}"));
    }
}

/// The ratio has three decimals.
#[test]
fn the_ratio_by_its_wire_form() {
    let mut rig = Rig::new();
    let mut check = |value: &str, reply: &str| {
        rig.ok(&format!("SLRU={value}"));
        rig.check("SLRU", reply);
    };
    check("0.001", "0.001");
    check("999.999", "999.999");
    check("2.5", "2.500");
    check("3", "3.000");
    for wrong in ["0", "1000", "0.0001", "-1", "1.2.3", ""] {
        rig.check(&format!("SLRU={wrong}"), "?Invalid Index");
    }
    rig.check("SLRU", "3.000");
}

/// What can only be read, and what can only be written or done.
#[test]
fn access_by_the_wire_form() {
    let mut rig = Rig::new();
    let reads = [
        ("AI1", "1650"),
        ("BSTAT", "0:0:0:100"),
        ("DI", "0"),
        ("DI4", "0"),
        ("DU", "0"),
        ("EP", "0:0:0:0"),
        ("LTEU", "0"),
        ("LTPU", "0"),
        ("LTSU", "0"),
        ("MM", "0"),
        ("PP", "0:0:0:0"),
        ("PSU", "0"),
        ("SASTAT3", "0"),
        ("SLSU", "12"),
        ("SPC3", "0"),
        ("SYNSU", "0"),
        ("VER", "V126BL"),
    ];
    for (name, value) in reads {
        rig.check(name, value);
        rig.check(&format!("{name}=1"), &format!("?Unknown Command: {name}=1"));
    }
    for name in
        ["LTX", "SACTRL0", "SSPD", "SSPDX", "STORE=1", "ABORT=1", "X100=1", "CLRX=1", "SYNOX=1", "GS1=1"]
    {
        rig.check(name, &format!("?Unknown Command: {name}"));
    }
}

/// `ERCD` and `ERCP` without an axis read X and set all; some others mean X (manual, 4.3.7 and 4.3.8).
#[test]
fn axes_left_out() {
    let mut rig = Rig::new();
    for name in ["ERCD", "ERCP"] {
        rig.ok(&format!("{name}=3"));
        for axis in AXES {
            rig.check(&format!("{name}{axis}"), "3");
        }
        rig.ok(&format!("{name}X=1"));
        rig.check(name, "1");
        rig.check(&format!("{name}U"), "3");
    }
    rig.ok("SSPDM=2");
    rig.check("SSPDMX", "2");
    rig.check("SSPDM", "2");
    rig.check("SSPDMY", "0");
    rig.ok("SYNCX=1 SYNPX=5 SYNO");
    rig.check("SYNSX", "1");
    rig.check("SYNSY", "0");
    for name in ["SYNF", "CLR", "J+", "ZMOVE+", "POL", "P=1", "E", "MST", "INP=1"] {
        rig.check(name, &format!("?Unknown Command: {name}"));
    }
}
