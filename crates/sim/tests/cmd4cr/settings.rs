//! Settings survive: exactly what table 2-19 names.

use crate::ascii::settings::{erased, every_item_is_stored, read, values, write};
use crate::rig::Rig;
use devices::ascii;
use devices::cmd4cr::table::COMMANDS;
use sim::SharedFlash;
use std::collections::BTreeSet;

/// Axes that follow something cannot follow something else.
pub const BEFORE_ITEMS: &str = "JENA=0 MPEZ=0";

/// Bit 4 of the configurable outputs is one, and as it is set.
pub const BEFORE_OTHERS: &str = "IOCFG=16 IOP=0";

/// Every item of table 2-19 with two values that are not its default; of the items of axes, of two axes.
pub const ITEMS: &[(&str, [&str; 2])] = &[
    ("DB", ["2", "5"]),
    ("DIP", ["1", "1"]),
    ("DOBOOT", ["5", "10"]),
    ("DOP", ["1", "1"]),
    ("EINT", ["0", "0"]),
    ("EOBOOT", ["1", "14"]),
    ("ERCX", ["1", "2"]),
    ("ERCU", ["3", "1"]),
    ("ERCDX", ["1", "2"]),
    ("ERCDU", ["3", "1"]),
    ("ERCPX", ["1", "2"]),
    ("ERCPU", ["6", "5"]),
    ("EXST", ["1", "1"]),
    ("ID", ["05", "99"]),
    ("IERR", ["1", "1"]),
    ("INPU", ["1", "1"]),
    ("IOBOOT", ["-1", "65536"]),
    ("IOCFG", ["-65536", "255"]),
    ("IOP", ["1", "2"]),
    ("JDELX", ["10", "11"]),
    ("JDELY", ["12", "13"]),
    ("JENA", ["1", "2"]),
    ("JLIM1", ["-1001", "-2001"]),
    ("JLIM2", ["-902", "-1902"]),
    ("JLIM3", ["903", "1903"]),
    ("JLIM4", ["1004", "2004"]),
    ("JLIM5", ["-1005", "-2005"]),
    ("JLIM6", ["-906", "-1906"]),
    ("JLIM7", ["907", "1907"]),
    ("JLIM8", ["1008", "2008"]),
    ("JMAXX", ["3000", "3001"]),
    ("JMAXY", ["3002", "3003"]),
    ("JMINX", ["300", "301"]),
    ("JMINY", ["302", "303"]),
    ("JSPDX", ["1000", "2000"]),
    ("JSPDY", ["1001", "2001"]),
    ("JTOLX", ["50", "60"]),
    ("JTOLY", ["51", "61"]),
    ("MPDX", ["1", "2047"]),
    ("MPDU", ["512", "513"]),
    ("MPEZ", ["1", "1"]),
    ("MPMX", ["2", "32"]),
    ("MPMU", ["3", "31"]),
    ("POLX", ["1", "131071"]),
    ("POLU", ["8", "0"]),
    ("SAP", ["1", "1"]),
    ("SDCX", ["1", "1"]),
    ("SDCU", ["1", "1"]),
    ("SDEX", ["1", "3"]),
    ("SDEU", ["3", "1"]),
    ("SLX", ["0", "0"]),
    ("SLAX", ["3", "4"]),
    ("SLAU", ["5", "6"]),
    ("SLEX", ["500", "501"]),
    ("SLEU", ["502", "503"]),
    ("SLOAD", ["1", "15"]),
    ("SLRX", ["2.500", "0.001"]),
    ("SLRU", ["999.999", "1.250"]),
    ("SLTX", ["5", "6"]),
    ("SLTU", ["7", "8"]),
    ("V0", ["1", "-1"]),
    ("V23", ["2147483647", "7"]),
    ("V99", ["-2147483648", "8"]),
    ("ZCNTX", ["1", "15"]),
    ("ZCNTU", ["2", "3"]),
];

/// What table 2-19 does not name.
pub const NOT_STORED: &[(&str, &str)] = &[
    ("ACC", "77"),
    ("ACCX", "78"),
    ("DEC", "79"),
    ("DECU", "80"),
    ("DO", "9"),
    ("EO", "3"),
    ("EU", "56"),
    ("HSPD", "5000"),
    ("HSPDX", "5001"),
    ("IO", "16"),
    ("LSPD", "50"),
    ("LSPDU", "51"),
    ("MPX", "57"),
    ("PU", "55"),
    ("PWM1", "5"),
    ("SCVX", "1"),
    ("SSPDMX", "2"),
    ("SYNCX", "1"),
    ("SYNMAXX", "10"),
    ("SYNMINX", "-10"),
    ("SYNPX", "11"),
];

#[test]
fn every_item_of_table_2_19_is_stored() {
    every_item_is_stored();
}

/// The table of commands says what is stored; the items above are all of it, and StepNLoop, which the joystick
/// switches off, has a test of its own.
#[test]
fn table_2_19_is_the_table_of_commands() {
    let stored = COMMANDS.iter().filter(|it| matches!(it.value, ascii::Value::Kept { stored: true, .. }));
    let stored: BTreeSet<_> = stored.map(|it| it.name).chain(["ID", "V"]).collect();
    let items: BTreeSet<_> = ITEMS
        .iter()
        .map(|(item, _)| {
            let name = item.trim_end_matches(|digit: char| digit.is_ascii_digit());
            let known = |name: &&str| stored.contains(name);
            Some(name).filter(known).or(name.get(..name.len() - 1)).expect("names are not empty")
        })
        .collect();
    assert_eq!(items, stored);
}

#[test]
fn closed_loops_are_stored() {
    let mut rig = Rig::new();
    rig.ok("SLX=1 SLU=1 STORE");
    rig.power_cycle();
    for (axis, on) in [("X", "1"), ("Y", "0"), ("Z", "0"), ("U", "1")] {
        rig.check(&format!("SL{axis}"), on);
        rig.check(&format!("SLS{axis}"), if on == "1" { "0" } else { "12" });
    }
}

/// A line that was answered is there after a cut, the last ones too.
#[test]
fn a_download_is_in_flash_at_once() {
    let flash = erased();
    let mut rig = Rig::on(flash.clone());
    rig.download("V1=5\nWHILE V1>0\nV1=V1-1\nENDWHILE\nEND");
    rig.ok("SA1799=END");
    let lines = |rig: &mut Rig| -> Vec<_> {
        [0, 1, 2, 3, 4, 5, 1799].map(|line| rig.say(&format!("SA{line}"))).to_vec()
    };
    let written = lines(&mut rig);
    assert_eq!(lines(&mut Rig::on(SharedFlash::from_bytes(flash.to_bytes()))), written);
}

/// All lines fit, and the settings beside them.
#[test]
fn a_full_program_and_all_settings_fit() {
    let flash = erased();
    let mut rig = Rig::on(flash.clone());
    for line in 0..1800 {
        rig.ok(&format!("SA{line}=END"));
    }
    for which in [0, 1, 0] {
        write(&mut rig, which);
        rig.ok("STORE");
    }
    let mut rig = Rig::on(flash);
    assert_eq!(read(&mut rig), values(0));
    rig.check("SA0", "END");
    rig.check("SA1799", "END");
    rig.check("SA1800", "?Invalid Index");
}
