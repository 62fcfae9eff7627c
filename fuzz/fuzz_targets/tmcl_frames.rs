//! Frames in any chunks, with any pauses: nothing panics, and what parses is written back the same.
#![no_main]

use libfuzzer_sys::fuzz_target;
use protocol::can;
use protocol::tmcl::{CanReply, CanRequest, MemoryReply, Receiver, Reply, Request, VersionReply};

fuzz_target!(|chunks: Vec<(u8, Vec<u8>)>| {
    let mut receiver = Receiver::new();
    let mut now = 0;
    for (pause, chunk) in &chunks {
        now += u64::from(*pause);
        let mut bytes = chunk.as_slice();
        while let Some(frame) = receiver.receive(&mut bytes, now, 50) {
            assert_eq!(Request::parse(&frame).is_ok(), frame.check().is_ok());
            if let Ok(request) = Request::parse(&frame) {
                assert_eq!(request.emit(), frame);
            }
            if let Ok(reply) = Reply::parse(&frame) {
                assert_eq!(reply.emit(), frame);
            }
            assert_eq!(VersionReply::parse(&frame).emit(), frame);
            if let Some(reply) = MemoryReply::parse(&frame) {
                assert_eq!(reply.emit(), frame);
            }
        }
        if let Ok(frame) = can::Frame::decode(chunk) {
            assert_eq!(frame.encode(&mut [0; can::MAX_FLAT]), chunk);
            if let Ok(request) = CanRequest::parse(&frame) {
                let again = request.emit().map(|frame| CanRequest::parse(&frame));
                assert_eq!(again, Some(Ok(request)));
            }
            if let Ok(reply) = CanReply::parse(&frame) {
                let again = reply.emit().map(|frame| CanReply::parse(&frame));
                assert_eq!(again, Some(Ok(reply)));
            }
        }
    }
});
