//! What the models can do.

use crate::common::{call, serve_http};
use serde_json::{Value, json};

fn catalog(model: &str) -> Value {
    let (server, address) = serve_http(vec![]);
    let (status, catalog) = call(address, "GET", &format!("/api/models/{model}"), "");
    assert_eq!(status, 200, "{model}");
    server.stop().unwrap();
    catalog
}

/// The entry of a list with this name or id.
#[track_caller]
fn entry<'a>(catalog: &'a Value, list: &str, key: &str, name: &str) -> &'a Value {
    let mut entries = catalog[list].as_array().unwrap().iter();
    entries.find(|it| it[key] == name).unwrap_or_else(|| panic!("{list} have no {name}"))
}

#[test]
fn the_models() {
    let (server, address) = serve_http(vec![]);
    let (status, list) = call(address, "GET", "/api/models", "");
    assert_eq!(status, 200);
    let names: Vec<_> = list.as_array().unwrap().iter().map(|it| it["model"].clone()).collect();
    assert_eq!(names, ["pd42-1140", "pmx-2ed", "cmd-4cr"]);
    let unknown = json!({ "error": "unknown model `pmx`, known: pd42-1140, pmx-2ed, cmd-4cr" });
    assert_eq!(call(address, "GET", "/api/models/pmx", ""), (404, unknown));
    server.stop().unwrap();
}

#[test]
fn a_module_with_tmcl() {
    let catalog = catalog("pd42-1140");
    assert_eq!(catalog["language"], "tmcl");
    assert_eq!(catalog["axes"], json!(["0"]));
    assert_eq!(catalog["units"], json!({ "position": "µsteps", "speed": "int", "encoder": "µsteps" }));
    assert_eq!((&catalog["programs"], &catalog["program_capacity"]), (&json!(1), &json!(2048)));
    let expected = json!({
        "id": "AP5.0", "group": "Motion", "axis": "0", "name": "Maximum acceleration",
        "symbol": "APMaxAcceleration", "unit": "int", "text": "Acceleration and deceleration of all ramps.",
        "section": "4", "low": 1.0, "high": 2047.0, "default": 500.0, "decimals": 0,
        "readable": true, "writable": true, "stored": true, "is_text": false, "role": "acceleration", "is_setting": true,
    });
    assert_eq!(entry(&catalog, "parameters", "id", "AP5.0"), &expected);
    let expected = json!({
        "name": "MVP", "syntax": "MVP ABS|REL|COORD, motor, position",
        "text": "Moves to a position, by a distance or to a coordinate.",
        "example": "MVP ABS, 0, 90000", "section": "3.7.4", "unit": "",
    });
    assert_eq!(entry(&catalog, "commands", "name", "MVP"), &expected);
    let expected =
        json!({ "bit": 5, "name": "stall", "text": "A stall has stopped the motor.", "kind": "error" });
    assert_eq!(entry(&catalog, "status_bits", "name", "stall"), &expected);
    assert_eq!(catalog["homing"][4]["directions"], json!(["-"]));
    let expected = json!({
        "name": "STOP_L", "kind": "input", "axis": "0", "role": "negative limit", "unit": "",
        "low": null, "high": null,
    });
    assert_eq!(entry(&catalog, "pins", "name", "STOP_L"), &expected);
}

#[test]
fn a_performax() {
    let catalog = catalog("pmx-2ed");
    assert_eq!(catalog["language"], "a-script");
    assert_eq!(catalog["axes"], json!(["X", "Y"]));
    let expected = json!({
        "id": "SLRX", "group": "StepNLoop", "axis": "X", "name": "Loop ratio", "symbol": "SLRX",
        "unit": "pulses a count", "text": "StepNLoop: ratio, 0.001 to 999.999.", "section": "7.17",
        "low": 0.001, "high": 999.999, "default": 1.0, "decimals": 3,
        "readable": true, "writable": true, "stored": true, "is_text": false, "role": "closed_loop_ratio", "is_setting": true,
    });
    assert_eq!(entry(&catalog, "parameters", "id", "SLRX"), &expected);
    assert_eq!(entry(&catalog, "parameters", "id", "DN")["is_text"], true);
}

#[test]
fn a_commander() {
    let catalog = catalog("cmd-4cr");
    assert_eq!(catalog["axes"], json!(["X", "Y", "Z", "U"]));
    assert_eq!((&catalog["programs"], &catalog["program_capacity"]), (&json!(4), &json!(1800)));
    assert_eq!(catalog["homing"].as_array().unwrap().len(), 13);
    assert_eq!(catalog["status_bits"].as_array().unwrap().len(), 20);
    let expected = json!({
        "name": "AI1", "kind": "analog", "axis": "X", "role": "joystick", "unit": "mV", "low": 0.0, "high": 3300.0,
    });
    assert_eq!(entry(&catalog, "pins", "name", "AI1"), &expected);
    assert_eq!(entry(&catalog, "parameters", "id", "SYNPU")["axis"], "U");
}
