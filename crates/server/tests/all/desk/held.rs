//! Jogs that are held: they go on while somebody says so, and no longer.

use super::Rig;
use crate::common::{TOKEN, call, commander, connect, connect_ws, eventually, free_address, serve};
use serde_json::{Value, json};
use std::{
    io::{BufRead, BufReader, Write},
    net::TcpStream,
    thread::sleep,
    time::{Duration, Instant},
};
use tungstenite::{Message, WebSocket};

const MODELS: [&str; 3] = ["pd42-1140", "pmx-2ed", "cmd-4cr"];

/// Silence after which an axis is stopped.
const SILENCE: Duration = Duration::from_millis(600);

/// Somebody who may hold jogs.
struct Holder(WebSocket<TcpStream>);

impl Holder {
    fn new(rig: &Rig, device: &str) -> Self {
        Self(connect_ws(rig.address, &format!("/api/devices/{device}/live?token={TOKEN}")))
    }

    fn say(&mut self, message: &Value) {
        self.0.send(Message::text(message.to_string())).unwrap();
    }

    /// Says again and again that an axis goes on, long enough for several silences. False if this machine itself was
    /// too busy to say it in time.
    fn holds(&mut self, axis: &str, lease: Option<&str>) -> bool {
        let (begin, mut last, mut longest) = (Instant::now(), Instant::now(), Duration::ZERO);
        while begin.elapsed() < 3 * SILENCE {
            let mut message = json!({ "type": "hold", "axes": [axis] });
            if let Some(lease) = lease {
                message["lease"] = lease.into();
            }
            self.say(&message);
            longest = longest.max(last.elapsed());
            last = Instant::now();
            sleep(Duration::from_millis(50));
        }
        longest.max(last.elapsed()) < SILENCE / 2
    }
}

fn axis_of(model: &str) -> &'static str {
    devices::model(model).unwrap().guide.axes[0]
}

fn jog(axis: &str) -> String {
    json!({ "do": "jog", "axis": axis, "direction": 1, "held": true }).to_string()
}

fn moves(rig: &Rig, device: &str, axis: &str) -> bool {
    rig.get(&format!("{device}/status"))["axes"][axis]["speed"] != 0
}

#[track_caller]
fn stands(rig: &Rig, device: &str, axis: &str) {
    eventually(&format!("{device} stands"), || !moves(rig, device, axis));
}

/// Jogs and holds until that was done in time.
#[track_caller]
fn is_held(rig: &Rig, device: &str, holder: &mut Holder) {
    let axis = axis_of(device);
    for _ in 0..10 {
        rig.tell("POST", &format!("{device}/act"), &jog(axis));
        if holder.holds(axis, None) {
            assert!(moves(rig, device, axis), "{device} goes on while it is held");
            return;
        }
        stands(rig, device, axis);
    }
    panic!("this machine is too slow");
}

#[test]
fn who_is_silent_from_the_start_moves_nothing_for_long() {
    let rig = Rig::new(&MODELS);
    for device in MODELS {
        let axis = axis_of(device);
        let from = rig.get(&format!("{device}/status"))["axes"][axis]["position"].as_i64().unwrap();
        rig.tell("POST", &format!("{device}/act"), &jog(axis));
        stands(&rig, device, axis);
        let to = rig.get(&format!("{device}/status"))["axes"][axis]["position"].as_i64().unwrap();
        assert!(to > from, "{device} has moved");
    }
    rig.server.stop().unwrap();
}

#[test]
fn it_goes_on_while_it_is_held_and_stops_when_the_socket_closes() {
    let rig = Rig::new(&MODELS);
    for device in MODELS {
        let mut holder = Holder::new(&rig, device);
        is_held(&rig, device, &mut holder);
        drop(holder);
        stands(&rig, device, axis_of(device));
    }
    rig.server.stop().unwrap();
}

#[test]
fn it_stops_when_nothing_is_said_or_the_axis_is_not_named() {
    let rig = Rig::new(&MODELS);
    for device in MODELS {
        let mut holder = Holder::new(&rig, device);
        is_held(&rig, device, &mut holder);
        stands(&rig, device, axis_of(device));
        is_held(&rig, device, &mut holder);
        holder.say(&json!({ "type": "hold", "axes": [] }));
        stands(&rig, device, axis_of(device));
    }
    rig.server.stop().unwrap();
}

#[test]
fn what_is_told_instead_is_not_stopped() {
    let rig = Rig::new(&MODELS);
    for device in MODELS {
        let axis = axis_of(device);
        let act = format!("{device}/act");
        rig.tell("POST", &act, &jog(axis));
        rig.tell("POST", &act, &json!({ "do": "stop", "axis": axis }).to_string());
        stands(&rig, device, axis);
        // Nobody holds this one.
        rig.tell("POST", &act, &json!({ "do": "jog", "axis": axis, "direction": -1 }).to_string());
        sleep(2 * SILENCE);
        assert!(moves(&rig, device, axis), "{device}");
        // A jog that is refused is none: the one before goes on as it was.
        if device != "pd42-1140" {
            assert_eq!(rig.call("POST", &act, &jog(axis)).0, 422);
            sleep(2 * SILENCE);
            assert!(moves(&rig, device, axis), "{device}");
        }
        rig.tell("POST", &format!("{device}/stop"), "");
    }
    rig.server.stop().unwrap();
}

#[test]
fn only_who_has_control_holds() {
    let rig = Rig::new(&["pmx-2ed"]);
    let take = |name: &str| {
        let body = json!({ "name": name, "force": true }).to_string();
        let (status, grant) = call(rig.address, "POST", "/api/lease", &body);
        assert_eq!(status, 200);
        grant["lease"].as_str().unwrap().to_owned()
    };
    let act = |lease: &str, body: &str| {
        let head = format!("POST /api/devices/pmx-2ed/act HTTP/1.1\r\nHost: {0}\r\n", rig.address);
        let request = format!(
            "{head}Authorization: Bearer {TOKEN}\r\nControl-Lease: {lease}\r\nConnection: close\r\n\
             Content-Length: {}\r\n\r\n{body}",
            body.len()
        );
        assert_eq!(crate::common::raw(rig.address, &request).0, 204);
    };
    let mut holder = Holder::new(&rig, "pmx-2ed");
    let mine = take("first");
    // It does not say who it is.
    act(&mine, &jog("X"));
    holder.holds("X", None);
    stands(&rig, "pmx-2ed", "X");
    let in_time = (0..10).any(|_| {
        act(&mine, &jog("X"));
        let in_time = holder.holds("X", Some(&mine));
        assert!(!in_time || moves(&rig, "pmx-2ed", "X"));
        in_time || {
            stands(&rig, "pmx-2ed", "X");
            false
        }
    });
    assert!(in_time, "this machine is too slow");
    // Somebody takes control: the axis stops unless he has it go on.
    let other = take("second");
    holder.holds("X", Some(&mine));
    stands(&rig, "pmx-2ed", "X");
    act(&other, r#"{ "do": "jog", "axis": "X", "direction": 1 }"#);
    sleep(2 * SILENCE);
    assert!(moves(&rig, "pmx-2ed", "X"));
    rig.server.stop().unwrap();
}

#[test]
fn the_end_of_the_server_stops_real_ones() {
    let endpoint = format!("tcp:{}", free_address());
    let machine = serve(vec![commander("a", &[&endpoint])]);
    let rig = Rig::new(&[]);
    let real = json!({ "real": { "name": "a", "model": "cmd-4cr", "link": endpoint } }).to_string();
    assert_eq!(call(rig.address, "POST", "/api/devices", &real).0, 201);
    rig.tell("POST", "a/act", &jog("Z"));
    let mut speed = {
        let mut wire = BufReader::new(connect(&endpoint));
        move || {
            wire.get_mut().write_all(b"PSZ\r").unwrap();
            let mut reply = Vec::new();
            wire.read_until(b'\r', &mut reply).unwrap();
            String::from_utf8(reply).unwrap()
        }
    };
    assert_ne!(speed(), "0\r");
    rig.server.stop().unwrap();
    eventually("it stands", || speed() == "0\r");
    machine.stop().unwrap();
}
