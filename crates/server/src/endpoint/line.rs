//! What hangs on an endpoint: one device, or all those that share a bus.

use super::Sink;
use crate::unit::{Sent, Unit};
use devices::Port;
use std::{sync::Arc, thread};

/// The devices at the far end of an endpoint, each with the port that it is connected by.
pub(crate) struct Line {
    stations: Vec<(Arc<Unit>, Port)>,
}

impl Line {
    /// A line to these.
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
    pub fn client(&self, sink: Arc<dyn Sink>) -> Client<'_> {
        Client { line: self, sink, sent: Vec::new() }
    }
}

/// One client of a line.
pub(crate) struct Client<'a> {
    line: &'a Line,
    sink: Arc<dyn Sink>,
    sent: Vec<Sent>,
}

impl Drop for Client<'_> {
    fn drop(&mut self) {
        for (unit, port) in &self.line.stations {
            unit.hang_up(*port, &self.sink);
        }
    }
}

impl Client<'_> {
    /// Gives bytes to every device on the line and their replies to `reply`, after the pause that the
    /// device was told to keep. Stops, and says so, when `reply` fails.
    pub fn exchange(&mut self, bytes: &[u8], mut reply: impl FnMut(&[u8]) -> bool) -> bool {
        // Of what comes in one go on a serial bus every device hears each byte before the next one, so that
        // their replies come in the order of the questions.
        let stations = &self.line.stations;
        let is_serial_bus = stations.iter().any(|(_, port)| *port == Port::Rs485);
        for part in bytes.chunks(if is_serial_bus { 1 } else { bytes.len().max(1) }) {
            for (unit, port) in stations {
                unit.exchange(*port, part, &self.sink, &mut self.sent);
            }
        }
        self.sent.drain(..).all(|sent| {
            if !sent.pause.is_zero() {
                thread::sleep(sent.pause);
            }
            reply(&sent.bytes)
        })
    }
}
