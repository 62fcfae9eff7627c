//! Standalone programs: time, errors, subroutines.

use super::rig::Rig;
use crate::controller::{CONTROL, DIALECT, HZ, LIMIT_ERRORS, PROGRAM};

/// Lines read back are the same in another controller; there are as many as this at least.
#[track_caller]
pub fn go_up_and_down(rig: &mut Rig, source: &str, least: usize) -> Vec<String> {
    assert_eq!(rig.say("SA0"), "");
    rig.download(source);
    let lines: Vec<_> = (0..20).map(|line| rig.say(&format!("SA{line}"))).collect();
    assert!(lines.iter().all(|line| line.len() <= 48), "{lines:?}");
    assert!(lines.iter().filter(|line| !line.is_empty()).count() >= least, "{lines:?}");
    let mut other = Rig::new();
    for (number, line) in lines.iter().enumerate() {
        other.check(&format!("SA{number}={line}"), "OK");
    }
    let copied: Vec<_> = (0..20).map(|line| other.say(&format!("SA{line}"))).collect();
    assert_eq!(copied, lines);
    lines
}

/// Operators; `other` is something else to read, and its value.
#[track_caller]
pub fn operators(rig: &mut Rig, other: &str, value: i32) {
    rig.start(
        0,
        &format!(
            "V1=7\nV2=V1*-3\nV3=V2/2\nV4=V2%4\nV5=V1<<2\nV6=V2>>1\nV7=V5&12\nV8=V1|8\nV9=~V1\nV10=V1-V2\n\
             V11={other}\nEND"
        ),
    );
    rig.pass_ms(10);
    let values: Vec<_> = (2..=11).map(|number| rig.get(&format!("V{number}"))).collect();
    // Division rounds down.
    assert_eq!(values[..2], [-21, -11]);
    assert_eq!(values[3..], [28, -11, 12, 15, -8, 28, value]);
}

/// A line takes 100 µs; it may be no whole number of clocks.
#[test]
fn lines_take_their_time() {
    let mut rig = Rig::new();
    let last = DIALECT.threads - 1;
    rig.start(last, &format!("PRG {last}\nWHILE 1=1\nV1=V1+1\nENDWHILE\nEND"));
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
fn subroutines_from_the_host() {
    let mut rig = Rig::new();
    rig.download("PRG 0\nWHILE 1=1\nV1=V1+1\nENDWHILE\nEND\nSUB 5\nDO=V9\nDELAY=100\nDO=0\nENDSUB");
    rig.ok(&format!("{CONTROL}0=1 V9=5 GS5"));
    rig.pass_ms(10);
    rig.check("DO", "5");
    // One at a time; program 0 goes on.
    rig.check("GS5", PROGRAM);
    let count = rig.get("V1");
    rig.pass_ms(200);
    rig.check("DO", "0");
    assert!(rig.get("V1") > count);
    rig.ok("GS5");
    rig.check("GS6", "?Sub not Initialized");
}

#[test]
fn subroutines_that_are_not_there() {
    let mut rig = Rig::new();
    rig.check("GS0", "?Sub not Initialized");
    rig.download("END\nSUB 3\nV1=7\nENDSUB");
    rig.check("GS0", "?Sub not Initialized");
    rig.check("GS31", "?Sub not Initialized");
    rig.ok("GS3");
    rig.pass_ms(10);
    rig.check("V1", "7");
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
    assert_eq!((rig.get("PX"), rig.get("SASTAT1"), rig.get("MSTX") & LIMIT_ERRORS), (0, 0, 0));
    // Back to the first line of the program.
    let mut rig = limited();
    rig.ok("SAP=1");
    rig.start(1, WITH_HANDLER);
    rig.pass_ms(3000);
    assert!(rig.get("V1") > 1 && rig.get("V2") > 1);
    rig.check("V3", "0");
    rig.check("SASTAT1", "1");
}

/// A program that stops itself in SUB 31 stops where SUB 31 ends.
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

/// A move of an axis that is moving is passed over, not an error.
#[test]
fn a_program_does_not_move_an_axis_twice() {
    let mut rig = Rig::new();
    rig.start(0, "X2000\nX3000\nWAITX\nDO=1\nEND");
    rig.pass_ms(5000);
    rig.check("PX", "2000");
    rig.check("DO", "1");
    rig.check("SASTAT0", "0");
}
