//! What needs control while somebody has it, and what does not: every route there is.

use crate::common::{TOKEN, call, performax, raw, serve_http};
use serde_json::{Value, json};
use std::net::SocketAddr;

/// What everybody with the token may ask for though it is no `GET`: method, path, what is sent.
const FREE: &[(&str, &str, &str)] = &[
    ("POST", "/api/devices/{device}/act", r#"{ "do": "stop" }"#),
    ("POST", "/api/devices/{device}/act", r#"{ "do": "stop", "axis": "X" }"#),
    ("POST", "/api/devices/{device}/act", r#"{ "do": "abort" }"#),
    ("POST", "/api/devices/{device}/program/compile", r#"{ "source": "END\n" }"#),
    ("POST", "/api/devices/{device}/stop", ""),
    ("POST", "/api/find", r#"{ "link": "tcp:127.0.0.1:1" }"#),
];

/// What is for the holder of control, each time something that changes something.
const LED: &[(&str, &str, &str)] = &[
    ("POST", "/api/devices", r#"{ "bench": "[[device]]\nmodel = \"pmx-2ed\"\nname = \"b\"\n" }"#),
    ("POST", "/api/devices/{device}/act", r#"{ "do": "set_position", "axis": "X", "value": 77 }"#),
    ("POST", "/api/devices/{device}/axes/{axis}/lose", "5"),
    ("POST", "/api/devices/{device}/axes/{axis}/push", "40"),
    ("PUT", "/api/devices/{device}/axes/{axis}/load", "0.5"),
    ("PUT", "/api/devices/{device}/debug", r#"{ "breakpoints": [3] }"#),
    ("POST", "/api/devices/{device}/debug", r#"{ "do": "pause" }"#),
    ("POST", "/api/devices/{device}/faults", r#"{ "kind": "broken_encoder", "axis": "X" }"#),
    ("PATCH", "/api/devices/{device}/machine", r#"{ "axis": "X", "home": [5, 6] }"#),
    ("POST", "/api/devices/{device}/mpg/{axis}", "3"),
    ("PUT", "/api/devices/{device}/parameters/{parameter}", "12"),
    ("POST", "/api/devices/{device}/parameters/restore", ""),
    ("POST", "/api/devices/{device}/parameters/store", ""),
    ("PUT", "/api/devices/{device}/pins/{pin}", "true"),
    ("DELETE", "/api/devices/{device}/pins/{pin}", ""),
    ("POST", "/api/devices/{device}/power-cut", ""),
    ("POST", "/api/devices/{device}/power-cycle", ""),
    ("PUT", "/api/devices/{device}/program", r#"{ "source": "PRG 0\nEND\n" }"#),
    ("POST", "/api/devices/{device}/programs/{program}", r#"{ "do": "run" }"#),
    ("POST", "/api/devices/{device}/terminal", r#"{ "line": "V2=9" }"#),
    ("DELETE", "/api/devices/{device}/faults/{id}", ""),
    ("DELETE", "/api/devices/{device}/faults", ""),
    ("DELETE", "/api/devices/{device}", ""),
];

/// What the lease itself is changed by.
const LEASE: &str = "/api/lease";

fn filled(path: &str) -> String {
    let places = [
        ("{device}", "a"),
        ("{axis}", "X"),
        ("{pin}", "DI1"),
        ("{parameter}", "V1"),
        ("{program}", "0"),
        ("{id}", "1"),
        ("{model}", "pmx-2ed"),
    ];
    places.iter().fold(path.to_owned(), |path, (place, name)| path.replace(place, name))
}

/// Everything of the device that can be changed.
fn seen(address: SocketAddr) -> Vec<Value> {
    let get = |path: &str| call(address, "GET", path, "").1;
    let mut all: Vec<_> = ["/machine", "/faults", "/debug", "/pins/DI1", "/parameters", "/program"]
        .iter()
        .map(|path| get(&format!("/api/devices/a{path}")))
        .collect();
    all.push(get("/api/devices/a")["axes"].clone());
    all.push(get("/api/devices"));
    all
}

#[test]
fn every_route_is_listed_here() {
    let (server, address) = serve_http(vec![]);
    let (_, document) = call(address, "GET", "/api/openapi.json", "");
    let mut routes = 0;
    for (path, item) in document["paths"].as_object().unwrap() {
        for (method, operation) in item.as_object().unwrap() {
            let method = method.to_uppercase();
            let listed = |list: &[(&str, &str, &str)]| {
                list.iter().any(|(other, place, _)| *other == method && place == path)
            };
            let parameters = operation["parameters"].as_array().unwrap().iter();
            let names_lease = parameters.filter(|it| it["name"] == "Control-Lease").count();
            assert_eq!(names_lease == 1, listed(LED), "{method} {path} in the document");
            let is_known = method == "GET" || path == LEASE || listed(LED) || listed(FREE);
            assert!(is_known, "{method} {path} is in no list");
            routes += 1;
        }
    }
    assert!(routes > 40);
    server.stop().unwrap();
}

#[test]
fn who_has_no_control_changes_nothing_and_can_do_all_else() {
    let (server, address) = serve_http(vec![performax("a", &[])]);
    let (_, grant) = call(address, "POST", LEASE, r#"{ "name": "somebody" }"#);
    let before = seen(address);
    let locked = json!({ "error": "somebody has control", "holder": "somebody" });
    for (method, path, body) in LED {
        assert_eq!(call(address, method, &filled(path), body), (423, locked.clone()), "{method} {path}");
        assert_eq!(call(address, method, &filled(path), "").0, 423, "{method} {path} with nothing");
    }
    assert_eq!(seen(address), before);
    for (method, path, body) in FREE {
        assert_ne!(call(address, method, &filled(path), body).0, 423, "{method} {path} {body}");
    }
    assert_eq!(seen(address), before);
    let (_, document) = call(address, "GET", "/api/openapi.json", "");
    for path in document["paths"].as_object().unwrap().keys() {
        assert_ne!(call(address, "GET", &filled(path), "").0, 423, "{path}");
    }
    // With control the same requests do what they say.
    let lease = grant["lease"].as_str().unwrap();
    for (method, path, body) in LED {
        let request = format!(
            "{method} {} HTTP/1.1\r\nHost: {address}\r\nAuthorization: Bearer {TOKEN}\r\nControl-Lease: {lease}\r\n\
             Connection: close\r\nContent-Length: {}\r\n\r\n{body}",
            filled(path),
            body.len()
        );
        let (status, answer) = raw(address, &request);
        // The device has no hand wheel, and was there from the start.
        let stays = matches!((*method, *path), ("DELETE", "/api/devices/{device}"));
        let expected = if path.contains("/mpg/") {
            404
        } else if stays {
            409
        } else {
            200
        };
        assert_eq!(
            if expected == 200 { status / 100 * 100 } else { status },
            expected,
            "{method} {path} {answer}"
        );
    }
    assert_ne!(seen(address), before);
    server.stop().unwrap();
}
