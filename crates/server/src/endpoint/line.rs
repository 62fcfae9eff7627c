//! What hangs on an endpoint: one device, or all those that share a bus.

use super::Sink;
use crate::unit::{Sent, Unit};
use devices::Port;
use std::sync::Arc;

/// The devices at the far end of an endpoint, each with the port that it is connected by.
pub(crate) struct Line {
    stations: Vec<(Arc<Unit>, Port)>,
}

impl Line {
    /// A line to these. Where two lines have some in common, these are in the same order.
    pub fn new(stations: Vec<(Arc<Unit>, Port)>) -> Self {
        Self { stations }
    }

    /// The device of a line that is no bus.
    ///
    /// # Panics
    /// If there is another one.
    pub fn only(&self) -> &Arc<Unit> {
        assert_eq!(self.stations.len(), 1, "one device is at an endpoint that is not shared");
        &self.stations[0].0
    }

    /// Somebody who talks over the line; `sink` takes what devices say later by themselves.
    pub fn client(self: &Arc<Self>, sink: Arc<dyn Sink>) -> Client {
        Client { line: Arc::clone(self), sink, sent: Vec::new() }
    }
}

/// One client of a line.
pub(crate) struct Client {
    line: Arc<Line>,
    sink: Arc<dyn Sink>,
    sent: Vec<Sent>,
}

impl Drop for Client {
    fn drop(&mut self) {
        for (unit, port) in &self.line.stations {
            unit.hang_up(*port, &self.sink);
        }
    }
}

impl Client {
    /// Gives bytes to every device on the line.
    pub fn exchange(&mut self, bytes: &[u8]) {
        let Self { line, sink, sent } = self;
        if let [(unit, port)] = &line.stations[..] {
            return unit.turn().exchange(*port, bytes, sink, sent);
        }
        // Of what comes in one go on a serial bus every device hears each byte before the next one, so that
        // their replies come in the order of the questions.
        let present = line.stations.iter().filter(|(unit, _)| !unit.is_gone());
        let mut turns: Vec<_> = present.map(|(unit, port)| (unit.turn(), *port)).collect();
        let is_serial = line.stations.iter().any(|(_, port)| *port == Port::Rs485);
        for part in bytes.chunks(if is_serial { 1 } else { bytes.len().max(1) }) {
            for (turn, port) in &mut turns {
                turn.exchange(*port, part, sink, sent);
            }
        }
    }

    /// What the devices replied, to be sent in this order, each after its pause.
    pub fn replies(&mut self) -> impl Iterator<Item = Sent> {
        self.sent.drain(..)
    }
}
