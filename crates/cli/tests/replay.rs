//! Tapes: what `run` and `serve` take down, and `replay`.

mod common;

use common::{GAP, MVP, Serve, directory, outcome, refused};
use rustix::process::Signal;
use std::fs;

#[test]
fn what_was_served_can_be_had_again() {
    let directory = directory(&[]);
    let devices = ["pd42-1140=left@tcp:127.0.0.1:0", "pd42-1140=right@tcp:127.0.0.1:0", "--no-http"];
    let record = ["--record", "day.ptr", "--record", "day.vcd"];
    let serve = Serve::start(&directory, &[&devices[..], &record[..]].concat(), 2);
    let mut client = serve.client(1);
    assert_eq!(client.value(MVP, 0, 0, -3000), -3000);
    client.wait_for(8, 1);
    assert_eq!(client.value(GAP, 1, 0, 0), -3000);
    assert_eq!(serve.end(Signal::TERM), Some(0));

    let replay = || {
        let (status, log, errors) = outcome(&directory, &["replay", "day.ptr", "--record", "again.vcd"]);
        assert_eq!((status, errors.as_str()), (0, ""));
        log
    };
    let log = replay();
    assert_eq!(replay(), log);
    // What the client asked, what it was told, and all that the motor made of it.
    assert!(log.contains(" right received usb 01040000fffff4483f\n"), "{log}");
    assert!(log.contains(" right sent usb 02016406fffff448a7"), "{log}");
    assert!(log.contains(" right axis 0: 3000 pulses, -3000 in sum, checksum "), "{log}");
    assert!(log.contains(" left axis 0: 0 pulses, 0 in sum, checksum "), "{log}");

    let rises = |file: &str| {
        let text = fs::read_to_string(directory.join(file)).unwrap();
        let steps = text.lines().find_map(|line| line.strip_suffix(" step_0 $end")).unwrap().to_owned();
        let rise = format!("1{}", steps.rsplit(' ').next().unwrap());
        text.lines().filter(|line| *line == rise).count()
    };
    for file in ["day-right.vcd", "again-right.vcd"] {
        assert_eq!(rises(file), 3000, "{file}");
    }
    assert_eq!(rises("day-left.vcd"), 0);
}

#[test]
fn a_run_can_be_had_again() {
    let program = "MVP ABS, 0, 5000\nWAIT POS, 0, 0\nSTOP\n";
    let directory = directory(&[("a.tmc", program)]);
    let run =
        ["run", "a.tmc", "--device", "pd42-1140", "--for", "9", "--record", "a.ptr", "--record", "a.csv"];
    assert_eq!(outcome(&directory, &[&run[..], &["--at", "0.05:HOME=true"]].concat()).0, 0);
    let (status, log, _) = outcome(&directory, &["replay", "a.ptr", "--record", "b.csv"]);
    assert_eq!(status, 0);
    assert!(log.contains("\n0.05 pd42-1140 pin HOME 1\n"), "{log}");
    assert!(log.contains("axis 0: 5000 pulses, 5000 in sum"), "{log}");
    let [before, after] = ["a.csv", "b.csv"].map(|file| fs::read_to_string(directory.join(file)).unwrap());
    assert_eq!(before, after);
}

#[test]
fn what_is_no_tape_is_refused() {
    let directory = directory(&[("no.ptr", "{}\n")]);
    refused(&directory, &["replay", "none.ptr"], "none.ptr: ");
    refused(&directory, &["replay", "no.ptr"], "no.ptr:1: missing field `pulsetrain_tape`");
    refused(&directory, &["replay", "no.ptr", "--record", "b.ptr"], "b.ptr: a tape of a tape");
    refused(&directory, &["serve", "--record", "a.xyz"], "a-pd42-1140.xyz: no recording format");
}
