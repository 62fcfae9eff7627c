//! A device that says back what it hears, so that the server is tested without a real controller's rules.

use devices::{
    AxisState, Board, Controller, Model, Pin, PinKind, Port, ProgramRun, ProgramState, Wiring,
    flash::{Flash, WORD_BYTES},
};
use rustix::fs::{Mode, OFlags};
use serde_json::Value;
use server::{HttpSettings, Server, Settings, Token};
use sim::{DeviceConfig, Scenario};
use std::{
    fs::File,
    io::{ErrorKind, Read, Write},
    net::{SocketAddr, TcpStream},
    path::{Path, PathBuf},
    sync::atomic::{AtomicU32, Ordering},
    time::{Duration, Instant},
};

/// Longest wait for anything.
pub const PATIENCE: Duration = Duration::from_secs(20);

pub const TOKEN: &str = "test-token";

/// Its only model.
pub static PARROT: Model = Model {
    name: "parrot",
    title: "says back what it hears",
    language: devices::Language::Tmcl,
    hid_product: Some("PARROT-"),
    flash_bytes: 8192,
    guide: &devices::guide::Guide::NONE,
    build: parrot,
};

const CLOCK_HZ: u32 = 1_000_000;

static PINS: &[Pin] = &[
    Pin { name: "IN", kind: PinKind::Input, wiring: Wiring::Free, unit: "", scale: 1, rest: 0 },
    Pin { name: "OUT", kind: PinKind::Output, wiring: Wiring::Free, unit: "", scale: 1, rest: 0 },
    Pin { name: "MV", kind: PinKind::Analog, wiring: Wiring::Free, unit: "mV", scale: 1, rest: 7 },
    Pin { name: "IO", kind: PinKind::Port, wiring: Wiring::Free, unit: "", scale: 1, rest: 0 },
    Pin { name: "PWM", kind: PinKind::AnalogOutput, wiring: Wiring::Free, unit: "%", scale: 1, rest: 1 },
];

/// Says back every byte through the port it came by, except for these:
/// `!` makes it send `?` by itself 20 ms later; `.` it keeps to itself; `p` it answers after a pause of
/// 200 ms; `w` and the next byte it writes to flash; `r` it answers with the byte in flash. With `IN` on it
/// drives all its outputs, `IO` too. The encoder of its axis counts what comes in at the pulser input.
struct Parrot {
    flash: Box<dyn Flash + Send>,
    now: u64,
    due: Option<(u64, Port)>,
    write: bool,
    turned: i32,
}

fn parrot(flash: Box<dyn Flash + Send>, _seed: u64) -> Box<dyn Controller + Send> {
    Box::new(Parrot { flash, now: 0, due: None, write: false, turned: -4 })
}

impl Controller for Parrot {
    fn clock_hz(&self) -> u32 {
        CLOCK_HZ
    }

    fn axes(&self) -> &'static [&'static str] {
        &["A"]
    }

    fn pins(&self) -> &'static [Pin] {
        PINS
    }

    fn watches(&self, _pin: usize) -> bool {
        true
    }

    fn advance(&mut self, now: u64, board: &mut dyn Board) -> u64 {
        self.now = now;
        if let Some((_, port)) = self.due.take_if(|(at, _)| *at <= now) {
            board.send(port, b"?", 0);
        }
        now
    }

    fn wake(&self) -> u64 {
        self.due.map_or(u64::MAX, |(at, _)| at)
    }

    fn is_moving(&self) -> bool {
        false
    }

    fn receive(&mut self, port: Port, bytes: &[u8], board: &mut dyn Board) {
        if port == Port::Can {
            return board.send(port, bytes, 0);
        }
        for byte in bytes {
            match *byte {
                byte if std::mem::take(&mut self.write) => {
                    self.flash.erase(0, 4096).unwrap();
                    self.flash.write(0, &[byte; WORD_BYTES as usize]).unwrap();
                }
                b'!' => self.due = Some((self.now + u64::from(CLOCK_HZ) / 50, port)),
                b'.' => {}
                b'p' => board.send(port, b"p", 200),
                b'w' => self.write = true,
                b'r' => {
                    let mut word = [0; WORD_BYTES as usize];
                    self.flash.read(0, &mut word).unwrap();
                    board.send(port, &word[..1], 0);
                }
                byte => board.send(port, &[byte], 0),
            }
        }
    }

    fn input(&mut self, pin: usize, on: bool, board: &mut dyn Board) {
        match (pin, on) {
            (0, true) => board.output(3, true),
            (0, false) => board.release(3),
            (pin, _) => return assert_eq!(pin, 3),
        }
        board.output(1, on);
        board.output_analog(4, if on { 75 } else { 1 });
    }

    fn has_pulser(&self, _axis: usize) -> bool {
        true
    }

    fn pulser(&mut self, _axis: usize, counts: i32, _board: &mut dyn Board) {
        self.turned += counts;
    }

    fn analog_changed(&mut self, _pin: usize, _board: &mut dyn Board) {}

    fn set_window(&mut self, _axis: usize, _low: i64, _high: i64) {}

    fn odometer(&self, _axis: usize) -> i64 {
        0
    }

    fn axis(&self, _axis: usize, board: &mut dyn Board) -> AxisState {
        let load = i32::from(board.load(0));
        AxisState { position: load, encoder: self.turned, speed_mpps: 1500, target: 12, status: 5, steps: 9 }
    }

    fn program(&self, index: usize) -> Option<ProgramState> {
        (index == 0).then_some(ProgramState { run: ProgramRun::Running, counter: 3, instructions: 44 })
    }
}

/// A parrot with these endpoints.
pub fn device(name: &str, endpoints: &[&str]) -> DeviceConfig {
    let listen = endpoints.iter().map(|endpoint| endpoint.parse().unwrap()).collect();
    DeviceConfig { name: name.into(), listen, ..DeviceConfig::new(&PARROT) }
}

/// A PD42-1140 with these endpoints.
pub fn trinamic(name: &str, endpoints: &[&str]) -> DeviceConfig {
    of_model("pd42-1140", name, endpoints)
}

/// A PMX-2ED-SA with these endpoints.
pub fn performax(name: &str, endpoints: &[&str]) -> DeviceConfig {
    of_model("pmx-2ed", name, endpoints)
}

/// A CMD-4CR with these endpoints.
pub fn commander(name: &str, endpoints: &[&str]) -> DeviceConfig {
    of_model("cmd-4cr", name, endpoints)
}

fn of_model(model: &str, name: &str, endpoints: &[&str]) -> DeviceConfig {
    DeviceConfig { model: devices::model(model).unwrap(), ..device(name, endpoints) }
}

/// An address that nobody listens at: port 0 would be an endpoint of its own for each device.
pub fn free_address() -> String {
    std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().to_string()
}

/// Settings for these devices, without HTTP and state.
pub fn settings(devices: Vec<DeviceConfig>) -> Settings {
    Settings {
        devices,
        http: None,
        speed: 1.0,
        state: None,
        record: Vec::new(),
        scenario: Scenario::default(),
        workers: None,
    }
}

/// A server for these devices.
pub fn serve(devices: Vec<DeviceConfig>) -> Server {
    Server::start(settings(devices)).unwrap()
}

/// A server with HTTP, and where that is.
pub fn serve_http(devices: Vec<DeviceConfig>) -> (Server, SocketAddr) {
    let http = Some(HttpSettings::new("127.0.0.1:0", Token::chosen(TOKEN).unwrap()));
    let server = Server::start(Settings { http, ..settings(devices) }).unwrap();
    let address = http_address(&server);
    (server, address)
}

/// Where a server's HTTP is.
pub fn http_address(server: &Server) -> SocketAddr {
    server.url().unwrap().split('/').nth(2).unwrap().parse().unwrap()
}

/// A connection to a TCP endpoint as [`Server::ready`] names it.
pub fn connect(endpoint: &str) -> TcpStream {
    let address = endpoint.split_once(':').unwrap().1;
    let stream = TcpStream::connect(address).unwrap();
    stream.set_read_timeout(Some(PATIENCE)).unwrap();
    stream
}

/// Sends bytes and expects others back.
#[track_caller]
pub fn check(mut port: impl Read + Write, sent: &[u8], expected: &[u8]) {
    port.write_all(sent).unwrap();
    let mut reply = vec![0; expected.len()];
    port.read_exact(&mut reply).unwrap();
    assert_eq!(reply.escape_ascii().to_string(), expected.escape_ascii().to_string());
}

/// Waits until something is so.
#[track_caller]
pub fn eventually(what: &str, mut is_so: impl FnMut() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < PATIENCE, "never: {what}");
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// A new directory for one test.
pub fn directory() -> PathBuf {
    static NUMBER: AtomicU32 = AtomicU32::new(0);
    let name = format!("server-{}-{}", std::process::id(), NUMBER.fetch_add(1, Ordering::Relaxed));
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&path).unwrap();
    path
}

/// A terminal as a serial library opens it; reads give up after a while.
pub struct Serial(pub File);

impl Serial {
    /// Opens it.
    pub fn open(path: &Path) -> std::io::Result<Self> {
        let flags = OFlags::RDWR | OFlags::NOCTTY | OFlags::NONBLOCK;
        Ok(Self(rustix::fs::open(path, flags, Mode::empty())?.into()))
    }
}

impl Read for &Serial {
    fn read(&mut self, bytes: &mut [u8]) -> std::io::Result<usize> {
        let start = Instant::now();
        loop {
            match (&self.0).read(bytes) {
                Err(error) if error.kind() == ErrorKind::WouldBlock && start.elapsed() < PATIENCE => {
                    std::thread::sleep(Duration::from_millis(1));
                }
                result => return result,
            }
        }
    }
}

impl Write for &Serial {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        (&self.0).write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// Sends a request as it stands, and gives head and body of the answer.
pub fn exchange(address: SocketAddr, request: &str) -> (String, Vec<u8>) {
    let mut stream = TcpStream::connect(address).unwrap();
    stream.set_read_timeout(Some(PATIENCE)).unwrap();
    stream.write_all(request.as_bytes()).unwrap();
    let mut answer = Vec::new();
    stream.read_to_end(&mut answer).unwrap();
    let end = answer.windows(4).position(|four| four == b"\r\n\r\n").unwrap();
    let body = answer.split_off(end + 4);
    (String::from_utf8(answer).unwrap(), body)
}

/// The same, and gives status and body.
pub fn raw(address: SocketAddr, request: &str) -> (u16, String) {
    let (head, body) = exchange(address, request);
    (head.split(' ').nth(1).unwrap().parse().unwrap(), String::from_utf8(body).unwrap())
}

/// A request with the token.
pub fn call(address: SocketAddr, method: &str, path: &str, body: &str) -> (u16, Value) {
    let request = format!(
        "{method} {path} HTTP/1.1\r\nHost: {address}\r\nAuthorization: Bearer {TOKEN}\r\nConnection: close\r\n\
         Content-Length: {}\r\n\r\n{body}",
        body.len()
    );
    let (status, body) = raw(address, &request);
    (status, if body.is_empty() { Value::Null } else { serde_json::from_str(&body).unwrap() })
}

/// A WebSocket of the HTTP interface.
pub fn connect_ws(address: SocketAddr, path: &str) -> tungstenite::WebSocket<TcpStream> {
    let stream = TcpStream::connect(address).unwrap();
    stream.set_read_timeout(Some(PATIENCE)).unwrap();
    tungstenite::client(format!("ws://{address}{path}"), stream).unwrap().0
}
