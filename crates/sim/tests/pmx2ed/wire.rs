//! Framing, identity, addresses, time-out.

use crate::rig::Rig;
use devices::Port;

#[test]
fn identity() {
    let mut rig = Rig::new();
    rig.check("ID", "PERFORMAX-2ED-SA");
    rig.check("VER", "V128BL");
    rig.check("DN", "2ED00");
}

#[test]
fn framing() {
    let mut rig = Rig::new();
    let mut check = |bytes: &[u8], reply: &[u8]| {
        assert_eq!(rig.bytes(Port::Usb, bytes), reply, "{}", bytes.escape_ascii());
    };
    check(b"ID\r", b"PERFORMAX-2ED-SA\r");
    check(b"ID\n", b"PERFORMAX-2ED-SA\r");
    check(b"ID\0\0\0", b"PERFORMAX-2ED-SA\r");
    check(b"@00ID\r", b"PERFORMAX-2ED-SA\r");
    check(b"@01ID\r", b"");
    check(b"\r\n\r\n", b"");
    check(b"EO=3\rEO\r\n", b"OK\r3\r");
    check(b"id\r", b"?id\r");
    check(b"I\x07D\r", b"?\r");
    check(&[b'V'; 200], b"");
    check(b"\r", b"?\r");
    check(b"VER\r", b"V128BL\r");
}

/// On RS-485 only what is addressed to the device counts.
#[test]
fn names_and_addresses() {
    let mut rig = Rig::new();
    assert_eq!(rig.bytes(Port::Rs485, b"ID\r"), b"");
    assert_eq!(rig.bytes(Port::Rs485, b"@00ID\r"), b"PERFORMAX-2ED-SA\r");
    for wrong in ["DN=2ED", "DN=2ED1", "DN=2ED100", "DN=2EX01", "DN=2ED0x", "DN="] {
        rig.check(wrong, "?Invalid Answer");
    }
    rig.ok("DN=2ED07");
    rig.check("DN", "2ED07");
    // It takes effect at power-up, and only if it was stored.
    assert_eq!(rig.bytes(Port::Rs485, b"@07ID\r"), b"");
    rig.power_cycle();
    rig.check("DN", "2ED00");
    rig.ok("DN=2ED07 STORE");
    rig.power_cycle();
    rig.check("DN", "2ED07");
    assert_eq!(rig.bytes(Port::Rs485, b"@07ID\r"), b"PERFORMAX-2ED-SA\r");
    assert_eq!(rig.bytes(Port::Rs485, b"@00ID\r"), b"");
    assert_eq!(rig.bytes(Port::Usb, b"@00ID\r"), b"");
}

#[test]
fn communication_time_out() {
    let mut rig = Rig::new();
    // The status is read at the end of each silence; reading it is hearing a host.
    let mut silence = |ms| {
        rig.pass_ms(ms);
        (rig.get("MSTX") & 2048, rig.get("MSTY") & 2048)
    };
    assert_eq!(silence(10_000), (0, 0));
    rig.ok("TOC=500");
    let mut silence = |ms| {
        rig.pass_ms(ms);
        let state = rig.device.state();
        let bits = state.axes["X"].status & state.axes["Y"].status & 2048;
        (bits, rig.get("MSTX") & 2048)
    };
    assert_eq!(silence(499), (0, 0));
    assert_eq!(silence(499), (0, 0));
    // The first command hears of it, the next one finds it cleared.
    assert_eq!(silence(501), (2048, 2048));
    assert_eq!(silence(0), (0, 0));
    // What is no command does not count.
    rig.pass_ms(300);
    rig.check("NONSENSE", "?NONSENSE");
    rig.pass_ms(300);
    assert_eq!(rig.device.state().axes["X"].status & 2048, 2048);
    // It stops nothing by itself.
    rig.ok("JX+");
    rig.pass_ms(1000);
    assert_eq!(rig.device.state().axes["X"].status & 2048, 2048);
    assert!(rig.moves("X"));
    rig.ok("ABORT TOC=0");
    rig.pass_ms(10_000);
    assert_eq!(rig.device.state().axes["X"].status & 2048, 0);
}
