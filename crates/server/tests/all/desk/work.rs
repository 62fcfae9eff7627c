//! What one does with a controller: jog, move, stop, home, clear errors, type commands.

use super::Rig;
use crate::common::eventually;
use serde_json::json;

/// The models, with an axis of each and commands of its wire: one that reads its position, one that is none.
const MODELS: [(&str, &str, &str, &str); 3] =
    [("pd42-1140", "0", "GAP 1, 0", "FLY 1"), ("pmx-2ed", "Y", "PY", "FLY"), ("cmd-4cr", "U", "PU", "FLY")];

fn action(text: &str, axis: &str) -> String {
    text.replace("AXIS", axis)
}

#[test]
fn jogs_stops_and_moves() {
    let rig = Rig::new(&MODELS.map(|(model, ..)| model));
    for (model, axis, ..) in MODELS {
        let act = |text: &str| rig.tell("POST", &format!("{model}/act"), &action(text, axis));
        let status = || rig.get(&format!("{model}/status"));
        let axes = status()["axes"].as_object().unwrap().len();
        assert_eq!(axes, devices::model(model).unwrap().guide.axes.len());
        act(r#"{ "do": "jog", "axis": "AXIS", "direction": -1 }"#);
        eventually("it moves", || status()["axes"][axis]["speed"] != 0);
        rig.tell("POST", &format!("{model}/stop"), "");
        eventually("it stands", || status()["axes"][axis]["speed"] == 0);
        assert!(status()["axes"][axis]["position"].as_i64().unwrap() < 0, "{model}");
        act(r#"{ "do": "set_position", "axis": "AXIS", "value": 50 }"#);
        act(r#"{ "do": "move", "targets": { "AXIS": 250 }, "relative": false }"#);
        rig.arrives(model, axis, 250);
        act(r#"{ "do": "move", "targets": { "AXIS": -100 }, "relative": true }"#);
        rig.arrives(model, axis, 150);
        assert_eq!(status()["axes"][axis]["state"], "idle");
    }
    rig.server.stop().unwrap();
}

#[test]
fn a_limit_is_an_error_until_it_is_cleared() {
    let rig = Rig::new(&["pmx-2ed"]);
    let act = |text: &str| rig.call("POST", "pmx-2ed/act", text);
    rig.tell("PUT", "pmx-2ed/pins/+LX", "true");
    let jog = r#"{ "do": "jog", "axis": "X", "direction": 1 }"#;
    act(jog);
    eventually("an error", || rig.get("pmx-2ed/status")["axes"]["X"]["error"].is_string());
    let status = rig.get("pmx-2ed/status");
    assert_eq!(status["axes"]["X"]["error"], "plus limit error");
    assert_eq!(status["axes"]["X"]["positive_limit"], true);
    assert_eq!(status["alarms"], json!(["X: plus limit error"]));
    let (refused, why) = act(jog);
    assert_eq!((refused, &why["error"]), (422, &json!("`JX+` is refused: ?State Error")));
    rig.tell("DELETE", "pmx-2ed/pins/+LX", "");
    rig.tell("POST", "pmx-2ed/act", r#"{ "do": "clear_error", "axis": "X" }"#);
    assert!(rig.get("pmx-2ed/status")["axes"]["X"]["error"].is_null());
    rig.server.stop().unwrap();
}

#[test]
fn outputs_and_power() {
    let rig = Rig::new(&["cmd-4cr"]);
    for text in [
        r#"{ "do": "power", "axis": "Z", "on": true }"#,
        r#"{ "do": "output", "name": "DO3", "value": true }"#,
        r#"{ "do": "output", "name": "PWM1", "value": 25 }"#,
    ] {
        rig.tell("POST", "cmd-4cr/act", text);
    }
    let status = rig.get("cmd-4cr/status");
    assert_eq!(status["axes"]["Z"]["enabled"], true);
    assert_eq!(rig.get("cmd-4cr/pins/EO3"), true);
    assert_eq!(rig.get("cmd-4cr/pins/DO3"), true);
    assert_eq!((&status["outputs"]["DO3"], &status["outputs"]["DO1"]), (&json!(true), &json!(false)));
    rig.server.stop().unwrap();
}

#[test]
fn lines_that_somebody_types() {
    let rig = Rig::new(&MODELS.map(|(model, ..)| model));
    for (model, _, reads, wrong) in MODELS {
        let type_in = |line: &str| {
            let body = json!({ "line": line }).to_string();
            rig.call("POST", &format!("{model}/terminal"), &body)
        };
        let (status, answer) = type_in(reads);
        assert_eq!((status, &answer["reply"], &answer["ok"]), (200, &json!("0"), &json!(true)), "{model}");
        assert!(answer["hex_request"].as_str().unwrap().len() >= 8, "{answer}");
        let (status, answer) = type_in(wrong);
        let is_refused = status == 200 && answer["ok"] == false || status == 422;
        assert!(is_refused, "{model}: {status} {answer}");
    }
    rig.server.stop().unwrap();
}

#[test]
fn wrong_requests() {
    let rig = Rig::new(&["pmx-2ed"]);
    rig.refused("GET", "lift/status", "", 404, "unknown device `lift`, known: pmx-2ed");
    rig.refused(
        "POST",
        "pmx-2ed/act",
        r#"{ "do": "jog", "axis": "U", "direction": 1 }"#,
        404,
        "this controller has no `U`",
    );
    for (path, body) in [("act", r#"{ "do": "fly" }"#), ("act", "{}"), ("terminal", "{}")] {
        assert_eq!(rig.call("POST", &format!("pmx-2ed/{path}"), body).0, 422, "{path} {body}");
    }
    assert_eq!(rig.call("POST", "pmx-2ed/act", "jog").0, 400);
    rig.server.stop().unwrap();
}

#[test]
fn a_device_of_a_bus_is_asked_over_usb() {
    let bus = crate::common::free_address();
    let device = |name: &str| crate::common::performax(name, &[&format!("tcp:{bus}")]);
    let rig = Rig::with(vec![device("a"), device("b")]);
    rig.tell("POST", "a/act", r#"{ "do": "set_position", "axis": "X", "value": 7 }"#);
    assert_eq!(rig.get("a/status")["axes"]["X"]["position"], 7);
    assert_eq!(rig.get("b/status")["axes"]["X"]["position"], 0);
    rig.server.stop().unwrap();
}

#[test]
fn what_others_have_half_typed_is_theirs() {
    use std::io::{Read, Write};
    let rig = Rig::with(vec![crate::common::performax("a", &["tcp:127.0.0.1:0"])]);
    let mut typist = crate::common::connect(&rig.server.ready()[0].1);
    typist.write_all(b"V5=1").unwrap();
    rig.tell("PUT", "a/parameters/V6", "4");
    assert_eq!(rig.get("a/parameters/V6"), 4);
    typist.write_all(b"23\r").unwrap();
    let mut reply = [0; 3];
    typist.read_exact(&mut reply).unwrap();
    assert_eq!(&reply, b"OK\r");
    assert_eq!(rig.get("a/parameters/V5"), 123);
    rig.server.stop().unwrap();
}

#[test]
fn the_machine() {
    let rig = Rig::new(&["pd42-1140"]);
    let expected = json!({ "axes": { "0": {
        "shaft": 0, "negative_limit": -10_000_000, "positive_limit": 10_000_000, "home": [-200, 0],
        "index_every": 4000, "circumference": null, "load": 0.0, "backlash": 0,
    } } });
    assert_eq!(rig.get("pd42-1140/machine"), expected);
    rig.tell("PUT", "pd42-1140/axes/0/load", "0.25");
    rig.tell("POST", "pd42-1140/axes/0/push", "30");
    let machine = rig.get("pd42-1140/machine");
    assert_eq!((&machine["axes"]["0"]["load"], &machine["axes"]["0"]["shaft"]), (&json!(0.25), &json!(30)));
    rig.server.stop().unwrap();
}

#[test]
fn switches_are_moved() {
    let rig = Rig::new(&["pmx-2ed"]);
    let path = "pmx-2ed/machine";
    rig.tell("PATCH", path, r#"{ "axis": "X", "positive_limit": 300, "home": [-20, -10] }"#);
    let machine = rig.get(path)["axes"].clone();
    assert_eq!((&machine["X"]["positive_limit"], &machine["X"]["home"]), (&json!(300), &json!([-20, -10])));
    assert_eq!(machine["Y"]["positive_limit"], 1_000_000);
    rig.tell("POST", "pmx-2ed/act", r#"{ "do": "power", "axis": "X", "on": true }"#);
    rig.tell("POST", "pmx-2ed/act", r#"{ "do": "move", "targets": { "X": 5000 }, "relative": false }"#);
    eventually("it is stopped at the limit", || {
        let axis = rig.get("pmx-2ed/status")["axes"]["X"].clone();
        axis["error"] == "plus limit error" && axis["position"] == 300 && axis["speed"] == 0
    });
    let refused = |body: &str, status: u16, words: &str| rig.refused("PATCH", path, body, status, words);
    let below = "the negative limit 300 must lie below the positive limit 300";
    refused(r#"{ "axis": "X", "negative_limit": 300 }"#, 422, below);
    refused(r#"{ "axis": "Z", "home": [0, 1] }"#, 404, "there is no axis `Z`, the device has: X, Y");
    refused(
        r#"{ "axis": "X" }"#,
        422,
        "`negative_limit`, `positive_limit` or `home` says where a switch goes",
    );
    assert_eq!(rig.call("PATCH", path, r#"{ "axis": "X", "home": [0.5, 1] }"#).0, 422);
    assert_eq!(rig.get(path)["axes"]["X"]["negative_limit"], -1_000_000);
    rig.server.stop().unwrap();
}
