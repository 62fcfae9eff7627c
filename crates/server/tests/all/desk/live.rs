//! The WebSocket that says what a controller is doing.

use super::Rig;
use crate::common::eventually;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Messages until there is one that satisfies.
fn until(next: &mut impl FnMut() -> Value, mut is_it: impl FnMut(&Value) -> bool) -> Value {
    loop {
        let message = next();
        if is_it(&message) {
            return message;
        }
    }
}

#[test]
fn everything_is_said_of_every_model() {
    let rig = Rig::new(&["pd42-1140", "pmx-2ed", "cmd-4cr"]);
    for model in ["pd42-1140", "pmx-2ed", "cmd-4cr"] {
        let mut next = rig.live(model);
        let mut kinds = BTreeMap::new();
        until(&mut next, |message| {
            kinds.insert(message["type"].as_str().unwrap().to_owned(), message.clone());
            kinds.len() == 5 && kinds["link"]["link"]["state"] == "up"
        });
        let axis = devices::model(model).unwrap().guide.axes[0];
        assert!(kinds["status"]["status"]["axes"][axis]["position"].is_number(), "{model}");
        assert_eq!(kinds["debug"]["debug"], json!({ "held": null, "breakpoints": [] }));
        assert!(kinds["traffic"]["traffic"][0]["hex"].is_string());
        let samples = &kinds["samples"]["samples"];
        assert_eq!(samples["axes"][axis]["load"].is_array(), model == "pd42-1140", "{model}");
        assert_eq!(samples["axes"][axis]["delta"].is_array(), model != "pd42-1140", "{model}");
    }
    rig.server.stop().unwrap();
}

#[test]
fn traffic_says_what_was_polled() {
    let rig = Rig::new(&["pmx-2ed"]);
    let mut next = rig.live("pmx-2ed");
    until(&mut next, |message| message["type"] == "status");
    assert_eq!(rig.call("POST", "pmx-2ed/terminal", r#"{ "line": "V17" }"#).0, 200);
    let mut marks = BTreeMap::new();
    until(&mut next, |message| {
        for it in message["traffic"].as_array().into_iter().flatten() {
            marks.insert(it["text"].as_str().unwrap().to_owned(), it["polled"].as_bool().unwrap());
        }
        marks.keys().any(|text| text.ends_with("V17"))
    });
    let polled = |text: &str| *marks.iter().find(|(said, _)| said.ends_with(text)).unwrap().1;
    assert!(!polled("V17") && polled("MST"));
    rig.server.stop().unwrap();
}

#[test]
fn samples_have_even_distances_and_lose_nothing() {
    let rig = Rig::new(&["pmx-2ed"]);
    let mut next = rig.live("pmx-2ed");
    rig.tell("POST", "pmx-2ed/act", r#"{ "do": "jog", "axis": "X", "direction": 1 }"#);
    let (mut seconds, mut positions) = (Vec::new(), Vec::new());
    until(&mut next, |message| {
        if message["type"] == "samples" {
            let samples = &message["samples"];
            seconds.extend(samples["seconds"].as_array().unwrap().iter().map(|it| it.as_f64().unwrap()));
            let axis = samples["axes"]["X"]["position"].as_array().unwrap();
            positions.extend(axis.iter().map(|it| it.as_f64().unwrap()));
        }
        seconds.len() >= 100
    });
    assert_eq!(seconds.len(), positions.len());
    for pair in seconds.windows(2) {
        assert!((pair[1] - pair[0] - 0.01).abs() < 1e-6, "{pair:?}");
    }
    assert!(positions.is_sorted() && positions.last() > positions.first());
    rig.server.stop().unwrap();
}

#[test]
fn a_line_that_is_held_is_said() {
    let rig = Rig::new(&["pmx-2ed"]);
    let body = json!({ "source": "PRG 0\nV1=1\nV1=2\nEND\n" }).to_string();
    assert_eq!(rig.call("PUT", "pmx-2ed/program", &body).0, 200);
    assert_eq!(rig.call("PUT", "pmx-2ed/debug", r#"{ "breakpoints": [2] }"#).0, 200);
    let mut next = rig.live("pmx-2ed");
    rig.tell("POST", "pmx-2ed/programs/0", r#"{ "do": "run" }"#);
    let held = until(&mut next, |message| !message["debug"]["held"].is_null());
    assert_eq!(held["debug"], json!({ "held": { "program": 0, "address": 2 }, "breakpoints": [2] }));
    // Time stands, and the wire does not.
    assert_eq!(rig.get("pmx-2ed/parameters/V1"), 1);
    assert_eq!(rig.call("POST", "pmx-2ed/debug", r#"{ "do": "continue" }"#).0, 200);
    until(&mut next, |message| message["type"] == "debug" && message["debug"]["held"].is_null());
    eventually("the next line", || rig.get("pmx-2ed/parameters/V1") == 2);
    rig.server.stop().unwrap();
}

#[test]
fn a_device_without_power_is_lost_and_found() {
    let rig = Rig::new(&["pmx-2ed"]);
    let mut next = rig.live("pmx-2ed");
    until(&mut next, |message| message["type"] == "status");
    let fault = r#"{ "kind": "power_cut", "duration": 2 }"#;
    assert_eq!(rig.call("POST", "pmx-2ed/faults", fault).0, 201);
    let lost = until(&mut next, |message| message["link"]["state"] == "lost");
    assert_eq!(lost["link"]["reason"], "no reply within 1000 ms");
    until(&mut next, |message| message["link"]["state"] == "up");
    until(&mut next, |message| message["type"] == "status");
    rig.server.stop().unwrap();
}
