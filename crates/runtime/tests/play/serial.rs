//! Bytes in and out.

use crate::script::Script;
use crate::session::{pass, pd42, pmx2ed, say, session, tmcl};
use devices::Port;

#[test]
fn answers_come_from_where_they_were_asked() {
    session::<_, 2, 25_000_000>(pmx2ed(), |main| {
        assert_eq!(say(main, Port::Usb, b"ID\r"), b"PERFORMAX-2ED-SA\r");
        assert_eq!(say(main, Port::Rs485, b"@00VER\r"), b"V128BL\r");
        assert_eq!(say(main, Port::Rs485, b"@01VER\r"), b"");
        assert!(!main.hardware().port(Port::Rs485).talking, "the bus is for others");
    });
}

/// The pause before an answer counts from when it is given, and what follows waits for it.
#[test]
fn answers_keep_their_pauses() {
    session::<_, 2, 25_000_000>(Script::default(), |main| {
        pass(main, 10_000);
        let asked = main.hardware().time();
        say(main, Port::Usb, &[20, 0, 5, 100]);
        pass(main, 50_000);
        let sent = main.hardware().port(Port::Usb).from_device.clone();
        assert!(sent.iter().map(|(_, byte)| *byte).eq([20, 0, 5, 100].iter().flat_map(|byte| [*byte; 40])));
        for (at, _) in sent {
            let ms = (at - asked) as f64 / 25_000.0;
            assert!((20.0..20.7).contains(&ms), "{ms} ms");
        }
        assert!(!main.hardware().port(Port::Usb).talking);
    });
}

/// The pause of the PD42-1140 (global parameter 75), which is for RS-485 alone.
#[test]
fn the_telegram_pause_is_kept() {
    session::<_, 1, 170_000_000>(pd42(), |main| {
        assert_eq!(say(main, Port::Usb, &tmcl(9, 75, 30))[2], 100);
        pass(main, 100_000);
        let asked = main.hardware().time();
        assert_eq!(say(main, Port::Usb, &tmcl(136, 1, 0)).len(), 9);
        assert_eq!(say(main, Port::Rs485, &tmcl(136, 1, 0)).len(), 0);
        pass(main, 40_000);
        let sent = main.hardware().port(Port::Rs485).from_device.clone();
        let ms = (sent[0].0 - asked) as f64 / 170_000.0;
        assert!(sent.len() == 9 && (30.0..34.0).contains(&ms), "{ms} ms");
    });
}

/// Who does not take answers is not asked on: commands wait, nothing is lost.
#[test]
fn what_cannot_be_answered_waits() {
    session::<_, 2, 25_000_000>(pmx2ed(), |main| {
        main.hardware().port(Port::Usb).room = 0;
        assert_eq!(say(main, Port::Usb, &b"ID\r".repeat(500)), b"");
        pass(main, 1_000_000);
        assert!(main.hardware().port(Port::Usb).to_device.len() > 1000);
        // The other port is not concerned.
        assert_eq!(say(main, Port::Rs485, b"@00ID\r"), b"PERFORMAX-2ED-SA\r");
        let mut answers = Vec::new();
        for _ in 0..20_000 {
            main.hardware().port(Port::Usb).room = 1;
            pass(main, 100);
        }
        answers.extend(main.hardware().port(Port::Usb).from_device.iter().map(|(_, byte)| *byte));
        assert_eq!(answers, b"PERFORMAX-2ED-SA\r".repeat(500));
        assert_eq!(main.figures().dropped_replies, 0);
    });
}
