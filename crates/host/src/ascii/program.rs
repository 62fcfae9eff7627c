//! Standalone programs: line by line up and down, and what they are to do (PMX-2ED-SA manual, 7.19; CMD-4CR manual,
//! 2.7).

use super::Unit;
use crate::code::Code;
use crate::error::{Error, Result};
use crate::types::ProgramAction;
use ascript::line::Line;

/// What the command that controls programs takes (PMX-2ED-SA manual, table 7.11; CMD-4CR manual, table 2-33).
mod control {
    pub const STOP: u8 = 0;
    pub const START: u8 = 1;
    pub const PAUSE: u8 = 2;
    pub const CONTINUE: u8 = 3;
}

impl Unit {
    /// Tells a program what to do.
    pub async fn program(&self, number: u8, action: ProgramAction) -> Result<()> {
        if number >= self.dialect.threads {
            return Err(Error::NoSuch(format!("program {number}")));
        }
        let value = match action {
            ProgramAction::Run { at: None } => control::START,
            ProgramAction::Run { at: Some(_) } => return Err(Error::Unsupported("start at an address")),
            ProgramAction::Stop | ProgramAction::Reset => control::STOP,
            ProgramAction::Pause => control::PAUSE,
            ProgramAction::Continue => control::CONTINUE,
            ProgramAction::Step => return Err(Error::Unsupported("single steps")),
        };
        self.tell(&format!("{}{number}={value}", self.dialect.control)).await
    }

    /// Replaces the program memory; programs that run are stopped before.
    ///
    /// What is left of a longer program is emptied first, from its end on, so that the first empty line is always the
    /// end of the memory's content, even if the wire breaks meanwhile.
    pub async fn download(&self, lines: &[Line]) -> Result<()> {
        if lines.len() > self.dialect.lines.into() {
            return Err(Error::Value(format!("the program has more than {} lines", self.dialect.lines)));
        }
        let _alone = self.downloads.lock().await;
        for program in 0..self.dialect.threads {
            self.program(program, ProgramAction::Stop).await?;
        }
        let length = lines.len() as u16;
        let mut end = length;
        while end < self.dialect.lines && self.line(end).await? != Line::Empty {
            end += 1;
        }
        for address in (length..end).rev() {
            self.tell(&format!("SA{address}=")).await?;
        }
        for (address, line) in lines.iter().enumerate() {
            self.tell(&format!("SA{address}={line}")).await?;
        }
        Ok(())
    }

    /// The program memory up to its first empty line.
    pub async fn upload(&self) -> Result<Code> {
        let mut lines = Vec::new();
        for address in 0..self.dialect.lines {
            match self.line(address).await? {
                Line::Empty => break,
                line => lines.push(line),
            }
        }
        Ok(Code::Ascript(self.dialect, lines))
    }

    async fn line(&self, address: u16) -> Result<Line> {
        let request = format!("SA{address}");
        let text: String = self.ask(&request).await?;
        let line = Line::parse(&text, self.dialect);
        line.ok_or(Error::Malformed { request, reply: text })
    }
}
