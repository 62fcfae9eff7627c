//! Standalone programs: control, errors, subroutines, variables, four threads, time.

use crate::controller::HZ;
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
    assert_eq!(rig.say("SA0"), "");
    rig.download(
        "HSPD=V1\nX1000Y-2000Z3000U-4000\nWAITU\nIF IO32=1\nIO=V2\nENDIF\nARCTN-1000000000:-1000000000:-90000:\
         -1000000000\nCIRZUPV1:V2\nEND",
    );
    let lines: Vec<_> = (0..20).map(|line| rig.say(&format!("SA{line}"))).collect();
    assert!(lines.iter().all(|line| line.len() <= 48), "{lines:?}");
    assert!(lines.iter().filter(|line| !line.is_empty()).count() >= 9, "{lines:?}");
    // The same lines in another controller.
    let mut other = Rig::new();
    for (number, line) in lines.iter().enumerate() {
        other.check(&format!("SA{number}={line}"), "OK");
    }
    let copied: Vec<_> = (0..20).map(|line| other.say(&format!("SA{line}"))).collect();
    assert_eq!(copied, lines);
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
    rig.start(
        0,
        "V1=7\nV2=V1*-3\nV3=V2/2\nV4=V2%4\nV5=V1<<2\nV6=V2>>1\nV7=V5&12\nV8=V1|8\nV9=~V1\nV10=V1-V2\nV11=V99\nEND",
    );
    rig.pass_ms(10);
    let values: Vec<_> = (2..=11).map(|number| rig.get(&format!("V{number}"))).collect();
    // Division rounds down.
    assert_eq!(values[..2], [-21, -11]);
    assert_eq!(values[3..], [28, -11, 12, 15, -8, 28, -1099]);
}

/// A line takes 100 µs, which is no whole number of clocks.
#[test]
fn lines_take_their_time() {
    let mut rig = Rig::new();
    rig.start(3, "PRG 3\nWHILE 1=1\nV1=V1+1\nENDWHILE\nEND");
    let executed = |rig: &Rig| rig.device.programs().map(|program| program.instructions).sum::<u64>();
    let (lines, start) = (executed(&rig), rig.device.now());
    rig.pass_ms(1000);
    let lines = executed(&rig) - lines;
    let expected = (rig.device.now() - start) * 10_000 / HZ;
    assert!(lines.abs_diff(expected) <= 1, "{lines} {expected}");
    // Delays are milliseconds.
    let mut rig = Rig::new();
    rig.start(0, "DO1=1\nDELAY=250\nDO1=0\nEND");
    rig.pass_ms(1);
    assert!(rig.level("DO1"));
    rig.pass_ms(248);
    assert!(rig.level("DO1"));
    rig.pass_ms(2);
    assert!(!rig.level("DO1"));
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

#[test]
fn subroutines_from_the_host() {
    let mut rig = Rig::new();
    rig.download("PRG 0\nWHILE 1=1\nV1=V1+1\nENDWHILE\nEND\nSUB 5\nDO=V9\nDELAY=100\nDO=0\nENDSUB");
    rig.ok("SACTRL0=1 V9=5 GS5");
    rig.pass_ms(10);
    rig.check("DO", "5");
    // One at a time; program 0 goes on.
    rig.check("GS5", "?Program Error");
    let count = rig.get("V1");
    rig.pass_ms(200);
    rig.check("DO", "0");
    assert!(rig.get("V1") > count);
    rig.ok("GS5");
    rig.check("GS6", "?Sub not Initialized");
}

const WITH_HANDLER: &str = "\
PRG 1
HSPD=5000
V2=V2+1
X9000
WAITX
V3=V3+1
X0
WAITX
END
SUB 31
V1=V1+1
ECLEARX
INC
X-500
WAITX
ABS
ENDSUB";

#[test]
fn errors_run_subroutine_31() {
    let limited = || Rig::with(|axis| axis.positive_limit = 1000);
    // Back to the line of the error: the wait, which is over then.
    let mut rig = limited();
    rig.start(1, WITH_HANDLER);
    rig.pass_ms(3000);
    assert_eq!((rig.get("V1"), rig.get("V2"), rig.get("V3")), (1, 1, 1));
    assert_eq!((rig.get("PX"), rig.get("SASTAT1"), rig.get("MSTX") & 0x300), (0, 0, 0));
    // Back to the first line of the program.
    let mut rig = limited();
    rig.ok("SAP=1");
    rig.start(1, WITH_HANDLER);
    rig.pass_ms(3000);
    assert!(rig.get("V1") > 1 && rig.get("V2") > 1);
    rig.check("V3", "0");
    rig.check("SASTAT1", "1");
    // Without the subroutine the program ends in an error, and only this one.
    let mut rig = limited();
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

/// A program that stops itself in SUB 31 stops where SUB 31 ends (manual, 5.4.10).
#[test]
fn a_program_that_stops_itself_in_subroutine_31() {
    let mut rig = Rig::new();
    rig.start(1, "PRG 1\nV2=1/V0\nV3=1\nEND\nSUB 31\nSR1=0\nV1=5\nDELAY=20\nDO=3\nENDSUB");
    rig.pass_ms(5);
    rig.check("V1", "5");
    rig.check("SASTAT1", "1");
    rig.pass_ms(50);
    assert_eq!((rig.get("DO"), rig.get("V3"), rig.get("SASTAT1")), (3, 0, 0));
    // Anywhere else it stops at once.
    rig.ok("V1=0 DO=0");
    rig.start(1, "PRG 1\nSR1=0\nV1=5\nEND");
    rig.pass_ms(50);
    assert_eq!((rig.get("V1"), rig.get("SASTAT1")), (0, 0));
}

#[test]
fn division_by_zero_is_an_error_of_the_program() {
    for line in ["V1=5/V2", "V1=5%V2"] {
        let mut rig = Rig::new();
        rig.start(0, &format!("{line}\nDO=1\nEND"));
        rig.pass_ms(10);
        rig.check("SASTAT0", "4");
        rig.check("DO", "0");
    }
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

/// A move of an axis that is moving is passed over, not an error (manual, 5.4.7).
#[test]
fn a_program_does_not_move_an_axis_twice() {
    let mut rig = Rig::new();
    rig.start(0, "X2000\nX3000\nWAITX\nDO=1\nEND");
    rig.pass_ms(5000);
    rig.check("PX", "2000");
    rig.check("DO", "1");
    rig.check("SASTAT0", "0");
}
