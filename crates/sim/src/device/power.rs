//! The supply of a controller: there or not.

use super::{VirtualDevice, world::Stirred};
use crate::{record::Note, tape::Act};

impl VirtualDevice {
    /// Switches the supply off and on again. Flash operations that are running come to their end. Without a
    /// supply, because of a fault, there is nothing to switch.
    pub fn power_cycle(&mut self) {
        self.tell_tape(|| Act::PowerCycle);
        if self.is_powered {
            self.switch_off(Flash::Finishes);
            self.switch_on("after a power cycle");
            self.tend_faults();
        }
    }

    /// Cuts the supply and switches it on again. What flash had not finished is lost or torn.
    pub fn power_cut(&mut self) {
        self.tell_tape(|| Act::PowerCut);
        if self.is_powered {
            self.switch_off(Flash::Tears);
            self.switch_on("after a power cut");
            self.tend_faults();
        }
    }

    /// Whether the controller has its supply: a fault may have taken it away.
    pub fn is_powered(&self) -> bool {
        self.is_powered
    }

    /// The supply goes: the outputs fall to rest and the motors turn freely.
    pub(super) fn switch_off(&mut self, flash: Flash) {
        self.executed = self.instructions();
        self.is_powered = false;
        self.world.set_clock(self.world.clock);
        match flash {
            Flash::Finishes => self.flash.finish(),
            Flash::Tears => self.flash.cut_now(),
        }
        self.world.power_up();
    }

    /// The supply is back: the controller starts again at its clock 0.
    pub(super) fn switch_on(&mut self, why: &str) {
        self.is_powered = true;
        self.flash.restore_power();
        self.world.power_up();
        self.world.record_note(Note::PowerUp, why);
        self.controller = (self.config.model.build)(Box::new(self.flash.clone()), self.seed);
        self.start();
    }

    /// The first moment of a controller: it is told what its inputs are unless they are at rest.
    pub(super) fn start(&mut self) {
        let pins = self.pins();
        self.told = pins.iter().map(|pin| pin.rest).collect();
        (0..pins.len()).for_each(|pin| _ = self.world.machine.take_jump(pin));
        self.world.set_clock(0);
        for (pin, description) in pins.iter().enumerate() {
            if description.kind.is_analog() && self.world.level(pin) != description.rest {
                self.controller.analog_changed(pin, &mut self.world);
            }
        }
        self.world.stirred = Stirred::Pins;
        self.settle();
        self.controller.advance(0, &mut self.world);
        self.settle();
        self.movements = self.movement();
    }

    /// Time passes without the controller: until `now`, device time.
    pub(super) fn pass_in_the_dark(&mut self, now: motion::Ticks) {
        self.world.set_clock(now - self.world.origin);
        self.world.settle_contacts();
        for wheel in &mut self.wheels {
            while wheel.take(now).is_some() {}
        }
    }
}

/// What becomes of the flash operations that are running when the supply goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Flash {
    /// They come to their end.
    Finishes,
    /// They are torn.
    Tears,
}
