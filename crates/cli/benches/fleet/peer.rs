//! The servers, each a process of its own, and what the system knows of them.

use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
use std::{
    env, fs,
    io::{BufRead, BufReader, Write},
    net::SocketAddr,
    process::{Child, Command, Stdio},
};
use tokio::{
    io::{AsyncReadExt, AsyncWriteExt},
    net::TcpListener,
    runtime::Builder,
};

/// The argument with which this program is an echo server.
pub const ECHO: &str = "echo";

/// Clock ticks a second in `/proc/PID/stat`: so many on all systems that Rust knows.
const TICKS_A_SECOND: f64 = 100.0;

/// A server that is ready.
pub struct Peer {
    process: Child,
    /// Where clients connect to.
    pub addresses: Vec<SocketAddr>,
}

impl Peer {
    /// `pulsetrain serve` with so many controllers.
    pub fn serve(model: &str, count: usize) -> Self {
        let bench = format!(
            "[[device]]\nmodel = \"{model}\"\ncount = {count}\nname = \"{model}-{{n}}\"\n\
             listen = [\"tcp:127.0.0.1:0\"]\n"
        );
        let file = env::temp_dir().join(format!("fleet-{}.toml", std::process::id()));
        fs::write(&file, bench).expect("a directory for temporary files");
        let mut command = Command::new(env!("CARGO_BIN_EXE_pulsetrain"));
        command.args(["serve", "--no-http", "--workers", "1", "--bench"]).arg(&file);
        let peer = Self::start(command, count);
        fs::remove_file(file).expect("it was written");
        peer
    }

    /// This program as an echo server.
    pub fn echo(count: usize) -> Self {
        let mut command = Command::new(env::current_exe().expect("a file"));
        command.arg(ECHO);
        let mut peer = Self::start(command, 1);
        peer.addresses = vec![peer.addresses[0]; count];
        peer
    }

    fn start(mut command: Command, ready: usize) -> Self {
        let mut process = command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn().expect("it starts");
        let output = BufReader::new(process.stdout.take().expect("it is piped"));
        let address = |line: std::io::Result<String>| {
            let line = line.expect("text");
            line.rsplit_once("tcp:")
                .and_then(|(_, address)| address.parse().ok())
                .expect("ready NAME tcp:ADDRESS")
        };
        let addresses: Vec<_> = output.lines().take(ready).map(address).collect();
        assert_eq!(addresses.len(), ready, "all are ready");
        Self { process, addresses }
    }

    /// Resident memory.
    pub fn resident_kib(&self) -> f64 {
        let status = fs::read_to_string(format!("/proc/{}/status", self.process.id())).expect("a Linux");
        let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).expect("its memory");
        line.split_whitespace().next().and_then(|number| number.parse().ok()).expect("a number of kB")
    }

    /// Processor time, that of the system for it included.
    pub fn processor_seconds(&self) -> f64 {
        let stat = fs::read_to_string(format!("/proc/{}/stat", self.process.id())).expect("a Linux");
        // Behind the name, which ends with a parenthesis, user time is the 12th field and system time the 13th.
        let fields = stat.rsplit_once(") ").expect("a name").1.split(' ').skip(11).take(2);
        fields.map(|ticks| ticks.parse::<f64>().expect("a number")).sum::<f64>() / TICKS_A_SECOND
    }
}

impl Drop for Peer {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// Every connection is an open file.
pub fn raise_file_limit() {
    let limit = getrlimit(Resource::Nofile);
    setrlimit(Resource::Nofile, Rlimit { current: limit.maximum, ..limit }).expect("up to the maximum");
}

/// The simplest server with an event loop: what comes goes back.
pub fn echo() {
    raise_file_limit();
    let runtime = Builder::new_current_thread().enable_all().build().expect("an event loop");
    runtime.block_on(async {
        let listener = TcpListener::bind("127.0.0.1:0").await.expect("a free port");
        println!("ready echo tcp:{}", listener.local_addr().expect("it is bound"));
        std::io::stdout().flush().expect("somebody reads");
        loop {
            let (mut stream, _) = listener.accept().await.expect("a client");
            stream.set_nodelay(true).expect("TCP");
            tokio::spawn(async move {
                let mut bytes = [0; 64];
                while let Ok(length @ 1..) = stream.read(&mut bytes).await {
                    if stream.write_all(&bytes[..length]).await.is_err() {
                        break;
                    }
                }
            });
        }
    });
}
