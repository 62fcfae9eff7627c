//! Lines that somebody types, as in the direct mode of the vendor's program.

use super::{Module, exchange, show, words};
use crate::bus::PATIENCE;
use crate::error::{Error, Result};
use crate::traffic::hex;
use crate::types::Answer;
use protocol::tmcl::{FRAME_LENGTH, Frame, Reply, Request};
use tmcl::asm::{NoFiles, assemble};
use tmcl::isa::{Command, opcode};

impl Module {
    /// A command in words or bytes, and what comes of it.
    pub async fn terminal(&self, line: &str) -> Result<Answer> {
        let line = line.trim();
        let (address, command) = match bytes(line) {
            Some(bytes) => {
                let Request { address, opcode, kind, motor, value } = Request::parse(&Frame(bytes))
                    .map_err(|error| Error::Value(format!("these bytes are no command: {error}")))?;
                (address, Command::new(opcode, kind, motor, value))
            }
            None => (self.listens_at(), command(line)?),
        };
        let Command { opcode, kind, motor, value } = command;
        let request = Request { address, opcode, kind, motor, value }.emit();
        let mut talk = self.talk().await?;
        let frame = exchange(&mut talk, address, command, PATIENCE, show).await?;
        let (reply, ok) = match Reply::parse(&frame) {
            Ok(reply) => {
                if address == self.listens_at() {
                    self.follow(command, &reply);
                }
                (reply.value.to_string(), reply.status.is_ok())
            }
            // The two replies that are not built like the others.
            Err(_) => (hex(&frame.0), matches!(opcode, opcode::FIRMWARE_VERSION | opcode::READ_MEMORY)),
        };
        Ok(Answer {
            request: words(command),
            reply,
            text: show(frame),
            ok,
            hex_request: hex(&request.0),
            hex_reply: hex(&frame.0),
        })
    }
}

/// Nine bytes in hexadecimal, with spaces between them.
fn bytes(line: &str) -> Option<[u8; FRAME_LENGTH]> {
    let byte = |word: &str| {
        let digits = word.len() == 2 && word.bytes().all(|digit| digit.is_ascii_hexdigit());
        digits.then(|| u8::from_str_radix(word, 16).ok())?
    };
    let bytes: Option<Vec<u8>> = line.split_ascii_whitespace().map(byte).collect();
    bytes?.try_into().ok()
}

/// A command as in programs.
fn command(line: &str) -> Result<Command> {
    // Without the STOP at the end that programs have.
    let assembly = assemble("", format!("#nostop\n{line}").as_bytes(), &NoFiles);
    let commands = assembly.program.map(|program| program.commands);
    match (commands.as_deref(), assembly.diagnostics.first()) {
        (Some([command]), _) => Ok(*command),
        (None, Some(problem)) => Err(Error::Value(problem.message.clone())),
        _ => Err(Error::Value("one command at a time".into())),
    }
}
