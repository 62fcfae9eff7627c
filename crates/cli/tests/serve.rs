//! `serve`, from a client's side.

mod common;

use common::{
    Client, GAP, GGP, MVP, PATIENCE, SAP, SGP, STAP, Serve, command, directory, frame, frame_to, refused,
};
use rustix::process::Signal;
use serde_json::Value;
use std::{
    fs::{self, OpenOptions},
    io::{BufRead, BufReader, Read, Write},
    net::{TcpListener, TcpStream},
    os::unix::net::UnixStream,
};

const TCP: &str = "pd42-1140@tcp:127.0.0.1:0";

#[test]
fn a_move_over_tcp() {
    let directory = directory(&[]);
    let serve = Serve::start(&directory, &[TCP, "--no-http"], 1);
    assert_eq!(serve.ready[0].0, "pd42-1140");
    let mut client = serve.client(0);
    assert_eq!(client.raw(&frame(GAP, 1, 0, 0)), [2, 1, 100, 6, 0, 0, 0, 0, 109]);
    assert_eq!(client.value(MVP, 0, 0, -3000), -3000);
    client.wait_for(8, 1);
    assert_eq!(client.value(GAP, 1, 0, 0), -3000);
    assert_eq!(client.raw(&[1, 6, 1, 0, 0, 0, 0, 0, 9])[2..4], [1, 0], "wrong checksum");
    assert_eq!(client.raw(&frame(GAP, 1, 1, 0))[2], 4, "no such motor");
    assert_eq!(serve.end(Signal::TERM), Some(0));
}

#[test]
fn both_models_at_once() {
    let directory = directory(&[]);
    let serve = Serve::start(&directory, &[TCP, "pmx-2ed=stage@tcp:127.0.0.1:0", "--no-http"], 2);
    assert_eq!(serve.ready[1].0, "stage");
    let mut client = BufReader::new(serve.client(1).0);
    let mut ask = |line: &str| {
        client.get_mut().write_all(format!("{line}\r").as_bytes()).unwrap();
        let mut reply = Vec::new();
        client.read_until(b'\r', &mut reply).unwrap();
        String::from_utf8(reply).unwrap().trim_end().to_owned()
    };
    assert_eq!(
        (ask("ID"), ask("@00DN"), ask("X-700")),
        ("PERFORMAX-2ED-SA".into(), "2ED00".into(), "OK".into())
    );
    let begin = std::time::Instant::now();
    while ask("PX") != "-700" {
        assert!(begin.elapsed() < PATIENCE);
    }
    assert_eq!(serve.client(0).value(GAP, 1, 0, 0), 0);
    assert_eq!(serve.end(Signal::TERM), Some(0));
}

#[test]
fn a_move_over_a_terminal() {
    let directory = directory(&[]);
    let serve = Serve::start(&directory, &["pd42-1140=axis@pty:port", "--no-http"], 1);
    assert_eq!(serve.ready[0], ("axis".into(), "pty:port".into()));
    for target in [3000, -3000] {
        let port = OpenOptions::new().read(true).write(true).open(directory.join("port")).unwrap();
        let mut client = Client(port);
        assert_eq!(client.value(MVP, 0, 0, target), target);
        client.wait_for(1, target);
    }
    assert_eq!(serve.end(Signal::INT), Some(0));
    assert!(fs::symlink_metadata(directory.join("port")).is_err(), "the link is removed");
}

#[test]
fn reports_over_a_unix_socket() {
    let directory = directory(&[]);
    let serve = Serve::start(&directory, &["pmx-2ed=stage@hid-unix:hid", "--no-http"], 1);
    assert_eq!(serve.ready[0], ("stage".into(), "hid-unix:hid".into()));
    let mut port = UnixStream::connect(directory.join("hid")).unwrap();
    port.set_read_timeout(Some(PATIENCE)).unwrap();
    let mut report = [0; 64];
    port.read_exact(&mut report).unwrap();
    assert!(report.starts_with(b"2ED00\0"));
    let mut command = [0; 64];
    command[..3].copy_from_slice(b"VER");
    port.write_all(&command).unwrap();
    port.read_exact(&mut report).unwrap();
    assert!(report.starts_with(b"V128BL\0"));
    assert_eq!(serve.end(Signal::TERM), Some(0));
    assert!(fs::symlink_metadata(directory.join("hid")).is_err(), "the socket is removed");
}

#[test]
fn two_modules_on_a_bus() {
    let free = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
    let bus = format!("tcp:{free}");
    let bench = format!(
        "[[device]]\nmodel = \"pd42-1140\"\nname = \"one\"\nlisten = [\"{bus}\"]\n\n\
         [[device]]\nmodel = \"pd42-1140\"\nname = \"two\"\nlisten = [\"tcp:127.0.0.1:0\"]\n"
    );
    let directory = directory(&[("bench.toml", &bench)]);
    let more = format!("pd42-1140=two@{bus}");
    let serve = Serve::start(&directory, &["--bench", "bench.toml", &more, "--no-http"], 3);
    let names: Vec<_> = serve.ready.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["one", "two", "two"]);
    // The second gets address 2 over its own endpoint.
    assert_eq!(serve.client(1).value(SGP, 66, 0, 2), 2);
    let mut client = serve.client(0);
    for (address, target) in [(1, 1000), (2, -1000)] {
        let reply = client.raw(&frame_to(address, MVP, 0, 0, target));
        assert_eq!(reply[..4], [2, address, 100, MVP]);
    }
    for (address, target) in [(1, 1000), (2, -1000_i32)] {
        let start = std::time::Instant::now();
        loop {
            let reply = client.raw(&frame_to(address, GAP, 1, 0, 0));
            assert_eq!(reply[..4], [2, address, 100, GAP]);
            if reply[4..8] == target.to_be_bytes() {
                break;
            }
            assert!(start.elapsed() < PATIENCE);
        }
    }
    // Nobody has address 3, so the next reply is that of module 1.
    client.0.write_all(&frame_to(3, GAP, 1, 0, 0)).unwrap();
    assert_eq!(client.raw(&frame_to(1, GAP, 1, 0, 0))[1], 1);
    assert_eq!(serve.end(Signal::TERM), Some(0));
}

#[test]
fn a_session_over_can() {
    let directory = directory(&[]);
    let serve = Serve::start(&directory, &["pd42-1140@slcan-tcp:127.0.0.1:0", "--no-http"], 1);
    let mut stream = serve.client(0).0;
    let mut check = |sent: &str, expected: &str| {
        stream.write_all(sent.as_bytes()).unwrap();
        let mut reply = vec![0; expected.len()];
        stream.read_exact(&mut reply).unwrap();
        assert_eq!(String::from_utf8(reply).unwrap(), expected);
    };
    // GAP 1, 0 with 7 bytes, SAP 4, 0, 500, and a message for somebody else.
    check("S8\rO\r", "\r\r");
    check("t001706010000000000\r", "z\rt00270164060000000\x30\r");
    check("t001705040\x30000001F4\r", "z\rt002701640500000\x31F4\r");
    check("t003706010000000000\rV\r", "z\rV1013\r");
    assert_eq!(serve.end(Signal::TERM), Some(0));
}

/// Sends a request and gives status and body.
fn http(url: &str, method: &str, path: &str, token: Option<&str>, body: &str) -> (u16, String) {
    let address = url.strip_prefix("http://").unwrap().split('/').next().unwrap();
    let mut stream = TcpStream::connect(address).unwrap();
    stream.set_read_timeout(Some(PATIENCE)).unwrap();
    let token = token.map_or(String::new(), |token| format!("Authorization: Bearer {token}\r\n"));
    let length = body.len();
    let head = format!("{method} {path} HTTP/1.1\r\nHost: {address}\r\n{token}Connection: close\r\n");
    write!(stream, "{head}Content-Length: {length}\r\n\r\n{body}").unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    let (head, body) = answer.split_once("\r\n\r\n").unwrap();
    (head.split(' ').nth(1).unwrap().parse().unwrap(), body.into())
}

#[test]
fn http_shows_and_drives_the_device() {
    let directory = directory(&[]);
    let serve = Serve::start(&directory, &[TCP, "--http", "127.0.0.1:0"], 2);
    let (name, url) = &serve.ready[1];
    assert_eq!(name, "http");
    let (_, token) = url.split_once("/?token=").unwrap();
    let call = |method: &str, path: &str, body: &str| {
        let path = format!("/api/devices/pd42-1140{path}");
        http(url, method, &path, Some(token), body)
    };
    let mut client = serve.client(0);
    client.value(MVP, 0, 0, 2000);
    client.wait_for(1, 2000);
    let (status, state) = call("GET", "", "");
    assert_eq!(status, 200);
    let state: Value = serde_json::from_str(&state).unwrap();
    assert_eq!(state["model"], "pd42-1140");
    assert_eq!(state["endpoints"][0], serve.ready[0].1.as_str());
    assert_eq!(state["axes"]["0"]["position"], 2000);
    assert_eq!(state["axes"]["0"]["target"], 2000);
    assert_eq!(state["programs"][0]["state"], "idle");
    assert!(state["device_seconds"].as_f64().unwrap() > 0.0);

    assert_eq!(client.value(GAP, 11, 0, 0), 0);
    assert_eq!(call("PUT", "/pins/STOP_L", "true"), (204, String::new()));
    assert_eq!(client.value(GAP, 11, 0, 0), 1, "the left stop switch is on");
    assert_eq!(call("GET", "/pins/STOP_L", ""), (200, "true".into()));
    assert_eq!(call("DELETE", "/pins/STOP_L", ""), (204, String::new()));
    assert_eq!(client.value(GAP, 11, 0, 0), 0);
    assert_eq!(call("PUT", "/axes/0/load", "0.5").0, 204);
    assert_eq!(call("PUT", "/axes/X/load", "0.5").0, 404);
    assert_eq!(call("PUT", "/pins/SUPPLY", "true").0, 422);
    assert_eq!(call("POST", "/power-cycle", "").0, 204);
    assert_eq!(client.value(GAP, 1, 0, 0), 0, "the position is lost with the power");
    assert_eq!(http(url, "GET", "/api/devices", None, "").0, 401);
    assert_eq!(http(url, "GET", "/api/devices", Some("wrong"), "").0, 401);
    assert_eq!(serve.end(Signal::TERM), Some(0));
}

#[test]
fn the_token_can_be_set_and_is_otherwise_new() {
    let directory = directory(&[]);
    let start = |token: Option<&str>| {
        let mut command = command(&directory, &["serve", TCP, "--http", "127.0.0.1:0"]);
        token.map(|token| command.env("PULSETRAIN_TOKEN", token));
        Serve::spawn(&mut command, 2).ready[1].1.split_once("?token=").unwrap().1.to_owned()
    };
    assert_eq!(start(Some("my-token")), "my-token");
    let (first, second) = (start(None), start(None));
    assert!(first.len() >= 32 && first != second);
    let mut command = command(&directory, &["serve", TCP]);
    let output = command.env("PULSETRAIN_TOKEN", "two words").output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8(output.stderr).unwrap().starts_with("error: PULSETRAIN_TOKEN: "));
}

/// The certificate and key of the server's own tests.
const CERTIFICATE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../server/tests/tls/certificate.pem");
const KEY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../server/tests/tls/key.pem");

#[test]
fn with_a_certificate_there_is_no_answer_without_tls() {
    let directory = directory(&[]);
    for address in ["0.0.0.0", "127.0.0.1"] {
        let http = format!("{address}:0");
        let flags = [TCP, "--http", &http, "--tls-cert", CERTIFICATE, "--tls-key", KEY];
        let serve = Serve::start(&directory, &flags, 2);
        let port = serve.ready[1].1.strip_prefix(&format!("https://{address}:")).expect("it says https");
        let port: u16 = port.split('/').next().unwrap().parse().unwrap();
        let mut stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        stream.write_all(b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n").unwrap();
        let mut alert = Vec::new();
        let _ = stream.read_to_end(&mut alert);
        // A record of TLS that says what is wrong.
        assert_eq!(alert.first(), Some(&0x15));
    }
    let serve = Serve::start(&directory, &[TCP, "--http", "0.0.0.0:0", "--insecure"], 2);
    let url = serve.ready[1].1.replace("0.0.0.0", "127.0.0.1");
    assert_eq!(http(&url, "GET", "/api/devices", url.split("token=").nth(1), "").0, 200);
}

#[test]
fn settings_survive_a_restart_and_a_kill() {
    let directory = directory(&[]);
    let start = || Serve::start(&directory, &[TCP, "--no-http", "--state", "state"], 1);
    let serve = start();
    let mut client = serve.client(0);
    client.value(SAP, 4, 0, 321);
    client.value(STAP, 4, 0, 0);
    client.value(SAP, 5, 0, 77);
    assert_eq!(serve.end(Signal::TERM), Some(0));
    let serve = start();
    let mut client = serve.client(0);
    assert_eq!(client.value(GAP, 4, 0, 0), 321);
    assert_eq!(client.value(GAP, 5, 0, 0), 500, "this one was not stored");
    let image = || fs::read(directory.join("state/pd42-1140.flash")).unwrap();
    let before = image();
    client.value(SGP, 76, 0, 9);
    // Saved soon after the change; then a kill loses nothing.
    let begin = std::time::Instant::now();
    while image() == before {
        assert!(begin.elapsed() < PATIENCE);
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    drop(serve);
    let serve = start();
    assert_eq!(serve.client(0).raw(&frame(GGP, 76, 0, 0))[0], 9, "the host address of replies");
    drop(serve);
}

#[test]
fn device_time_can_run_faster() {
    let directory = directory(&[]);
    let serve = Serve::start(&directory, &[TCP, "--no-http", "--speed", "100"], 1);
    let mut client = serve.client(0);
    let (before, start) = (client.value(GGP, 132, 0, 0), std::time::Instant::now());
    std::thread::sleep(std::time::Duration::from_millis(300));
    let passed_ms = client.value(GGP, 132, 0, 0) - before;
    let wall_ms = start.elapsed().as_millis() as i32;
    assert!((25_000..=100 * wall_ms + 1000).contains(&passed_ms), "{passed_ms} ms in {wall_ms} ms");
}

#[test]
fn wrong_arguments_are_refused_in_one_line() {
    let directory = directory(&[
        ("syntax.toml", "[[device]\n"),
        ("key.toml", "[[device]]\nmodel = \"pd42-1140\"\nspeed = 3\n"),
        ("limit.toml", "[[device]]\nmodel = \"pd42-1140\"\n[device.axis.0]\nnegative_limit = 1e9\n"),
        ("file", ""),
    ]);
    let check = |arguments: &[&str], expected: &str| {
        refused(&directory, &[&["serve"], arguments].concat(), expected);
    };
    check(&["pd42-1140"], "write MODEL[=NAME]@ENDPOINT");
    check(&["pd57@tcp:127.0.0.1:0"], "unknown model `pd57`, known: pd42-1140");
    check(&["pd42-1140=a/b@tcp:127.0.0.1:0"], "`a/b` is not a name");
    check(&["pd42-1140@udp:127.0.0.1:0"], "`udp:127.0.0.1:0` is not an endpoint");
    check(&["pd42-1140@tcp:127.0.0.1"], "needs a host and a port");
    check(&["pd42-1140@tcp:127.0.0.1:99999"], "`99999` is not a port");
    check(&["pd42-1140@pty:file", "--no-http"], "pty:file: exists and is not a link");
    check(&["pd42-1140@pty:a", "pd42-1140@pty:a"], "`pd42-1140` is at pty:a already");
    check(&["pd42-1140@hid-tcp:h:0", "--no-http"], "hid-tcp:h:0: a pd42-1140 is no HID device");
    check(&["pmx-2ed=a@hid-unix:s", "pmx-2ed=b@hid-unix:s", "--no-http"], "hid-unix:s: `a` is there already");
    check(&["pmx-2ed=a@hid-unix:file", "--no-http"], "hid-unix:file: exists and is not a socket");
    check(&["--speed", "0", TCP], "a speed is a number from 0.001 to 1000");
    check(&["--speed", "fast", TCP], "a speed is a number from 0.001 to 1000");
    check(&["--http", "127.0.0.1:0", "--no-http", TCP], "cannot be used with");
    check(&["--http", "nowhere", TCP], "http nowhere: ");
    check(&["--http", "0.0.0.0:0", TCP], "http 0.0.0.0:0: ");
    check(&["--tls-cert", CERTIFICATE, TCP], "--tls-key <FILE>");
    check(&["--tls-key", KEY, TCP], "--tls-cert <FILE>");
    check(&["--tls-cert", CERTIFICATE, "--tls-key", KEY, "--insecure", TCP], "cannot be used with");
    check(&["--tls-cert", "none.pem", "--tls-key", KEY, TCP], "none.pem: ");
    check(&["--tls-cert", CERTIFICATE, "--tls-key", "file", TCP], "file: ");
    check(&["--bench", "none.toml"], "none.toml: No such file");
    check(&["--bench", "syntax.toml"], "syntax.toml:1: ");
    check(&["--bench", "key.toml"], "key.toml:3: device.speed: ");
    check(&["--bench", "limit.toml"], "limit.toml:4: device.axis.0.negative_limit: ");
    check(&["--state", "file", "--no-http", TCP], "file: ");
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let endpoint = format!("tcp:{}", taken.local_addr().unwrap());
    check(&[&format!("pd42-1140@{endpoint}"), "--no-http"], &format!("{endpoint}: "));
    check(&["--http", &taken.local_addr().unwrap().to_string(), TCP], "http 127.0.0.1:");
}
