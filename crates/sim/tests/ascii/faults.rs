//! Faults, and what the controllers do about each of them.

use super::rig::Rig;
use crate::controller::{ADDRESS, CLEAR_LOOP, HZ, LIMIT_ERRORS, LOOP_ERROR, POSITIVE_LIMIT, STATE};
use devices::Port;
use sim::{DeviceConfig, PinValue, Scenario, fault::scenario::no_source};

impl Rig {
    /// Plans a fault as a scenario says it, for now; its number.
    #[track_caller]
    fn fault(&mut self, entries: &str) -> u64 {
        let devices: [DeviceConfig; 1] = [self.device.config().clone()];
        let scenario = Scenario::parse(&format!("[[fault]]\n{entries}"), "test", &devices, &no_source);
        let scenario = scenario.unwrap_or_else(|error| panic!("{error}"));
        self.device.plan(&scenario.faults[0].1).unwrap_or_else(|error| panic!("{error}"))
    }

    /// Whether the oldest fault has begun; `None` if there is none.
    fn begun(&self) -> Option<bool> {
        self.device.faults().first().map(|fault| fault.is_active)
    }

    /// The status of StepNLoop when it has nothing to do any more.
    #[track_caller]
    fn loop_settled(&mut self) -> i32 {
        for _ in 0..20_000 {
            self.pass_ms(1);
            let status = self.get("SLSX");
            if matches!(status, 0 | 8..=12) {
                return status;
            }
        }
        panic!("StepNLoop does not settle");
    }
}

fn moving(command: &str) -> Rig {
    let mut rig = Rig::with(|axis| axis.encoder_ratio = 2.0);
    rig.ok("SLRX=0.500 SLTX=5 SLEX=400 SLAX=3 HSPD=4000 LSPD=400 ACC=100 DEC=100");
    rig.ok(command);
    rig.pass_ms(300);
    rig
}

#[test]
fn stuck_switches() {
    // On: the axis stops at once and has an error that has to be cleared.
    let mut rig = Rig::new();
    rig.ok("HSPD=4000 LSPD=400 ACC=100 DEC=100");
    let stuck =
        rig.fault("on = { axis = 'X', position = 2000 }\nkind = 'stuck_switch'\npin = '+LX'\nvalue = true");
    rig.run("X5000");
    assert_eq!((rig.get("PX"), rig.shaft("X")), (2000, 2000), "at the pulse that passes the position");
    assert_eq!(rig.get("MSTX") & POSITIVE_LIMIT, POSITIVE_LIMIT);
    rig.check("X0", STATE);
    rig.device.clear_fault(stuck).unwrap();
    assert_ne!(rig.get("MSTX") & LIMIT_ERRORS, 0, "still an error");
    rig.ok("CLRX");
    assert_eq!(rig.get("MSTX") & POSITIVE_LIMIT, 0);
    rig.run("X5000");
    rig.check("PX", "5000");
    // Off: it goes past its end.
    let mut rig = Rig::with(|axis| axis.positive_limit = 3000);
    rig.ok("HSPD=4000 LSPD=400 ACC=100 DEC=100");
    rig.fault("kind = 'stuck_switch'\npin = '+LX'");
    rig.run("X5000");
    assert_eq!((rig.shaft("X"), rig.get("MSTX") & POSITIVE_LIMIT), (5000, 0));
}

/// The error stays although the contact comes apart again, and the axis stays where it was.
#[test]
fn bouncing_switches() {
    let mut rig = Rig::with(|axis| axis.positive_limit = 3000);
    rig.ok("HSPD=4000 LSPD=400 ACC=100 DEC=100");
    rig.fault("kind = 'bouncing_switch'\npin = '+LX'\nms = 50");
    rig.ok("X5000");
    let mut levels = Vec::new();
    for _ in 0..15_000 {
        rig.pass_us(100);
        levels.push(rig.level("+LX"));
    }
    levels.dedup();
    assert!(levels.len() > 3, "{levels:?}");
    assert_eq!(levels.last(), Some(&true));
    assert_eq!((rig.get("PX"), rig.shaft("X")), (3000, 3000));
    assert_eq!(rig.get("MSTX") & POSITIVE_LIMIT, POSITIVE_LIMIT);
}

/// StepNLoop sees a motor that does not follow, and gives up.
#[test]
fn broken_encoders() {
    let mut rig = moving("SLX=1 X9000");
    let broken = rig.fault("kind = 'broken_encoder'\naxis = 'X'");
    let count = rig.get("EX");
    assert_eq!(rig.loop_settled(), 10, "stall error");
    assert_eq!(rig.get("EX"), count);
    rig.check("X0", LOOP_ERROR);
    rig.device.clear_fault(broken).unwrap();
    rig.ok(CLEAR_LOOP);
    rig.ok(&format!("X{}", count + 1000));
    assert_eq!(rig.loop_settled(), 0);
}

/// StepNLoop makes up for it.
#[test]
fn slips() {
    let mut rig = moving("SLX=1 X2000");
    rig.fault("kind = 'slip'\naxis = 'X'\npulses = 30");
    assert_eq!(rig.loop_settled(), 0);
    assert_eq!((rig.get("EX"), rig.shaft("X")), (2000, 1000));
    // Without it nobody knows.
    let mut rig = moving("X2000");
    rig.fault("kind = 'slip'\naxis = 'X'\npulses = 30");
    rig.until_rest();
    assert_eq!((rig.get("PX"), rig.shaft("X")), (2000, 1970));
}

#[test]
fn extra_loads() {
    let mut rig = moving("SLX=1 X20000");
    rig.fault("kind = 'extra_load'\naxis = 'X'\nload = 2\nduration = 1");
    assert_eq!(rig.loop_settled(), 10, "stall error");
    assert!(!rig.moves("X"));
    rig.pass_ms(1000);
    assert_eq!(rig.begun(), None);
    rig.ok(CLEAR_LOOP);
    rig.ok("X0");
    assert_eq!(rig.loop_settled(), 0);
    rig.check("EX", "0");
}

/// It starts again as from a power-up: positions are 0, what was not stored is gone, what was is there.
#[test]
fn brown_outs() {
    let mut rig = Rig::new();
    rig.ok("DOBOOT=7 STORE");
    rig.pass_ms(5);
    rig.ok("DOBOOT=5 X3000");
    rig.pass_ms(1000);
    rig.fault("kind = 'brown_out'\nduration = 0.2");
    assert!(!rig.device.is_powered());
    rig.check("PX", "");
    rig.pass_ms(199);
    rig.check("PX", "");
    rig.pass_ms(2);
    rig.check("PX", "0");
    rig.check("DOBOOT", "7");
}

/// All settings are the old ones or the new ones.
#[test]
fn power_cuts() {
    let stored = |after: &str| {
        let mut rig = Rig::new();
        rig.ok("DOBOOT=7");
        rig.fault(&format!("on = {{ message = 1 }}\nafter = {after}\nkind = 'power_cut'\nduration = 1"));
        rig.ok("STORE");
        rig.pass_ms(900);
        rig.check("PX", "");
        rig.pass_ms(900);
        rig.say("DOBOOT")
    };
    assert_eq!(stored("0.0001"), "0");
    assert_eq!(stored("0.55"), "7");
}

/// Nothing is checked on these lines: what is no command is said back, what is one is done.
#[test]
fn noise() {
    let mut rig = Rig::new();
    let id = rig.fault("kind = 'noise'\nrate = 0.01\nway = 'in'");
    let replies: Vec<_> = (0..300).map(|_| rig.bytes(Port::Usb, b"PX\r")).collect();
    let good = replies.iter().filter(|reply| reply.as_slice() == b"0\r").count();
    let refused = replies.iter().filter(|reply| reply.starts_with(b"?")).count();
    assert!((200..=260).contains(&good) && refused > 20, "{good}, {refused}");
    rig.device.clear_fault(id).unwrap();
    rig.bytes(Port::Usb, b"\r");
    rig.check("PX", "0");
    // The other way the host has to mistrust what it hears.
    rig.fault("kind = 'noise'\nrate = 0.02\nway = 'out'");
    let wrong = (0..200).filter(|_| rig.bytes(Port::Usb, b"PX\r") != b"0\r").count();
    assert!((35..=85).contains(&wrong), "{wrong}");
}

#[test]
fn loss() {
    let mut rig = Rig::new();
    let id = rig.fault("kind = 'loss'\nrate = 1\nway = 'in'\nduration = 0.5");
    rig.check("X1000", "");
    rig.pass_ms(600);
    assert_eq!(rig.device.clear_fault(id).unwrap_err().to_string(), format!("there is no fault {id}"));
    assert_eq!((rig.get("PX"), rig.begun()), (0, None));
    // A part of a command goes on with the next one.
    rig.fault("kind = 'loss'\nrate = 0.2\nway = 'in'");
    let replies: Vec<_> = (0..200).map(|_| rig.bytes(Port::Usb, b"PX\r")).collect();
    let silent = replies.iter().filter(|reply| reply.is_empty()).count();
    let good = replies.iter().filter(|reply| reply.as_slice() == b"0\r").count();
    assert!((20..=60).contains(&silent) && good > 70, "{silent}, {good}");
}

#[test]
fn duplication() {
    let mut rig = Rig::new();
    rig.fault("kind = 'duplication'\nrate = 1\nway = 'in'");
    let reply = rig.bytes(Port::Usb, b"PX\r");
    assert!(reply.starts_with(b"?") && reply.ends_with(b"PPXX\r"), "{}", reply.escape_ascii());
}

#[test]
fn delay() {
    let mut rig = Rig::new();
    rig.ok("HSPD=1000 LSPD=1000 ACC=1");
    rig.fault("kind = 'delay'\nms = 20\nway = 'in'");
    rig.check("X100", "");
    rig.pass_us(19_990);
    assert!(rig.device.drain_sent().next().is_none());
    assert_eq!(rig.device.axis(0).steps, 0);
    rig.pass_us(20);
    let sent: Vec<_> = rig.device.drain_sent().collect();
    assert_eq!((sent.len(), sent[0].at, sent[0].bytes.as_slice()), (1, 20 * HZ / 1000, &b"OK\r"[..]));
}

/// Nobody but the device that is meant answers; what is on the bus is heard by all.
#[test]
fn babbling_nodes() {
    let mut rig = Rig::new();
    let id = rig.fault("kind = 'babbling_node'\nport = 'rs485'\nms = 10\nbytes = '403737494400'");
    let mut said = 0;
    for _ in 0..50 {
        rig.pass_ms(13);
        let heard = rig.bytes(Port::Rs485, format!("@{ADDRESS}PX\r").as_bytes());
        assert!(heard.ends_with(b"0\r"), "{}", heard.escape_ascii());
        said += heard.windows(6).filter(|bytes| bytes == b"@77ID\0").count();
    }
    assert!((50..=80).contains(&said), "{said}");
    rig.device.clear_fault(id).unwrap();
    let id = rig.fault("kind = 'babbling_node'\nport = 'rs485'\nms = 2");
    rig.pass_ms(500);
    rig.device.clear_fault(id).unwrap();
    rig.bytes(Port::Rs485, b"\r");
    assert_eq!(rig.bytes(Port::Rs485, format!("@{ADDRESS}PX\r").as_bytes()), b"0\r");
}

/// Each event begins a fault when it happens, once.
#[test]
fn events() {
    let mut rig = Rig::new();
    rig.ok("HSPD=1000 LSPD=1000 ACC=1");
    let fault = |event: &str| {
        format!("on = {{ {event} }}\nkind = 'stuck_switch'\npin = 'DI1'\nvalue = true\nduration = 1")
    };
    let mut check = |event: &str, act: &dyn Fn(&mut Rig), us: u64| {
        rig.device.clear_faults();
        rig.ok("ABORT");
        rig.pass_ms(20);
        rig.fault(&fault(event));
        rig.pass_ms(20);
        assert_eq!(rig.begun(), Some(false), "{event}: not yet");
        act(&mut rig);
        if us <= 100 {
            rig.pass_us(us);
        } else {
            let margin = us / 50 + 100;
            rig.pass_us(us - margin);
            assert_eq!(rig.begun(), Some(false), "{event}: too early");
            rig.pass_us(2 * margin);
        }
        assert_eq!(rig.begun(), Some(true), "{event}");
        assert_eq!(rig.device.read_pin("DI1"), Ok(PinValue::Level(true)));
        rig.pass_ms(1000);
        assert_eq!(rig.begun(), None, "{event}: it is over");
    };
    check("pin = 'HX'", &|rig| rig.pin("HX", !rig.level("HX")), 0);
    check("pin = 'HX', value = true", &|rig| (0..3).for_each(|_| rig.pin("HX", !rig.level("HX"))), 0);
    check(
        "pin = 'DO1'",
        &|rig| {
            let on = rig.level("DO1");
            rig.ok(&format!("DO1={}", u8::from(!on)))
        },
        100,
    );
    check("axis = 'Y', motion = 'starts'", &|rig| rig.ok("JY+"), 100);
    // Forty pulses at 1000 a second.
    check("axis = 'Y', motion = 'stops'", &|rig| rig.ok("INC Y40"), 40_000);
    check("axis = 'X', position = 25", &|rig| rig.ok("ABS X100"), 25_000);
    check("axis = 'X', position = 20", &|rig| rig.ok("ABS X0"), 80_000);
    check("axis = 'X', position = -7", &|rig| rig.device.push("X", -300).unwrap(), 0);
    check("message = 3", &|rig| (0..3).for_each(|_| drop(rig.say("EX"))), 0);
    // Lines take 100 us. What follows a delay is executed as soon as that is over.
    let program = "V1=1\nV1=2\nDELAY=50\nV1=3\nV1=4\nEND";
    for (address, us) in [(2, 150), (4, 50_350), (5, 50_350), (6, 50_450)] {
        check(&format!("address = {address}"), &|rig| rig.start(0, program), us);
    }
}
