//! Programs: command by command up and down, and what they are to do (TMCL manual, 3.7.53).

use super::{Module, exchange, malformed, show, words};
use crate::bus::{PATIENCE, Talk};
use crate::code::Code;
use crate::error::{Error, Result};
use crate::types::ProgramAction;
use protocol::tmcl::{Frame, MemoryReply, Reply};
use std::sync::atomic::Ordering;
use tmcl::isa::{Command, PROGRAM_LENGTH, opcode};

impl Module {
    /// Tells the program what to do.
    pub async fn program(&self, number: u8, action: ProgramAction) -> Result<()> {
        if number != 0 {
            return Err(Error::NoSuch(format!("program {number}")));
        }
        let control = |opcode, kind, value| self.send(Command::new(opcode, kind, 0, value));
        match action {
            ProgramAction::Run { at } => {
                if at.is_none() {
                    control(opcode::RESET_APPLICATION, 0, 0).await?;
                }
                control(opcode::RUN_APPLICATION, 1, at.unwrap_or(0).into()).await?;
            }
            ProgramAction::Continue => drop(control(opcode::RUN_APPLICATION, 0, 0).await?),
            ProgramAction::Step => drop(control(opcode::STEP_APPLICATION, 0, 0).await?),
            ProgramAction::Stop | ProgramAction::Pause => {
                control(opcode::STOP_APPLICATION, 0, 0).await?;
            }
            ProgramAction::Reset => drop(control(opcode::RESET_APPLICATION, 0, 0).await?),
        }
        // What made single steps waits for the next one.
        let paused = match action {
            ProgramAction::Pause | ProgramAction::Step => Some(self.counter().await?),
            _ => None,
        };
        self.memory().paused = paused;
        Ok(())
    }

    /// Replaces the program. An empty command behind it is its end for whoever uploads it, since what was there before
    /// is not erased.
    pub async fn download(&self, commands: &[Command]) -> Result<()> {
        if commands.len() > PROGRAM_LENGTH {
            return Err(Error::Value(format!("the program has more than {PROGRAM_LENGTH} commands")));
        }
        if let Some(control) = commands.iter().find(|command| is_control(command.opcode)) {
            return Err(Error::Value(format!("`{}` cannot be in a program", words(*control))));
        }
        let stops = self.stops.load(Ordering::Relaxed);
        let mut talk = self.talk().await?;
        self.downloading.store(true, Ordering::Relaxed);
        let mut loaded =
            self.send_in(&mut talk, Command::new(opcode::START_DOWNLOAD, 0, 0, 0)).await.map(drop);
        let end = (commands.len() < PROGRAM_LENGTH).then_some(Command::EMPTY);
        for command in commands.iter().copied().chain(end) {
            if loaded.is_err() {
                break;
            }
            loaded = if self.stops.load(Ordering::Relaxed) == stops {
                self.send_in(&mut talk, command).await.map(drop)
            } else {
                Err(Error::Interrupted)
            };
        }
        let ended = self.end_download(&mut talk).await;
        drop(talk);
        loaded.and(ended)?;
        // Nothing is left of the old program's course.
        self.program(0, ProgramAction::Reset).await
    }

    /// Makes sure that commands are executed again.
    pub(super) async fn end_download(&self, talk: &mut Talk<'_>) -> Result<()> {
        if self.downloading.load(Ordering::Relaxed) {
            self.send_in(talk, Command::new(opcode::END_DOWNLOAD, 0, 0, 0)).await?;
            self.downloading.store(false, Ordering::Relaxed);
        }
        Ok(())
    }

    /// The program, up to the first empty command.
    pub async fn upload(&self) -> Result<Code> {
        let mut commands = Vec::new();
        for address in 0..PROGRAM_LENGTH {
            match self.stored(address).await? {
                Command { opcode: 0, .. } => break,
                command => commands.push(command),
            }
        }
        Ok(Code::Tmcl(commands))
    }

    /// The command at an address.
    async fn stored(&self, address: usize) -> Result<Command> {
        let command = Command::new(opcode::READ_MEMORY, 0, 0, address as i32);
        let mut talk = self.talk().await?;
        let mut frame = exchange(&mut talk, self.listens_at(), command, PATIENCE, show_stored).await?;
        if MemoryReply::parse(&frame).is_none() && Reply::parse(&frame).is_err() {
            talk.doubt();
            frame = exchange(&mut talk, self.listens_at(), command, PATIENCE, show_stored).await?;
        }
        // An ordinary reply says that there is nothing to be had. Both sums cannot be right at once but for one host
        // address, 0, and then the opcode tells.
        match (Reply::parse(&frame), MemoryReply::parse(&frame)) {
            (Ok(reply), stored) if stored.is_none() || reply.opcode == command.opcode => {
                Err(Error::Refused { request: words(command), words: reply.status.to_string() })
            }
            (_, Some(MemoryReply { opcode, kind, motor, value, .. })) => {
                Ok(Command::new(opcode, kind, motor, value))
            }
            _ => Err(malformed(&mut talk, command, frame)),
        }
    }
}

/// Whether a command is executed even while others are stored.
const fn is_control(opcode: u8) -> bool {
    matches!(opcode, opcode::STOP_APPLICATION..=opcode::ASCII_MODE | opcode::SOFTWARE_RESET)
}

/// The reply with a stored command in words.
fn show_stored(frame: Frame) -> String {
    match MemoryReply::parse(&frame) {
        Some(MemoryReply { opcode, kind, motor, value, .. }) => {
            words(Command::new(opcode, kind, motor, value))
        }
        None => show(frame),
    }
}
