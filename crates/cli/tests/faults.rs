//! Scenarios: what `run` and `serve` make of them.

mod common;

use common::{GAP, Serve, directory, outcome, refused};
use rustix::process::Signal;

const THERE: &str = "\
SAP 212, 0, 500\nSAP 4, 0, 1000\nSAP 5, 0, 500\nMVP ABS, 0, 51200\nWAIT POS, 0, 0\nBack: MVP ABS, 0, 0\nWAIT POS, 0, 0\nSTOP\n";

/// A scenario with one fault.
fn fault(entries: &str) -> String {
    format!("[[fault]]\n{entries}\n")
}

#[test]
fn a_run_has_its_faults() {
    let slip = "kind = 'slip'\naxis = '0'\npulses = 3000";
    let directory = directory(&[
        ("a.tmc", THERE),
        ("label.toml", &fault(&format!("on = {{ label = 'back' }}\nafter = 0.1\n{slip}"))),
        ("line.toml", &fault(&format!("on = {{ line = 6 }}\nafter = 0.1\n{slip}"))),
        ("cut.toml", &fault("at = 0.2\nkind = 'power_cut'\nduration = 0.5")),
    ]);
    let run = |scenario: &str| {
        let run = ["run", "a.tmc", "--device", "pd42-1140", "--json", "--for", "10", "--record", "a.ptr"];
        let (status, text, errors) = outcome(&directory, &[&run[..], &["--scenario", scenario]].concat());
        assert_eq!((status, errors.as_str()), (0, ""));
        let (replayed, log, _) = outcome(&directory, &["replay", "a.ptr"]);
        assert_eq!(replayed, 0);
        let json: serde_json::Value = serde_json::from_str(&text).unwrap();
        (json, log)
    };
    // On the way back the motor loses steps, and the module stops.
    let (by_label, log) = run("label.toml");
    let axis = &by_label["axes"]["0"];
    assert!((1000..51_000).contains(&axis["position"].as_i64().unwrap()), "{axis}");
    let difference = axis["encoder"].as_i64().unwrap() - axis["position"].as_i64().unwrap();
    assert!((500..3000).contains(&difference), "{axis}");
    let (by_line, other) = run("line.toml");
    assert_eq!((&by_line["axes"], other), (&by_label["axes"], log));
    // Without a supply it stands, and with it it knows nothing of before.
    let (cut, _) = run("cut.toml");
    assert_eq!((&cut["stop_reason"], &cut["axes"]["0"]["steps"]), (&"ended".into(), &0.into()));
    assert_eq!(cut["device_seconds"], 0.7);
}

#[test]
fn scenarios_that_cannot_be() {
    let directory = directory(&[
        ("a.tmc", THERE),
        ("line.toml", &fault("kind = 'brown_out'\non = { line = 99 }")),
        ("label.toml", &fault("kind = 'brown_out'\non = { label = 'Nowhere' }")),
        ("kind.toml", &fault("kind = 'brownout'")),
        ("device.toml", &fault("kind = 'brown_out'\ndevice = 'stage'")),
    ]);
    let run = |scenario| ["run", "a.tmc", "--device", "pd42-1140", "--scenario", scenario];
    let line = "line.toml:3: fault.on: line: nothing of line 99 of a.tmc is executed";
    refused(&directory, &run("line.toml"), line);
    refused(&directory, &run("label.toml"), "label.toml:3: fault.on: label: there is no `Nowhere` in a.tmc");
    refused(
        &directory,
        &run("kind.toml"),
        "kind.toml:2: fault.kind: unknown kind `brownout`, known: stuck_switch,",
    );
    refused(
        &directory,
        &run("device.toml"),
        "device.toml:3: fault.device: unknown device `stage`, known: pd42-1140",
    );
    refused(&directory, &run("none.toml"), "none.toml: ");
    let serve = ["serve", "--no-http", "pd42-1140@tcp:127.0.0.1:0", "--scenario", "label.toml"];
    refused(&directory, &serve, "label.toml:3: fault.on: the source of the program is not known here");
}

#[test]
fn a_server_has_its_faults() {
    let directory = directory(&[("day.toml", &fault("kind = 'stuck_switch'\npin = 'STOP_R'\nvalue = true"))]);
    let arguments =
        ["pd42-1140@tcp:127.0.0.1:0", "--no-http", "--scenario", "day.toml", "--record", "day.ptr"];
    let serve = Serve::start(&directory, &arguments, 1);
    assert_eq!(serve.client(0).value(GAP, 10, 0, 0), 1);
    assert_eq!(serve.end(Signal::TERM), Some(0));
    let (status, log, _) = outcome(&directory, &["replay", "day.ptr"]);
    assert_eq!(status, 0);
    assert!(log.contains(" pd42-1140 pin STOP_R 1\n"), "{log}");
}
