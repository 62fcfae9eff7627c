//! Bytes at a Performax port: no message says what its bytes did not, and lines do not meet.
#![no_main]

use libfuzzer_sys::fuzz_target;
use protocol::performax::{MAX_COMMAND, PACKET_LENGTH, Packet, Receiver, TextError};

type Message = (Option<u8>, Result<String, TextError>);

fn messages(bytes: &[u8]) -> Vec<Message> {
    let mut receiver = Receiver::new();
    let mut messages = Vec::new();
    for &byte in bytes {
        messages.extend(receiver.push(byte).map(|it| (it.address, it.text.map(str::to_owned))));
    }
    messages
}

fuzz_target!(|chunks: Vec<Vec<u8>>| {
    let bytes = chunks.concat();
    let mut one_by_one = Vec::new();
    for line in bytes.split_inclusive(|byte| matches!(byte, 0 | b'\r' | b'\n')) {
        let found = messages(line);
        assert!(found.len() <= 1);
        for (address, text) in &found {
            assert!(address.is_none_or(|address| address < 100));
            if let Ok(text) = text {
                assert!((1..=MAX_COMMAND).contains(&text.len()));
                let prefix = address.map_or(String::new(), |address| format!("@{address:02}"));
                assert_eq!(&line[..line.len() - 1], format!("{prefix}{text}").as_bytes());
            }
        }
        one_by_one.extend(found);
    }
    // What one receiver makes of the whole stream, however it was cut.
    let mut receiver = Receiver::new();
    let mut all = Vec::new();
    for chunk in &chunks {
        for &byte in chunk {
            all.extend(receiver.push(byte).map(|it| (it.address, it.text.map(str::to_owned))));
        }
    }
    assert_eq!(all, one_by_one);

    for packet in bytes.as_chunks::<PACKET_LENGTH>().0 {
        let packet = Packet(*packet);
        if let Ok(text) = packet.decode() {
            let again = Packet::encode(text).expect("what was in a packet fits into one");
            assert_eq!(again.decode(), Ok(text));
        }
    }
});
