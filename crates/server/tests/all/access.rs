//! Who may do what over HTTP, and how much of it.

use crate::common::{PATIENCE, TOKEN, call, device, eventually, exchange, raw, serve_http};
use serde_json::{Value, json};
use server::{HttpSettings, Server, Settings, Tls, Token};
use std::{
    io::{Read, Write},
    net::{SocketAddr, TcpStream},
    path::Path,
    sync::Arc,
    time::Duration,
};
use tokio_rustls::rustls::{
    ClientConfig, ClientConnection, RootCertStore, StreamOwned,
    crypto::ring,
    pki_types::{CertificateDer, pem::PemObject},
};
use tungstenite::{Message, WebSocket};

#[test]
fn every_request_needs_the_token_and_a_host_of_ours() {
    let (server, address) = serve_http(vec![device("a", &[])]);
    let check = |headers: &str, path: &str, expected: u16| {
        let request = format!("GET {path} HTTP/1.1\r\n{headers}Connection: close\r\n\r\n");
        let (status, body) = raw(address, &request);
        assert_eq!(status, expected, "{headers} {path}");
        if expected >= 400 {
            let body: Value = serde_json::from_str(&body).unwrap();
            assert!(body["error"].is_string());
        }
    };
    let host = format!("Host: {address}\r\n");
    let token = format!("Authorization: Bearer {TOKEN}\r\n");
    check(&format!("{host}{token}"), "/api/devices", 200);
    check(&format!("Host: localhost\r\n{token}"), "/api/devices", 200);
    check(&host, "/api/devices", 401);
    check(&host, "/nothing", 401);
    check(&host, &format!("/api/devices?token={TOKEN}"), 401);
    check(&format!("{host}Authorization: Bearer test-tokeN\r\n"), "/api/devices", 401);
    check(&format!("{host}Authorization: Bearer\r\n"), "/api/devices", 401);
    check(&format!("{host}Authorization: Basic {TOKEN}\r\n"), "/api/devices", 401);
    check(&format!("Host: evil.example\r\n{token}"), "/api/devices", 403);
    check(&format!("Host: evil.example:{}\r\n{token}", address.port()), "/api/devices", 403);
    server.stop().unwrap();
}

#[test]
fn the_page_needs_no_token_and_everything_says_what_browsers_may_do() {
    let (server, address) = serve_http(vec![device("a", &[])]);
    let ask = |method: &str, path: &str, headers: &str| {
        let request = format!("{method} {path} HTTP/1.1\r\n{headers}Connection: close\r\n\r\n");
        let (head, body) = exchange(address, &request);
        let status: u16 = head.split(' ').nth(1).unwrap().parse().unwrap();
        (status, head.to_ascii_lowercase(), body)
    };
    let host = format!("Host: {address}\r\n");
    let (status, head, page) = ask("GET", &format!("/?token={TOKEN}"), &host);
    assert_eq!(status, 200);
    assert!(page.starts_with(b"<!doctype html>"));
    assert!(head.contains("\r\ncontent-type: text/html; charset=utf-8\r\n"), "{head}");
    assert!(head.contains("\r\ncache-control: no-cache\r\n"), "{head}");

    let (status, head, packed) = ask("GET", "/", &format!("{host}Accept-Encoding: br, gzip\r\n"));
    assert_eq!(status, 200);
    assert!(head.contains("\r\ncontent-encoding: gzip\r\n"), "{head}");
    assert!(packed.len() < page.len() && packed.starts_with(&[0x1F, 0x8B]));
    let (_, tag) = head.split_once("\r\netag: ").unwrap();
    let known = format!("{host}If-None-Match: {}\r\n", tag.split('\r').next().unwrap().replace("w/", "W/"));
    assert_eq!(ask("GET", "/", &known).0, 304);
    let (status, head, body) = ask("HEAD", "/index.html", &host);
    assert!(status == 200 && body.is_empty() && head.contains("\r\ncontent-length: "), "{status} {head}");

    for (method, path, headers, expected) in [
        ("GET", "/", host.clone(), 200),
        ("GET", "/", "Host: evil.example\r\n".into(), 403),
        ("GET", "/", format!("{host}Origin: http://{address}\r\n"), 200),
        ("GET", "/", format!("{host}Origin: http://evil.example\r\n"), 403),
        ("POST", "/", host.clone(), 401),
        ("GET", "/assets/", host.clone(), 401),
        ("GET", "/%69ndex.html", host.clone(), 401),
        ("GET", "/api/devices", host.clone(), 401),
    ] {
        let (status, head, _) = ask(method, path, &headers);
        assert_eq!(status, expected, "{method} {path} {headers}");
        assert!(
            head.contains("\r\ncontent-security-policy: default-src 'none'; script-src 'self';"),
            "{head}"
        );
        assert!(head.contains("frame-ancestors 'none'") && !head.contains("unsafe"), "{head}");
        assert!(head.contains("\r\nx-content-type-options: nosniff\r\n"), "{head}");
        assert!(head.contains("\r\nreferrer-policy: no-referrer\r\n"), "{head}");
    }
    let token = format!("{host}Authorization: Bearer {TOKEN}\r\n");
    let (status, head, _) = ask("GET", "/api/devices", &token);
    assert!(status == 200 && head.contains("\r\ncache-control: no-store\r\n"), "{head}");
    let foreign = format!("{token}Origin: http://evil.example\r\n");
    assert_eq!(ask("GET", "/api/devices", &foreign).0, 403);
    server.stop().unwrap();
}

#[test]
fn connections_are_limited_but_not_lost() {
    let (server, address) = serve_http(vec![device("a", &[])]);
    let idle: Vec<_> = (0..128).map(|_| TcpStream::connect(address).unwrap()).collect();
    // Give the server time to accept them all before one more asks.
    std::thread::sleep(Duration::from_millis(200));
    let waiting = std::thread::spawn(move || call(address, "GET", "/api/devices", "").0);
    std::thread::sleep(Duration::from_millis(200));
    assert!(!waiting.is_finished(), "it waits for room");
    drop(idle);
    eventually("it is answered", || waiting.is_finished());
    assert_eq!(waiting.join().unwrap(), 200);
    server.stop().unwrap();
}

/// A request with the token and a lease: status and answer.
fn call_with(address: SocketAddr, method: &str, path: &str, lease: &str, body: &str) -> (u16, Value) {
    let (status, body) = raw(
        address,
        &format!(
            "{method} {path} HTTP/1.1\r\nHost: {address}\r\nAuthorization: Bearer {TOKEN}\r\nConnection: close\r\n\
             Control-Lease: {lease}\r\nContent-Length: {}\r\n\r\n{body}",
            body.len()
        ),
    );
    (status, if body.is_empty() { Value::Null } else { serde_json::from_str(&body).unwrap() })
}

#[test]
fn who_has_control_is_the_only_one_to_change_anything() {
    let (server, address) = serve_http(vec![device("a", &[])]);
    let pin = |lease: &str| call_with(address, "PUT", "/api/devices/a/pins/IN", lease, "true").0;
    let take = |lease: &str, body: &str| call_with(address, "POST", "/api/lease", lease, body);
    assert_eq!(pin("none"), 204, "while nobody has control");
    let (status, granted) = take("none", r#"{ "name": "first" }"#);
    assert_eq!((status, &granted["seconds"]), (200, &json!(10.0)));
    let first = granted["lease"].as_str().unwrap();
    assert_eq!((pin(first), pin("none")), (204, 423));
    assert_eq!(call(address, "PUT", "/api/devices/a/pins/IN", "true").0, 423);
    assert_eq!(call(address, "GET", "/api/devices/a/pins/IN", "").0, 200, "everybody looks");
    let locked = json!({ "error": "first has control", "holder": "first" });
    assert_eq!(take("none", r#"{ "name": "second" }"#), (423, locked));
    let seen = |lease: &str| {
        let (_, seen) = call_with(address, "GET", "/api/lease", lease, "");
        (seen["holder"].clone(), seen["mine"] == true)
    };
    assert_eq!(seen(first), (json!("first"), true));
    assert_eq!(seen("none"), (json!("first"), false));
    assert_eq!(call_with(address, "PUT", "/api/lease", first, "").0, 204);
    assert_eq!(call_with(address, "PUT", "/api/lease", "none", "").0, 423);

    let (_, granted) = take("none", r#"{ "name": "second", "force": true }"#);
    let second = granted["lease"].as_str().unwrap();
    assert_eq!((pin(first), pin(second)), (423, 204));
    assert_eq!(call_with(address, "DELETE", "/api/lease", first, "").0, 423);
    assert_eq!(call_with(address, "DELETE", "/api/lease", second, "").0, 204);
    assert_eq!(seen(second), (Value::Null, false));
    assert_eq!(pin("none"), 204);

    let long = format!(r#"{{ "name": "{}" }}"#, "x".repeat(65));
    for body in [r#"{ "name": "" }"#, r#"{ "name": "a\nb" }"#, r#"{}"#, r#"{ "name": 3 }"#, &long] {
        assert_eq!(take("none", body).0, 422, "{body}");
    }
    server.stop().unwrap();
}

/// A WebSocket of the server.
fn socket(address: SocketAddr, path: &str) -> Option<WebSocket<TcpStream>> {
    let stream = TcpStream::connect(address).unwrap();
    stream.set_read_timeout(Some(PATIENCE)).unwrap();
    Some(tungstenite::client(format!("ws://{address}{path}"), stream).ok()?.0)
}

#[test]
fn control_lasts_while_a_socket_is_open_that_shows_it() {
    let (server, address) = serve_http(vec![device("a", &[])]);
    let (_, granted) = call(address, "POST", "/api/lease", r#"{ "name": "first" }"#);
    let lease = granted["lease"].as_str().unwrap();
    let seconds = || call(address, "GET", "/api/lease", "").1["seconds"].as_f64().unwrap();
    std::thread::sleep(Duration::from_millis(300));
    let before = seconds();
    assert!(before < 9.8, "{before}");
    let open = socket(address, &format!("/api/devices/a/stream?token={TOKEN}&lease={lease}")).unwrap();
    eventually("it lasts anew", || seconds() > before);
    let _other = socket(address, &format!("/api/devices/a/stream?token={TOKEN}&lease=other")).unwrap();
    drop(open);
    server.stop().unwrap();
}

#[test]
fn the_language_server_is_at_the_other_end_of_a_socket() {
    let (server, address) = serve_http(vec![device("a", &[])]);
    assert!(socket(address, "/api/lsp").is_none(), "without the token");
    assert!(socket(address, &format!("/api/lsp?token={TOKEN}&model=none")).is_none());
    let mut socket = socket(address, &format!("/api/lsp?token={TOKEN}&model=pmx-2ed")).unwrap();
    let say = |socket: &mut WebSocket<_>, message: Value| {
        socket
            .send(Message::text(
                json!({ "jsonrpc": "2.0" })
                    .as_object()
                    .map_or(Value::Null, |head| {
                        let mut all = head.clone();
                        all.extend(message.as_object().unwrap().clone());
                        Value::Object(all)
                    })
                    .to_string(),
            ))
            .unwrap();
    };
    let next = |socket: &mut WebSocket<_>| -> Value {
        serde_json::from_str(&socket.read().unwrap().into_text().unwrap()).unwrap()
    };
    say(&mut socket, json!({ "id": 1, "method": "initialize", "params": { "capabilities": {} } }));
    assert_eq!(next(&mut socket)["id"], 1);
    say(&mut socket, json!({ "method": "initialized", "params": {} }));
    let document = json!({ "uri": "pulsetrain:/a.prg", "languageId": "a-script", "version": 1, "text": "NONSENSE\nEND\n" });
    say(&mut socket, json!({ "method": "textDocument/didOpen", "params": { "textDocument": document } }));
    let published = next(&mut socket);
    assert_eq!(published["method"], "textDocument/publishDiagnostics");
    assert_eq!(published["params"]["diagnostics"][0]["range"]["start"]["line"], 0);
    socket.send(Message::text("x".repeat((4 << 20) + 1))).unwrap_or_default();
    assert!(socket.read().is_err(), "nothing is longer than 4 MiB");
    server.stop().unwrap();
}

#[test]
fn sockets_of_a_client_are_limited() {
    let (server, address) = serve_http(vec![device("a", &[])]);
    let path = format!("/api/lsp?token={TOKEN}");
    let mut open: Vec<_> = (0..64).map(|_| socket(address, &path).unwrap()).collect();
    assert!(socket(address, &path).is_none());
    assert_eq!(call(address, "GET", "/api/devices", "").0, 200, "requests are none");
    open.pop().unwrap().close(None).unwrap();
    eventually("there is room again", || socket(address, &path).is_some());
    server.stop().unwrap();
}

#[test]
fn heads_and_bodies_are_limited() {
    let (server, address) = serve_http(vec![device("a", &[])]);
    let ask = |headers: &str| {
        raw(address, &format!("GET / HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n{headers}\r\n")).0
    };
    assert_eq!(ask(&format!("X: {}\r\n", "x".repeat(8000))), 200);
    assert_eq!(ask(&format!("X: {}\r\n", "x".repeat(20_000))), 431);
    assert_eq!(ask(&"X: x\r\n".repeat(50)), 200);
    assert_eq!(ask(&"X: x\r\n".repeat(100)), 431);
    let (status, _) = call(address, "PUT", "/api/devices/a/pins/IN", &format!("{}true", " ".repeat(4000)));
    assert_eq!(status, 204);
    let (status, _) = call(address, "PUT", "/api/devices/a/pins/IN", &format!("{}true", " ".repeat(5000)));
    assert_eq!(status, 413);
    server.stop().unwrap();
}

pub fn with_http(http: HttpSettings) -> Result<Server, server::Error> {
    Server::start(Settings { http: Some(http), ..crate::common::settings(vec![device("a", &[])]) })
}

pub fn token() -> Token {
    Token::chosen(TOKEN).unwrap()
}

#[test]
fn other_machines_need_tls_or_the_users_word() {
    let address = "0.0.0.0:0";
    let error = with_http(HttpSettings::new(address, token())).err().unwrap().to_string();
    assert!(error.starts_with("http 0.0.0.0:0: ") && error.contains("--insecure"), "{error}");
    let server =
        with_http(HttpSettings { is_insecure: true, ..HttpSettings::new(address, token()) }).unwrap();
    assert!(server.url().unwrap().starts_with("http://0.0.0.0:"));
    server.stop().unwrap();
}

pub fn tls() -> Tls {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/tls");
    Tls { certificate: folder.join("certificate.pem"), key: folder.join("key.pem") }
}

#[test]
fn https() {
    let settings = HttpSettings { tls: Some(tls()), ..HttpSettings::new("0.0.0.0:0", token()) };
    let server = with_http(settings).unwrap();
    let port: u16 = server.url().unwrap().split([':', '/']).nth(4).unwrap().parse().unwrap();
    assert!(server.url().unwrap().starts_with("https://0.0.0.0:"));
    let address = SocketAddr::from(([127, 0, 0, 1], port));

    let mut roots = RootCertStore::empty();
    roots.add(CertificateDer::from_pem_file(tls().certificate).unwrap()).unwrap();
    let config = ClientConfig::builder_with_provider(Arc::new(ring::default_provider()))
        .with_safe_default_protocol_versions()
        .unwrap()
        .with_root_certificates(roots)
        .with_no_client_auth();
    let client = ClientConnection::new(Arc::new(config), "localhost".try_into().unwrap()).unwrap();
    let stream = TcpStream::connect(address).unwrap();
    stream.set_read_timeout(Some(PATIENCE)).unwrap();
    let mut stream = StreamOwned::new(client, stream);
    let request = format!(
        "GET /api/devices HTTP/1.1\r\nHost: localhost:{port}\r\nAuthorization: Bearer {TOKEN}\r\nConnection: close\r\n\r\n"
    );
    stream.write_all(request.as_bytes()).unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    assert!(answer.starts_with("HTTP/1.1 200 "), "{answer}");

    let mut plain = TcpStream::connect(address).unwrap();
    plain.write_all(request.as_bytes()).unwrap();
    let mut answer = Vec::new();
    let _ = plain.read_to_end(&mut answer);
    assert!(!answer.starts_with(b"HTTP"), "no answer without TLS");
    server.stop().unwrap();
}

#[test]
fn wrong_certificates_are_named() {
    let check = |tls: Tls, expected: &str| {
        let settings = HttpSettings { tls: Some(tls), ..HttpSettings::new("127.0.0.1:0", token()) };
        let error = with_http(settings).err().unwrap().to_string();
        assert!(error.contains(expected), "{error}");
    };
    check(Tls { certificate: "missing.pem".into(), ..tls() }, "missing.pem: ");
    check(Tls { key: "missing.pem".into(), ..tls() }, "missing.pem: ");
    check(Tls { certificate: tls().key, ..tls() }, "key.pem: there is no certificate in it");
    check(Tls { key: tls().certificate, ..tls() }, "certificate.pem: ");
}
