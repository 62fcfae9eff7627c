//! Breakpoints over HTTP, in real time.

use crate::common::{call, connect, eventually, serve_http, trinamic};
use protocol::tmcl::{Frame, Reply, Request};
use serde_json::{Value, json};
use std::{
    io::{Read, Write},
    net::TcpStream,
    thread,
    time::Duration,
};
use tmcl::{
    Command,
    asm::{NoFiles, assemble},
};

/// Commands 0 and 1 once, then 2 and 3 for ever.
const PROGRAM: &[u8] = b"SGP 0, 2, 5\nROR 0, 1000\nLoop: WAIT TICKS, 0, 1\nJA Loop\n";

const RUN: u8 = 129;
const ENTER_DOWNLOAD: u8 = 132;
const EXIT_DOWNLOAD: u8 = 133;
const GET_AXIS_PARAMETER: u8 = 6;

fn ask(stream: &mut TcpStream, command: Command) -> i32 {
    let Command { opcode, kind, motor, value } = command;
    stream.write_all(&Request { address: 1, opcode, kind, motor, value }.emit().0).unwrap();
    let mut reply = [0; 9];
    stream.read_exact(&mut reply).unwrap();
    let reply = Reply::parse(&Frame(reply)).unwrap();
    assert!(reply.status.0 >= 100, "{command:?}: {reply:?}");
    reply.value
}

const fn control(opcode: u8) -> Command {
    Command { opcode, kind: 0, motor: 0, value: 0 }
}

#[test]
fn a_program_is_held_stepped_and_let_go_and_time_stands_meanwhile() {
    let (server, address) = serve_http(vec![trinamic("a", &["tcp:127.0.0.1:0"])]);
    let mut stream = connect(&server.ready()[0].1);
    ask(&mut stream, control(ENTER_DOWNLOAD));
    for command in assemble("test.tmc", PROGRAM, &NoFiles).program.unwrap().commands {
        ask(&mut stream, command);
    }
    ask(&mut stream, control(EXIT_DOWNLOAD));

    let debug = |method: &str, body: Value| {
        let body = if body.is_null() { String::new() } else { body.to_string() };
        call(address, method, "/api/devices/a/debug", &body)
    };
    let held = |at: u16| json!({ "held": { "program": 0, "address": at }, "breakpoints": [3] });
    let seconds = || call(address, "GET", "/api/devices/a", "").1["device_seconds"].as_f64().unwrap();
    assert_eq!(debug("GET", Value::Null), (200, json!({ "held": null, "breakpoints": [] })));
    assert_eq!(debug("PUT", json!({ "breakpoints": [3] })).0, 200);
    ask(&mut stream, control(RUN));
    eventually("held at 3", || debug("GET", Value::Null).1 == held(3));

    // Everything stands, and answers.
    let position = Command { opcode: GET_AXIS_PARAMETER, kind: 1, motor: 0, value: 0 };
    let (before, at) = (seconds(), ask(&mut stream, position));
    thread::sleep(Duration::from_millis(50));
    assert_eq!((seconds(), ask(&mut stream, position)), (before, at));

    debug("POST", json!({ "do": "step" }));
    eventually("held at 2", || debug("GET", Value::Null).1 == held(2));
    debug("POST", json!({ "do": "continue" }));
    eventually("held at 3 again", || debug("GET", Value::Null).1 == held(3));
    assert!((0.009..0.02).contains(&(seconds() - before)), "a round takes ten milliseconds");

    assert_eq!(debug("PUT", json!({ "breakpoints": [] })).0, 200);
    debug("POST", json!({ "do": "continue" }));
    let (before, at) = (seconds(), ask(&mut stream, position));
    eventually("time goes on", || seconds() > before + 0.05 && ask(&mut stream, position) > at);

    assert_eq!(debug("POST", json!({ "do": "back" })).0, 422);
    assert_eq!(debug("PUT", json!({ "breakpoints": [70_000] })).0, 422);
    assert_eq!(call(address, "GET", "/api/devices/b/debug", "").0, 404);
    server.stop().unwrap();
}
