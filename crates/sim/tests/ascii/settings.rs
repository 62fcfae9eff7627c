//! Settings survive: what is stored, and a power cut at every single flash operation.

use super::rig::Rig;
use crate::controller::MODEL;
use crate::settings::{BEFORE_ITEMS, BEFORE_OTHERS, ITEMS, NOT_STORED};
use devices::model;
use sim::SharedFlash;

/// A new flash.
pub fn erased() -> SharedFlash {
    SharedFlash::erased(model(MODEL).expect("the model exists").flash_bytes)
}

fn set(rig: &mut Rig, values: &[String]) {
    rig.ok(BEFORE_ITEMS);
    for ((name, _), value) in ITEMS.iter().zip(values) {
        rig.ok(&format!("{name}={value}"));
    }
}

/// Sets all items to one of their two values.
pub fn write(rig: &mut Rig, which: usize) {
    set(rig, &values(which));
}

fn set_others(rig: &mut Rig) {
    rig.ok(BEFORE_OTHERS);
    for (name, value) in NOT_STORED {
        rig.ok(&format!("{name}={value}"));
        rig.check(name, value);
    }
}

/// The items as they are.
pub fn read(rig: &mut Rig) -> Vec<String> {
    ITEMS.iter().map(|(name, _)| rig.say(name)).collect()
}

/// One of the two values of all items.
pub fn values(which: usize) -> Vec<String> {
    ITEMS.iter().map(|(_, values)| values[which].to_owned()).collect()
}

/// Every item is stored by `STORE`, and nothing else.
#[track_caller]
pub fn every_item_is_stored() {
    let mut rig = Rig::on(erased());
    let defaults = read(&mut rig);
    set_others(&mut rig);
    write(&mut rig, 0);
    assert_eq!(read(&mut rig), values(0));
    // Without STORE nothing is kept.
    rig.power_cycle();
    assert_eq!(read(&mut rig), defaults);
    for which in [0, 1] {
        set_others(&mut rig);
        write(&mut rig, which);
        rig.ok("STORE");
        rig.power_cycle();
        assert_eq!(read(&mut rig), values(which));
        rig.ok(BEFORE_ITEMS);
        for (name, value) in NOT_STORED.iter().filter(|(name, _)| *name != "IO") {
            assert_ne!(rig.say(name), *value, "{name}");
        }
    }
    // Defaults can be stored again.
    set(&mut rig, &defaults);
    rig.ok("STORE");
    rig.power_cycle();
    assert_eq!(read(&mut rig), defaults);
}

/// All old or all new, whichever flash operation the power is cut at; new if `STORE` was answered.
pub fn cut_everywhere(start: &[u8]) {
    let flash = SharedFlash::from_bytes(start.to_vec());
    let mut rig = Rig::on(flash.clone());
    let before = flash.operations();
    write(&mut rig, 1);
    rig.ok("STORE");
    let operations = flash.operations() - before;
    assert!(operations > 5, "{operations}");
    let defaults = read(&mut Rig::on(erased()));
    for cut in 0..=operations {
        let flash = SharedFlash::from_bytes(start.to_vec());
        flash.set_seed(cut);
        let mut rig = Rig::on(flash.clone());
        write(&mut rig, 1);
        flash.cut_after(cut);
        let answered = rig.say("STORE") == "OK";
        flash.restore_power();
        let mut rig = Rig::on(flash.clone());
        let found = read(&mut rig);
        if answered {
            assert_eq!(found, values(1), "cut at {cut}");
        } else {
            assert!(found == values(0) || found == values(1), "cut at {cut}: {found:?}");
        }
        // What the cut left behind does not show in a store of less.
        let other = SharedFlash::from_bytes(flash.to_bytes());
        let mut less = Rig::on(other.clone());
        set(&mut less, &defaults);
        less.ok("STORE");
        assert_eq!(read(&mut Rig::on(other)), defaults, "less after the cut at {cut}");
        // And it can be stored again.
        write(&mut rig, 0);
        rig.ok("V33=1 STORE");
        let mut rig = Rig::on(flash);
        assert_eq!(read(&mut rig), values(0), "after the cut at {cut}");
    }
}

#[test]
fn a_store_is_all_old_or_all_new() {
    let flash = erased();
    let mut rig = Rig::on(flash.clone());
    write(&mut rig, 0);
    rig.ok("STORE");
    cut_everywhere(&flash.to_bytes());
}
