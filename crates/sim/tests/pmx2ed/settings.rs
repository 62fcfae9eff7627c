//! Settings survive: what is stored, and a power cut at every single flash operation.

use crate::ascii::settings::{cut_everywhere, erased, every_item_is_stored, write};
use crate::rig::Rig;
use sim::SharedFlash;

/// The ratio is that of a loop that is off.
pub const BEFORE_ITEMS: &str = "SLX=0";

/// What is not stored needs no preparation.
pub const BEFORE_OTHERS: &str = "";

/// Every item of table 7.15 with two values that are not its default.
pub const ITEMS: &[(&str, [&str; 2])] = &[
    ("DOBOOT", ["5", "250"]),
    ("DB", ["2", "5"]),
    ("DN", ["2ED05", "2ED99"]),
    ("EDEC", ["1", "1"]),
    ("EOBOOT", ["1", "2"]),
    ("HCA", ["12", "-13"]),
    ("HCAX", ["1", "2"]),
    ("HCAY", ["3", "4"]),
    ("IERR", ["1", "1"]),
    ("JV1", ["1000", "2000"]),
    ("JV2", ["1001", "2001"]),
    ("JV3", ["102", "202"]),
    ("JV4", ["103", "203"]),
    ("JV5", ["14", "24"]),
    ("JV6", ["15", "25"]),
    ("JL1", ["-1001", "-2001"]),
    ("JL2", ["-902", "-1902"]),
    ("JL3", ["903", "1903"]),
    ("JL4", ["1004", "2004"]),
    ("JL5", ["-1005", "-2005"]),
    ("JL6", ["-906", "-1906"]),
    ("JL7", ["907", "1907"]),
    ("JL8", ["1008", "2008"]),
    ("LCA", ["99", "98"]),
    ("LCAX", ["97", "96"]),
    ("LCAY", ["95", "94"]),
    ("POLX", ["768", "0"]),
    ("POLY", ["513", "258"]),
    ("RZ", ["1", "1"]),
    ("SCVX", ["1", "1"]),
    ("SCVY", ["1", "1"]),
    ("SLRX", ["2.500", "0.001"]),
    ("SLRY", ["999.999", "1.250"]),
    ("SLX", ["1", "1"]),
    ("SLEX", ["500", "501"]),
    ("SLEY", ["502", "503"]),
    ("SLTX", ["5", "6"]),
    ("SLTY", ["7", "8"]),
    ("SLAX", ["3", "4"]),
    ("SLAY", ["5", "6"]),
    ("SLOAD", ["1", "3"]),
    ("TOC", ["10000", "20000"]),
    ("V32", ["1", "-1"]),
    ("V47", ["2147483647", "7"]),
    ("V63", ["-2147483648", "8"]),
];

/// What table 7.15 does not name.
pub const NOT_STORED: &[(&str, &str)] = &[
    ("HSPD", "5000"),
    ("LSPDX", "50"),
    ("ACC", "77"),
    ("DECY", "78"),
    ("SSPDMX", "2"),
    ("V0", "9"),
    ("V31", "9"),
    ("DO", "9"),
    ("EO", "3"),
    ("PX", "55"),
    ("EX", "56"),
];

#[test]
fn every_item_of_table_7_15_is_stored() {
    every_item_is_stored();
}

/// The joystick mask is a setting too, but cannot be read back as one.
#[test]
fn the_joystick_mask_is_stored() {
    let mut rig = Rig::new();
    rig.ok("JO=2 STORE");
    rig.power_cycle();
    assert_eq!((rig.get("MSTX") & 1024, rig.get("MSTY") & 1024), (0, 1024));
    rig.ok("JF STORE");
    rig.power_cycle();
    assert_eq!(rig.get("MSTY") & 1024, 0);
}

#[test]
fn a_store_on_a_worn_flash() {
    let flash = erased();
    let mut rig = Rig::on(flash.clone());
    // Far more than fits: the store has gone round more than once.
    for round in 0..1500 {
        rig.ok(&format!("V40={round} STORE"));
    }
    write(&mut rig, 0);
    rig.ok("STORE");
    cut_everywhere(&flash.to_bytes());
}

/// A line that was answered is there after a cut, and what was there before is whole.
#[test]
fn a_download_is_in_flash_at_once() {
    let program = "V1=5\nWHILE V1>0\nV1=V1-1\nENDWHILE\nEND";
    let flash = erased();
    let mut rig = Rig::on(flash.clone());
    rig.download("END");
    let start = flash.to_bytes();
    rig.download(program);
    let lines = |rig: &mut Rig| -> Vec<_> { (0..8).map(|line| rig.say(&format!("SA{line}"))).collect() };
    let (new, operations) = (lines(&mut rig), flash.operations());
    assert_eq!(lines(&mut Rig::on(flash)), new);
    for cut in 0..operations {
        let flash = SharedFlash::from_bytes(start.clone());
        let mut rig = Rig::on(flash.clone());
        let old = lines(&mut rig);
        flash.cut_after(cut);
        let answered =
            (0..8).take_while(|&line: &usize| rig.say(&format!("SA{line}={}", new[line])) == "OK").count();
        flash.restore_power();
        let found = lines(&mut Rig::on(flash));
        assert_eq!(found[..answered], new[..answered], "cut at {cut}");
        for line in answered..8 {
            assert!(found[line] == old[line] || found[line] == new[line], "cut at {cut}");
        }
    }
}
