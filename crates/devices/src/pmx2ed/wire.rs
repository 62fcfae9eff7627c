//! Bytes in, replies out, and the communication time-out (manual, sections 6.2 and 7.18).

use super::refusal::Refusal;
use super::table::Id;
use super::{MILLISECOND, Pmx2ed};
use crate::board::{Board, Port};
use crate::flash::Flash;
use ::motion::Ticks;
use core::fmt::Write;
use protocol::performax::{Receiver, Reply};

/// State of the ports.
pub struct Wire {
    /// Of USB and of RS-485.
    receivers: [Receiver; 2],
    /// The last two digits of the device name, as they were at power-up.
    pub address: u8,
    /// When a host was heard last.
    heard_at: Ticks,
    /// Nobody was heard for too long.
    pub timed_out: bool,
}

impl Wire {
    pub const fn new(address: u8) -> Self {
        Self { receivers: [Receiver::new(), Receiver::new()], address, heard_at: 0, timed_out: false }
    }

    /// Forgets a command that has begun at a port.
    pub fn hang_up(&mut self, port: Port) {
        self.receivers[receiver(port)].clear();
    }

    /// A host was heard, or nobody is missing one any more.
    pub const fn heard(&mut self, now: Ticks) {
        self.heard_at = now;
        self.timed_out = false;
    }
}

impl<F: Flash> Pmx2ed<F> {
    /// A byte arrives at a serial port. On RS-485 only commands with the address count.
    pub fn take_byte(&mut self, port: Port, byte: u8, board: &mut dyn Board) {
        let receiver = receiver(port);
        // The receiver is copied back, so that the line may borrow it while the command acts.
        let mut taken = core::mem::take(&mut self.wire.receivers[receiver]);
        if let Some(message) = taken.push(byte) {
            let meant = message.address.map_or(port == Port::Usb, |address| address == self.wire.address);
            if meant && !self.dead {
                let reply = match message.text {
                    Ok(text) => self.answer(text, board),
                    Err(_) => nothing_known(),
                };
                if !self.dead {
                    if !reply.as_str().starts_with('?') {
                        self.wire.heard(self.now);
                    }
                    board.send(port, &reply.emit(), 0);
                }
            }
        }
        self.wire.receivers[receiver] = taken;
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

/// Which receiver is a port's.
const fn receiver(port: Port) -> usize {
    match port {
        Port::Rs485 => 1,
        Port::Usb | Port::Can => 0,
    }
}

/// The reply to what is no line of text.
fn nothing_known() -> Reply {
    let mut reply = Reply::new();
    assert!(reply.write_str(Refusal::Unknown.text()).is_ok(), "room for one character");
    reply
}
