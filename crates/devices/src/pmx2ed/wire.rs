//! Bytes in, replies out, and the communication time-out (manual, sections 6.2 and 7.18).

use super::refusal::Refusal;
use super::table::Id;
use super::{MILLISECOND, Pmx2ed};
use crate::ascii::ports::Ports;
use crate::board::{Board, Port};
use crate::flash::Flash;
use ::motion::Ticks;
use core::fmt::Write;
use protocol::performax::Reply;

/// State of the ports.
pub struct Wire {
    ports: Ports,
    /// When a host was heard last.
    heard_at: Ticks,
    /// Nobody was heard for too long.
    pub timed_out: bool,
}

impl Wire {
    pub const fn new() -> Self {
        Self { ports: Ports::new(), heard_at: 0, timed_out: false }
    }

    /// The device number at power-up.
    pub const fn power_on(&mut self, address: u8) {
        self.ports.power_on(address);
    }

    /// The last two digits of the device name, as they were at power-up.
    pub const fn address(&self) -> u8 {
        self.ports.address()
    }

    /// Forgets a command that has begun at a port.
    pub fn hang_up(&mut self, port: Port) {
        self.ports.hang_up(port);
    }

    /// A host was heard, or nobody is missing one any more.
    pub const fn heard(&mut self, now: Ticks) {
        self.heard_at = now;
        self.timed_out = false;
    }
}

impl<F: Flash> Pmx2ed<F> {
    /// A byte arrives at a serial port.
    pub fn take_byte(&mut self, port: Port, byte: u8, board: &mut dyn Board) {
        let heard = self.wire.ports.hear(port, byte);
        let Some(command) = heard.filter(|_| !self.dead) else { return };
        let reply = match command {
            Some(text) => self.answer(&text, board),
            None => nothing_known(),
        };
        if !self.dead {
            if !reply.as_str().starts_with('?') {
                self.wire.heard(self.now);
            }
            board.send(port, &reply.emit(), 0);
        }
    }

    /// When the communication time-out is due.
    pub fn time_out_due(&self) -> Option<Ticks> {
        let ms = self.memory.cells.get(Id::TimeOut);
        let span = Ticks::from(ms.unsigned_abs()) * MILLISECOND;
        (ms != 0 && !self.wire.timed_out).then(|| self.wire.heard_at.saturating_add(span))
    }

    /// Notices that nobody was heard for too long.
    pub fn watch_hosts(&mut self) {
        if self.time_out_due().is_some_and(|due| due <= self.now) {
            self.wire.timed_out = true;
        }
    }
}

/// The reply to what is no line of text.
fn nothing_known() -> Reply {
    let mut reply = Reply::new();
    assert!(reply.write_str(Refusal::Unknown.text()).is_ok(), "room for one character");
    reply
}
