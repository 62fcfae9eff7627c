//! Every word of the language: what a program with it asks of the device. The table of words names these tests.

use ascript::dialect::{COMMANDER, Family, PERFORMAX_2};
use ascript::isa::{Access, Kind, Suffix, TABLE};
use ascript::{Action, Dialect, Direction, Exit, Memory, State, Thread, Word, compile};

/// More lines than any test executes.
const BUDGET: u32 = 1000;

/// What the device reads, whatever it is asked for.
const READING: i32 = 1234;

type Device = Memory<200, 100>;

fn load(dialect: &Dialect, source: &str) -> Device {
    let compilation = compile("test", source.as_bytes(), dialect);
    let Some(code) = &compilation.code else { panic!("{}", compilation.render(false)) };
    let mut memory = Device::new();
    assert!(memory.load(&code.lines));
    memory
}

/// An action in words.
fn told(action: Action) -> String {
    let Action { word, index, axis, second_axis, direction, targets, arguments } = action;
    let name = |axis: u8| ["X", "Y", "Z", "U"][usize::from(axis)];
    let mut text = format!("{word:?}");
    let mut say = |part: String| text = format!("{text} {part}");
    if word == Word::Sr {
        say(index.to_string());
    }
    axis.into_iter().chain(second_axis).for_each(|axis| say(name(axis).into()));
    match direction {
        Some(Direction::Plus) => say("+".into()),
        Some(Direction::Minus) => say("-".into()),
        None => (),
    }
    for (axis, target) in (0..).zip(targets) {
        if let Some(target) = target {
            say(format!("{}:{target}", name(axis)));
        }
    }
    let last = arguments.iter().rposition(|&argument| argument != 0).map_or(0, |last| last + 1);
    arguments[..last].iter().for_each(|argument| say(argument.to_string()));
    text
}

/// Runs program 0 to its end; gives what the device was asked for, in words.
fn run(memory: &mut Device) -> Vec<String> {
    let mut thread = Thread::new();
    thread.start(memory.program(0).expect("program 0"));
    let mut events = Vec::new();
    for _ in 0..100 {
        match thread.run(memory, BUDGET).1 {
            Exit::Read(place) => {
                events.push(format!("read {place}"));
                thread.complete(READING);
            }
            Exit::Write(place, value) => {
                events.push(format!("{place}={value}"));
                thread.done();
            }
            Exit::Do(action) => {
                events.push(told(action));
                thread.done();
            }
            Exit::Stopped => {
                assert_eq!(thread.state(), State::Idle);
                return events;
            }
            exit => panic!("{exit:?} after {events:?}"),
        }
    }
    panic!("no end: {events:?}");
}

/// What the statements of a program ask of the device. V1 is 7, V2 is 8.
#[track_caller]
fn check_in(dialect: &Dialect, statements: &str, expected: &[&str]) {
    let mut memory = load(dialect, &format!("PRG 0\nV1=7\nV2=8\n{statements}\nEND\n"));
    assert_eq!(run(&mut memory), expected, "{statements}");
}

#[track_caller]
fn check(statements: &str, expected: &[&str]) {
    check_in(&PERFORMAX_2, statements, expected);
    check_in(&COMMANDER, statements, expected);
}

/// The value of V1 behind the statements.
#[track_caller]
fn check_v1(statements: &str, expected: i32) {
    let mut memory = load(&PERFORMAX_2, &format!("PRG 0\nV1=7\nV2=8\n{statements}\nEND\n"));
    run(&mut memory);
    assert_eq!(memory.variable(1), Some(expected), "{statements}");
}

#[test]
fn every_example_compiles_in_its_dialects() {
    for dialect in [&PERFORMAX_2, &COMMANDER] {
        for entry in TABLE {
            let example = match entry.word {
                // The Commander's has a mode, Performax' has none.
                Word::Home if dialect.family == Family::Performax => "HOMEX-",
                _ => entry.doc.example,
            };
            let program = match entry.word {
                Word::Prg => format!("{example}\nEND\n"),
                Word::Sub => format!("{example}\nENDSUB\n"),
                Word::End => format!("PRG 0\n{example}\n"),
                Word::EndSub => format!("SUB 0\n{example}\n"),
                Word::If => format!("{example}\nENDIF\nEND\n"),
                Word::ElseIf | Word::Else | Word::EndIf => {
                    let end = if entry.word == Word::EndIf { "" } else { "ENDIF\n" };
                    format!("IF 1=1\n{example}\n{end}END\n")
                }
                Word::While => format!("{example}\nENDWHILE\nEND\n"),
                Word::EndWhile => format!("WHILE 1=1\n{example}\nEND\n"),
                _ if example.starts_with("IF") => format!("{example}\nENDIF\nEND\n"),
                _ if example.starts_with("WHILE") => format!("{example}\nENDWHILE\nEND\n"),
                _ => format!("{example}\nEND\n"),
            };
            let errors = compile("example", program.as_bytes(), dialect).has_errors();
            assert_eq!(errors, entry.access(dialect.family).is_none(), "{}: {program}", dialect.name);
            assert!(entry.suffix == Suffix::Targets || example.contains(entry.name), "{example}");
        }
    }
}

#[test]
fn every_word_has_its_test() {
    let tests = include_str!("words.rs");
    for entry in TABLE {
        assert!(tests.contains(&format!("\nfn {}() {{", entry.doc.test)), "no test `{}`", entry.doc.test);
    }
}

/// The page of decisions names tests of this crate, in its last column.
#[test]
fn every_decision_has_its_test() {
    let crate_folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = std::fs::read_to_string(crate_folder.join("../../docs/conformance/a-script-decisions.md"));
    let page = page.expect("the page is there");
    let mut sources = String::new();
    let mut folders = vec![crate_folder.join("src"), crate_folder.join("tests")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
            match entry.file_type() {
                Ok(kind) if kind.is_dir() => folders.push(entry.path()),
                _ => sources += &std::fs::read_to_string(entry.path()).expect("text"),
            }
        }
    }
    let last_columns = page.lines().filter_map(|line| line.strip_suffix("` |")?.rsplit('`').next());
    let tests: Vec<&str> = last_columns.collect();
    assert!(tests.len() > 20);
    for test in tests {
        assert!(sources.contains(&format!("fn {test}(")), "no test `{test}`");
    }
}

#[test]
fn registers_are_read_and_written_as_their_access_says() {
    for dialect in [&PERFORMAX_2, &COMMANDER] {
        let registers = TABLE.iter().filter(|entry| entry.kind == Kind::Register);
        for (entry, access) in registers.filter_map(|entry| Some((entry, entry.access(dialect.family)?))) {
            let name = match entry.suffix {
                Suffix::Axis => format!("{}Y", entry.name),
                Suffix::Index(index) => format!("{}{}", entry.name, index.range(dialect).1),
                _ => entry.name.to_owned(),
            };
            let can = |statement: String| {
                !compile("test", format!("{statement}\nEND\n").as_bytes(), dialect).has_errors()
            };
            assert_eq!(can(format!("V1={name}")), access.reads(), "{name}");
            assert_eq!(can(format!("{name}=1")), access.writes(), "{name}");
            if access.reads() {
                check_in(dialect, &format!("V1={name}"), &[&format!("read {name}")]);
            }
            if access.writes() {
                check_in(dialect, &format!("{name}=-5"), &[&format!("{name}=-5")]);
                check_in(dialect, &format!("{name}=V2"), &[&format!("{name}=8")]);
            }
            assert_ne!(access, Access::Flow);
        }
    }
}

#[test]
fn comments() {
    check("; nothing\nABS ;X1000\n;;\n;WAITX", &["Abs"]);
}

#[test]
fn programs() {
    let memory = load(&COMMANDER, "PRG 3\nABS\nEND\nPRG0\nINC\nEND\n");
    let line = |address: u16| memory.line(address).expect("a line").to_string();
    assert_eq!(memory.program(3).map(line).as_deref(), Some("PRG 3"));
    assert_eq!(memory.program(0), Some(3));
    assert_eq!(memory.program(1), None);
    // Without PRG it is program 0.
    assert_eq!(run(&mut load(&PERFORMAX_2, "ABS\nEND\n")), ["Abs"]);
    assert_eq!(run(&mut load(&PERFORMAX_2, "ABS\nEND\nPRG 1\nINC\nEND\n")), ["Abs"]);
}

#[test]
fn subroutines() {
    let source = "PRG 0\nGOSUB 1\nX1\nGOSUB31\nEND\nSUB 1\nX2\nGOSUB 31\nENDSUB\nSUB 31\nX3\nENDSUB\n";
    assert_eq!(run(&mut load(&PERFORMAX_2, source)), ["X X X:2", "X X X:3", "X X X:1", "X X X:3"]);
}

#[test]
fn branches() {
    let source = "IF V1=1\nX1\nELSEIF V1=DI2\nX2\nELSEIF V1=3\nX3\nELSE\nX4\nENDIF\nX5\n";
    let check_branch = |v1: i32, expected: &[&str]| check(&format!("V1={v1}\n{source}"), expected);
    check_branch(1, &["X X X:1", "X X X:5"]);
    check_branch(READING, &["read DI2", "X X X:2", "X X X:5"]);
    check_branch(3, &["read DI2", "X X X:3", "X X X:5"]);
    check_branch(9, &["read DI2", "X X X:4", "X X X:5"]);
    check("IF V1=8\nX1\nENDIF\nIF V1=7\nELSE\nX2\nENDIF", &[]);
    // Every comparison, with a calculation on either side.
    for (condition, holds) in [
        ("V1=7", true),
        ("V1!=7", false),
        ("V1<V2", true),
        ("V1>V2", false),
        ("V1<=7", true),
        ("V1>=8", false),
        ("V1+1=V2", true),
        ("V2=V1+1", true),
        ("V1>V2-2", true),
        ("V2-2>V1", false),
        ("V1>=V2*-1", true),
        ("3<V1&V2", false),
        ("~V1=-8", true),
        ("-8>=~V1", true),
        ("1<2", true),
    ] {
        let expected: &[&str] = if holds { &["Abs"] } else { &[] };
        check(&format!("IF {condition}\nABS\nENDIF"), expected);
    }
    check("IF DI1+DI2=DI3\nENDIF", &["read DI1", "read DI2", "read DI3"]);
    // An operator's side is read first.
    check("IF DI3=DI1+DI2\nENDIF", &["read DI1", "read DI2", "read DI3"]);
}

#[test]
fn loops() {
    check("V3=0\nWHILE V3<3\nXV3\nV3=V3+1\nENDWHILE", &["X X X:0", "X X X:1", "X X X:2"]);
    check("WHILE V1=8\nABS\nENDWHILE", &[]);
    let nested =
        "V3=0\nWHILE V3<2\nV4=0\nWHILE V4<2\nIF V4=1\nXV3\nENDIF\nV4=V4+1\nENDWHILE\nV3=V3+1\nENDWHILE";
    check(nested, &["X X X:0", "X X X:1"]);
    check("WHILE DI1=1\nENDWHILE", &["read DI1"]);
}

#[test]
fn variables() {
    check_v1("V1=V2", 8);
    check_v1("V1=-2147483648", i32::MIN);
    check_v1("V1=DI", READING);
    check_v1("V1=~DI", !READING);
    check_v1("V1 = ~ V2", -9);
    check_v1("V1=V1+V2", 15);
    check_v1("V1=V1-V2", -1);
    check_v1("V1=V1--1", 8);
    check_v1("V1=V1*V2", 56);
    check_v1("V1=V2/3", 2);
    check_v1("V1=-7/2", -4);
    check_v1("V1=-7%5", 3);
    check_v1("V1=V2>>2", 2);
    check_v1("V1=V1 << 2", 28);
    check_v1("V1=V1&3", 3);
    check_v1("V1=V1|8", 15);
    check_v1("V1=2147483647+V2", i32::MIN + 7);
    check_v1("V1=PX-EX", 0);
    check_v1("V1=1000+DI", 1000 + READING);
    check_v1("V63=V2\nV1=V63", 8);
}

#[test]
fn stopping() {
    check("ABORT\nABORTY\nSTOP\nSTOPX", &["Abort", "AbortAxis Y", "Stop", "StopAxis X"]);
}

#[test]
fn modes() {
    check("ABS\nINC", &["Abs", "Inc"]);
    check_in(&COMMANDER, "EINT=0\nV1=EINT", &["EINT=0", "read EINT"]);
}

#[test]
fn errors_and_settings() {
    check("ECLEARY\nSTORE", &["Eclear Y", "Store"]);
    check_in(&PERFORMAX_2, "TOC=5000", &["TOC=5000"]);
}

#[test]
fn waiting() {
    check("WAITX\nDELAY=100\nDELAY=V1", &["Wait X", "Delay 100", "Delay 7"]);
    // Milliseconds are unsigned: this is 4294967295.
    check("DELAY=4294967295", &["Delay -1"]);
}

#[test]
fn program_control() {
    check("SR0=1\nSR1=V1", &["Sr 0 1", "Sr 1 7"]);
    check_in(&COMMANDER, "SR3=2", &["Sr 3 2"]);
}

#[test]
fn jogging() {
    check("JOGX+\nJOGY -", &["Jog X +", "Jog Y -"]);
}

#[test]
fn homing() {
    let words = "HOMEX-\nHLHOMEY+\nLHOMEX-\nZHOMEX+\nZOMEY-";
    let expected = ["Home X -", "HlHome Y +", "LHome X -", "ZHome X +", "Zome Y -"];
    check_in(&PERFORMAX_2, words, &expected);
    check_in(&COMMANDER, "HOMEX-6\nHOMEU+12\nZMOVEZ+", &["Home X - 6", "Home U + 12", "ZMove Z +"]);
}

#[test]
fn moves() {
    check("X1000\nY-5\nXV1\nX V2", &["X X X:1000", "Y Y Y:-5", "X X X:7", "X X X:8"]);
    check("X1000Y-2000\nXV1YV2\nY1X2", &["Linear X:1000 Y:-2000", "Linear X:7 Y:8", "Linear X:2 Y:1"]);
    check_in(&COMMANDER, "Z1\nUV1", &["Z Z Z:1", "U U U:7"]);
    check_in(&COMMANDER, "X1Y2Z3U4\nX1Z3", &["Linear X:1 Y:2 Z:3 U:4", "Linear X:1 Z:3"]);
}

#[test]
fn arcs() {
    let words = "CIRXYP487659:562431\nCIRUZNV1:V2\nARCXYN288899:267403:95000";
    let expected = ["Cir X Y + 487659 562431", "Cir U Z - 7 8", "Arc X Y - 288899 267403 95000"];
    check_in(&COMMANDER, words, &expected);
    check_in(
        &COMMANDER,
        "CIRTP1:2:3\nCIRTN1:V1:-3\nARCTP1:2:3:4\nARCTNV1:1:V2:-4",
        &["CirT + 1 2 3", "CirT - 1 7 -3", "ArcT + 1 2 3 4", "ArcT - 7 1 8 -4"],
    );
}

#[test]
fn buffer() {
    check_in(&COMMANDER, "BUFON\nISTART\nBUFOFF", &["BufOn", "IStart", "BufOff"]);
}

#[test]
fn synchronization() {
    check_in(
        &COMMANDER,
        "SYNCFGX=1\nSYNPOSU=V1\nSYNONX\nV1=SYNSTATX\nSYNOFFX",
        &["SYNCFGX=1", "SYNPOSU=7", "SynOn X", "read SYNSTATX", "SynOff X"],
    );
}

#[test]
fn latches_and_more() {
    check_in(
        &COMMANDER,
        "LTX=1\nV1=LTSX\nV1=LTPY\nV1=LTEU\nMPGEZ=V2\nV1=MPGEZ\nPWM2=50\nV1=PWM1",
        &["LTX=1", "read LTSX", "read LTPY", "read LTEU", "MPGEZ=8", "read MPGEZ", "PWM2=50", "read PWM1"],
    );
    let source = b"PRG 0\nPWM3=1\nEND\n";
    assert!(ascript::compiler::compile("test.prg", source, &COMMANDER).has_errors());
}

#[test]
fn speeds() {
    check(
        "HSPD=20000\nHSPDY=V1\nLSPD=100\nLSPDX=1\nACC=300\nACCX=V2\nDEC=1\nDECY=2\nSSPDMX=3\nSSPDX=5000",
        &[
            "HSPD=20000",
            "HSPDY=7",
            "LSPD=100",
            "LSPDX=1",
            "ACC=300",
            "ACCX=8",
            "DEC=1",
            "DECY=2",
            "SSPDMX=3",
            "SSPDX=5000",
        ],
    );
    check_in(&PERFORMAX_2, "SCVX=1\nV1=SCVY", &["SCVX=1", "read SCVY"]);
}

#[test]
fn positions() {
    check("PX=0\nEY=V1\nV1=PSX\nV1=MSTX&7", &["PX=0", "EY=7", "read PSX", "read MSTX"]);
}

#[test]
fn inputs_and_outputs() {
    check("V1=DI\nV1=DI4\nV1=AI2", &["read DI", "read DI4", "read AI2"]);
    check("DO=2\nDO4=1\nEO=3\nEO2=V1\nV1=DO1", &["DO=2", "DO4=1", "EO=3", "EO2=7", "read DO1"]);
    check_in(&PERFORMAX_2, "DO8=1\nV1=DI8", &["DO8=1", "read DI8"]);
    check_in(&COMMANDER, "IO=64\nIO32=1\nIF IO1=0\nENDIF", &["IO=64", "IO32=1", "read IO1"]);
}

#[test]
fn step_n_loop() {
    check("SLX=1\nV1=SLSY", &["SLX=1", "read SLSY"]);
    check_in(&COMMANDER, "V1=SLX", &["read SLX"]);
}

#[test]
fn joystick() {
    check("JOYENA=3\nJOYHSX=V1\nJOYDELY=100", &["JOYENA=3", "JOYHSX=7", "JOYDELY=100"]);
    check_in(
        &PERFORMAX_2,
        "JOYTOLX=200\nJOYNOX=-10000\nJOYNIX=-9000\nJOYPIY=9000\nJOYPOY=10000",
        &["JOYTOLX=200", "JOYNOX=-10000", "JOYNIX=-9000", "JOYPIY=9000", "JOYPOY=10000"],
    );
}
