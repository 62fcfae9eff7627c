//! Anything a client sends to an SLCAN adapter, and anything an adapter sends to a client.
#![no_main]

use libfuzzer_sys::fuzz_target;
use protocol::slcan::{Adapter, Event, Lines, Message};

fuzz_target!(|bytes: &[u8]| {
    let mut adapter = Adapter::new();
    let (mut lines, mut answers) = (Lines::new(), Lines::new());
    for &byte in bytes {
        let Some(line) = lines.push(byte) else { continue };
        let _ = Event::parse(line);
        let answer = adapter.execute(line);
        for &byte in &answer.reply {
            if let Some(line) = answers.push(byte) {
                assert!(Event::parse(line).is_some());
            }
        }
        if let Some(message) = answer.transmit {
            let text = message.emit(None);
            assert_eq!(Message::parse(&text[..text.len() - 1]), Some((message, &[][..])));
            if let Some(frame) = message.frame() {
                assert_eq!(Message::from(&frame), message);
                adapter.received(&frame, u64::MAX);
            }
        }
    }
});
