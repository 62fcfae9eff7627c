//! Controllers that come and go while the server runs.

use super::Rig;
use crate::common::{
    call, check, connect, directory, eventually, free_address, http_address, performax, settings, trinamic,
};
use serde_json::{Value, json};
use server::{HttpSettings, Server, Settings, Token};

fn add(rig: &Rig, what: Value) -> (u16, Value) {
    call(rig.address, "POST", "/api/devices", &what.to_string())
}

fn names(rig: &Rig) -> Vec<String> {
    let (_, list) = call(rig.address, "GET", "/api/devices", "");
    list.as_array().unwrap().iter().map(|it| it["name"].as_str().unwrap().to_owned()).collect()
}

#[test]
fn virtual_ones_from_a_bench_file() {
    let rig = Rig::new(&["pmx-2ed"]);
    let endpoint = format!("tcp:{}", free_address());
    let bench = format!(
        "[[device]]\nmodel = \"cmd-4cr\"\nname = \"saw\"\nlisten = [\"{endpoint}\"]\n\
         [device.axis.X]\nnegative_limit = -500\n"
    );
    let (status, added) = add(&rig, json!({ "bench": bench }));
    assert_eq!(status, 201, "{added}");
    let expected = json!([{
        "name": "saw", "model": "cmd-4cr", "title": "Nippon Pulse CMD-4CR, firmware V126BL",
        "axis_names": ["X", "Y", "Z", "U"], "kind": "virtual",
        "endpoints": [endpoint], "link": { "state": "up" }, "removable": true,
    }]);
    assert_eq!(added, expected);
    assert_eq!(names(&rig), ["pmx-2ed", "saw"]);
    check(connect(&endpoint), b"VER\r", b"V126BL\r");
    assert_eq!(rig.get("saw/machine")["axes"]["X"]["negative_limit"], -500);
    rig.tell("PUT", "saw/parameters/V3", "5");

    rig.tell("DELETE", "saw", "");
    assert_eq!(names(&rig), ["pmx-2ed"]);
    rig.refused("GET", "saw", "", 404, "unknown device `saw`, known: pmx-2ed");
    // The endpoint is free again, and the next one is new.
    assert_eq!(add(&rig, json!({ "bench": bench })).0, 201);
    assert_eq!(rig.get("saw/parameters/V3"), 0);
    rig.server.stop().unwrap();
    assert!(
        std::net::TcpStream::connect(endpoint.trim_start_matches("tcp:")).is_err(),
        "closed with the server"
    );
}

#[test]
fn one_of_a_bus_goes_and_the_other_stays() {
    let rig = Rig::new(&[]);
    let endpoint = format!("tcp:{}", free_address());
    let device = |name: &str| {
        format!("[[device]]\nmodel = \"pmx-2ed\"\nname = \"{name}\"\nlisten = [\"{endpoint}\"]\n")
    };
    let (status, _) = add(&rig, json!({ "bench": device("a") + &device("b") }));
    assert_eq!(status, 201);
    rig.tell("PUT", "b/parameters/DN", "\"2ED01\"");
    rig.tell("POST", "b/parameters/store", "");
    rig.tell("POST", "b/power-cycle", "");
    rig.tell("DELETE", "a", "");
    let mut stream = connect(&endpoint);
    use std::io::Write;
    // Nobody has the address 0 any more.
    stream.write_all(b"@00VER\r").unwrap();
    check(stream, b"@01VER\r", b"V128BL\r");
    rig.server.stop().unwrap();
}

#[test]
fn benches_that_are_wrong() {
    let rig = Rig::new(&["pmx-2ed"]);
    let refused = |what: Value, expected: u16, words: &str| {
        let (status, answer) = add(&rig, what);
        assert_eq!((status, answer["error"].as_str().unwrap_or_default()), (expected, words));
    };
    let bench = |text: &str| json!({ "bench": text });
    let wrong = "[[device]]\nmodel = \"pmx-2ed\"\nname = \"a\"\n[device.axis.X]\nhome = 5\n";
    let (status, answer) = add(&rig, bench(wrong));
    assert_eq!(status, 422);
    assert!(answer["error"].as_str().unwrap().starts_with("bench:5: device.axis.X.home: "), "{answer}");
    refused(bench("[[device]]\nmodel = \"pmx-2ed\"\n"), 409, "there is a controller `pmx-2ed` already");
    let far =
        "over HTTP devices come that listen on TCP at this machine (127.0.0.1, [::1], localhost), or nowhere";
    for place in
        ["pty:/tmp/x", "hid-unix:/tmp/x", "tcp:0.0.0.0:0", "hid-tcp:192.168.1.5:80", "tcp:example.org:0"]
    {
        let listens = |place: &str| format!("[[device]]\nmodel = \"pmx-2ed\"\nlisten = [\"{place}\"]\n");
        let text = format!("{}name = \"a\"\n{}", listens("tcp:localhost:0"), listens(place));
        let words = format!("bench:7: device.listen: {place}: {far}");
        refused(bench(&text), 422, &words);
    }
    assert_eq!(names(&rig), ["pmx-2ed"]);
    assert_eq!(add(&rig, json!({ "bench": 5, "real": 6 })).0, 422);
    rig.refused("DELETE", "pmx-2ed", "", 409, "`pmx-2ed` was there from the start and stays");
    let taken = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let place = taken.local_addr().unwrap();
    let busy = format!("[[device]]\nmodel = \"pmx-2ed\"\nname = \"a\"\nlisten = [\"tcp:{place}\"]\n");
    let (status, answer) = add(&rig, bench(&busy));
    assert_eq!(status, 422, "{answer}");
    assert!(answer["error"].as_str().unwrap().starts_with(&format!("tcp:{place}: ")), "{answer}");
    assert_eq!(names(&rig), ["pmx-2ed"]);
    rig.server.stop().unwrap();
}

#[test]
fn what_is_in_flash_is_on_disk() {
    let state = directory();
    let start = || {
        let http = Some(HttpSettings::new("127.0.0.1:0", Token::chosen(crate::common::TOKEN).unwrap()));
        let all = Settings { http, state: Some(state.clone()), ..settings(vec![]) };
        let server = Server::start(all).unwrap();
        Rig { address: http_address(&server), server }
    };
    let bench = json!({ "bench": "[[device]]\nmodel = \"pmx-2ed\"\nname = \"a\"\n" });
    for (removed, before) in [(true, 0), (false, 77), (false, 77)] {
        let rig = start();
        assert_eq!(add(&rig, bench.clone()).0, 201);
        assert_eq!(rig.get("a/parameters/LCAX"), before);
        rig.tell("PUT", "a/parameters/LCAX", "77");
        rig.tell("POST", "a/parameters/store", "");
        if removed {
            rig.tell("DELETE", "a", "");
        }
        rig.server.stop().unwrap();
    }
}

#[test]
fn a_real_one_by_tcp() {
    // A virtual one stands for it, on a server of its own that comes later.
    let endpoint = format!("tcp:{}", free_address());
    let rig = Rig::new(&[]);
    let real = json!({ "real": { "name": "stage", "model": "pmx-2ed", "link": endpoint } });
    let (status, added) = add(&rig, real.clone());
    assert_eq!(status, 201, "{added}");
    assert_eq!((&added[0]["kind"], &added[0]["removable"]), (&json!("real"), &json!(true)));
    eventually("it is lost", || rig.get("stage")["link"]["state"] == "lost");
    let (status, answer) = rig.call("GET", "stage/status", "");
    assert_eq!(status, 502, "{answer}");
    let (_, taken) = add(&rig, real);
    assert_eq!(taken["error"], "there is a controller `stage` already");

    let mut next = rig.live("stage");
    let machine = crate::common::serve(vec![performax("a", &[&endpoint])]);
    eventually("it is there", || rig.get("stage")["link"]["state"] == "up");
    rig.tell("POST", "stage/act", r#"{ "do": "move", "targets": { "Y": 40 }, "relative": false }"#);
    rig.arrives("stage", "Y", 40);
    let sample = loop {
        let message = next();
        if message["type"] == "samples" && message["samples"]["axes"]["Y"]["position"] == json!([40.0]) {
            break message;
        }
    };
    assert_eq!(sample["samples"]["seconds"].as_array().unwrap().len(), 1);
    let only = "`stage` is a real controller: only virtual ones have this";
    for path in ["machine", "pins/DI1", "faults", "debug"] {
        rig.refused("GET", &format!("stage/{path}"), "", 409, only);
    }
    rig.refused("POST", "stage/power-cycle", "", 409, only);
    rig.refused("PATCH", "stage/machine", r#"{ "axis": "X", "home": [0, 5] }"#, 409, only);
    machine.stop().unwrap();
    eventually("it is lost again", || rig.get("stage")["link"]["state"] == "lost");
    rig.tell("DELETE", "stage", "");
    assert_eq!(names(&rig), Vec::<String>::new());
    rig.server.stop().unwrap();
}

#[test]
fn a_real_one_that_is_given_another_address() {
    let (state, endpoint) = (directory(), format!("tcp:{}", free_address()));
    // With company on the bus it listens to its address alone.
    let machine = || {
        let devices = vec![trinamic("a", &[&endpoint]), performax("b", &[&endpoint])];
        Server::start(Settings { state: Some(state.clone()), ..settings(devices) }).unwrap()
    };
    let before = machine();
    let rig = Rig::new(&[]);
    let real = json!({ "name": "stage", "model": "pd42-1140", "link": endpoint, "address": 1 });
    let (status, added) = add(&rig, json!({ "real": real }));
    assert_eq!(status, 201, "{added}");
    rig.tell("PUT", "stage/parameters/GP66", "7");
    assert_eq!(rig.get("stage/parameters/GP66"), 7);
    rig.tell("POST", "stage/parameters/store", "");
    before.stop().unwrap();
    eventually("it is lost", || rig.get("stage")["link"]["state"] == "lost");
    let after = machine();
    eventually("it is found", || rig.get("stage")["link"]["state"] == "up");
    assert_eq!(rig.get("stage/parameters/GP66"), 7);
    rig.server.stop().unwrap();
    after.stop().unwrap();
}

#[test]
fn real_ones_that_are_wrong() {
    let rig = Rig::new(&[]);
    let refused = |name: &str, model: &str, link: &str, expected: u16, words: &str| {
        let (status, answer) = add(&rig, json!({ "real": { "name": name, "model": model, "link": link } }));
        assert_eq!((status, answer["error"].as_str().unwrap_or_default()), (expected, words));
    };
    let models = "unknown model `lift`, known: pd42-1140, pmx-2ed, cmd-4cr";
    refused("a", "lift", "tcp:h:1", 404, models);
    refused("a b", "pmx-2ed", "tcp:h:1", 422, "`a b` is not a name: letters, digits and `.`, `_`, `-`");
    refused("a", "pmx-2ed", "usb:1", 422, "`usb:1` is not a link: write serial:PATH:BAUD or tcp:HOST:PORT");
    rig.server.stop().unwrap();
}

#[test]
fn somebody_is_found() {
    let machine = crate::common::serve(vec![performax("a", &["tcp:127.0.0.1:0"])]);
    let rig = Rig::new(&[]);
    let body = json!({ "link": machine.ready()[0].1 }).to_string();
    let found = call(rig.address, "POST", "/api/find", &body);
    assert_eq!(found, (200, json!([{ "address": 0, "model": "pmx-2ed", "version": "V128BL" }])));
    let (status, ports) = call(rig.address, "GET", "/api/serial-ports", "");
    assert!(status == 200 && ports.is_array());
    rig.server.stop().unwrap();
    machine.stop().unwrap();
}
