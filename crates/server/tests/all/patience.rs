//! How long clients may take, and that the others do not wait for them.

use crate::access::{tls, token, with_http};
use crate::common::{PATIENCE, TOKEN, call, http_address};
use server::{HttpSettings, Patience, Server};
use std::{
    io::{ErrorKind, Read, Write},
    net::{SocketAddr, TcpStream},
    time::{Duration, Instant},
};

/// Enough for the requests of a test, little for somebody who waits.
const SHORT: Duration = Duration::from_millis(300);

/// For what is not under test: more than a test takes.
const LONG: Duration = Duration::from_secs(3600);

const PATIENT: Patience = Patience { handshake: LONG, head: LONG, body: LONG, send: LONG };

fn serve(settings: HttpSettings) -> (Server, SocketAddr) {
    let server = with_http(settings).unwrap();
    let address = http_address(&server);
    (server, address)
}

fn plain(patience: Patience) -> (Server, SocketAddr) {
    serve(HttpSettings { patience, ..HttpSettings::new("127.0.0.1:0", token()) })
}

/// Says something, and gives what comes until the server hangs up.
#[track_caller]
fn say(address: SocketAddr, words: &str, meanwhile: impl FnOnce()) -> String {
    let begin = Instant::now();
    let mut stream = TcpStream::connect(address).unwrap();
    stream.set_read_timeout(Some(PATIENCE)).unwrap();
    stream.write_all(words.as_bytes()).unwrap();
    meanwhile();
    let mut heard = Vec::new();
    match stream.read_to_end(&mut heard) {
        Ok(_) => {}
        Err(error) => assert_eq!(error.kind(), ErrorKind::ConnectionReset, "it hangs up"),
    }
    assert!(begin.elapsed() >= SHORT, "not at once");
    String::from_utf8(heard).unwrap()
}

fn is_served(address: SocketAddr) {
    assert_eq!(call(address, "GET", "/api/devices", "").0, 200);
}

#[test]
fn half_a_head() {
    let (server, address) = plain(Patience { head: SHORT, ..PATIENT });
    assert_eq!(say(address, "", || is_served(address)), "");
    assert_eq!(say(address, "GET /api/dev", || is_served(address)), "");
    // Between two requests too.
    let whole = format!("GET / HTTP/1.1\r\nHost: {address}\r\n\r\n");
    assert!(say(address, &whole, || is_served(address)).starts_with("HTTP/1.1 200 "));
    server.stop().unwrap();
}

#[test]
fn half_a_body() {
    let (server, address) = plain(Patience { body: SHORT, ..PATIENT });
    let half = format!(
        "PUT /api/devices/a/pins/IN HTTP/1.1\r\nHost: {address}\r\nAuthorization: Bearer {TOKEN}\r\n\
         Connection: close\r\nContent-Length: 4\r\n\r\ntr"
    );
    let answer = say(address, &half, || is_served(address));
    assert!(
        answer.starts_with("HTTP/1.1 408 ") && answer.contains("the body did not come in time"),
        "{answer}"
    );
    server.stop().unwrap();
}

#[test]
fn half_a_handshake() {
    let patience = Patience { handshake: SHORT, ..PATIENT };
    let tls = Some(tls());
    let (server, address) =
        serve(HttpSettings { tls, patience, ..HttpSettings::new("127.0.0.1:0", token()) });
    assert_eq!(say(address, "", || {}), "");
    // The beginning of a record.
    assert_eq!(say(address, "\u{16}\u{3}\u{1}", || {}), "");
    server.stop().unwrap();
}

#[test]
fn a_client_that_takes_nothing() {
    let (server, address) = plain(Patience { send: SHORT, ..PATIENT });
    let request =
        format!("GET /api/openapi.json HTTP/1.1\r\nHost: {address}\r\nAuthorization: Bearer {TOKEN}\r\n\r\n");
    let mut stream = TcpStream::connect(address).unwrap();
    stream.set_write_timeout(Some(Duration::from_millis(50))).unwrap();
    let begin = Instant::now();
    // The answers fill all buffers on their way; then the requests do.
    let error = loop {
        match stream.write(request.as_bytes()) {
            Ok(_) => {}
            Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {
                is_served(address);
            }
            Err(error) => break error,
        }
        assert!(begin.elapsed() < PATIENCE, "the server waits for ever");
    };
    assert!(matches!(error.kind(), ErrorKind::ConnectionReset | ErrorKind::BrokenPipe), "{error}");
    server.stop().unwrap();
}
