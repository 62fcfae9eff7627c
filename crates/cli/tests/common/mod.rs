//! The program as a process of its own, and a client that speaks TMCL frames.
#![allow(dead_code, reason = "every test binary uses its own part")]

use std::{
    fs,
    io::{BufRead, BufReader, Read, Write},
    net::TcpStream,
    path::{Path, PathBuf},
    process::{Child, Command, Output, Stdio},
    sync::{
        atomic::{AtomicU32, Ordering},
        mpsc,
    },
    thread,
    time::{Duration, Instant},
};

/// Longest wait for anything.
pub const PATIENCE: Duration = Duration::from_secs(30);

/// The program with these arguments, in a directory.
pub fn command(directory: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pulsetrain"));
    command.args(arguments).current_dir(directory).env_remove("PULSETRAIN_TOKEN");
    command
}

/// Runs the program to its end.
pub fn output(directory: &Path, arguments: &[&str]) -> Output {
    command(directory, arguments).output().unwrap()
}

/// Exit status, standard output and standard error.
pub fn outcome(directory: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output = output(directory, arguments);
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().expect("it exits"), text(output.stdout), text(output.stderr))
}

/// Expects status 1, nothing on standard output, and one line on standard error that starts with
/// `error: ` and contains `expected`.
#[track_caller]
pub fn refused(directory: &Path, arguments: &[&str], expected: &str) {
    let (status, stdout, stderr) = outcome(directory, arguments);
    assert_eq!((status, stdout.as_str()), (1, ""), "{arguments:?}: {stderr}");
    assert!(stderr.starts_with("error: ") && stderr.lines().count() == 1, "{arguments:?}: {stderr}");
    assert!(stderr.contains(expected), "{arguments:?}: {stderr}");
}

/// A new directory with these files.
pub fn directory(files: &[(&str, &str)]) -> PathBuf {
    static NUMBER: AtomicU32 = AtomicU32::new(0);
    let name = format!("cli-{}-{}", std::process::id(), NUMBER.fetch_add(1, Ordering::Relaxed));
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&path).unwrap();
    for (name, text) in files {
        fs::write(path.join(name), text).unwrap();
    }
    path
}

/// `pulsetrain serve`, ended with the test whatever happens.
pub struct Serve {
    child: Child,
    /// The `ready` lines without that word: name and endpoint.
    pub ready: Vec<(String, String)>,
}

impl Serve {
    /// Starts it and waits for as many `ready` lines as `lines`.
    pub fn start(directory: &Path, arguments: &[&str], lines: usize) -> Self {
        Self::spawn(&mut command(directory, &[&["serve"], arguments].concat()), lines)
    }

    /// The same from a command.
    pub fn spawn(command: &mut Command, lines: usize) -> Self {
        let mut child = command.stdout(Stdio::piped()).spawn().unwrap();
        let output = BufReader::new(child.stdout.take().unwrap());
        let (sender, receiver) = mpsc::channel();
        thread::spawn(move || output.lines().map_while(Result::ok).try_for_each(|line| sender.send(line)));
        let mut serve = Self { child, ready: Vec::new() };
        for _ in 0..lines {
            let line = receiver.recv_timeout(PATIENCE).expect("one more ready line");
            let words: Vec<_> = line.split(' ').collect();
            let ["ready", name, endpoint] = words[..] else { panic!("{line}") };
            serve.ready.push((name.into(), endpoint.into()));
        }
        assert!(receiver.recv_timeout(Duration::from_millis(50)).is_err(), "no more lines");
        serve
    }

    /// A client of the endpoint with this number.
    pub fn client(&self, number: usize) -> Client<TcpStream> {
        let address = self.ready[number].1.split_once(':').unwrap().1;
        let stream = TcpStream::connect(address).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        Client(stream)
    }

    /// Sends a signal and gives the exit status.
    pub fn end(mut self, signal: rustix::process::Signal) -> Option<i32> {
        let pid = rustix::process::Pid::from_child(&self.child);
        rustix::process::kill_process(pid, signal).unwrap();
        let start = Instant::now();
        loop {
            if let Some(status) = self.child.try_wait().unwrap() {
                return status.code();
            }
            assert!(start.elapsed() < PATIENCE, "it does not end");
            thread::sleep(Duration::from_millis(5));
        }
    }
}

impl Drop for Serve {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The frame of a command for module 1.
pub fn frame(command: u8, kind: u8, motor: u8, value: i32) -> [u8; 9] {
    frame_to(1, command, kind, motor, value)
}

/// The frame of a command.
pub fn frame_to(address: u8, command: u8, kind: u8, motor: u8, value: i32) -> [u8; 9] {
    let [a, b, c, d] = value.to_be_bytes();
    let mut frame = [address, command, kind, motor, a, b, c, d, 0];
    frame[8] = frame[..8].iter().fold(0, |sum, byte| sum.wrapping_add(*byte));
    frame
}

/// Somebody at the other end of a wire.
pub struct Client<P>(pub P);

impl<P: Read + Write> Client<P> {
    /// Sends bytes and reads a reply of nine.
    pub fn raw(&mut self, bytes: &[u8]) -> [u8; 9] {
        self.0.write_all(bytes).unwrap();
        let mut reply = [0; 9];
        self.0.read_exact(&mut reply).unwrap();
        reply
    }

    /// A command that succeeds; gives the value of the reply.
    #[track_caller]
    pub fn value(&mut self, command: u8, kind: u8, motor: u8, value: i32) -> i32 {
        let reply = self.raw(&frame(command, kind, motor, value));
        assert_eq!((reply[2], reply[3]), (100, command), "status and command of {reply:?}");
        i32::from_be_bytes(reply[4..8].try_into().unwrap())
    }

    /// Waits until axis parameter `kind` has the value.
    #[track_caller]
    pub fn wait_for(&mut self, kind: u8, expected: i32) {
        let start = Instant::now();
        while self.value(GAP, kind, 0, 0) != expected {
            assert!(start.elapsed() < PATIENCE, "parameter {kind} never gets {expected}");
            thread::sleep(Duration::from_millis(5));
        }
    }
}

pub const MVP: u8 = 4;
pub const SAP: u8 = 5;
pub const GAP: u8 = 6;
pub const STAP: u8 = 7;
pub const SGP: u8 = 9;
pub const GGP: u8 = 10;
