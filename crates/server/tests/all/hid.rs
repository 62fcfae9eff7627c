//! Reports of USB HID over TCP and Unix sockets, spoken as the vendor's library does.

use crate::common::{
    PATIENCE, call, check, commander, connect, device, directory, free_address, performax, serve, serve_http,
    trinamic,
};
use protocol::hid::{ApiError, Exchange, Packet};
use server::Server;
use std::{
    fs,
    io::{ErrorKind, Read, Write},
    net::{Shutdown, TcpStream},
    os::unix::net::{UnixListener, UnixStream},
    path::Path,
};

/// A handle of the vendor's library.
struct Handle<S> {
    port: S,
    name: String,
    exchange: Exchange,
}

impl<S: Read + Write> Handle<S> {
    fn open(mut port: S) -> Self {
        let name = read(&mut port).unwrap().decode().unwrap().to_owned();
        Self { port, name, exchange: Exchange::new() }
    }

    fn ask(&mut self, command: &str) -> Result<String, ApiError> {
        let report = self.exchange.send(command, 0)?;
        self.port.write_all(&report.0).map_err(|_| ApiError::Write)?;
        let report = read(&mut self.port).map_err(|_| ApiError::Communication)?;
        Ok(self.exchange.receive(&report.0)?.expect("it was asked for").as_str().to_owned())
    }

    #[track_caller]
    fn check(&mut self, command: &str, expected: &str) {
        assert_eq!(self.ask(command).as_deref(), Ok(expected), "{command}");
    }
}

fn read(port: &mut impl Read) -> std::io::Result<Packet> {
    let mut report = [0; 64];
    port.read_exact(&mut report).map(|()| Packet(report))
}

fn open(endpoint: &str) -> Handle<TcpStream> {
    Handle::open(connect(endpoint.strip_prefix("hid-").unwrap()))
}

fn open_unix(path: &Path) -> Handle<UnixStream> {
    let port = UnixStream::connect(path).unwrap();
    port.set_read_timeout(Some(PATIENCE)).unwrap();
    Handle::open(port)
}

fn refused(devices: Vec<sim::DeviceConfig>) -> String {
    Server::start(crate::common::settings(devices)).err().expect("refused").to_string()
}

/// What is the same on both kinds of endpoint.
fn speaks<S: Read + Write>(mut host: Handle<S>) {
    assert_eq!(host.name, "2ED00");
    host.check("ID", "PERFORMAX-2ED-SA");
    host.check("V1=5", "OK");
    host.check("V1", "5");
    host.check("mm", "?mm");
    // A reply that is too long loses its end.
    let long = "v".repeat(63);
    host.check(&long, &format!("?{}", &long[..62]));

    // Only the text before the first NUL counts.
    let report = |text: &[u8]| {
        let mut report = [0; 64];
        report[..text.len()].copy_from_slice(text);
        report
    };
    check(&mut host.port, &report(b"V1\0V1=6\0"), &report(b"5"));
    // Without a NUL in it, or with strange bytes, a report is refused and nothing of it is done.
    check(&mut host.port, &[b'V'; 64], &report(b"?"));
    check(&mut host.port, &report(b"V1=6\r"), &report(b"?"));
    // An empty one is no command.
    check(&mut host.port, &[report(b""), report(b"V1")].concat(), &report(b"5"));
    // Several at once, and one in pieces.
    let three = [report(b"V1"), report(b"MM"), report(b"V2")].concat();
    check(&mut host.port, &three, &[report(b"5"), report(b"0"), report(b"0")].concat());
    let (beginning, end) = three[..64].split_at(2);
    host.port.write_all(beginning).unwrap();
    std::thread::sleep(std::time::Duration::from_millis(20));
    check(&mut host.port, end, &report(b"5"));
}

#[test]
fn reports_carry_commands_and_replies() {
    let socket = directory().join("hid");
    let path = format!("hid-unix:{}", socket.display());
    let server = serve(vec![performax("a", &["hid-tcp:127.0.0.1:0"]), performax("b", &[&path])]);
    let endpoint = &server.ready()[0].1;
    assert!(endpoint.starts_with("hid-tcp:127.0.0.1:") && !endpoint.ends_with(":0"), "{endpoint}");
    assert_eq!(server.ready()[1].1, path);
    speaks(open(endpoint));
    speaks(open_unix(&socket));
    server.stop().unwrap();
}

/// As the manual of the CMD-4CR has it (3.1.2).
#[test]
fn a_commander() {
    let endpoint = "hid-tcp:127.0.0.1:0";
    let (server, address) = serve_http(vec![commander("a", &[endpoint]), commander("b", &[endpoint])]);
    let [a, b] = [0, 1].map(|index: usize| server.ready()[index].1.clone());
    let mut host = open(&a);
    assert_eq!(host.name, "CMD-4CR-01");
    host.check("ID", "01");
    host.check("PX", "0");
    host.check("HSPDX=5000", "OK");
    // The reply repeats the command, as far as there is room.
    let long = "v".repeat(63);
    host.check(&long, &format!("?Unknown Command: {}", &long[..45]));
    let mut other = open(&b);
    other.check("ID=02", "OK");
    other.check("STORE", "OK");
    assert_eq!(call(address, "POST", "/api/devices/b/power-cycle", "").0, 204);
    assert_eq!(open(&b).name, "CMD-4CR-02");
    host.check("ID", "01");
    server.stop().unwrap();
}

#[test]
fn clients_have_reports_of_their_own() {
    let server = serve(vec![performax("a", &["hid-tcp:127.0.0.1:0", "tcp:127.0.0.1:0"])]);
    let endpoint = &server.ready()[0].1;
    let (mut first, mut second) = (open(endpoint), open(endpoint));
    let report = Packet::encode("V1=7").unwrap();
    first.port.write_all(&report.0[..10]).unwrap();
    second.check("V1", "0");
    first.port.write_all(&report.0[10..]).unwrap();
    assert_eq!(read(&mut first.port).unwrap().decode(), Ok("OK"));
    second.check("V1", "7");
    check(connect(&server.ready()[1].1), b"V1\r", b"7\r");
    server.stop().unwrap();
}

#[test]
fn a_client_that_leaves_leaves_no_half_report() {
    let server = serve(vec![performax("a", &["hid-tcp:127.0.0.1:0"])]);
    let endpoint = &server.ready()[0].1;
    for length in [1, 7, 63] {
        let mut host = open(endpoint);
        host.port.write_all(&Packet::encode("V1=5").unwrap().0[..length]).unwrap();
        host.port.shutdown(Shutdown::Write).unwrap();
        assert_eq!(host.port.read(&mut [0; 10]).unwrap(), 0);
        open(endpoint).check("V1", "0");
    }
    server.stop().unwrap();
}

#[test]
fn the_name_has_the_number_since_power_up() {
    let (server, address) = serve_http(vec![performax("a", &["hid-tcp:127.0.0.1:0"])]);
    let endpoint = &server.ready()[0].1;
    let mut host = open(endpoint);
    host.check("DN=2ED42", "OK");
    host.check("STORE", "OK");
    assert_eq!(open(endpoint).name, "2ED00");
    assert_eq!(call(address, "POST", "/api/devices/a/power-cycle", "").0, 204);
    assert_eq!(host.ask("DN"), Err(ApiError::Communication), "it was unplugged, as it were");
    let mut host = open(endpoint);
    assert_eq!(host.name, "2ED42");
    host.check("DN", "2ED42");
    server.stop().unwrap();
}

#[test]
fn what_a_device_says_by_itself_comes_in_reports_too() {
    let server = serve(vec![device("a", &["hid-tcp:127.0.0.1:0"])]);
    let mut host = open(&server.ready()[0].1);
    assert_eq!(host.name, "PARROT-00");
    host.check("!x", "x");
    // It says back the NUL as well.
    assert_eq!(read(&mut host.port).unwrap().decode(), Ok(""));
    assert_eq!(read(&mut host.port).unwrap().decode(), Ok("?"));
    server.stop().unwrap();
}

#[test]
fn who_cannot_be_there_is_refused() {
    let address = free_address();
    let endpoint = format!("hid-tcp:{address}");
    assert_eq!(
        refused(vec![trinamic("c", &[&endpoint])]),
        format!("{endpoint}: a pd42-1140 is no HID device")
    );
    let two = vec![performax("a", &[&endpoint]), performax("b", &[&endpoint])];
    let taken = format!("{endpoint}: `a` is there already, and a HID endpoint has one device");
    assert_eq!(refused(two), taken);
}

#[test]
fn a_socket_goes_with_its_server_and_only_dead_ones_are_replaced() {
    let directory = directory();
    let path = |name: &str| directory.join(name);
    let start = |name: &str| vec![performax("a", &[&format!("hid-unix:{}", path(name).display())])];

    let server = serve(start("one"));
    let said = refused(start("one"));
    assert!(said.ends_with("one: somebody listens there already"), "{said}");
    let mut host = open_unix(&path("one"));
    host.check("MM", "0");
    server.stop().unwrap();
    assert!(host.ask("MM").is_err(), "the connection ends");
    assert!(!path("one").exists());

    // Nobody removes the file of a socket that is only closed.
    drop(UnixListener::bind(path("stale")).unwrap());
    assert!(path("stale").exists());
    let server = serve(start("stale"));
    open_unix(&path("stale")).check("MM", "0");
    // What somebody else put there meanwhile is left alone.
    fs::remove_file(path("stale")).unwrap();
    fs::write(path("stale"), "precious").unwrap();
    server.stop().unwrap();
    assert_eq!(fs::read_to_string(path("stale")).unwrap(), "precious");

    let said = refused(start("stale"));
    assert!(said.ends_with("stale: exists and is not a socket left over from an earlier run"), "{said}");
    assert_eq!(fs::read_to_string(path("stale")).unwrap(), "precious");
    assert!(refused(start("missing/one")).contains("missing/one: "));
    assert!(refused(start(&"n".repeat(200))).contains(": "), "a path of a socket is short");
    assert_eq!(UnixStream::connect(path("one")).unwrap_err().kind(), ErrorKind::NotFound);
}
