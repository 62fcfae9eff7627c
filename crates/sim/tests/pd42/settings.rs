//! Settings survive: a power cut at every single flash operation of a workload.

use crate::rig::Rig;
use devices::{Port, model};
use protocol::tmcl::{Frame, Reply, Request};
use sim::SharedFlash;
use std::collections::HashMap;

/// A store command: what it sets before, and what it stores.
#[derive(Clone, Copy, Debug)]
enum Store {
    Axis(u8, i32),
    Module(u8, i32),
    Variable(u8, i32),
    Coordinate(u8, i32),
    Word(u8, i32),
}

impl Store {
    /// The setting's identity and its value.
    fn setting(self) -> ((u8, u8), i32) {
        match self {
            Self::Axis(number, value) => ((0, number), value),
            Self::Module(number, value) => ((1, number), value),
            Self::Variable(number, value) => ((2, number), value),
            Self::Coordinate(number, value) => ((3, number), value),
            Self::Word(address, value) => ((4, address), value),
        }
    }

    fn commands(self) -> Vec<(u8, u8, u8, i32)> {
        match self {
            Self::Axis(number, value) => vec![(5, number, 0, value), (7, number, 0, 0)],
            Self::Module(number, value) => vec![(9, number, 0, value)],
            Self::Variable(number, value) => vec![(9, number, 2, value), (11, number, 2, 0)],
            Self::Coordinate(number, value) => vec![(30, number, 0, value), (30, number, 255, 0)],
            Self::Word(address, value) => {
                vec![(132, 0, 0, address.into()), (45, 9, 7, value), (133, 0, 0, 0)]
            }
        }
    }

    /// Carries it out; whether it was answered.
    fn send(self, rig: &mut Rig) -> bool {
        self.commands().into_iter().all(|(opcode, kind, motor, value)| {
            let request = Request { address: 1, opcode, kind, motor, value };
            let bytes = rig.bytes(Port::Usb, &request.emit().0);
            let Ok(frame) = <[u8; 9]>::try_from(bytes) else { return false };
            let status = Reply::parse(&Frame(frame)).expect("a good checksum").status.0;
            assert!(status == 100 || status == 101, "{self:?}: {status}");
            true
        })
    }

    fn read(rig: &mut Rig, (kind, number): (u8, u8)) -> i32 {
        match kind {
            0 => rig.gap(number),
            1 => rig.ggp(number, 0),
            2 => rig.ggp(number, 2),
            3 => {
                rig.ok(31, number, 255, 0);
                rig.ok(31, number, 0, 0)
            }
            _ => {
                let request = Request { address: 1, opcode: 134, kind: 0, motor: 0, value: number.into() };
                let bytes = rig.bytes(Port::Usb, &request.emit().0);
                i32::from_be_bytes(bytes[4..8].try_into().expect("four bytes"))
            }
        }
    }
}

/// Stores of every kind, some settings again and again. Parameters that change the wire stay out.
fn workload() -> Vec<Store> {
    let mut stores = Vec::new();
    for round in 1..=12 {
        stores.extend([
            Store::Axis(4, 100 + round),
            Store::Module(75, round),
            Store::Variable(0, -round * 1000),
            Store::Word((round % 5) as u8, round),
            Store::Variable((round % 56) as u8, round << 20),
            Store::Coordinate((round % 20) as u8 + 1, round * 77),
            Store::Axis(214, 300 + round),
            Store::Module(68, 1000 + round),
        ]);
    }
    stores
}

fn erased() -> SharedFlash {
    SharedFlash::erased(model("pd42-1140").expect("the model exists").flash_bytes)
}

/// Fills the flash almost up, so that the workload makes it move records to other pages.
fn worn() -> Vec<u8> {
    let flash = erased();
    let mut rig = Rig::on(flash.clone());
    // Far more stores than fit: the store has gone round more than once.
    for round in 0..9000 {
        assert!(Store::Variable((round % 40) as u8 + 10, round).send(&mut rig));
    }
    flash.to_bytes()
}

fn cut_everywhere(start: &[u8]) {
    let flash = SharedFlash::from_bytes(start.to_vec());
    let mut rig = Rig::on(flash.clone());
    let before = flash.operations();
    for store in workload() {
        assert!(store.send(&mut rig));
    }
    let operations = flash.operations() - before;
    assert!(operations > 100, "{operations}");
    let fresh: HashMap<_, _> = {
        let mut rig = Rig::on(SharedFlash::from_bytes(start.to_vec()));
        workload()
            .into_iter()
            .map(|store| (store.setting().0, Store::read(&mut rig, store.setting().0)))
            .collect()
    };
    for cut in 0..=operations {
        let flash = SharedFlash::from_bytes(start.to_vec());
        flash.set_seed(cut);
        let mut rig = Rig::on(flash.clone());
        flash.cut_after(cut);
        let mut known = fresh.clone();
        let mut unanswered = None;
        for store in workload() {
            if !store.send(&mut rig) {
                unanswered = Some(store.setting());
                break;
            }
            let (setting, value) = store.setting();
            known.insert(setting, value);
        }
        assert_eq!(unanswered.is_some(), flash.is_cut());
        drop(rig);
        flash.restore_power();
        let mut rig = Rig::on(flash);
        for (&setting, &value) in &known {
            let read = Store::read(&mut rig, setting);
            let new = unanswered.filter(|&(other, _)| other == setting).map(|(_, value)| value);
            assert!(
                read == value || Some(read) == new,
                "cut after {cut} of {operations}: {setting:?} is {read}, was {value}, new {new:?}"
            );
        }
        // The store goes on after the cut.
        assert!(Store::Axis(4, 999).send(&mut rig));
        rig.device.power_cycle();
        assert_eq!(rig.gap(4), 999);
    }
}

#[test]
fn a_power_cut_loses_no_answered_setting() {
    cut_everywhere(&erased().to_bytes());
}

#[test]
fn a_power_cut_loses_no_answered_setting_of_a_worn_flash() {
    cut_everywhere(&worn());
}

#[test]
fn factory_settings_are_all_or_nothing() {
    let flash = erased();
    let mut rig = Rig::on(flash.clone());
    for number in 0..30 {
        assert!(Store::Variable(number, 7).send(&mut rig));
    }
    let image = flash.to_bytes();
    let reset = Request { address: 1, opcode: 137, kind: 0, motor: 0, value: 1234 };
    for cut in 0..8 {
        let flash = SharedFlash::from_bytes(image.clone());
        let mut rig = Rig::on(flash.clone());
        flash.cut_after(cut);
        rig.bytes(Port::Usb, &reset.emit().0);
        drop(rig);
        flash.restore_power();
        let mut rig = Rig::on(flash);
        let values: Vec<_> = (0..30).map(|number| rig.ggp(number, 2)).collect();
        assert!(
            values.iter().all(|&value| value == 7) || values.iter().all(|&value| value == 0),
            "{values:?}"
        );
    }
}
