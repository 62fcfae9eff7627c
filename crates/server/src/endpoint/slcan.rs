//! A CAN adapter with the SLCAN text protocol in front of the line.

use super::{
    Line, Sink,
    stream::{Stream, StreamSink},
};
use crate::unit::wait;
use protocol::{
    can,
    slcan::{Adapter, Lines},
};
use std::{
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::{Duration, Instant},
};

/// One connection, to its end. Each has an adapter of its own, as if everybody had plugged one in.
pub(super) async fn talk(stream: Arc<Stream>, line: Arc<Line>) {
    let bus = Arc::new(BusSink {
        adapter: Mutex::new(Adapter::new()),
        stream: StreamSink(Arc::clone(&stream)),
        plugged_in: Instant::now(),
    });
    let mut client = line.client(bus.clone());
    let mut lines = Lines::new();
    let mut answer = Vec::new();
    let mut execute = |bytes: &[u8], answer: &mut Vec<u8>| {
        let mut pause = Duration::ZERO;
        for byte in bytes {
            let Some(line) = lines.push(*byte) else { continue };
            let done = bus.adapter().execute(line);
            answer.extend_from_slice(&done.reply);
            if let Some(frame) = done.transmit.and_then(|message| message.frame()) {
                let mut flat = [0; can::MAX_FLAT];
                client.exchange(frame.encode(&mut flat));
                for reply in client.replies() {
                    pause += reply.pause;
                    answer.extend_from_slice(&bus.text(&reply.bytes));
                }
            }
        }
        pause
    };
    while let Some(pause) = stream.receive(|bytes| execute(bytes, &mut answer)).await {
        wait(pause).await;
        if !stream.send(&answer).await {
            return;
        }
        answer.clear();
    }
}

/// Takes frames from the bus as one client's adapter does.
struct BusSink {
    adapter: Mutex<Adapter>,
    stream: StreamSink,
    plugged_in: Instant,
}

impl BusSink {
    fn adapter(&self) -> MutexGuard<'_, Adapter> {
        self.adapter.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A frame in the flat form as the adapter's client reads it: nothing if the channel is closed.
    fn text(&self, flat: &[u8]) -> Vec<u8> {
        let time_ms = u64::try_from(self.plugged_in.elapsed().as_millis()).unwrap_or(u64::MAX);
        let frame = can::Frame::decode(flat).ok();
        let text = frame.and_then(|frame| self.adapter().received(&frame, time_ms));
        text.map(|text| text.to_vec()).unwrap_or_default()
    }
}

impl Sink for BusSink {
    fn push(&self, bytes: &[u8]) {
        let text = self.text(bytes);
        if !text.is_empty() {
            self.stream.push(&text);
        }
    }
}
