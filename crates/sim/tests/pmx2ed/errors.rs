//! Every error of table 9.1 in the situation that it names. Nothing has changed after it.

use crate::rig::Rig;

#[test]
fn unknown_commands_are_repeated() {
    let mut rig = Rig::new();
    for line in ["x1000", "HELLO", "PX =5", " PX", "JOYENA=3", "REL", "SASTAT2x", "=", "@0ID", "?"] {
        rig.check(line, &format!("?{line}"));
    }
    rig.check("PX", "0");
}

#[test]
fn a_target_is_changed_only_during_a_move() {
    let mut rig = Rig::new();
    rig.check("TX500", "?ABS/INC is not in operation");
    rig.check("PX", "0");
    assert!(!rig.moves("X"));
    // Only for moves of one axis.
    rig.ok("I3000:3000");
    rig.pass_ms(100);
    rig.check("TX100", "?ABS/INC is not in operation");
    rig.until_rest();
    rig.ok("JX+");
    rig.check("TX100", "?ABS/INC is not in operation");
    rig.ok("ABORT X1000");
    rig.pass_ms(10);
    rig.ok("STOPX");
    rig.check("TX100", "?ABS/INC is not in operation");
    rig.check("T100", "?T100");
}

#[test]
fn indices_out_of_range() {
    let mut rig = Rig::new();
    let wrong = [
        "V64", "V64=1", "V999999", "SA1275", "SA1275=x", "GS32", "DI9", "DO0", "EO3", "AI3", "JL9", "JV7",
        "SR2=1",
    ];
    for line in wrong {
        rig.check(line, "?Index out of Range");
    }
}

#[test]
fn values_out_of_range() {
    let mut rig = Rig::new();
    let wrong = [
        "DB=0",
        "DB=6",
        "RZ=2",
        "SLOAD=4",
        "POLX=16384",
        "SSPDMX=10",
        "SLRX=0",
        "SLRX=1000",
        "SLRX=1.2345",
        "TOC=-1",
        "V1=",
        "V1=abc",
        "V1=2147483648",
        "SR0=4",
        "SLX=2",
        "JO=4",
        "JV5=5001",
        "SAP=2",
    ];
    for line in wrong {
        let (name, _) = line.split_once('=').expect("all are assignments");
        let before = if name.starts_with("SR") { String::new() } else { rig.say(name) };
        rig.check(line, "?Invalid Answer");
        if !before.is_empty() && name != "JO" {
            rig.check(name, &before);
        }
    }
}
