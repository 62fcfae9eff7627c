//! Lines that somebody types.

use super::{DONE, REFUSAL, Unit};
use crate::bits::flags;
use crate::error::Result;
use crate::traffic::hex;
use crate::types::Answer;

impl Unit {
    /// A line as it is, and what comes of it.
    pub async fn terminal(&self, line: &str) -> Result<Answer> {
        let line = line.trim();
        let mut talk = self.bus.talk().await;
        let reply = self.say(&mut talk, line).await?;
        let bytes = match self.address {
            None => format!("{line}\r"),
            Some(address) => format!("@{address:02}{line}\r"),
        };
        Ok(Answer {
            request: line.into(),
            text: self.meaning(line, &reply),
            ok: !reply.starts_with(REFUSAL),
            hex_request: hex(bytes.as_bytes()),
            hex_reply: hex(format!("{reply}\r").as_bytes()),
            reply,
        })
    }

    /// What a reply does not say itself.
    fn meaning(&self, line: &str, reply: &str) -> String {
        let axis = |name: &str| {
            line.strip_prefix(name)
                .filter(|axis| axis.len() == 1 && self.dialect.axes.contains(axis))
                .is_some()
        };
        let number = reply.parse::<i32>().ok();
        match number {
            Some(word) if axis("MST") && word != 0 => flags(&self.bits, word as u32).join(", "),
            Some(state) if axis("SLS") => loop_state(state).unwrap_or("off").into(),
            _ if reply == DONE => "done".into(),
            _ => String::new(),
        }
    }
}

/// What StepNLoop says that it does; `None` if it is off (PMX-2ED-SA manual, table 7.9; CMD-4CR manual, table 2-27).
pub(super) fn loop_state(number: i32) -> Option<&'static str> {
    Some(match number {
        0 => "idle",
        1 => "moving",
        2 => "correcting",
        3 => "stopping",
        4 => "aborting",
        5 => "jogging",
        6 => "homing",
        7 => "index homing",
        8 => "error range exceeded",
        9 => "too many corrections",
        10 => "stalled",
        11 => "stopped by a limit",
        13 => "limit homing",
        _ => return None,
    })
}

/// Whether StepNLoop has given up.
pub(super) const fn is_loop_error(number: i32) -> bool {
    matches!(number, 8..=11)
}
