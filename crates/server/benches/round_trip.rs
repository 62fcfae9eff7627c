//! A command over TCP against a bare echo of as many bytes, one after the other in the same loop.

use server::{Server, Settings};
use sim::DeviceConfig;
use std::{
    io::{Read, Write},
    net::{SocketAddr, TcpListener, TcpStream},
    thread,
    time::{Duration, Instant},
};

const ROUNDS: usize = 20_000;

/// Rounds that are not counted: caches, branch predictors and clocks get warm.
const WARM_UP: usize = 1_000;

/// Most that the median round trip may be above the echo's.
const GOAL: f64 = 1.2;

/// GAP 1, 0: the position of motor 0.
const COMMAND: [u8; 9] = [1, 6, 1, 0, 0, 0, 0, 0, 8];

fn main() {
    let mut echo = connect(echo_server());
    let model = devices::model("pd42-1140").expect("the model exists");
    let listen = vec!["tcp:127.0.0.1:0".parse().expect("an endpoint")];
    let devices = vec![DeviceConfig { listen, ..DeviceConfig::new(model) }];
    let server = Server::start(Settings { devices, http: None, speed: 1.0, state: None }).expect("it starts");
    let (_, endpoint) = &server.ready()[0];
    let address = endpoint.strip_prefix("tcp:").and_then(|address| address.parse().ok());
    let mut device = connect(address.expect("a real address"));

    let (mut echoes, mut commands) = (Vec::new(), Vec::new());
    for round in 0..ROUNDS + WARM_UP {
        let (echo, reply) = (round_trip(&mut echo), round_trip(&mut device));
        assert_eq!(reply.0[2], 100, "the command succeeds");
        if round >= WARM_UP {
            echoes.push(echo.1);
            commands.push(reply.1);
        }
    }
    let (echo, command) = (median(echoes), median(commands));
    let ratio = command.as_secs_f64() / echo.as_secs_f64();
    println!("median of {ROUNDS} round trips over TCP, 9 bytes each way");
    println!("echo     {echo:>10.2?}");
    println!("command  {command:>10.2?}");
    println!("ratio    {ratio:>10.3}   (goal: at most {GOAL})");
    server.stop().expect("nothing to save");
    assert!(ratio <= GOAL, "a command takes {ratio:.3} times as long as an echo");
}

/// The simplest server there is: a thread that writes what it reads.
fn echo_server() -> SocketAddr {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
    let address = listener.local_addr().expect("it is bound");
    thread::spawn(move || {
        let (mut stream, _) = listener.accept().expect("a client");
        stream.set_nodelay(true).expect("TCP");
        let mut bytes = [0; 4096];
        while let Ok(length @ 1..) = stream.read(&mut bytes) {
            if stream.write_all(&bytes[..length]).is_err() {
                break;
            }
        }
    });
    address
}

fn connect(address: SocketAddr) -> TcpStream {
    let stream = TcpStream::connect(address).expect("somebody listens");
    stream.set_nodelay(true).expect("TCP");
    stream.set_read_timeout(Some(Duration::from_secs(10))).expect("a timeout");
    stream
}

fn round_trip(stream: &mut TcpStream) -> ([u8; 9], Duration) {
    let mut reply = [0; 9];
    let start = Instant::now();
    stream.write_all(&COMMAND).expect("it takes bytes");
    stream.read_exact(&mut reply).expect("it replies");
    (reply, start.elapsed())
}

fn median(mut times: Vec<Duration>) -> Duration {
    times.sort_unstable();
    times[times.len() / 2]
}
