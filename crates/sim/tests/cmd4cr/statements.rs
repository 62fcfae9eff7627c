//! The statements of table 5-42 on the device, each with its effect.

use crate::rig::Rig;

/// A controller that is fast enough for short tests, with home at 1000 and an index mark every 300 pulses.
fn rig() -> Rig {
    let mut rig = Rig::with(|axis| {
        axis.home = [1000, 1100];
        axis.index_every = 300;
        axis.negative_limit = -2000;
        axis.positive_limit = 5000;
    });
    rig.ok("HSPD=4000 LSPD=400 ACC=50 DEC=50");
    rig
}

/// Runs a program to its end.
#[track_caller]
fn run(rig: &mut Rig, program: &str) {
    rig.ok("SACTRL0=0");
    for line in 0..60 {
        rig.ok(&format!("SA{line}="));
    }
    rig.start(0, program);
    for _ in 0..20_000 {
        match rig.get("SASTAT0") {
            0 => return,
            1 => rig.pass_ms(1),
            status => panic!("status {status}: {program}"),
        }
    }
    panic!("it does not end: {program}");
}

/// Every register that can be written, and read where it can be, from a program.
#[test]
fn registers() {
    let mut rig = Rig::new();
    rig.pin("DI3", true);
    rig.pin("IO2", true);
    rig.analog("AI2", 1500.0);
    rig.ok("IOCFG=240");
    run(
        &mut rig,
        "HSPD=5000\nLSPD=200\nACC=111\nDEC=112\nHSPDZ=5001\nLSPDU=201\nACCX=113\nDECY=114\nDO=3\nDO2=0\nDO4=1\n\
         EO=2\nEO4=1\nPZ=77\nEU=78\nSSPDMZ=3\nEINT=0\nIO=48\nIO8=1\nSLU=1\nJOYHSX=1000\nJOYDELY=20\nSYNCFGZ=9\n\
         SYNPOSZ=-5\nV1=DI\nV2=DI3\nV3=AI2\nV4=PZ\nV5=EU\nV6=MSTX&64\nV7=PSX\nV8=SLSU\nV9=ACCX\nV10=DO4\nV11=EO\n\
         V12=HSPD-LSPD\nV13=EINT\nV14=IO\nV15=IO2\nV16=IO3\nV17=SLU\nV18=JOYENA\nV19=JOYHSX\nV20=SYNCFGZ\n\
         V21=SYNPOSZ\nV22=SYNSTATZ\nV23=DECY\nV24=HSPDZ\nV25=DO\nV26=EO4\nV27=AI1\nEND",
    );
    for (command, value) in [
        ("HSPD", 5000),
        ("LSPD", 200),
        ("ACC", 111),
        ("DEC", 112),
        ("HSPDZ", 5001),
        ("LSPDU", 201),
        ("ACCX", 113),
        ("DECY", 114),
        ("DO", 9),
        ("EO", 10),
        ("PZ", 77),
        ("EU", 78),
        ("SSPDMZ", 3),
        ("EINT", 0),
        ("IO", 178),
        ("SLU", 1),
        ("JSPDX", 1000),
        ("JDELY", 20),
        ("SYNCZ", 9),
        ("SYNPZ", -5),
        ("V1", 4),
        ("V2", 1),
        ("V3", 1500),
        ("V4", 77),
        ("V5", 78),
        ("V6", 64),
        ("V7", 0),
        ("V8", 0),
        ("V9", 113),
        ("V10", 1),
        ("V11", 10),
        ("V12", 4800),
        ("V13", 0),
        ("V14", 178),
        ("V15", 1),
        ("V16", 0),
        ("V17", 1),
        ("V18", 0),
        ("V19", 1000),
        ("V20", 9),
        ("V21", -5),
        ("V22", 0),
        ("V23", 114),
        ("V24", 5001),
        ("V25", 9),
        ("V26", 1),
        ("V27", 1650),
    ] {
        assert_eq!(rig.get(command), value, "{command}");
    }
}

/// A value out of range changes nothing and ends nothing.
#[test]
fn values_out_of_range_are_passed_over() {
    let mut rig = Rig::new();
    run(&mut rig, "V1=16\nDO=V1\nV2=-1\nHSPD=V2\nSYNCFGX=V1\nJOYHSZ=5\nJOYDELU=5\nV3=JOYHSZ\nDO1=1\nEND");
    assert_eq!((rig.get("DO"), rig.get("HSPD"), rig.get("SYNCX"), rig.get("V3")), (1, 1000, 0, 0));
    assert_eq!((rig.get("JSPDX"), rig.get("JDELX"), rig.get("JSPDY")), (0, 0, 0));
}

#[test]
fn moves_and_modes() {
    let mut rig = rig();
    let mut check = |program: &str, positions: &str| {
        run(&mut rig, program);
        rig.check("PP", positions);
    };
    check("ABS\nX500Y-250Z100U-50\nWAITX\nEND", "500:-250:100:-50");
    check("INC\nX100\nY50\nZ-1\nU-2\nWAITX\nWAITY\nWAITZ\nWAITU\nABS\nEND", "600:-200:99:-52");
    check("V1=7\nV2=-8\nXV1ZV2\nWAITZ\nEND", "7:-200:-8:-52");
    // Without interpolation the shorter way is over first.
    check("EINT=0\nX1007Y-100\nWAITY\nV1=PX\nWAITX\nEINT=1\nEND", "1007:-100:-8:-52");
    assert!((100..900).contains(&rig.get("V1")), "{}", rig.get("V1"));
    // With it they end together.
    run(&mut rig, "X7Y-200\nWAITY\nV1=PX\nWAITX\nEND");
    rig.check("V1", "7");
}

#[test]
fn jogs_and_stops() {
    let mut rig = rig();
    run(&mut rig, "JOGX+\nJOGU-\nDELAY=100\nABORTX\nV1=MSTX&7\nV2=MSTU&7\nSTOPU\nV3=MSTU&7\nWAITU\nEND");
    let (x, u) = (rig.get("PX"), rig.get("PU"));
    assert!(x > 100 && u < -100, "{x} {u}");
    assert_eq!((rig.get("V1"), rig.get("V2"), rig.get("V3")), (0, 4, 2));
    run(
        &mut rig,
        "JOGX-\nJOGY+\nDELAY=20\nSTOP\nWAITX\nWAITY\nJOGZ+\nJOGU+\nDELAY=30\nABORT\nV1=MSTZ|MSTU\nV1=V1&7\nEND",
    );
    rig.check("V1", "0");
    assert!(rig.get("PX") < x && rig.get("PY") > 0 && rig.get("PZ") > 0 && rig.get("PU") > u);
}

#[test]
fn speeds_and_targets_on_the_fly() {
    let mut rig = rig();
    run(&mut rig, "SSPDMX=1\nJOGX+\nDELAY=100\nV1=PSX\nSSPDX=2000\nDELAY=100\nV2=PSX\nABORTX\nEND");
    assert_eq!((rig.get("V1"), rig.get("V2")), (4000, 2000));
}

#[test]
fn homing_and_index_moves() {
    let mut rig = rig();
    // The edge of the home switch.
    run(&mut rig, "HOMEX+0\nWAITX\nX0\nWAITX\nEND");
    assert_eq!(rig.shaft("X"), 1000);
    // A limit, at low speed off it.
    run(&mut rig, "HOMEY-6\nWAITY\nEND");
    assert_eq!((rig.shaft("Y"), rig.get("PY")), (-1999, 0));
    // The second mark on the way.
    rig.ok("ZCNTZ=1 HSPDZ=100 LSPDZ=100");
    run(&mut rig, "Z10\nWAITZ\nZMOVEZ+\nWAITZ\nEND");
    rig.check("PZ", "600");
}

#[test]
fn circles_arcs_and_helices() {
    let mut rig = rig();
    let mut check = |program: &str, positions: &str| {
        run(&mut rig, program);
        rig.check("PP", positions);
    };
    check("V1=100\nCIRXYPV1:0\nDELAY=50\nV2=PY\nWAITX\nEND", "0:0:0:0");
    check("CIRZUN0:100\nDELAY=50\nV3=PZ\nWAITZ\nEND", "0:0:0:0");
    check("ARCXZN0:100:0\nWAITX\nEND", "100:0:100:0");
    check("ARCXZP0:100:270000\nWAITZ\nEND", "0:0:0:0");
    check("ARCTN0:100:90000:40\nWAITX\nEND", "0:200:40:0");
    check("CIRTP0:100:-40\nWAITX\nEND", "0:200:-40:0");
    // Clockwise from the left of the centre is up; counter-clockwise from below it is to the right.
    assert!(rig.get("V2") > 0 && rig.get("V3") > 0);
}

#[test]
fn buffered_moves_of_programs() {
    let mut rig = rig();
    run(
        &mut rig,
        "BUFON\nX100Y100\nCIRXYN100:200\nX0Y0\nDELAY=50\nV1=PX\nISTART\nWAITX\nBUFOFF\nX7Y7\nWAITX\nEND",
    );
    rig.check("V1", "0");
    rig.check("PP", "7:7:0:0");
    let status = rig.say("BSTAT");
    assert!(status.starts_with("0:") && status.ends_with(":100"), "{status}");
}

#[test]
fn synchronisation_of_programs() {
    let mut rig = rig();
    run(
        &mut rig,
        "SYNCFGX=3\nSYNPOSX=500\nV1=SYNSTATX\nSYNONX\nV2=SYNSTATX\nV5=DO1\nX600\nWAITX\nV3=SYNSTATX\nV6=DO1\n\
         SYNOFFX\nV4=SYNSTATX\nV7=DO1\nEND",
    );
    let values: Vec<_> = (1..=7).map(|number| rig.get(&format!("V{number}"))).collect();
    assert_eq!(values, [0, 1, 2, 0, 0, 1, 0]);
}

/// Words of chapter 2 that table 5-42 leaves out.
#[test]
fn latches_and_more_of_programs() {
    let mut rig = rig();
    rig.pin("DI2", false);
    rig.download(
        "PRG 0\nLTY=1\nV1=LTSY\nJOGY+\nWHILE LTSY=1\nENDWHILE\nV2=LTSY\nV3=LTPY\nV4=LTEY\nABORTY\nLTY=0\nV5=LTSY\n\
         PWM1=20\nV6=PWM1\nMPGEZ=1\nV7=MPGEZ\nEND",
    );
    rig.ok("SACTRL0=1");
    rig.pass_ms(200);
    let position = rig.get("PY");
    rig.pin("DI2", true);
    rig.pass_ms(50);
    rig.check("SASTAT0", "0");
    let values: Vec<_> = (1..=7).map(|number| rig.get(&format!("V{number}"))).collect();
    assert_eq!(values, [1, 2, position, position, 0, 20, 1]);
    rig.check("PWM1", "20");
    rig.check("MPEZ", "1");
    rig.device.pulser("Z", 40).unwrap();
    rig.pass_ms(500);
    rig.check("PZ", "40");
}

#[test]
fn joysticks_of_programs() {
    let mut rig = rig();
    rig.analog("AI1", 3300.0);
    run(&mut rig, "JOYHSX=1000\nJOYDELX=10\nJOYENA=1\nDELAY=500\nV1=PSX\nV2=JOYENA\nJOYENA=0\nWAITX\nEND");
    assert_eq!((rig.get("V1"), rig.get("V2"), rig.get("JENA")), (1000, 1, 0));
    assert!(rig.get("PX") > 300 && !rig.moves("X"));
}

#[test]
fn errors_settings_and_other_programs() {
    let mut rig = rig();
    rig.pin("+LX", true);
    rig.pin("-LX", true);
    rig.pin("+LX", false);
    rig.pin("-LX", false);
    rig.ok("V50=5");
    // A store keeps what is set; program 3 is started, paused, continued and stopped.
    run(
        &mut rig,
        "V51=6\nSTORE\nSR3=1\nDELAY=10\nV1=V60\nSR3=2\nDELAY=10\nV2=V60\nDELAY=10\nV3=V60\nSR3=3\nDELAY=10\nV4=V60\n\
         SR3=0\nDELAY=10\nV5=V60\nDELAY=10\nV6=V60\nEND\nPRG 3\nWHILE 1=1\nV60=V60+1\nENDWHILE\nEND",
    );
    let counts: Vec<_> = (1..=6).map(|number| rig.get(&format!("V{number}"))).collect();
    assert!(counts[0] > 5, "{counts:?}");
    assert_eq!(counts[1], counts[2]);
    assert!(counts[3] > counts[2]);
    assert_eq!(counts[4], counts[5]);
    rig.power_cycle();
    assert_eq!((rig.get("V50"), rig.get("V51"), rig.get("V60")), (5, 6, 0));
    // Errors are cleared.
    rig.ok("EO=15 X900");
    rig.pass_ms(100);
    rig.pin("ALMX", true);
    rig.pin("ALMX", false);
    assert_eq!(rig.get("MSTX") & 1024, 1024);
    run(&mut rig, "ECLEARX\nEND");
    assert_eq!(rig.get("MSTX") & 1024, 0);
}

#[test]
fn branches_loops_and_subroutines() {
    let mut rig = rig();
    run(
        &mut rig,
        "V1=0 ;a comment\nWHILE V1<5\nV1=V1+1\nIF V1=2\nV2=V2+1\nELSEIF V1>3\nV3=V3+1\nELSE\nV4=V4+1\nENDIF\n\
         ENDWHILE\nGOSUB 30\nEND\nSUB 30\nV5=9\nENDSUB",
    );
    let values: Vec<_> = (1..=5).map(|number| rig.get(&format!("V{number}"))).collect();
    assert_eq!(values, [5, 1, 2, 2, 9]);
}

/// More moves than there are registers: the program goes on when one is free.
#[test]
fn a_program_waits_for_the_buffer() {
    let mut rig = rig();
    run(
        &mut rig,
        "BUFON\nHSPD=4000\nX1Y1\nISTART\nV1=0\nWHILE V1<150\nV1=V1+1\nV2=V1*10\nXV2Y0\nIF V1=100\nISTART\nENDIF\n\
         ENDWHILE\nWAITX\nBUFOFF\nEND",
    );
    rig.check("PP", "1500:0:0:0");
}
