//! Programs: compiled, down and up, run.

use super::Rig;
use crate::common::eventually;
use serde_json::{Value, json};

/// The models, with a program that counts in its first variable, one that is wrong in its second line, and the
/// variable.
const MODELS: [(&str, &str, &str, &str); 3] = [
    ("pd42-1140", "loop: CALCV ADD, 0, 1\nWAIT TICKS, 0, 1\nJA loop\n", "STOP\nFLY 5\n", "GP0.2"),
    ("pmx-2ed", "PRG 0\nWHILE 1=1\nV0=V0+1\nENDWHILE\nEND\n", "PRG 0\nFLY 5\nEND\n", "V0"),
    ("cmd-4cr", "PRG 0\nWHILE 1=1\nV0=V0+1\nENDWHILE\nEND\n", "PRG 0\nFLY 5\nEND\n", "V0"),
];

fn source(text: &str) -> String {
    json!({ "source": text }).to_string()
}

#[test]
fn a_right_program_and_a_wrong_one() {
    let rig = Rig::new(&MODELS.map(|(model, ..)| model));
    for (model, right, wrong, _) in MODELS {
        let compile = |text: &str| {
            let (status, compiled) = rig.call("POST", &format!("{model}/program/compile"), &source(text));
            assert_eq!(status, 200);
            compiled
        };
        let compiled = compile(right);
        assert_eq!((&compiled["ok"], &compiled["diagnostics"]), (&json!(true), &json!([])), "{model}");
        let lines = compiled["lines"].as_array().unwrap();
        assert_eq!(compiled["size"], lines.len());
        assert_eq!(lines[0], json!([0, 1]), "{model}");
        assert_eq!(compiled["listing"].as_str().unwrap().lines().count(), lines.len());
        assert!(!compiled["symbols"].as_str().unwrap().is_empty(), "{model}");

        let compiled = compile(wrong);
        assert_eq!((&compiled["ok"], &compiled["size"]), (&json!(false), &json!(0)), "{model}");
        let first = &compiled["diagnostics"][0];
        assert_eq!((&first["line"], &first["is_error"]), (&json!(2), &json!(true)), "{model}: {first}");
        assert!(first["column"].as_u64().unwrap() > 0);
    }
    rig.server.stop().unwrap();
}

#[test]
fn down_run_pause_and_up() {
    let rig = Rig::new(&MODELS.map(|(model, ..)| model));
    for (model, right, wrong, variable) in MODELS {
        let path = |rest: &str| format!("{model}/{rest}");
        let (status, compiled) = rig.call("PUT", &path("program"), &source(right));
        assert_eq!((status, &compiled["ok"]), (200, &json!(true)), "{model}");
        // A wrong one replaces nothing.
        let (status, compiled) = rig.call("PUT", &path("program"), &source(wrong));
        assert_eq!((status, &compiled["ok"]), (200, &json!(false)), "{model}");

        let uploaded = rig.get(&path("program"))["source"].as_str().unwrap().to_owned();
        let again = rig.call("POST", &path("program/compile"), &source(&uploaded)).1;
        let first = rig.call("POST", &path("program/compile"), &source(right)).1;
        let codes = |compiled: &Value| {
            let listing = compiled["listing"].as_str().unwrap().to_owned();
            listing.lines().map(str::to_owned).collect::<Vec<_>>()
        };
        assert_eq!(codes(&again), codes(&first), "{model}");

        let state = || rig.get(&path("status"))["programs"][0]["state"].clone();
        let counted = || rig.get(&path("variables"))[variable].as_i64().unwrap();
        assert_eq!((state(), counted()), (json!("idle"), 0), "{model}");
        rig.tell("POST", &path("programs/0"), r#"{ "do": "run" }"#);
        eventually("it counts", || counted() > 2);
        assert_eq!(state(), "running");
        rig.tell("POST", &path("programs/0"), r#"{ "do": "pause" }"#);
        assert_eq!(state(), "paused", "{model}");
        let stood = counted();
        rig.tell("POST", &path("programs/0"), r#"{ "do": "continue" }"#);
        eventually("it goes on", || counted() > stood);
        rig.tell("POST", &path("stop"), "");
        assert_eq!(state(), "idle", "{model}");
        assert_eq!(rig.call("POST", &path("programs/9"), r#"{ "do": "run" }"#).0, 404, "{model}");
    }
    rig.server.stop().unwrap();
}
