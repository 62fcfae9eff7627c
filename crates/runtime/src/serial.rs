//! Replies on their way out of a serial port.

use crate::hardware::Serial;
use heapless::Deque;

/// Bytes that wait to be sent at a port.
pub const SEND_BYTES: usize = 448;

/// Pauses that are told apart among them.
pub const SEND_MESSAGES: usize = 6;

/// Bytes that a controller is given at a time.
pub const CHUNK_BYTES: usize = 8;

/// What they ask for at most: a command has two bytes or more.
pub const ANSWERS: usize = CHUNK_BYTES / 2;

/// The longest answer: 96 characters and an end of line.
pub const ANSWER_BYTES: usize = 98;

/// Bytes that belong together.
#[derive(Clone, Copy, Debug)]
struct Message {
    /// When it may begin, in timer ticks.
    due: u64,
    bytes: u16,
}

/// What waits to be sent at one port.
#[derive(Debug)]
pub(crate) struct Outbox {
    bytes: Deque<u8, SEND_BYTES>,
    messages: Deque<Message, SEND_MESSAGES>,
    /// The bus is ours.
    talking: bool,
}

impl Outbox {
    pub const fn new() -> Self {
        Self { bytes: Deque::new(), messages: Deque::new(), talking: false }
    }

    /// Whether there is room for all answers to the next bytes. If not, nothing is read.
    pub fn has_room(&self) -> bool {
        let bytes = self.bytes.len() + ANSWERS * ANSWER_BYTES;
        bytes <= SEND_BYTES && self.messages.len() + ANSWERS <= SEND_MESSAGES
    }

    /// Takes bytes that may be sent from `due` on, and at once if that is `None`; all of them or, without room,
    /// none.
    pub fn push(&mut self, bytes: &[u8], due: Option<u64>) -> bool {
        if bytes.len() > SEND_BYTES - self.bytes.len() {
            return false;
        }
        // What needs no pause goes on behind what is there.
        let message = match (due, self.messages.back_mut()) {
            (None, Some(last)) => last,
            _ => {
                let message = Message { due: due.unwrap_or(0), bytes: 0 };
                if self.messages.push_back(message).is_err() {
                    return false;
                }
                let Some(last) = self.messages.back_mut() else { return false };
                last
            }
        };
        message.bytes += bytes.len() as u16;
        self.bytes.extend(bytes.iter().copied());
        true
    }

    /// Sends what the port takes.
    pub fn pump(&mut self, serial: &mut impl Serial, now: u64) {
        while let Some(message) = self.messages.front_mut().filter(|message| message.due <= now) {
            if !core::mem::replace(&mut self.talking, true) {
                serial.begin();
            }
            while message.bytes > 0 {
                let (first, _) = self.bytes.as_slices();
                let first = &first[..first.len().min(message.bytes.into())];
                let Ok(true) = serial.write_ready() else { return };
                let Ok(written) = serial.write(first) else { return };
                for _ in 0..written {
                    self.bytes.pop_front();
                }
                message.bytes -= written as u16;
            }
            self.messages.pop_front();
        }
        if self.talking && serial.is_sent() {
            self.talking = false;
            serial.end();
        }
    }
}
