//! Faults, and what the module does about each of them.

use crate::rig::{Rig, program, running};
use devices::Port;
use protocol::tmcl::{Request, Status};
use sim::{
    DeviceConfig, Scenario, SharedFlash,
    fault::scenario::no_source,
    tape::{Reader, Tape},
};

const LIMIT: i64 = 51_200;

impl Rig {
    /// Plans a fault as a scenario says it, for now; its number.
    #[track_caller]
    fn fault(&mut self, entries: &str) -> u64 {
        let devices: [DeviceConfig; 1] = [self.device.config().clone()];
        let scenario = Scenario::parse(&format!("[[fault]]\n{entries}"), "test", &devices, &no_source);
        let scenario = scenario.unwrap_or_else(|error| panic!("{error}"));
        self.device.plan(&scenario.faults[0].1).unwrap_or_else(|error| panic!("{error}"))
    }

    /// What comes back of a command, if anything does.
    fn reply(&mut self, port: Port, opcode: u8, kind: u8, value: i32) -> Vec<u8> {
        self.bytes(port, &Request { address: 1, opcode, kind, motor: 0, value }.emit().0)
    }
}

#[test]
fn stuck_switches() {
    // On: the motor stops at once, and turns the other way only (manual, 4.4).
    let mut rig = running(500);
    let stuck = rig.fault("kind = 'stuck_switch'\npin = 'STOP_R'\nvalue = true");
    assert_eq!((rig.gap(3), rig.gap(10)), (0, 1));
    rig.pin("STOP_R", false);
    rig.pass_ms(100);
    assert_eq!((rig.gap(3), rig.gap(10)), (0, 1), "no hand moves it");
    rig.device.release_pin("STOP_R").unwrap();
    rig.ok(2, 0, 0, 500);
    rig.pass_ms(200);
    assert_eq!(rig.gap(3), -500);
    rig.device.clear_fault(stuck).unwrap();
    rig.ok(1, 0, 0, 500);
    rig.pass_ms(400);
    assert_eq!((rig.gap(3), rig.gap(10)), (500, 0));
    // Off: nothing stops it.
    let mut rig = Rig::with(|axis| axis.positive_limit = LIMIT);
    rig.fault("kind = 'stuck_switch'\npin = 'STOP_R'");
    rig.ok(1, 0, 0, 1000);
    rig.pass_ms(5000);
    assert_eq!(rig.gap(3), 1000);
    assert!(rig.shaft() > 2 * LIMIT, "{}", rig.shaft());
}

#[test]
fn bouncing_switches() {
    let end = |bounces: bool| {
        let mut rig = Rig::with(|axis| axis.positive_limit = LIMIT);
        if bounces {
            rig.fault("kind = 'bouncing_switch'\npin = 'STOP_R'\nms = 20");
        }
        rig.ok(1, 0, 0, 1000);
        rig.pass_ms(5000);
        assert_eq!((rig.gap(3), rig.gap(10)), (0, 1), "it stands at the switch");
        rig.shaft() - LIMIT
    };
    assert_eq!(end(false), 0);
    // In velocity mode it goes on as long as the contact is apart.
    let beyond = end(true);
    assert!((1..5000).contains(&beyond), "{beyond}");
}

#[test]
fn broken_encoders() {
    let mut rig = running(500);
    rig.sap(212, 500);
    rig.pass_ms(300);
    assert_eq!(rig.gap(3), 500);
    // The other one does not count here.
    rig.fault("kind = 'broken_encoder'\naxis = '0'\nencoder = 1");
    rig.pass_ms(300);
    assert_eq!(rig.gap(3), 500);
    let broken = rig.fault("kind = 'broken_encoder'\naxis = '0'\nencoder = 0");
    let count = rig.gap(209);
    rig.pass_ms(300);
    assert_eq!((rig.gap(3), rig.gap(207)), (0, 2), "deviation error");
    assert_eq!(rig.gap(209), count);
    // Mended it counts again from where it was.
    rig.device.clear_fault(broken).unwrap();
    rig.sap(212, 0);
    rig.ok(1, 0, 0, 500);
    rig.pass_ms(300);
    assert!(rig.gap(209) > count);
}

#[test]
fn slips() {
    let mut rig = running(500);
    rig.sap(212, 500);
    rig.fault("kind = 'slip'\naxis = '0'\npulses = 400");
    rig.pass_ms(100);
    assert_eq!(rig.gap(3), 500, "so much is allowed");
    assert!(rig.device.faults().is_empty(), "it is over by itself");
    rig.fault("kind = 'slip'\naxis = '0'\npulses = 200");
    rig.pass_ms(100);
    assert_eq!((rig.gap(3), rig.gap(207)), (0, 2));
    let lost = i64::from(rig.gap(1)) - rig.shaft();
    assert!((501..600).contains(&lost), "it stops when more than 500 are lost: {lost}");
}

#[test]
fn extra_loads() {
    let mut rig = running(1000);
    rig.sap(181, 500);
    rig.device.set_load("0", 0.2).unwrap();
    rig.pass_ms(100);
    assert_eq!(rig.gap(3), 1000, "no stall");
    rig.fault("at = 0.05\nkind = 'extra_load'\naxis = '0'\nload = 0.8\nduration = 0.1");
    rig.pass_ms(49);
    assert_eq!(rig.gap(3), 1000);
    rig.pass_ms(20);
    assert_eq!((rig.gap(3), rig.gap(207)), (0, 1), "StallGuard");
    rig.pass_ms(100);
    assert!(rig.device.faults().is_empty());
    rig.sap(5, 100);
    rig.ok(1, 0, 0, 1000);
    rig.pass_ms(2000);
    assert_eq!((rig.gap(3), rig.gap(207)), (1000, 0), "the load is what it was before");
}

#[test]
fn supply_dips() {
    let mut rig = Rig::new();
    program(&mut rig, "ROR 0, 500\nLoop: CALCV ADD, 0, 1\nJA Loop");
    rig.sgp(77, 0, 1);
    rig.ok(129, 1, 0, 0);
    rig.pass_ms(300);
    // Enough for the motor, and to be seen.
    rig.fault("kind = 'supply_dip'\nvolts = 9\nduration = 0.1");
    rig.pass_ms(50);
    assert_eq!((rig.gap(3), rig.ok(15, 8, 1, 0)), (500, 90));
    rig.pass_ms(100);
    assert_eq!(rig.ok(15, 8, 1, 0), 240);
    // Below 8.5 V motor and program stop until there are 9.5 V (firmware 1.35).
    rig.fault("kind = 'supply_dip'\nvolts = 8.4\nduration = 0.2");
    assert_eq!((rig.gap(3), rig.ggp(128, 0)), (0, 0));
    assert_eq!(rig.send(4, 0, 0, 100).0, Status::NOT_AVAILABLE.0);
    rig.pass_ms(150);
    assert_eq!((rig.gap(3), rig.ggp(128, 0)), (0, 0));
    rig.pass_ms(350);
    assert_eq!((rig.gap(3), rig.ggp(128, 0)), (500, 1), "the program starts again");
    // Too much is only seen.
    rig.fault("kind = 'supply_dip'\nvolts = 30\nduration = 0.2");
    assert_eq!((rig.gap(3), rig.ok(15, 8, 1, 0)), (500, 300));
}

/// At 24 V the motor follows 300 full steps a second, at 12 V 150; speed 1000 are 238.
#[test]
fn a_supply_pin_driven_by_hand_is_the_motors_supply() {
    let mut rig = Rig::with(|axis| (axis.pull_out, axis.load) = (vec![[0.0, 1.0], [400.0, 0.0]], 0.25));
    let config = rig.device.config().clone();
    let file = std::env::temp_dir().join(format!("supply-{}.ptr", std::process::id()));
    let flash = SharedFlash::erased(config.model.flash_bytes);
    let tape = Tape::create(&file, &[(&config, 1, &flash)]).unwrap();
    rig.device.add_tape(tape.track(0));
    rig.sap(5, 500);
    rig.sap(4, 1000);
    let follows = |rig: &mut Rig| {
        let lost = |rig: &mut Rig| i64::from(rig.gap(1)) - rig.shaft();
        let before = lost(rig);
        let target = if rig.gap(1) == 0 { 100_000 } else { 0 };
        rig.move_to(target);
        rig.until_rest();
        lost(rig) == before
    };
    assert!(follows(&mut rig));
    rig.analog("SUPPLY", 12.0);
    assert!(!follows(&mut rig));
    rig.device.release_pin("SUPPLY").unwrap();
    assert!(follows(&mut rig), "24 V again");
    let dip = rig.fault("kind = 'supply_dip'\nvolts = 12");
    rig.analog("SUPPLY", 24.0);
    assert!(follows(&mut rig), "the hand has it");
    rig.device.release_pin("SUPPLY").unwrap();
    assert!(!follows(&mut rig), "and gives it back to the dip");
    rig.device.clear_fault(dip).unwrap();
    assert!(follows(&mut rig));

    rig.device.end_tape();
    tape.finish().unwrap();
    let mut replay = Reader::open(&file).unwrap().replay().unwrap();
    replay.play(|_, _, _| ()).unwrap();
    std::fs::remove_file(file).unwrap();
    let again = &replay.devices()[0];
    assert_eq!((again.now(), again.shaft("0").unwrap()), (rig.device.now(), rig.shaft()));
}

#[test]
fn brown_outs() {
    let mut rig = Rig::new();
    program(&mut rig, "ROR 0, 500\nLoop: CALCV ADD, 0, 1\nJA Loop");
    rig.sgp(77, 0, 1);
    rig.sap(5, 300);
    rig.ok(7, 5, 0, 0);
    rig.fault("kind = 'brown_out'\nduration = 0.2");
    assert!(!rig.device.is_powered());
    assert_eq!(rig.reply(Port::Usb, 6, 5, 0), [0; 0], "nobody answers");
    rig.pass_ms(199);
    assert_eq!(rig.reply(Port::Usb, 6, 5, 0), [0; 0]);
    let state = rig.device.state();
    assert_eq!((state.axes["0"].steps, state.programs[0].state), (0, "idle"));
    rig.pass_ms(500);
    assert_eq!(rig.gap(5), 300, "what was stored is there");
    assert_eq!((rig.ggp(128, 0), rig.gap(3)), (1, 500), "autostart");
    // The motor has no current meanwhile: the shaft is where it was pushed to.
    rig.ok(128, 0, 0, 0);
    rig.ok(3, 0, 0, 0);
    rig.pass_ms(500);
    rig.fault("kind = 'brown_out'\nduration = 0.2");
    let before = rig.shaft();
    rig.device.push("0", 777).unwrap();
    rig.pass_ms(100);
    assert_eq!(rig.shaft(), before + 777);
}

#[test]
fn power_cuts() {
    let stored = |after: &str| {
        let mut rig = Rig::new();
        rig.sap(4, 777);
        rig.fault(&format!("on = {{ message = 1 }}\nafter = {after}\nkind = 'power_cut'\nduration = 0.1"));
        assert_eq!(rig.reply(Port::Usb, 7, 4, 0).len(), 9, "it is answered at once");
        rig.pass_ms(90);
        rig.bytes(Port::Usb, &[0; 5]);
        rig.pass_ms(90);
        rig.pass_ms(100);
        rig.gap(4)
    };
    assert_eq!(stored("0.00001"), 1000, "the record was torn: the old value");
    assert_eq!(stored("0.08"), 777);
}

#[test]
fn noise() {
    let mut rig = Rig::new();
    let id = rig.fault("kind = 'noise'\nrate = 0.005\nway = 'in'\nport = 'usb'");
    let mut statuses = [0; 256];
    for _ in 0..500 {
        let reply = rig.reply(Port::Usb, 6, 4, 0);
        statuses[usize::from(reply[2])] += 1;
        if reply[2] == Status::OK.0 {
            assert_eq!(reply, [2, 1, 100, 6, 0, 0, 3, 232, 88]);
        }
    }
    // Each frame has 72 bits: a bit more than two thirds come through. A sum does not see two bits that cancel.
    let (good, bad) = (statuses[usize::from(Status::OK.0)], statuses[usize::from(Status::WRONG_CHECKSUM.0)]);
    assert!((300..=390).contains(&good) && good + bad >= 495, "{good}, {bad}");
    rig.device.clear_fault(id).unwrap();
    assert_eq!(rig.gap(4), 1000);
    // Checked frames of CAN are right or lost.
    rig.fault("kind = 'noise'\nrate = 0.002\nport = 'can'");
    let request = [0, 1, 6, 4, 0, 0, 0, 0, 0];
    let replies: Vec<_> = (0..500).map(|_| rig.bytes(Port::Can, &request)).collect();
    let come = replies.iter().filter(|reply| !reply.is_empty()).count();
    assert!((270..=370).contains(&come), "{come}");
    assert!(replies.iter().all(|reply| matches!(reply[..], [] | [0, 2, 1, 100, 6, 0, 0, 3, 232])));
}

#[test]
fn loss() {
    let mut rig = Rig::new();
    let id = rig.fault("kind = 'loss'\nrate = 0.02\nway = 'in'");
    let mut answered = 0;
    for _ in 0..200 {
        let reply = rig.reply(Port::Usb, 6, 4, 0);
        if !reply.is_empty() {
            assert_eq!(reply, [2, 1, 100, 6, 0, 0, 3, 232, 88]);
            answered += 1;
        }
        // A frame with a byte too few is forgotten after this pause.
        rig.pass_ms(50);
    }
    assert!((150..=185).contains(&answered), "{answered}");
    rig.device.clear_fault(id).unwrap();
    assert_eq!(rig.gap(4), 1000);
}

#[test]
fn duplication() {
    let mut rig = Rig::new();
    rig.fault("kind = 'duplication'\nrate = 1\nport = 'can'\nway = 'in'");
    // Nothing in a frame tells that it is the same again: it is executed twice, and answered twice. Both moves are
    // relative to where the motor stands.
    let replies = rig.bytes(Port::Can, &[0, 1, 4, 1, 0, 0, 0, 3, 232]);
    assert_eq!(replies, [[0, 2, 1, 100, 4, 0, 0, 3, 232]; 2].concat());
    rig.until_rest();
    assert_eq!(rig.gap(1), 1000);
    // Doubled bytes are no frame.
    rig.fault("kind = 'duplication'\nrate = 1\nport = 'rs485'\nway = 'in'");
    let replies = rig.reply(Port::Rs485, 4, 1, 1000);
    assert!(replies.iter().skip(2).step_by(9).all(|status| *status == Status::WRONG_CHECKSUM.0));
    rig.until_rest();
    assert_eq!(rig.gap(1), 1000);
}

#[test]
fn delay() {
    let mut rig = Rig::new();
    rig.fault("kind = 'delay'\nms = 20\nway = 'out'\nduration = 0.1");
    for opcode in [6, 10] {
        assert_eq!(rig.reply(Port::Usb, opcode, 4, 0), [0; 0]);
        rig.pass_ms(1);
    }
    rig.pass_ms(17);
    assert_eq!(rig.device.drain_sent().count(), 0);
    assert!(rig.device.wake() <= rig.device.now() + 2 * crate::rig::MS);
    rig.pass_ms(5);
    let sent: Vec<_> = rig.device.drain_sent().collect();
    let replies: Vec<_> = sent.iter().map(|sent| (sent.at / crate::rig::MS, sent.bytes[3])).collect();
    assert_eq!(replies, [(20, 6), (21, 10)]);
    // What is late when it is over is still late, and nothing overtakes it.
    rig.pass_ms(70);
    rig.reply(Port::Usb, 6, 4, 0);
    rig.pass_ms(10);
    assert_eq!(rig.reply(Port::Usb, 10, 4, 0), [0; 0]);
    rig.pass_ms(20);
    let replies: Vec<_> = rig.device.drain_sent().map(|sent| sent.bytes[3]).collect();
    assert_eq!(replies, [6, 10]);
    assert_eq!(rig.gap(4), 1000);
}

#[test]
fn babbling_nodes() {
    // Frames between others: the module is not meant, and is silent.
    let mut rig = Rig::new();
    let other = "090604000000000013";
    let id = rig.fault(&format!("kind = 'babbling_node'\nport = 'rs485'\nms = 5\nbytes = '{other}'"));
    for _ in 0..50 {
        rig.pass_ms(7);
        // The host hears the neighbour, and then the reply.
        let heard = rig.reply(Port::Rs485, 6, 4, 0);
        assert!(heard.ends_with(&[2, 1, 100, 6, 0, 0, 3, 232, 88]), "{heard:x?}");
        assert_eq!(heard.len() % 9, 0);
    }
    rig.device.clear_fault(id).unwrap();
    // Anything at any time: it spoils frames, and none of it is executed.
    let id = rig.fault("kind = 'babbling_node'\nport = 'rs485'\nms = 3");
    let request = Request { address: 1, opcode: 6, kind: 4, motor: 0, value: 0 }.emit().0;
    let mut spoiled = 0;
    for _ in 0..50 {
        let mut heard = Vec::new();
        for byte in request {
            heard.extend(rig.bytes(Port::Rs485, &[byte]));
            rig.pass_ms(1);
        }
        spoiled += u32::from(!heard.ends_with(&[2, 1, 100, 6, 0, 0, 3, 232, 88]));
    }
    assert!(spoiled > 25, "{spoiled}");
    rig.device.clear_fault(id).unwrap();
    rig.pass_ms(50);
    rig.device.drain_sent().for_each(drop);
    assert_eq!(rig.reply(Port::Rs485, 6, 4, 0), [2, 1, 100, 6, 0, 0, 3, 232, 88]);
}

#[test]
fn programs_that_come_to_an_address() {
    for (address, ms) in [(1, 0), (2, 100), (3, 100), (4, 200)] {
        let mut rig = Rig::new();
        program(&mut rig, "CALC LOAD, 1\nWAIT TICKS, 0, 10\nCALC LOAD, 2\nWAIT TICKS, 0, 10\nLoop: JA Loop");
        rig.fault(&format!(
            "on = {{ address = {address} }}\nkind = 'stuck_switch'\npin = 'HOME'\nvalue = true"
        ));
        rig.ok(129, 1, 0, 0);
        let begun = |rig: &Rig| rig.device.faults()[0].is_active;
        if ms > 0 {
            rig.pass_ms(ms - 1);
            assert!(!begun(&rig), "{address}: too early");
        }
        rig.pass_ms(2);
        assert!(begun(&rig), "{address}");
    }
}
