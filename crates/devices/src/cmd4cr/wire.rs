//! Bytes in, replies out (manual, 3.1 to 3.3).

use super::Cmd4cr;
use crate::board::{Board, Port};
use crate::flash::Flash;

impl<F: Flash> Cmd4cr<F> {
    /// A byte arrives at a port.
    pub fn take_byte(&mut self, port: Port, byte: u8, board: &mut dyn Board) {
        let heard = self.ports.hear(port, byte);
        let Some(command) = heard.filter(|_| !self.dead) else { return };
        let reply = self.answer(command.as_deref(), board);
        if !self.dead {
            board.send(port, &reply.emit(), 0);
        }
    }
}
