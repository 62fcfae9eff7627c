//! A device on USB HID: reports of 64 bytes, one after the other without anything between.
//!
//! The first report from the device is its name, so that a client knows whom it talks to; from then on each
//! report to the device is a command and each one back a reply. Only whole reports count: a client that leaves
//! in the middle of one has said nothing. As on a real port, whoever was connected when the device was
//! switched off is cut off; a new connection gets the name that it has then.

use super::{
    Line, Sink,
    stream::{Stream, StreamSink},
};
use protocol::hid::{Packet, Reports};
use std::sync::Arc;

/// One connection, to its end.
pub(super) async fn talk(stream: Arc<Stream>, line: Arc<Line>) {
    let presence = || line.only().with(|device| (device.hid_name(), device.switched_on_at()));
    let (Some(name), switched_on_at) = presence() else { return };
    if !stream.send(&Packet::of_reply(name.as_str().as_bytes()).0).await {
        return;
    }
    let mut client = line.client(Arc::new(ReportSink(StreamSink(Arc::clone(&stream)))));
    let mut reports = Reports::new();
    let mut complete = |bytes: &[u8]| bytes.iter().filter_map(|byte| reports.push(*byte)).collect::<Vec<_>>();
    while let Some(commands) = stream.receive(&mut complete).await {
        for command in commands {
            if presence().1 != switched_on_at {
                return;
            }
            client.exchange(command.heard());
            for reply in client.replies() {
                reply.pause().await;
                if !stream.send(&Packet::of_reply(&reply.bytes).0).await {
                    return;
                }
            }
        }
    }
}

/// Sends what a device says by itself as reports.
struct ReportSink(StreamSink);

impl Sink for ReportSink {
    fn push(&self, bytes: &[u8]) {
        self.0.push(&Packet::of_reply(bytes).0);
    }
}
