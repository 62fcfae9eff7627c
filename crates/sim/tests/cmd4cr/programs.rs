//! Standalone programs: control, errors, subroutines, variables, four threads, time.

use crate::ascii::programs::{go_up_and_down, operators};
use crate::rig::Rig;

#[test]
fn programs_are_controlled_by_the_host() {
    let mut rig = Rig::new();
    rig.download(
        "PRG 0\nWHILE 1=1\nV10=V10+1\nENDWHILE\nEND\nPRG 1\nWHILE 1=1\nV11=V11+1\nENDWHILE\nEND\n\
         PRG 2\nWHILE 1=1\nV12=V12+1\nENDWHILE\nEND\nPRG 3\nV13=7\nEND",
    );
    for number in 0..3 {
        let (control, status, counter) =
            (format!("SACTRL{number}"), format!("SASTAT{number}"), format!("SPC{number}"));
        let count = format!("V1{number}");
        rig.check(&status, "0");
        rig.ok(&format!("{control}=1"));
        rig.pass_ms(50);
        rig.check(&status, "1");
        assert!(rig.get(&count) > 10);
        // Paused, it stays where it is.
        rig.ok(&format!("{control}=2"));
        rig.check(&status, "2");
        let (counted, line) = (rig.get(&count), rig.get(&counter));
        rig.pass_ms(50);
        assert_eq!((rig.get(&count), rig.get(&counter)), (counted, line));
        rig.ok(&format!("{control}=3"));
        rig.check(&status, "1");
        rig.pass_ms(50);
        assert!(rig.get(&count) > counted);
        // Starting a program that runs changes nothing.
        rig.ok(&format!("{control}=1"));
        rig.pass_ms(1);
        assert!(rig.get(&count) > counted);
    }
    // The fourth beside three others.
    rig.ok("SACTRL3=1");
    rig.pass_ms(10);
    rig.check("V13", "7");
    rig.check("SASTAT3", "0");
    rig.ok("SACTRL0=0 SACTRL1=0 SACTRL2=0");
    let counts = [10, 11, 12].map(|number| rig.get(&format!("V{number}")));
    rig.pass_ms(50);
    assert_eq!([10, 11, 12].map(|number| rig.get(&format!("V{number}"))), counts);
    rig.check("SACTRL0=4", "?Invalid Index");
}

#[test]
fn programs_go_up_and_down() {
    let mut rig = Rig::new();
    let lines = go_up_and_down(
        &mut rig,
        "HSPD=V1\nX1000Y-2000Z3000U-4000\nWAITU\nIF IO32=1\nIO=V2\nENDIF\nARCTN-1000000000:-1000000000:-90000:\
         -1000000000\nCIRZUPV1:V2\nEND",
        9,
    );
    rig.check("SA0=NONSENSE", "?Invalid Index");
    // Not a word of this controller.
    rig.check("SA0=TOC=5", "?Invalid Index");
    assert_eq!(rig.say("SA0"), lines[0]);
}

#[test]
fn variables() {
    let mut rig = Rig::new();
    for number in [0, 50, 99] {
        rig.check(&format!("V{number}"), "0");
        rig.ok(&format!("V{number}={}", -1000 - number));
    }
    rig.ok("STORE");
    rig.power_cycle();
    for number in [0, 50, 99] {
        rig.check(&format!("V{number}"), &format!("{}", -1000 - number));
    }
    operators(&mut rig, "V99", -1099);
}

#[test]
fn programs_run_on_boot() {
    let mut rig = Rig::new();
    rig.download("PRG 0\nDO1=1\nEND\nPRG 1\nDO2=1\nEND\nPRG 2\nDO3=1\nEND\nPRG 3\nDO4=1\nEND");
    rig.ok("SLOAD=2");
    rig.power_cycle();
    rig.pass_ms(10);
    rig.check("DO", "0");
    for mask in ["10", "5", "15", "0"] {
        rig.ok(&format!("SLOAD={mask} STORE"));
        rig.power_cycle();
        rig.pass_ms(10);
        rig.check("DO", mask);
    }
    // A bit by itself is the same setting.
    rig.ok("SLOAD3=1 SLOAD1=1");
    rig.check("SLOAD", "10");
    rig.ok("SLOAD1=0");
    rig.check("SLOAD", "8");
    rig.check("SLOAD3", "1");
    rig.ok("STORE");
    rig.power_cycle();
    rig.pass_ms(10);
    rig.check("DO", "8");
}

/// Alarms, emergency stops and StepNLoop are errors of the program that moves the axis.
#[test]
fn other_errors_of_programs() {
    let program = "PRG 2\nX5000\nWAITX\nEND\nSUB 31\nV1=MSTX&67328\nV2=SLSX\nECLEARX\nENDSUB";
    let check = |pin: &str, errors: i32| {
        let mut rig = Rig::new();
        rig.start(2, program);
        rig.pass_ms(500);
        rig.pin(pin, true);
        rig.pin(pin, false);
        rig.pass_ms(10);
        assert_eq!((rig.get("V1"), rig.get("SASTAT2")), (errors, 0), "{pin}");
    };
    check("ALMX", 1 << 10);
    check("CEMG", 1 << 16);
    check("+LX", 1 << 8);
    let mut rig = Rig::new();
    rig.ok("SLEX=50 SLX=1");
    rig.start(2, program);
    rig.pass_ms(500);
    rig.device.set_load("X", 2.0).unwrap();
    rig.pass_ms(500);
    rig.check("V2", "10");
    rig.check("SLSX", "0");
}

/// Without SUB 31 a program ends in an error, and only this one.
#[test]
fn errors_without_subroutine_31() {
    let mut rig = Rig::with(|axis| axis.positive_limit = 1000);
    rig.download("PRG 0\nWHILE 1=1\nENDWHILE\nEND\nPRG 3\nHSPD=5000\nX9000\nWAITX\nDO=1\nEND");
    rig.ok("SACTRL0=1 SACTRL3=1");
    rig.pass_ms(3000);
    rig.check("SASTAT3", "4");
    rig.check("SASTAT0", "1");
    rig.check("DO", "0");
    rig.check("PX", "1000");
    // It can be stopped and started again.
    rig.check("SACTRL3=1", "?Program Error");
    rig.ok("CLRX IERR=1 X0");
    rig.until_rest();
    rig.ok("SACTRL3=0 SACTRL3=1");
    rig.pass_ms(2000);
    rig.check("SASTAT3", "0");
    rig.check("DO", "1");
}
