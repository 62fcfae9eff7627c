//! USB HID: a stream is cut into reports however it comes, a controller hears one command of each at most,
//! and a host takes whatever it reads.
#![no_main]

use libfuzzer_sys::fuzz_target;
use protocol::{
    hid::{ApiError, Exchange, Name, Packet, REPLY_TIME_OUT_MS, Reports, frame, unframe},
    performax::{PACKET_LENGTH, Receiver},
};

fuzz_target!(|chunks: Vec<Vec<u8>>| {
    let bytes = chunks.concat();
    let mut reports = Reports::new();
    let cut: Vec<Packet> = chunks.iter().flatten().filter_map(|byte| reports.push(*byte)).collect();
    let whole: Vec<Packet> = bytes.as_chunks::<PACKET_LENGTH>().0.iter().copied().map(Packet).collect();
    assert_eq!(cut, whole);

    for packet in &cut {
        assert_eq!(unframe(&frame(packet)), Ok(*packet));
        let mut receiver = Receiver::new();
        let mut heard = Vec::new();
        for &byte in packet.heard() {
            heard.extend(receiver.push(byte).map(|it| it.text.map(str::to_owned)));
        }
        assert!(heard.len() <= 1, "a report is one command");
        let refused = packet.decode().is_err();
        assert_eq!(heard.first().is_some_and(|text| text.is_err()), refused, "it is refused as a whole");
        if let Some(name) = packet.decode().ok().and_then(Name::parse) {
            assert_eq!(Name::new(name.product(), name.number()), name);
        }
    }

    // A conversation in which the device says anything at any time.
    let (mut exchange, mut now_ms) = (Exchange::new(), 0_u64);
    for chunk in &chunks {
        let waits = exchange.deadline_ms().is_some();
        let sent = exchange.send(&String::from_utf8_lossy(chunk), now_ms);
        assert_eq!(sent == Err(ApiError::Protected), waits);
        let waits = exchange.deadline_ms().is_some();
        if chunk.len() % 3 == 0 {
            let reply = exchange.receive(chunk);
            assert_eq!(reply == Ok(None), !waits);
            assert_eq!(exchange.deadline_ms(), None, "one reply, well or not");
        } else {
            now_ms += chunk.len() as u64 * REPLY_TIME_OUT_MS / 8;
            let late = exchange.deadline_ms().is_some_and(|deadline| deadline <= now_ms);
            assert_eq!(exchange.poll(now_ms).is_err(), late);
        }
        let line = Packet::of_reply(chunk);
        assert_eq!(line.0[PACKET_LENGTH - 1], 0, "a reply is ended");
    }
});
