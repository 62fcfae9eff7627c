//! The clients: a connection to each controller, and what is said over it.

use std::{
    net::SocketAddr,
    time::{Duration, Instant},
};
use tokio::{
    io::{AsyncReadExt, AsyncWriteExt},
    net::TcpStream,
    runtime::Builder,
    time::{MissedTickBehavior, interval_at, timeout},
};

/// Between two polls of a controller.
const PERIOD: Duration = Duration::from_millis(200);

/// One controller of so many moves.
const MOVING: usize = 10;

/// A moving controller is sent the other way after so many polls.
const POLLS_A_MOVE: u32 = 10;

/// Polls of a controller that are not counted: its connection is still to be accepted.
const WARM_UP: u32 = 5;

/// Longest wait for a reply; then the connection is given up.
const PATIENCE: Duration = Duration::from_secs(5);

/// What is said to a model. Each command has one reply.
pub struct Talk {
    model: &'static str,
    /// Asks for a position.
    poll: &'static [u8],
    /// Said once to a controller that is going to move.
    prepare: &'static [&'static [u8]],
    /// There and back again.
    moves: [&'static [u8]; 2],
    /// Where the reply at the beginning of some bytes ends.
    reply: fn(&[u8]) -> Option<usize>,
}

static TALKS: [Talk; 3] = [
    Talk {
        model: "pd42-1140",
        // GAP 1, 0.
        poll: &[1, 6, 1, 0, 0, 0, 0, 0, 8],
        prepare: &[],
        // MVP ABS, 0, 100000 and -100000.
        moves: [&[1, 4, 0, 0, 0, 1, 0x86, 0xA0, 0x2C], &[1, 4, 0, 0, 0xFF, 0xFE, 0x79, 0x60, 0xDB]],
        reply: frame,
    },
    Talk {
        model: "pmx-2ed",
        poll: b"PX\r",
        prepare: &[b"EO=3\r", b"HSPD=20000\r"],
        moves: [b"X100000\r", b"X-100000\r"],
        reply: line,
    },
    Talk {
        model: "cmd-4cr",
        poll: b"PX\r",
        prepare: &[b"EO=15\r", b"HSPD=20000\r"],
        moves: [b"X100000\r", b"X-100000\r"],
        reply: line,
    },
];

fn frame(bytes: &[u8]) -> Option<usize> {
    (bytes.len() >= 9).then_some(9)
}

fn line(bytes: &[u8]) -> Option<usize> {
    bytes.iter().position(|byte| *byte == b'\r').map(|end| end + 1)
}

/// What is said to a model.
pub fn talk(model: &str) -> &'static Talk {
    TALKS.iter().find(|talk| talk.model == model).expect("a model that can be talked to")
}

/// How late replies were.
#[derive(Default)]
pub struct Late {
    /// Ascending.
    times: Vec<Duration>,
    /// Polls whose reply had not come when the next one was due.
    pub missed: usize,
}

impl Late {
    /// The time within which this part of the replies came.
    pub fn at(&self, part: f64) -> Duration {
        let last = self.times.len() - 1;
        self.times[(part * last as f64).round() as usize]
    }

    /// How many there were.
    pub fn replies(&self) -> usize {
        self.times.len()
    }
}

/// Connects to all of them, polls each for a while, and tells how late replies were and how long it took.
pub fn poll(addresses: &[SocketAddr], talk: &'static Talk, span: Duration) -> (Late, Duration) {
    let runtime = Builder::new_current_thread().enable_all().build().expect("an event loop");
    runtime.block_on(async {
        let mut clients = Vec::new();
        for address in addresses {
            let stream = TcpStream::connect(address).await.expect("somebody listens");
            stream.set_nodelay(true).expect("TCP");
            clients.push(Client { stream, talk });
        }
        let start = Instant::now();
        let count = clients.len();
        // Evenly over the period, as if nobody knew of the others.
        let offset = |number: usize| PERIOD.mul_f64(number as f64 / count as f64);
        let tasks: Vec<_> = (0..)
            .zip(clients)
            .map(|(number, client)| {
                let moves = number % MOVING == 0;
                tokio::spawn(client.session(start + offset(number), start + span, moves))
            })
            .collect();
        let mut late = Late::default();
        for task in tasks {
            let own = task.await.expect("a client does not fail");
            late.times.extend(own.times);
            late.missed += own.missed;
        }
        late.times.sort_unstable();
        (late, start.elapsed())
    })
}

struct Client {
    stream: TcpStream,
    talk: &'static Talk,
}

impl Client {
    async fn session(mut self, first: Instant, end: Instant, moves: bool) -> Late {
        let mut late = Late::default();
        let mut ticks = interval_at(first.into(), PERIOD);
        ticks.set_missed_tick_behavior(MissedTickBehavior::Skip);
        if moves {
            for command in self.talk.prepare {
                self.ask(command).await;
            }
        }
        for round in 0_u32.. {
            ticks.tick().await;
            if Instant::now() >= end {
                break;
            }
            if moves && round.is_multiple_of(POLLS_A_MOVE) {
                self.ask(self.talk.moves[(round / POLLS_A_MOVE % 2) as usize]).await;
            }
            let time = self.ask(self.talk.poll).await;
            if round >= WARM_UP {
                late.missed += usize::from(time > PERIOD);
                late.times.push(time);
            }
        }
        late
    }

    /// How long a command waits for its reply.
    async fn ask(&mut self, command: &[u8]) -> Duration {
        let start = Instant::now();
        self.stream.write_all(command).await.expect("it takes bytes");
        let (mut bytes, mut length) = ([0; 64], 0);
        loop {
            let read = timeout(PATIENCE, self.stream.read(&mut bytes[length..])).await;
            let read = read.expect("it replies in time").expect("it is connected");
            assert!(read > 0, "the connection stays");
            length += read;
            if let Some(end) = (self.talk.reply)(&bytes[..length]) {
                assert_eq!(end, length, "one reply a command");
                return start.elapsed();
            }
        }
    }
}
