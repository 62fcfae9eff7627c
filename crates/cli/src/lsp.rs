//! `pulsetrain lsp`: an editor at the language server.

use crate::{Failure, Outcome, args::LspArgs};
use debugger::wire;
use lsp::{Files, Server, uri};
use std::{
    fs::File,
    io::{BufReader, Read, stdin, stdout},
};

/// Speaks with an editor over standard input and output until it leaves.
pub fn lsp(args: &LspArgs) -> Outcome {
    let mut server = Server::new(args.device, Box::new(Disk));
    let (mut input, mut output) = (BufReader::new(stdin()), stdout().lock());
    while !server.is_over() {
        let Some(message) = wire::read_text(&mut input)? else { break };
        for answer in server.handle(&String::from_utf8_lossy(&message)) {
            wire::write_text(&mut output, answer.as_bytes())?;
        }
    }
    if server.is_abrupt() { Err(Failure::Told(crate::FAILED)) } else { Ok(()) }
}

/// The files of this machine.
struct Disk;

impl Files for Disk {
    fn read(&self, uri: &str) -> Option<Vec<u8>> {
        let file = File::open(uri::to_path(uri)?).ok()?;
        if !file.metadata().ok()?.is_file() {
            return None;
        }
        let mut text = Vec::new();
        file.take(source::MAX_SOURCE_BYTES as u64 + 1).read_to_end(&mut text).ok()?;
        Some(text)
    }
}
