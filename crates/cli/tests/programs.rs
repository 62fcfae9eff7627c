//! `run`, `asm`, `disasm` and `check`.

mod common;

use common::{command, directory, outcome, refused};
use serde_json::Value;
use std::{fs, io::Write, path::Path, process::Stdio};

const MOVE: &str = "MVP ABS, 0, 51200\nWAIT POS, 0, 0\nSTOP\n";

/// `MVP ABS, 0, 51200`, `WAIT POS, 0, 0` and `STOP` as a program file.
const MOVE_BYTES: [u8; 24] = [4, 0, 0, 0, 0, 200, 0, 204, 27, 1, 0, 0, 0, 0, 0, 28, 28, 0, 0, 0, 0, 0, 0, 28];

fn json(directory: &Path, arguments: &[&str], status: i32) -> Value {
    let (code, stdout, stderr) = outcome(directory, arguments);
    assert_eq!(code, status, "{stderr}");
    serde_json::from_str(&stdout).unwrap()
}

#[test]
fn a_run_moves_the_axis() {
    let directory = directory(&[("move.tmc", MOVE)]);
    fs::write(directory.join("move.bin"), MOVE_BYTES).unwrap();
    for file in ["move.tmc", "move.bin"] {
        let result = json(&directory, &["run", file, "--device", "pd42-1140", "--json"], 0);
        assert_eq!(result["axes"]["0"]["position"], 51200);
        assert_eq!(result["axes"]["0"]["steps"], 51200);
        assert_eq!(result["stop_reason"], "ended");
        assert_eq!(result["instructions"], 3);
        let seconds = result["device_seconds"].as_f64().unwrap();
        assert!((0.5..10.0).contains(&seconds), "{seconds}");
        assert!(result["wall_seconds"].as_f64().unwrap() < seconds);
        assert!(result["axes"]["0"]["encoder"].is_i64() && result["axes"]["0"]["status"].is_u64());
    }
    let (status, stdout, _) = outcome(&directory, &["run", "move.tmc", "--device", "pd42-1140"]);
    assert_eq!(status, 0);
    assert!(stdout.starts_with("ended after ") && stdout.contains("axis 0: position 51200"), "{stdout}");
}

#[test]
fn commands_that_are_passed_over_are_reported() {
    let directory = directory(&[("wrong.tmc", "SAP 5, 0, 10000\nMVP ABS, 0, 10\nWAIT POS, 0, 0\nSTOP\n")]);
    let (status, stdout, stderr) = outcome(&directory, &["run", "wrong.tmc", "--device", "pd42-1140"]);
    assert_eq!(status, 0);
    assert!(stdout.contains("axis 0: position 10"), "{stdout}");
    let expected = "warning: wrong.tmc: SAP at address 0 was passed over: invalid value (4)\n";
    assert!(stderr.ends_with(expected), "{stderr}");
}

#[test]
fn the_time_of_a_run_is_bounded() {
    let directory = directory(&[("loop.tmc", "l: JA l\n")]);
    let arguments = ["run", "loop.tmc", "--device", "pd42-1140", "--json", "--for"];
    let result = json(&directory, &[&arguments[..], &["2.5"]].concat(), 0);
    assert_eq!(result["device_seconds"], 2.5);
    assert_ne!(result["stop_reason"], "ended");
    // 50 µs a command.
    let instructions = result["instructions"].as_u64().unwrap();
    assert!((49_990..=50_010).contains(&instructions), "{instructions}");
}

#[test]
fn pins_change_on_the_way() {
    let source = "ROR 0, 500\nWAIT LIMSW, 0, 0\nGAP 1, 0\nSTOP\n";
    let directory = directory(&[("search.tmc", source)]);
    let arguments = ["run", "search.tmc", "--device", "pd42-1140", "--json", "--for", "5"];
    let free = json(&directory, &arguments, 0);
    let stopped = json(&directory, &[&arguments[..], &["--at", "1:STOP_R=true"]].concat(), 0);
    let released = ["--at", "1:STOP_R=true", "--at", "1.5:STOP_R=release"];
    let released = json(&directory, &[&arguments[..], &released].concat(), 0);
    let position = |result: &Value| result["axes"]["0"]["position"].as_i64().unwrap();
    assert!(position(&free) > 2 * position(&stopped), "{free} {stopped}");
    assert!(position(&stopped) > 0);
    assert_eq!(stopped["stop_reason"], "ended");
    assert_eq!(position(&released), position(&stopped), "the program has ended by then");
}

#[test]
fn a_bench_file_tells_the_machine() {
    let bench = "[[device]]\nmodel = \"pd42-1140\"\n[device.axis.0]\npositive_limit = 20000\n";
    let directory = directory(&[("move.tmc", MOVE), ("bench.toml", bench), ("empty.toml", "device = []\n")]);
    let arguments = ["run", "move.tmc", "--device", "pd42-1140", "--json", "--for", "10", "--bench"];
    let result = json(&directory, &[&arguments[..], &["bench.toml"]].concat(), 0);
    let position = result["axes"]["0"]["position"].as_i64().unwrap();
    assert!((20_000..20_100).contains(&position), "the switch stops it at once: {position}");
    refused(&directory, &[&arguments[..], &["empty.toml"]].concat(), "empty.toml: there is no pd42-1140");
    refused(&directory, &[&arguments[..], &["none.toml"]].concat(), "none.toml: ");
}

#[test]
fn runs_are_recorded() {
    let directory = directory(&[("move.tmc", MOVE)]);
    let files = ["--record", "a.csv", "--record", "b.csv", "--plot", "c.svg"];
    let (status, _, stderr) =
        outcome(&directory, &[&["run", "move.tmc", "--device", "pd42-1140"], &files[..]].concat());
    assert_eq!((status, stderr.as_str()), (0, ""));
    let text = |name: &str| fs::read_to_string(directory.join(name)).unwrap();
    assert!(text("a.csv").lines().any(|line| line.contains("51200")));
    assert_eq!(text("a.csv"), text("b.csv"));
    assert!(text("c.svg").starts_with("<svg") && text("c.svg").trim_end().ends_with("</svg>"));
}

#[test]
fn a_program_that_the_module_does_not_take_is_refused() {
    // A command that only a host may send is executed in the middle of the download.
    let directory = directory(&[]);
    fs::write(directory.join("bad.bin"), [&[129, 0, 0, 0, 0, 0, 0, 129], &MOVE_BYTES[..]].concat()).unwrap();
    let arguments = ["run", "bad.bin", "--device", "pd42-1140", "--json", "--for", "5"];
    refused(&directory, &arguments, "bad.bin: ");
}

#[test]
fn wrong_runs_are_refused_in_one_line() {
    let directory = directory(&[("move.tmc", MOVE), ("text.txt", ""), ("short.bin", "1234567")]);
    let check = |arguments: &[&str], expected: &str| {
        refused(&directory, &[&["run"], arguments].concat(), expected);
    };
    let device = ["--device", "pd42-1140"];
    let with = |arguments: &[&'static str]| [&["move.tmc"][..], &device, arguments].concat();
    check(&[], "required arguments were not provided: --device <MODEL> <PROGRAM>");
    check(&["move.tmc"], "--device <MODEL>");
    check(&["move.tmc", "--device", "pd57"], "unknown model `pd57`, known: pd42-1140");
    check(&["none.tmc", device[0], device[1]], "none.tmc: No such file");
    check(&["text.txt", device[0], device[1]], "text.txt: a program of a pd42-1140 is a .tmc or .bin file");
    check(&["short.bin", device[0], device[1]], "short.bin: ");
    check(&["move", device[0], device[1]], "move: a program of a pd42-1140 is a .tmc or .bin file");
    check(&with(&["--for", "-1"]), "a time is a number of seconds");
    check(&with(&["--for", "soon"]), "a time is a number of seconds");
    check(&with(&["--for", "NaN"]), "a time is a number of seconds");
    check(&with(&["--at", "1:HOME"]), "`1:HOME` is not of the form TIME:PIN=VALUE");
    check(&with(&["--at", "x:HOME=true"]), "`x` is not a time in seconds");
    check(&with(&["--at", "1:HOME=maybe"]), "`maybe` is not a value");
    check(&with(&["--at", "1:NOSE=true"]), "there is no pin `NOSE`");
    check(&with(&["--at", "1:HOME=7"]), "`HOME` is digital");
    check(&with(&["--record", "a.mp3"]), "a.mp3: no recording format with this extension, known: .csv");
    check(&with(&["--record", "none/a.csv"]), "none/a.csv: No such file");
    check(&with(&["--plot", "a.csv"]), "a.csv: a plot is an .svg or .png file");
    check(&with(&["--record", "a.csv", "--record", "a.csv"]), "a.csv: one file cannot hold two recordings");
    check(&with(&["--frobnicate"]), "unexpected argument '--frobnicate'");
}

#[test]
fn assembling_and_disassembling() {
    let source = "// comment\nSpeed = 500 * 2\nSAP 4, 0, Speed\nLoop: MVP REL, 0, 100\nJA Loop\n";
    let directory = directory(&[("a.tmc", source)]);
    let (status, stdout, stderr) = outcome(&directory, &["asm", "a.tmc", "-o", "a.bin"]);
    assert_eq!((status, stdout.as_str(), stderr.as_str()), (0, "", ""));
    let bytes = fs::read(directory.join("a.bin")).unwrap();
    assert_eq!(bytes[..8], [5, 4, 0, 0, 0, 3, 232, 244]);
    assert_eq!(bytes.len(), 4 * 8, "a STOP is appended");

    let (status, stdout, _) = outcome(&directory, &["disasm", "a.bin"]);
    assert_eq!(status, 0);
    fs::write(directory.join("b.tmc"), &stdout).unwrap();
    let (status, listing, _) =
        outcome(&directory, &["asm", "b.tmc", "-o", "b.bin", "--symbols", "b.sym", "--list"]);
    assert_eq!(status, 0);
    assert_eq!(fs::read(directory.join("b.bin")).unwrap(), bytes);
    assert!(fs::read_to_string(directory.join("b.sym")).unwrap().contains("1 L1"));
    assert_eq!(listing.lines().count(), 4);
    let first = "   0  05 04 00 00 00 03 E8 F4  SAP 4, 0, 1000";
    assert!(listing.starts_with(first), "{listing}");

    assert_eq!(outcome(&directory, &["check", "a.tmc", "--device", "pd42-1140"]).0, 0);
    assert_eq!(outcome(&directory, &["check", "a.bin", "--device", "pd42-1140"]).0, 0);
}

#[test]
fn mistakes_in_a_source_have_file_line_and_column() {
    let directory = directory(&[
        ("bad.tmc", "MVP ABS, 0, 100\n  MVQ ABS, 0, 100\nJA nowhere\n"),
        ("warn.tmc", "SAP 5, 0, 10000\n"),
        ("main.tmc", "#include part.tmc\nSTOP\n"),
        ("part.tmc", "\nMVP ABS\n"),
    ]);
    fs::write(directory.join("warn.bin"), [5, 5, 0, 0, 0, 39, 16, 65]).unwrap();
    let check = |arguments: &[&str], status: i32, expected: &[&str]| {
        let (code, stdout, stderr) = outcome(&directory, arguments);
        assert_eq!((code, stdout.as_str()), (status, ""), "{arguments:?}: {stderr}");
        for text in expected {
            assert!(stderr.contains(text), "{arguments:?}: {text} is not in\n{stderr}");
        }
    };
    let device = ["--device", "pd42-1140"];
    check(&["asm", "bad.tmc", "-o", "x.bin"], 1, &["error: ", "bad.tmc:2:3", "MVP", "bad.tmc:3:4"]);
    assert!(!directory.join("x.bin").exists(), "nothing is written");
    check(&["check", "bad.tmc", device[0], device[1]], 1, &["bad.tmc:2:3"]);
    check(&["run", "bad.tmc", device[0], device[1]], 1, &["bad.tmc:2:3"]);
    check(&["check", "main.tmc", device[0], device[1]], 1, &["part.tmc:2:"]);
    let range = "maximum acceleration goes from 1 to 2047";
    check(&["check", "warn.tmc", device[0], device[1]], 0, &["warning: ", "warn.tmc:1:", range]);
    check(&["check", "warn.bin", device[0], device[1]], 0, &["warning: warn.bin: command 0", range]);
}

#[test]
fn wrong_files_are_refused_in_one_line() {
    let directory = directory(&[("short.bin", "1234567"), ("sum.bin", "12345678"), ("a.tmc", "STOP\n")]);
    let check = |arguments: &[&str], expected: &str| refused(&directory, arguments, expected);
    check(&["asm"], "required arguments were not provided");
    check(&["asm", "a.tmc"], "required arguments were not provided");
    check(&["asm", "none.tmc", "-o", "a.bin"], "none.tmc: No such file");
    check(&["asm", ".", "-o", "a.bin"], ".: Is a directory");
    check(&["asm", "a.tmc", "-o", "none/a.bin"], "none/a.bin: No such file");
    check(&["disasm", "none.bin"], "none.bin: No such file");
    check(&["disasm", "short.bin"], "short.bin: a program file has 8 bytes a command, this one has 7 bytes");
    check(&["disasm", "sum.bin"], "sum.bin: record 0 has checksum 38h");
    check(&["check", "a.tmc"], "--device <MODEL>");
    check(
        &["check", "a.toml", "--device", "pd42-1140"],
        "a.toml: a program of a pd42-1140 is a .tmc or .bin file",
    );
    check(&["explode"], "unrecognized subcommand 'explode'");
    check(&["completions", "tcsh"], "invalid value 'tcsh'");
}

#[test]
fn help_version_and_completions() {
    let directory = directory(&[]);
    let check = |arguments: &[&str], expected: &str| {
        let (status, stdout, stderr) = outcome(&directory, arguments);
        assert_eq!((status, stderr.as_str()), (0, ""), "{arguments:?}");
        assert!(stdout.contains(expected), "{arguments:?}: {stdout}");
    };
    check(&["--version"], concat!("pulsetrain ", env!("CARGO_PKG_VERSION")));
    check(&["--help"], "Run a program in virtual time");
    check(&["serve", "--help"], "MODEL[=NAME]@ENDPOINT");
    check(&["run", "--help"], "--plot <FILE.svg>");
    check(&["completions", "bash"], "complete -F _pulsetrain");
    let (status, stdout, stderr) = outcome(&directory, &[]);
    assert_eq!((status, stdout.as_str()), (1, ""));
    assert!(stderr.contains("Usage: pulsetrain <COMMAND>"), "{stderr}");
}

#[test]
fn a_reader_that_has_seen_enough_is_no_error() {
    let directory = directory(&[]);
    fs::write(directory.join("long.bin"), [28, 0, 0, 0, 0, 0, 0, 28].repeat(2048)).unwrap();
    let mut child = command(&directory, &["disasm", "long.bin"])
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), output.stderr.as_slice()), (Some(0), &b""[..]));
}

#[test]
fn sources_are_laid_out() {
    let untidy = "loop:  mvp rel,0,100 // on\nja loop\n";
    let tidy = "loop: MVP rel, 0, 100       // on\n    JA   loop\n";
    let directory = directory(&[("a.tmc", untidy), ("b.tmc", tidy), ("c.md", "")]);
    fs::write(directory.join("a.bin"), MOVE_BYTES).unwrap();
    let check = |arguments: &[&str], status: i32, expected: &str| {
        let (code, stdout, stderr) = outcome(&directory, &[&["fmt"], arguments].concat());
        assert_eq!((code, stdout.as_str(), stderr.as_str()), (status, "", expected), "{arguments:?}");
    };
    check(&["--check", "b.tmc", "a.tmc"], 1, "error: a.tmc: the formatter would change it\n");
    assert_eq!(fs::read_to_string(directory.join("a.tmc")).unwrap(), untidy, "nothing is written");
    check(&["a.tmc", "b.tmc", "--device", "pd42-1140"], 0, "");
    assert_eq!(fs::read_to_string(directory.join("a.tmc")).unwrap(), tidy);
    check(&["--check", "a.tmc", "b.tmc"], 0, "");
    check(&["c.md"], 1, "error: c.md: a program is a .tmc, .bin, .prg or .txt file\n");
    check(&["a.bin"], 1, "error: a.bin: machine code has no layout\n");
    check(&["-"], 1, "error: -: say whose program it is, with --device\n");
    // One that fails does not keep the others from being laid out.
    fs::write(directory.join("a.tmc"), untidy).unwrap();
    let (status, _, stderr) = outcome(&directory, &["fmt", "none.tmc", "a.tmc"]);
    assert!(status == 1 && stderr.starts_with("error: none.tmc: "), "{stderr}");
    assert_eq!(fs::read_to_string(directory.join("a.tmc")).unwrap(), tidy);

    let mut child = command(&directory, &["fmt", "-", "--device", "pd42-1140"]);
    let child = child.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
    let mut child = child.unwrap();
    child.stdin.take().unwrap().write_all(untidy.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success());
    assert_eq!(String::from_utf8(output.stdout).unwrap(), tidy);
}
