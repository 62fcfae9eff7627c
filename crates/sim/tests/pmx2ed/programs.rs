//! Standalone programs: control, errors, subroutines, variables, time.

use crate::ascii::programs::{go_up_and_down, operators};
use crate::rig::Rig;

#[test]
fn programs_are_controlled_by_the_host() {
    let mut rig = Rig::new();
    for status in ["SASTAT0", "SASTAT1", "SPC0", "SPC1"] {
        rig.check(status, "0");
    }
    // There is no program to start.
    rig.check("SR0=1", "?State Error");
    rig.check("SASTAT0", "0");
    rig.download("PRG 0\nV1=0\nWHILE 1=1\nV1=V1+1\nENDWHILE\nEND\nPRG 1\nV2=7\nEND");
    rig.ok("SR0=1");
    rig.pass_ms(50);
    rig.check("SASTAT0", "1");
    assert!(rig.get("V1") > 10);
    assert!((1..8).contains(&rig.get("SPC0")));
    // Paused, it stays where it is.
    rig.ok("SR0=2");
    rig.check("SASTAT0", "2");
    let (count, line) = (rig.get("V1"), rig.get("SPC0"));
    rig.pass_ms(50);
    assert_eq!((rig.get("V1"), rig.get("SPC0")), (count, line));
    rig.ok("SR0=3");
    rig.check("SASTAT0", "1");
    rig.pass_ms(50);
    assert!(rig.get("V1") > count);
    // Starting a program that runs changes nothing.
    let count = rig.get("V1");
    rig.ok("SR0=1");
    rig.pass_ms(1);
    assert!(rig.get("V1") >= count);
    rig.ok("SR0=0");
    rig.check("SASTAT0", "0");
    let count = rig.get("V1");
    rig.pass_ms(50);
    assert_eq!(rig.get("V1"), count);
    // It starts from its first line.
    rig.ok("SR0=1");
    rig.pass_ms(1);
    assert!(rig.get("V1") < 10);
    rig.ok("SR1=1");
    rig.pass_ms(10);
    rig.check("V2", "7");
    rig.check("SASTAT1", "0");
    rig.check("SASTAT0", "1");
    rig.check("SR0=4", "?Invalid Answer");
    rig.check("SR0", "?SR0");
}

#[test]
fn programs_go_up_and_down() {
    let mut rig = Rig::new();
    let lines = go_up_and_down(&mut rig, "HSPD=V1\nX1000Y-2000\nWAITX\nIF DI1=1\nDO=V2\nENDIF\nEND", 7);
    // What is no line changes nothing.
    rig.check("SA0=NONSENSE", "?Invalid Answer");
    assert_eq!(rig.say("SA0"), lines[0]);
    rig.ok("SA1274=END");
    rig.check("SA1274", "END");
    rig.check("SA1275", "?Index out of Range");
    rig.ok("SA1274=");
    assert_eq!(rig.say("SA1274"), "");
}

#[test]
fn variables() {
    let mut rig = Rig::new();
    for number in [0, 31, 32, 63] {
        rig.check(&format!("V{number}"), "0");
        rig.ok(&format!("V{number}={}", -1000 - number));
    }
    for number in [0, 31, 32, 63] {
        rig.check(&format!("V{number}"), &format!("{}", -1000 - number));
    }
    rig.ok("STORE");
    rig.power_cycle();
    // The upper half is stored.
    rig.check("V31", "0");
    rig.check("V32", "-1032");
    rig.check("V63", "-1063");
    operators(&mut rig, "DI", 0);
}

#[test]
fn programs_run_on_boot() {
    let mut rig = Rig::new();
    rig.download("PRG 0\nDO1=1\nEND\nPRG 1\nDO2=1\nEND");
    rig.ok("SLOAD=2");
    rig.power_cycle();
    rig.pass_ms(10);
    rig.check("DO", "0");
    rig.ok("SLOAD=2 STORE");
    rig.power_cycle();
    rig.pass_ms(10);
    rig.check("DO", "2");
    rig.ok("SLOAD=3 STORE");
    rig.power_cycle();
    rig.pass_ms(10);
    rig.check("DO", "3");
}

/// StepNLoop's errors are errors of the program that moves the axis.
#[test]
fn a_stall_is_an_error_of_the_program() {
    let mut rig = Rig::new();
    rig.ok("SLEX=50");
    rig.start(0, "SLX=1\nX5000\nWAITX\nEND\nSUB 31\nV1=SLSX\nECLEARX\nENDSUB");
    rig.pass_ms(500);
    rig.device.set_load("X", 2.0).unwrap();
    rig.pass_ms(500);
    rig.check("V1", "10");
    rig.check("SLSX", "0");
    rig.check("SASTAT0", "0");
}

/// Every register of table 10.0 that can be written and read, from a program.
#[test]
fn registers() {
    let mut rig = Rig::new();
    rig.pin("DI3", true);
    rig.analog("AI2", 1500.0);
    rig.start(0,
        "HSPD=5000\nLSPD=200\nACC=111\nDEC=112\nHSPDX=5001\nLSPDY=201\nACCX=113\nDECY=114\nSCVX=1\nDO=3\nDO2=0\n\
         EO=2\nEO1=1\nPX=77\nEY=78\nSSPDMX=3\nTOC=60000\nSLY=1\nJOYHSX=1000\nJOYDELY=20\nJOYTOLX=30\nJOYNOX=-4\n\
         JOYNIX=-3\nJOYPIY=3\nJOYPOY=4\nV1=DI\nV2=DI3\nV3=AI2\nV4=PX\nV5=EY\nV6=MSTX&64\nV7=PSX\nV8=SLSY\nV9=ACCX\n\
         V10=DO1\nV11=EO\nV12=HSPD-LSPD\nV13=SCVX\nEND",
    );
    rig.pass_ms(20);
    for (command, value) in [
        ("HSPD", "5000"),
        ("LSPD", "200"),
        ("ACC", "111"),
        ("DEC", "112"),
        ("HSPDX", "5001"),
        ("LSPDY", "201"),
        ("ACCX", "113"),
        ("DECY", "114"),
        ("SCVX", "1"),
        ("DO", "1"),
        ("EO", "3"),
        ("PX", "77"),
        ("EY", "78"),
        ("SSPDMX", "3"),
        ("TOC", "60000"),
        ("SLY", "1"),
        ("JV1", "1000"),
        ("JV4", "20"),
        ("JV5", "30"),
        ("JL1", "-4"),
        ("JL2", "-3"),
        ("JL7", "3"),
        ("JL8", "4"),
        ("V1", "4"),
        ("V2", "1"),
        ("V3", "1500"),
        ("V4", "77"),
        ("V5", "78"),
        ("V6", "64"),
        ("V7", "0"),
        ("V8", "0"),
        ("V9", "113"),
        ("V10", "1"),
        ("V11", "3"),
        ("V12", "4800"),
        ("V13", "1"),
    ] {
        rig.check(command, value);
    }
    rig.check("SASTAT0", "0");
}

/// Every statement of table 10.0 that acts, from a program.
#[test]
fn statements() {
    let mut rig = Rig::with(|axis| {
        axis.home = [1000, 1100];
        axis.index_every = 300;
    });
    let mut run = |program: &str, ms: u64| {
        rig.ok("SR0=0 SR1=0 ABORT CLRX HSPD=4000 LSPD=400 ACC=50");
        for line in 0..30 {
            rig.ok(&format!("SA{line}="));
        }
        rig.start(0, program);
        rig.pass_ms(ms);
        assert_ne!(rig.get("SASTAT0"), 4, "{program}");
        let (x, y) = (rig.get("PX"), rig.get("PY"));
        (x, y, rig.shaft("X"), rig.shaft("Y"))
    };
    assert_eq!(run("ABS\nX500Y-250\nWAITX\nEND", 1000), (500, -250, 500, -250));
    assert_eq!(run("INC\nX100\nY50\nWAITX\nWAITY\nABS\nEND", 1000), (600, -200, 600, -200));
    let (out, ..) = run("JOGX+\nDELAY=100\nABORTX\nEND", 1000);
    assert!(out > 700, "{out}");
    let (x, y, ..) = run("JOGX-\nJOGY+\nDELAY=50\nSTOPX\nWAITX\nABORT\nEND", 1000);
    assert!(x < out && y > -200, "{x} {y}");
    assert_eq!(run("X0\nWAITX\nHOMEX+\nWAITX\nX0\nWAITX\nEND", 3000).2, 1000);
    assert_eq!(run("X-500\nWAITX\nHLHOMEX+\nWAITX\nEND", 5000).0, 0);
    assert_eq!(run("ZOMEX-\nWAITX\nEND", 3000).2, 900);
    assert_eq!(run("X-400\nWAITX\nZHOMEX+\nWAITX\nEND", 5000).2, 1200);
    assert_eq!(run("STOP\nXV63\nWAITX\nSTORE\nEND", 1000).0, 0);
}

/// Without SUB 31 a program ends in an error.
#[test]
fn errors_without_subroutine_31() {
    let mut rig = Rig::with(|axis| axis.positive_limit = 1000);
    rig.start(0, "HSPD=5000\nX9000\nWAITX\nDO=1\nEND");
    rig.pass_ms(3000);
    rig.check("SASTAT0", "4");
    rig.check("DO", "0");
    rig.check("PX", "1000");
    // It can be started again.
    rig.ok("CLRX IERR=1 SR0=1");
    rig.pass_ms(10);
    rig.check("SASTAT0", "0");
    rig.check("DO", "1");
}
