//! Every error of table 4-41 in the situation that it names. Nothing has changed after it.

use crate::rig::Rig;

#[test]
fn unknown_commands_are_repeated() {
    let mut rig = Rig::new();
    let longest = "X".repeat(64);
    for line in ["x1000", "HELLO", "PX =5", " PX", "DN", "TOC=5", "SR0=1", "=", "@0ID", "?", "CLR", &longest]
    {
        rig.check(line, &format!("?Unknown Command: {line}"));
    }
    rig.check("PX", "0");
}

#[test]
fn axes_that_move_take_no_other_motion() {
    let mut rig = Rig::new();
    rig.ok("JX+");
    rig.pass_ms(100);
    for line in ["X0", "JX+", "JX-", "HX+0", "ZMOVEX+", "X0Y0", "CIRXYP0:10", "ARCZXN0:5:0", "PX=0", "SLX=1"]
    {
        rig.check(line, "?Error Moving");
    }
    assert!(rig.moves("X") && !rig.moves("Y") && !rig.moves("Z"));
    // Others are free.
    rig.ok("Y100 CIRZUP0:100");
    rig.pass_ms(10);
    rig.check("CIRTP0:100:50", "?Error Moving");
    rig.ok("ABORT");
    assert!(!rig.moves("X"));
}

/// An error that was not cleared is in the way of every motion of its axis.
#[test]
fn an_error_is_cleared_before_the_next_motion() {
    let mut rig = Rig::with(|axis| axis.positive_limit = 500);
    rig.run("X900");
    assert_eq!(rig.get("MSTX") & 0x330, 0x110);
    rig.check("JX-", "?Error Moving");
    rig.check("X900", "?Error +Limit");
    rig.ok("CLRX JX-");
    rig.pass_ms(100);
    rig.ok("ABORT");
    // In the other direction it may move, though the switch is on.
    assert!(rig.get("PX") < 500);
}

#[test]
fn an_alarm_that_is_on() {
    let mut rig = Rig::new();
    rig.pin("ALMY", true);
    for line in ["Y100", "JY+", "HY-3", "X10Y10", "CIRXYP5:5", "CIRTP5:5:5", "ZMOVEY-"] {
        rig.check(line, "?Error Alarm");
    }
    assert!(!rig.moves("X") && !rig.moves("Y"));
    rig.ok("X10");
    rig.pin("ALMY", false);
    rig.ok("Y100");
    rig.until_rest();
    rig.check("PP", "10:100:0:0");
}

#[test]
fn limits_that_are_on() {
    let mut rig = Rig::new();
    rig.pin("+LZ", true);
    for line in ["Z100", "JZ+", "Z1X1", "X1Y2Z3U4"] {
        rig.check(line, "?Error +Limit");
    }
    rig.ok("Z-100");
    rig.until_rest();
    rig.pin("+LZ", false);
    rig.pin("-LU", true);
    for line in ["U-100", "JU-", "U-1X1"] {
        rig.check(line, "?Error -Limit");
    }
    rig.ok("U100");
    rig.until_rest();
    rig.check("PP", "0:0:-100:100");
}

#[test]
fn an_emergency_stop_that_is_on() {
    let mut rig = Rig::new();
    rig.pin("CEMG", true);
    for line in ["X100", "JY+", "HZ-3", "X10U10", "CIRXYP5:5"] {
        rig.check(line, "?Error ESTOP");
    }
    rig.pin("CEMG", false);
    // An axis that was to start meanwhile has an error, the others have none (manual, 2.1.3.1.2).
    assert_eq!(rig.get("MSTX") & 1 << 16, 1 << 16);
    rig.check("X100", "?Error Moving");
    rig.ok("CLRX X100");
    rig.until_rest();
    rig.check("PX", "100");
}

#[test]
fn numbers_out_of_range() {
    let mut rig = Rig::new();
    let indices = [
        "V100",
        "V100=1",
        "V999999",
        "SA1800",
        "SA1800=END",
        "GS32",
        "DI5",
        "DO0",
        "EO5",
        "AI3",
        "IO33",
        "JLIM9",
        "JLIM0",
        "SACTRL4=1",
        "SASTAT4",
        "SPC4",
        "SLOAD4",
        "PWM3",
        "HX+13",
        "HX-99999",
    ];
    let values = [
        "DB=6",
        "POLX=131072",
        "SSPDMX=8",
        "SLRX=1000",
        "V1=2147483648",
        "SACTRL0=4",
        "SA0=NONSENSE",
        "X2147483648",
        "TX2147483648",
        "I1:2:3:9999999999",
        "CIRXYP0:2147483648",
        "HSPD=0",
        "ID=100",
    ];
    for line in indices.into_iter().chain(values) {
        rig.check(line, "?Invalid Index");
    }
    // A centre that is the position, and one that is too far away.
    for line in ["CIRXYP0:0", "ARCXYN0:0:90000", "CIRTP0:0:5", "CIRXYP134216774:0"] {
        rig.check(line, "?Invalid Index");
    }
    rig.check("PP", "0:0:0:0");
    rig.check("ID", "01");
    rig.check("V1", "0");
}

/// A program in its error state is neither started nor continued before it was stopped.
#[test]
fn programs_in_error() {
    let mut rig = Rig::new();
    rig.start(2, "PRG 2\nV1=1/V0\nEND");
    rig.pass_ms(10);
    rig.check("SASTAT2", "4");
    for line in ["SACTRL2=1", "SACTRL2=2", "SACTRL2=3"] {
        rig.check(line, "?Program Error");
    }
    rig.check("SASTAT2", "4");
    rig.ok("V0=1 SACTRL2=0 SACTRL2=1");
    rig.pass_ms(10);
    rig.check("SASTAT2", "0");
    // Nor is one that is not there.
    rig.check("SACTRL3=1", "?Program Error");
}

/// A hundred registers; and three motions that wait for the external start.
#[test]
fn full_buffers() {
    let mut rig = Rig::new();
    rig.ok("BO");
    for x in 1..=100 {
        rig.ok(&format!("I{x}:0:0:1000"));
    }
    rig.check("BSTAT", "1:0:0:0");
    rig.check("I101:0:0:1000", "?Buffer Full");
    rig.check("CIRXYP0:9", "?Buffer Full");
    rig.check("X101Y1", "?Buffer Full");
    rig.ok("BF EXST=1 X1 Y2 Z3");
    rig.check("U4", "?Buffer Full");
    rig.check("X5", "?Buffer Full");
    rig.check("PP", "0:0:0:0");
}

#[test]
fn buffer_commands_without_a_buffer() {
    let mut rig = Rig::new();
    for line in ["I1:2:3:1000", "BSTART"] {
        rig.check(line, "?Buffer Disabled");
    }
    rig.ok("BF");
    rig.check("PP", "0:0:0:0");
}

#[test]
fn no_other_speed_while_the_buffer_is_on() {
    let mut rig = Rig::new();
    rig.ok("SSPDMX=1 BO");
    rig.check("SSPDX=2000", "?Buffer Enabled");
    rig.ok("BF JX+");
    rig.pass_ms(500);
    rig.ok("SSPDX=2000");
}

#[test]
fn speeds_outside_their_window() {
    let mut rig = Rig::new();
    rig.ok("HSPD=5000 SSPDMX=1 JX+");
    rig.pass_ms(500);
    rig.check("SSPDX=65536", "?SSPD Error");
    rig.check("SSPDX=0", "?SSPD Error");
    rig.ok("SSPDMX=3");
    rig.check("SSPDX=4", "?SSPD Error");
    rig.check("SSPDX=327676", "?SSPD Error");
    rig.ok("SSPDX=65536");
    rig.ok("ABORTX SCVX=1 SSPDMX=1 JX-");
    rig.pass_ms(1000);
    rig.check("SSPDX=2000", "?SSPD Error");
}

/// There is nothing to change.
#[test]
fn changes_without_a_motion() {
    let mut rig = Rig::new();
    rig.ok("SSPDMX=1");
    for line in ["TX500", "SSPDX=2000"] {
        rig.check(line, "?Override Failed");
    }
    // Not of a jog, not of a line, not of homing.
    rig.ok("JX+ Y1000Z1000 HU+0");
    rig.pass_ms(50);
    for line in ["TX500", "TY500", "TZ500", "TU500"] {
        rig.check(line, "?Override Failed");
    }
    rig.ok("ABORT");
    rig.check("TX500", "?Override Failed");
}
