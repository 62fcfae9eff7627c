//! Frames and lines (manual, sections 3.1 to 3.4, 7.4, 7.5).

use crate::rig::Rig;
use devices::Port;

#[test]
fn replies() {
    let mut rig = Rig::new();
    let check = |rig: &mut Rig, request: &[u8], reply: &[u8]| {
        for port in [Port::Usb, Port::Rs485] {
            assert_eq!(rig.bytes(port, request), reply, "{request:x?}");
        }
    };
    // Value, echo, unknown command, wrong type, wrong checksum.
    check(&mut rig, &[1, 6, 4, 0, 0, 0, 0, 0, 11], &[2, 1, 100, 6, 0, 0, 3, 232, 88]);
    check(&mut rig, &[1, 5, 4, 0, 0, 0, 3, 232, 245], &[2, 1, 100, 5, 0, 0, 3, 232, 87]);
    check(&mut rig, &[1, 99, 0, 0, 0, 0, 0, 0, 100], &[2, 1, 2, 99, 0, 0, 0, 0, 104]);
    check(&mut rig, &[1, 6, 99, 0, 0, 0, 0, 0, 106], &[2, 1, 3, 6, 0, 0, 0, 0, 12]);
    check(&mut rig, &[1, 6, 1, 0, 0, 0, 0, 0, 9], &[2, 1, 1, 0, 0, 0, 0, 0, 4]);
}

#[test]
fn a_wrong_checksum_executes_nothing() {
    let mut rig = Rig::new();
    rig.bytes(Port::Usb, &[1, 5, 4, 0, 0, 0, 0, 100, 0]);
    assert_eq!(rig.gap(4), 1000);
}

#[test]
fn addresses() {
    let mut rig = Rig::new();
    let to_nine = [9, 6, 4, 0, 0, 0, 0, 0, 19];
    assert_eq!(rig.bytes(Port::Rs485, &to_nine), [0; 0]);
    assert_eq!(rig.bytes(Port::Usb, &to_nine).len(), 9, "USB is point to point");
    assert_eq!(rig.bytes(Port::Rs485, &[9, 6, 4, 0, 0, 0, 0, 0, 1]), [0; 0], "not even a checksum error");
}

#[test]
fn partial_frames_time_out() {
    let mut rig = Rig::new();
    assert_eq!(rig.bytes(Port::Usb, &[1, 6, 4]), [0; 0]);
    rig.pass_ms(49);
    assert_eq!(rig.bytes(Port::Usb, &[0, 0, 0, 0, 0, 11]).len(), 9, "still one frame");
    rig.bytes(Port::Usb, &[1, 6, 4]);
    rig.pass_ms(50);
    assert_eq!(rig.gap(4), 1000, "forgotten");
    // Or with zeros: whatever was begun ends with an error.
    rig.bytes(Port::Usb, &[1, 6, 4, 0]);
    let reply = rig.bytes(Port::Usb, &[0; 9]);
    assert_eq!(reply[2], 1);
    rig.pass_ms(50);
    assert_eq!(rig.bytes(Port::Usb, &[0; 9])[2], 2);
}

#[test]
fn several_frames_at_once_and_byte_by_byte() {
    let mut rig = Rig::new();
    let frame = [1, 6, 4, 0, 0, 0, 0, 0, 11];
    assert_eq!(rig.bytes(Port::Usb, &[frame, frame, frame].concat()).len(), 27);
    let replies: usize = frame.iter().map(|byte| rig.bytes(Port::Usb, &[*byte]).len()).sum();
    assert_eq!(replies, 9);
}

#[test]
fn can_frames_of_seven_and_eight_bytes() {
    let mut rig = Rig::new();
    assert_eq!(rig.bytes(Port::Can, &[0, 1, 6, 4, 0, 0, 0, 0, 0]), [0, 2, 1, 100, 6, 0, 0, 3, 232]);
    assert_eq!(rig.bytes(Port::Can, &[0, 1, 6, 4, 0, 0, 0, 0, 0, 77]), [0, 2, 1, 100, 6, 0, 0, 3, 232, 0]);
    for frame in [&[0, 1, 6, 4][..], &[0, 3, 6, 4, 0, 0, 0, 0, 0], &[0, 1], &[]] {
        assert_eq!(rig.bytes(Port::Can, frame), [0; 0], "{frame:?}");
    }
    // The version as text, seven or eight characters of it.
    assert_eq!(rig.bytes(Port::Can, &[0, 1, 136, 0, 0, 0, 0, 0, 0]), b"\x00\x021140V14");
    assert_eq!(rig.bytes(Port::Can, &[0, 1, 136, 0, 0, 0, 0, 0, 0, 0]), b"\x00\x021140V147");
    assert_eq!(rig.bytes(Port::Can, &[0, 1, 139, 0, 0, 0, 0, 0, 0])[3], 6, "no lines on CAN");
}

fn line(rig: &mut Rig, text: &str) -> String {
    String::from_utf8(rig.bytes(Port::Usb, text.as_bytes())).expect("ASCII")
}

#[test]
fn ascii_lines() {
    let mut rig = Rig::new();
    rig.sgp(67, 0, 0x20);
    rig.ok(139, 0, 0, 0);
    drop(rig.device.drain_sent());
    for (typed, reply) in [
        ("AMVP ABS, 0, 50000\r", "BA 100 50000\r"),
        ("A MVP ABS, 0, 50000\r", "BA 100 50000\r"),
        ("AGAP 0, 0\r", "BA 100 50000\r"),
        ("AMST 0\r", "BA 100 0\r"),
        ("AROL 0, 500\r", "BA 100 500\r"),
        ("asap 4,0,77\r", ""),
        ("AROR 2, 500\r", "BA 4 0\r"),
        ("AGAP 99, 0\r", "BA 3 0\r"),
        ("AFLY 1\r", "BA 2 0\r"),
        ("BGAP 0, 0\r", ""),
        ("ASTOP\r", "BA 100 0\r"),
        ("AUF3\r", "BA 6 0\r"),
        ("ARFS STATUS, 0\r", "BA 100 0\r"),
        ("ASGP 1, 2, -8\r", "BA 100 -8\r"),
        ("AGGP 1, 2\r", "BA 100 -8\r"),
        ("ABIN\r", "BA 100 0\r"),
    ] {
        assert_eq!(line(&mut rig, typed), reply, "{typed}");
    }
    assert_eq!(rig.ggp(1, 2), -8);
}

#[test]
fn ascii_echo() {
    let mut rig = Rig::new();
    rig.ok(139, 0, 0, 0);
    assert_eq!(line(&mut rig, "AG"), "AG", "each character");
    assert_eq!(line(&mut rig, "X\x08"), "X\x08 \x08");
    assert_eq!(line(&mut rig, "GP 66, 0\r"), "GP 66, 0\rBA 100 1\r");
    line(&mut rig, "ASGP 67, 0, 16\r");
    assert_eq!(line(&mut rig, "AGGP 66, 0"), "");
    assert_eq!(line(&mut rig, "\r"), "AGGP 66, 0\rBA 100 1\r", "the whole line");
    // RS-485 stays binary: the mode belongs to the port.
    assert_eq!(rig.bytes(Port::Rs485, &[1, 6, 4, 0, 0, 0, 0, 0, 11]).len(), 9);
}

#[test]
fn ascii_runs_and_stops_programs() {
    let mut rig = Rig::new();
    crate::rig::program(&mut rig, "Loop: CALCV ADD, 0, 1\nJA Loop");
    rig.ok(139, 0, 0, 0);
    line(&mut rig, "ARUN\r");
    rig.pass_ms(10);
    line(&mut rig, "ASTOP\r");
    line(&mut rig, "ABIN\r");
    let count = rig.ggp(0, 2);
    assert!(count > 90, "{count}");
    rig.pass_ms(10);
    assert_eq!(rig.ggp(0, 2), count);
}
