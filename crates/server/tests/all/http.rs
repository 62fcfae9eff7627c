//! The HTTP interface, call by call.

use crate::common::{PATIENCE, TOKEN, call, device, eventually, performax, serve_http};
use serde_json::{Value, json};
use std::{
    net::TcpStream,
    time::{Duration, Instant},
};
use tungstenite::{client::IntoClientRequest, http::header};

#[test]
fn devices_and_their_state() {
    let (server, address) = serve_http(vec![device("a", &["tcp:127.0.0.1:0"]), device("b", &[])]);
    let endpoint = &server.ready()[0].1;
    let (status, list) = call(address, "GET", "/api/devices", "");
    assert_eq!(status, 200);
    let entry = |name: &str, endpoints: Value| {
        json!({
            "name": name, "model": "parrot", "title": "says back what it hears", "kind": "virtual",
            "axis_names": [], "endpoints": endpoints, "link": { "state": "up" }, "removable": false,
        })
    };
    let expected = json!([entry("a", json!([endpoint])), entry("b", json!([]))]);
    assert_eq!(list, expected);

    let (status, mut state) = call(address, "GET", "/api/devices/a", "");
    assert_eq!(status, 200);
    let seconds = state.as_object_mut().unwrap().remove("device_seconds").unwrap().as_f64().unwrap();
    assert!(seconds > 0.0 && seconds < PATIENCE.as_secs_f64());
    let mut expected = entry("a", json!([endpoint]));
    let own = json!({
        "axes": { "A": {
            "position": 0, "encoder": -4, "speed": 1.5, "target": 12, "status": 5, "steps": 9
        } },
        "programs": [{ "state": "running", "counter": 3, "instructions": 44 }],
    });
    expected.as_object_mut().unwrap().extend(own.as_object().unwrap().clone());
    assert_eq!(state, expected);
    server.stop().unwrap();
}

#[test]
fn pins_loads_and_power() {
    let (server, address) = serve_http(vec![device("a", &[])]);
    let check = |method: &str, path: &str, body: &str, status: u16, answer: Value| {
        let got = call(address, method, &format!("/api/devices/a/{path}"), body);
        assert_eq!(got, (status, answer), "{method} {path} {body}");
    };
    let none = Value::Null;
    let error = |text: &str| json!({ "error": text });
    check("GET", "pins/IN", "", 200, json!(false));
    check("PUT", "pins/IN", "true", 204, none.clone());
    check("GET", "pins/IN", "", 200, json!(true));
    check("GET", "pins/OUT", "", 200, json!(true));
    check("DELETE", "pins/IN", "", 204, none.clone());
    check("GET", "pins/IN", "", 200, json!(false));
    check("GET", "pins/OUT", "", 200, json!(false));
    check("PUT", "pins/MV", "1234", 204, none.clone());
    check("GET", "pins/MV", "", 200, json!(1234.0));
    check("DELETE", "pins/MV", "", 204, none.clone());
    check("GET", "pins/MV", "", 200, json!(7.0));

    // A port is an output as long as the controller drives it.
    check("PUT", "pins/IO", "true", 204, none.clone());
    check("GET", "pins/IO", "", 200, json!(true));
    check("PUT", "pins/IO", "false", 204, none.clone());
    check("GET", "pins/PWM", "", 200, json!(1.0));
    check("PUT", "pins/IN", "true", 204, none.clone());
    check("GET", "pins/IO", "", 200, json!(true));
    check("PUT", "pins/IO", "false", 422, error("`IO` is an output now, the controller drives it"));
    check("DELETE", "pins/IO", "", 204, none.clone());
    check("GET", "pins/PWM", "", 200, json!(75.0));
    check("PUT", "pins/PWM", "5", 422, error("`PWM` is an output, only the controller drives it"));
    check("DELETE", "pins/PWM", "", 422, error("`PWM` is an output, only the controller drives it"));
    check("DELETE", "pins/IN", "", 204, none.clone());
    check("GET", "pins/IO", "", 200, json!(false));
    check("PUT", "pins/IO", "1", 422, error("`IO` is digital: true or false"));

    let unknown = "there is no pin `LID`, the device has: IN, OUT, MV, IO, PWM";
    check("GET", "pins/LID", "", 404, error(unknown));
    check("PUT", "pins/LID", "true", 404, error(unknown));
    check("DELETE", "pins/LID", "", 404, error(unknown));
    check("PUT", "pins/OUT", "true", 422, error("`OUT` is an output, only the controller drives it"));
    check("DELETE", "pins/OUT", "", 422, error("`OUT` is an output, only the controller drives it"));
    check("PUT", "pins/IN", "5", 422, error("`IN` is digital: true or false"));
    check("PUT", "pins/MV", "true", 422, error("`MV` is analog: a number in mV"));
    check("PUT", "pins/MV", "1e300", 422, error("`MV` cannot have this value"));
    check("PUT", "pins/IN", "\"on\"", 422, error("`\"on\"` is not true, false or a number"));
    let (status, body) = call(address, "PUT", "/api/devices/a/pins/IN", "{");
    assert_eq!(status, 400);
    assert!(body["error"].as_str().unwrap().starts_with("the body is not JSON: "), "{body}");
    let (status, body) = call(address, "PUT", "/api/devices/a/pins/IN", &" ".repeat(5000));
    assert_eq!(status, 413);
    assert!(body["error"].is_string());

    check("PUT", "axes/A/load", "0.25", 204, none.clone());
    let position = || call(address, "GET", "/api/devices/a", "").1["axes"]["A"]["position"].clone();
    assert_eq!(position(), 250);
    check("PUT", "axes/B/load", "0.25", 404, error("there is no axis `B`, the device has: A"));
    check("PUT", "axes/A/load", "-1", 422, error("the value is out of range"));
    check("PUT", "axes/A/load", "true", 422, error("`true` is not a number"));
    check("POST", "power-cycle", "", 204, none.clone());
    check("POST", "power-cut", "", 204, none);

    check("POST", "pins/IN", "", 405, error("this path does not take that method"));
    check("GET", "nothing", "", 404, error("there is nothing here"));
    let (status, body) = call(address, "GET", "/api/devices/b", "");
    assert_eq!((status, body), (404, error("unknown device `b`, known: a")));
    let (status, _) = call(address, "GET", "/api/devices/%FF", "");
    assert_eq!(status, 400);
    server.stop().unwrap();
}

#[test]
fn hand_wheels() {
    let (server, address) = serve_http(vec![device("a", &[]), performax("b", &[])]);
    let check = |path: &str, body: &str, status: u16, answer: Value| {
        let got = call(address, "POST", &format!("/api/devices/{path}"), body);
        assert_eq!(got, (status, answer), "{path} {body}");
    };
    let error = |text: &str| json!({ "error": text });
    let encoder = || call(address, "GET", "/api/devices/a", "").1["axes"]["A"]["encoder"].clone();
    check("a/mpg/A", "104", 204, Value::Null);
    check("a/mpg/A", "-90.0", 204, Value::Null);
    eventually("the counts have come", || encoder() == 10);
    check("a/mpg/B", "1", 404, error("there is no axis `B`, the device has: A"));
    check("b/mpg/X", "1", 404, error("axis `X` has no MPG input"));
    check("a/mpg/A", "1e300", 422, error("the value is out of range"));
    check("a/mpg/A", "0.5", 422, error("`0.5` is not a number of counts"));
    check("a/mpg/A", "1000000000000", 422, error("the value is out of range"));
    check("a/mpg/A", "true", 422, error("`true` is not a number of counts"));
    let (status, _) = call(address, "GET", "/api/devices/a/mpg/A", "");
    assert_eq!(status, 405);
    server.stop().unwrap();
}

#[test]
fn the_stream_sends_thirty_states_a_second() {
    let (server, address) = serve_http(vec![device("a", &["tcp:127.0.0.1:0"])]);
    let attempt = |path: &str, bearer: Option<&str>| {
        let mut request = format!("ws://{address}{path}").into_client_request().unwrap();
        if let Some(token) = bearer {
            request.headers_mut().insert(header::AUTHORIZATION, format!("Bearer {token}").parse().unwrap());
        }
        let stream = TcpStream::connect(address).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        Some(tungstenite::client(request, stream).ok()?.0)
    };
    assert!(attempt("/api/devices/a/stream", None).is_none());
    assert!(attempt("/api/devices/a/stream?token=wrong", None).is_none());
    assert!(attempt("/api/devices/b/stream", Some(TOKEN)).is_none());
    assert!(attempt("/api/devices/a", Some(TOKEN)).is_none(), "no WebSocket there");
    assert_eq!(call(address, "GET", "/api/devices/a/stream", "").0, 400);

    let query = format!("/api/devices/a/stream?token={TOKEN}");
    for mut socket in [attempt(&query, None).unwrap(), attempt("/api/devices/a/stream", Some(TOKEN)).unwrap()]
    {
        let mut next = || {
            let message = socket.read().unwrap().into_text().unwrap();
            serde_json::from_str::<Value>(&message).unwrap()["device_seconds"].as_f64().unwrap()
        };
        let (first, start) = (next(), Instant::now());
        for _ in 0..29 {
            next();
        }
        let (last, wall) = (next(), start.elapsed());
        assert!((0.95..1.5).contains(&(last - first)), "30 states in {} s of device time", last - first);
        assert!(wall < Duration::from_secs(3), "30 states in {wall:?}");
        socket.close(None).unwrap();
    }
    server.stop().unwrap();
}

#[test]
fn faults() {
    let (server, address) = serve_http(vec![device("a", &[]), performax("b", &[])]);
    let check = |method: &str, path: &str, body: &str, status: u16, answer: Value| {
        let got = call(address, method, &format!("/api/devices/{path}"), body);
        assert_eq!(got, (status, answer), "{method} {path} {body}");
    };
    let error = |text: &str| json!({ "error": text });
    check("GET", "a/faults", "", 200, json!([]));
    let stuck = r#"{ "kind": "stuck_switch", "pin": "IN", "value": true }"#;
    check("POST", "a/faults", stuck, 201, json!({ "id": 1 }));
    check("GET", "a/pins/IN", "", 200, json!(true));
    check("PUT", "a/pins/IN", "false", 204, Value::Null);
    check("GET", "a/pins/IN", "", 200, json!(true));
    let later = r#"{ "kind": "slip", "axis": "A", "pulses": 5, "on": { "message": 3 }, "after": 0.5 }"#;
    check("POST", "a/faults", later, 201, json!({ "id": 2 }));
    let listed = json!([
        { "id": 1, "state": "active", "kind": "stuck_switch", "pin": "IN", "value": true },
        { "id": 2, "state": "waiting", "kind": "slip", "axis": "A", "pulses": 5, "on": { "message": 3 }, "after": 0.5 },
    ]);
    check("GET", "a/faults", "", 200, listed);
    check("DELETE", "a/faults/1", "", 204, Value::Null);
    check("GET", "a/pins/IN", "", 200, json!(false));
    check("DELETE", "a/faults/1", "", 404, error("there is no fault 1"));
    check("POST", "a/faults", r#"{ "kind": "power_cut", "duration": 0.05 }"#, 201, json!({ "id": 3 }));
    eventually("it is over", || {
        call(address, "GET", "/api/devices/a/faults", "").1.as_array().unwrap().len() == 1
    });
    check("DELETE", "a/faults", "", 204, Value::Null);
    check("GET", "a/faults", "", 200, json!([]));

    let missing = error("kind: slip needs `pulses`");
    check("POST", "a/faults", r#"{ "kind": "slip", "axis": "A" }"#, 422, missing);
    check(
        "POST",
        "a/faults",
        r#"{ "kind": "brown_out", "on": { "line": 3 } }"#,
        422,
        error("on: the source of the program is not known here; say `address`"),
    );
    check(
        "POST",
        "a/faults",
        r#"{ "kind": "brown_out", "device": "b" }"#,
        422,
        error("device: the path says which device it is"),
    );
    let unknown = "this is no fault: unknown field `colour`, expected one of ";
    let (status, body) = call(address, "POST", "/api/devices/a/faults", r#"{ "kind": "slip", "colour": 3 }"#);
    assert_eq!(status, 422);
    assert!(body["error"].as_str().unwrap().starts_with(unknown), "{body}");
    check("POST", "c/faults", stuck, 404, error("unknown device `c`, known: a, b"));

    // Pushed, and pulses lost.
    let encoder = || call(address, "GET", "/api/devices/b", "").1["axes"]["X"]["encoder"].clone();
    check("POST", "b/axes/X/push", "-40", 204, Value::Null);
    assert_eq!(encoder(), -40);
    check("POST", "b/axes/X/lose", "12", 204, Value::Null);
    check("POST", "b/axes/Q/lose", "12", 404, error("there is no axis `Q`, the device has: X, Y"));
    check("POST", "b/axes/X/lose", "-1", 422, error("the value is out of range"));
    check("POST", "b/axes/X/push", "1e300", 422, error("the value is out of range"));
    check("POST", "b/axes/X/push", "0.5", 422, error("`0.5` is not a number of pulses"));
    server.stop().unwrap();
}

#[test]
fn a_scenario_begins_with_the_server() {
    let devices = vec![device("a", &[]), device("b", &[])];
    let text = "[[fault]]\ndevice = 'b'\nkind = 'stuck_switch'\npin = 'IN'\nvalue = true\n";
    let scenario = sim::Scenario::parse(text, "test", &devices, &sim::fault::scenario::no_source).unwrap();
    let http = Some(server::HttpSettings::new("127.0.0.1:0", server::Token::chosen(TOKEN).unwrap()));
    let server =
        server::Server::start(server::Settings { http, scenario, ..crate::common::settings(devices) })
            .unwrap();
    let address = server.url().unwrap().split(['/', '?']).nth(2).unwrap().parse().unwrap();
    let level = |name: &str| call(address, "GET", &format!("/api/devices/{name}/pins/IN"), "").1;
    assert_eq!((level("a"), level("b")), (json!(false), json!(true)));
    server.stop().unwrap();
}
