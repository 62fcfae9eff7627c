//! `compile`, `decompile`, `check`, `run` and `fmt` with A-SCRIPT programs.

mod common;

use common::{directory, outcome, refused};
use serde_json::Value;
use std::{fs, path::Path};

const DEVICE: [&str; 2] = ["--device", "pmx-2ed"];

const TWO_PROGRAMS: &str = "\
; Each program moves an axis.
PRG 0
  HSPD=20000
  EO=3
  X4000
  WAITX
END

PRG 1
  Y-300
  WAITY
END
";

fn with(arguments: &[&'static str]) -> Vec<&'static str> {
    [arguments, &DEVICE[..]].concat()
}

fn json(directory: &Path, arguments: &[&str], status: i32) -> Value {
    let (code, stdout, stderr) = outcome(directory, arguments);
    assert_eq!(code, status, "{stderr}");
    serde_json::from_str(&stdout).unwrap()
}

#[test]
fn all_programs_of_a_file_run() {
    let directory = directory(&[("two.prg", TWO_PROGRAMS), ("two.txt", TWO_PROGRAMS)]);
    assert_eq!(outcome(&directory, &with(&["compile", "two.prg", "-o", "two.bin"])).0, 0);
    for file in ["two.prg", "two.txt", "two.bin"] {
        let result = json(&directory, &[&["run", file, "--json"], &DEVICE[..]].concat(), 0);
        assert_eq!(result["stop_reason"], "ended");
        assert_eq!(result["instructions"], 10);
        let axis = |name: &str| ["position", "encoder", "steps"].map(|of| result["axes"][name][of].as_i64());
        assert_eq!(axis("X"), [4000, 4000, 4000].map(Some));
        assert_eq!(axis("Y"), [-300, -300, 300].map(Some));
    }
    let (_, stdout, _) = outcome(&directory, &with(&["run", "two.prg"]));
    assert!(stdout.contains("axis X: position 4000") && stdout.contains("axis Y: position -300"), "{stdout}");
}

#[test]
fn a_run_is_bounded_recorded_and_disturbed() {
    let forever = "EO=1\nHSPD=5000\nWHILE 1=1\nX10000\nWAITX\nX0\nWAITX\nENDWHILE\nEND\n";
    let bench = "[[device]]\nmodel = \"pmx-2ed\"\n[device.axis.X]\npositive_limit = 2000\n";
    let directory = directory(&[("forever.prg", forever), ("bench.toml", bench)]);
    let run = ["run", "forever.prg", "--json", "--for", "3"];
    let result = json(&directory, &with(&run), 0);
    assert_eq!((&result["stop_reason"], &result["device_seconds"]), (&"time up".into(), &3.0.into()));

    let (status, stdout, stderr) = outcome(
        &directory,
        &with(&["run", "forever.prg", "--json", "--at", "0.5:+LX=true", "--record", "a.csv"]),
    );
    assert_eq!(status, 2, "{stderr}");
    assert_eq!(stderr, "error: forever.prg:5: program 0 went into its error state\n");
    let result: Value = serde_json::from_str(&stdout).unwrap();
    assert_eq!(result["stop_reason"], "error");
    let csv = fs::read_to_string(directory.join("a.csv")).unwrap();
    assert!(csv.contains("0.5,pin,,,,,,,+LX,1"), "the switch is in the recording");

    // On a short axis it is the machine that stops it.
    let (status, stdout, _) =
        outcome(&directory, &with(&["run", "forever.prg", "--json", "--bench", "bench.toml"]));
    let result: Value = serde_json::from_str(&stdout).unwrap();
    assert_eq!((status, result["axes"]["X"]["position"].as_i64()), (2, Some(2000)));
    let check = |at: &'static str, expected: &str| {
        refused(&directory, &with(&["run", "forever.prg", "--at", at]), expected);
    };
    check("1:+LZ=true", "there is no pin `+LZ`");
    check("1:AI1=true", "`AI1` is analog: a number in mV");
    check("1:DO1=true", "`DO1` is an output");
}

#[test]
fn compiling_and_decompiling() {
    let directory = directory(&[("two.prg", TWO_PROGRAMS), ("empty.bin", "")]);
    let (status, stdout, stderr) =
        outcome(&directory, &with(&["compile", "two.prg", "-o", "two.bin", "--list"]));
    assert_eq!((status, stderr.as_str()), (0, ""));
    assert!(stdout.starts_with("   0  PRG 0 ") && stdout.lines().count() == 10, "{stdout}");
    assert!(stdout.contains("X 4000 ") && stdout.contains("; two.prg:5"), "{stdout}");
    let (status, source, _) = outcome(&directory, &with(&["decompile", "two.bin"]));
    assert_eq!(status, 0);
    fs::write(directory.join("again.prg"), source).unwrap();
    assert_eq!(outcome(&directory, &with(&["compile", "again.prg", "-o", "again.bin"])).0, 0);
    let bytes = |name: &str| fs::read(directory.join(name)).unwrap();
    assert_eq!(bytes("again.bin"), bytes("two.bin"));
    assert_eq!(outcome(&directory, &with(&["check", "two.bin"])), (0, String::new(), String::new()));

    let mut damaged = bytes("two.bin");
    damaged[9] ^= 1;
    fs::write(directory.join("damaged.bin"), damaged).unwrap();
    refused(&directory, &with(&["decompile", "damaged.bin"]), "damaged.bin: the program file is damaged");
    refused(&directory, &with(&["decompile", "empty.bin"]), "empty.bin: this is no A-SCRIPT program file");
    refused(&directory, &with(&["run", "empty.bin"]), "empty.bin: this is no A-SCRIPT program file");
    refused(&directory, &with(&["compile", "two.prg"]), "required arguments were not provided");
    refused(&directory, &with(&["compile", "none.prg", "-o", "a"]), "none.prg: No such file");
    let other = ["compile", "two.prg", "-o", "a", "--device", "pd42-1140"];
    refused(&directory, &other, "a pd42-1140 has no A-SCRIPT programs");
}

#[test]
fn mistakes_have_file_line_and_column() {
    let directory = directory(&[("bad.prg", "HSPD=1000\n  FOO=3\nDELAY=V1+200\nX1000\nEND\n")]);
    for arguments in [
        &["check", "bad.prg"][..],
        &["run", "bad.prg"],
        &["compile", "bad.prg", "-o", "x"],
        &["fmt", "bad.prg"],
    ] {
        let (status, stdout, stderr) = outcome(&directory, &[arguments, &DEVICE[..]].concat());
        assert_eq!((status, stdout.as_str()), (1, ""), "{arguments:?}");
        for expected in ["bad.prg:2:3", "bad.prg:3:", "Token Error"] {
            assert!(stderr.contains(expected), "{arguments:?}: {expected} is not in\n{stderr}");
        }
    }
    assert!(!directory.join("x").exists(), "nothing is written");
    assert!(fs::read_to_string(directory.join("bad.prg")).unwrap().contains("  FOO"), "nothing is laid out");
}

#[test]
fn a_program_belongs_to_a_model() {
    let directory = directory(&[("a.prg", "END\n"), ("a.tmc", "STOP\n")]);
    let check = |arguments: &[&str], expected: &str| refused(&directory, arguments, expected);
    for command in ["run", "check", "fmt"] {
        let wrong = "a.tmc: a program of a pmx-2ed is a .prg, .txt or .bin file";
        check(&[command, "a.tmc", "--device", "pmx-2ed"], wrong);
        check(
            &[command, "a.prg", "--device", "pd42-1140"],
            "a.prg: a program of a pd42-1140 is a .tmc or .bin file",
        );
    }
}

#[test]
fn sources_are_laid_out() {
    let directory =
        directory(&[("two.prg", TWO_PROGRAMS), ("untidy.txt", "while 1=1\nx1000\nendwhile\nend")]);
    fs::write(directory.join("untidy.prg"), "WHILE 1 = 1\nX1000\nENDWHILE\nEND").unwrap();
    assert_eq!(outcome(&directory, &["fmt", "--check", "two.prg"]), (0, String::new(), String::new()));
    let (status, _, stderr) = outcome(&directory, &["fmt", "--check", "untidy.prg", "two.prg"]);
    assert_eq!((status, stderr.as_str()), (1, "error: untidy.prg: the formatter would change it\n"));
    assert_eq!(outcome(&directory, &["fmt", "untidy.prg"]).0, 0);
    let text = fs::read_to_string(directory.join("untidy.prg")).unwrap();
    assert_eq!(text, "WHILE 1=1\n  X1000\nENDWHILE\nEND\n");
}
