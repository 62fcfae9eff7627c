//! Commands over TCP against bare echoes with as many bytes each way, one after the other in the same loop.

use server::{Server, Settings};
use sim::{DeviceConfig, Scenario};
use std::{
    io::{Read, Write},
    net::{SocketAddr, TcpListener, TcpStream},
    num::NonZero,
    thread,
    time::{Duration, Instant},
};

const ROUNDS: usize = 20_000;

/// Rounds that are not counted: caches, branch predictors and clocks get warm.
const WARM_UP: usize = 1_000;

/// A command and its answer.
struct Question {
    model: &'static str,
    command: &'static [u8],
    reply: &'static [u8],
    /// Most that the median round trip may be above the echo's.
    goal: f64,
}

const QUESTIONS: [Question; 2] = [
    // GAP 1, 0: the position of motor 0.
    Question {
        model: "pd42-1140",
        command: &[1, 6, 1, 0, 0, 0, 0, 0, 8],
        reply: &[2, 1, 100, 6, 0, 0, 0, 0, 109],
        goal: 1.2,
    },
    // The position of X, with the address of a serial line.
    Question { model: "pmx-2ed", command: b"@00PX\r", reply: b"0\r", goal: 1.25 },
];

fn main() {
    let device = |question: &Question| {
        let model = devices::model(question.model).expect("the model exists");
        let listen = vec!["tcp:127.0.0.1:0".parse().expect("an endpoint")];
        DeviceConfig { listen, ..DeviceConfig::new(model) }
    };
    let devices = QUESTIONS.iter().map(device).collect();
    let server = Server::start(Settings {
        devices,
        http: None,
        speed: 1.0,
        state: None,
        record: Vec::new(),
        scenario: Scenario::default(),
        workers: NonZero::new(1),
    })
    .expect("it starts");
    println!("median of {ROUNDS} round trips over TCP");
    let mut slow = Vec::new();
    for (question, (name, endpoint)) in QUESTIONS.iter().zip(server.ready()) {
        let address = endpoint.strip_prefix("tcp:").and_then(|address| address.parse().ok());
        let (echo, command) = compare(question, address.expect("a real address"));
        let (ratio, goal) = (command.as_secs_f64() / echo.as_secs_f64(), question.goal);
        println!(
            "{name:<10} echo {echo:>9.2?}  command {command:>9.2?}  ratio {ratio:.3}  (goal: at most {goal})"
        );
        if ratio > goal {
            slow.push(format!("a command of the {name} takes {ratio:.3} times as long as an echo"));
        }
    }
    server.stop().expect("nothing to save");
    assert!(slow.is_empty(), "{}", slow.join("; "));
}

/// Medians of the echo and of the command, which take turns.
fn compare(question: &Question, address: SocketAddr) -> (Duration, Duration) {
    let mut echo = connect(echo_server(question.command.len(), question.reply));
    let mut device = connect(address);
    let (mut echoes, mut commands) = (Vec::new(), Vec::new());
    for round in 0..ROUNDS + WARM_UP {
        let (echo, command) = (round_trip(&mut echo, question), round_trip(&mut device, question));
        if round >= WARM_UP {
            echoes.push(echo);
            commands.push(command);
        }
    }
    (median(echoes), median(commands))
}

/// The simplest server there is: a thread that answers every so many bytes with the same ones.
fn echo_server(length: usize, reply: &'static [u8]) -> SocketAddr {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
    let address = listener.local_addr().expect("it is bound");
    thread::spawn(move || {
        let (mut stream, _) = listener.accept().expect("a client");
        stream.set_nodelay(true).expect("TCP");
        let mut bytes = [0; 4096];
        while let Ok(read @ 1..) = stream.read(&mut bytes) {
            assert_eq!(read, length, "a command comes in one piece");
            if stream.write_all(reply).is_err() {
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

fn round_trip(stream: &mut TcpStream, question: &Question) -> Duration {
    let mut reply = [0; 16];
    let reply = &mut reply[..question.reply.len()];
    let start = Instant::now();
    stream.write_all(question.command).expect("it takes bytes");
    stream.read_exact(reply).expect("it replies");
    let time = start.elapsed();
    assert_eq!(reply, question.reply);
    time
}

fn median(mut times: Vec<Duration>) -> Duration {
    times.sort_unstable();
    times[times.len() / 2]
}
