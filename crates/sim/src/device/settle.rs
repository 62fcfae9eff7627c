//! What follows from a moment: the controller is told what has changed, and how far it can go from there.

use super::{
    VirtualDevice,
    traps::Seen,
    world::{Follower, Stirred},
};
use motion::Ticks;

/// How often inputs may change one another at one and the same clock.
const MAX_SETTLING: u32 = 1000;

impl VirtualDevice {
    /// Tells the controller of inputs that changed, until none does, and how far it can go from there.
    pub(super) fn settle(&mut self) {
        if !self.is_powered {
            return;
        }
        let mut rounds = 0;
        loop {
            self.world.machine.update_contacts(self.world.now());
            match std::mem::take(&mut self.world.stirred) {
                Stirred::None => {}
                Stirred::Contacts => {
                    for contact in 0..self.world.contacts.len() {
                        self.look_at(self.world.contacts[contact]);
                    }
                }
                Stirred::Pins => (0..self.world.pins.len()).for_each(|pin| self.look_at(pin)),
            }
            self.look_at_encoders();
            if self.world.stirred == Stirred::None {
                break;
            }
            rounds += 1;
            assert!(rounds < MAX_SETTLING, "the inputs of {} do not settle", self.config.name);
        }
        self.world.look_at_watches(self.controller.as_ref());
        for axis in 0..self.world.windows.len() {
            if !self.world.is_window_stale(axis) {
                continue;
            }
            let window = self.world.window(axis);
            if self.world.windows[axis] != Some(window) {
                self.world.windows[axis] = Some(window);
                self.controller.set_window(axis, window.0, window.1);
            }
        }
    }

    fn look_at(&mut self, pin: usize) {
        if !self.world.pins[pin].kind.is_told() || self.world.is_output(pin) {
            return;
        }
        let jumped = self.world.machine.take_jump(pin);
        let level = self.world.level(pin);
        if level != self.told[pin] {
            self.tell(pin, level);
        } else if jumped && self.world.is_free(pin) && self.world.watches(pin, self.controller.as_ref()) {
            // Full steps are longer than some marks: it was on within a pulse.
            self.tell(pin, 1 - level);
            self.tell(pin, level);
        }
    }

    fn tell(&mut self, pin: usize, level: i32) {
        self.told[pin] = level;
        self.world.traps.see(pin, level, Seen::AtOnce);
        // A mark that nobody watches is seen late, if at all: a recording had better not name it.
        if self.world.watches(pin, self.controller.as_ref()) {
            self.world.record_pin(pin, level);
        }
        self.controller.input(pin, level != 0, &mut self.world);
    }

    /// Tells the controller of encoders that have come to the end of its windows, and of those that an axis
    /// follows.
    fn look_at_encoders(&mut self) {
        for channel in 0..self.world.machine.encoders() {
            if let Some(window) = self.controller.encoder_window(channel)
                && self.world.is_at_encoder_window(channel, window)
            {
                self.controller.encoder_moved(channel, &mut self.world);
            }
        }
        for number in 0..self.world.followers.len() {
            let Follower { axis, channel, count, watched } = self.world.followers[number];
            let reached = self.world.machine.encoder(channel);
            self.world.followers[number].count = reached;
            if watched && reached != count {
                self.controller.pulser(axis, reached.wrapping_sub(count), &mut self.world);
            }
        }
    }

    /// Gives the controller the counts of the hand wheels that are due.
    pub(super) fn turn_wheels(&mut self) {
        let now = self.now();
        for axis in 0..self.wheels.len() {
            while let Some(count) = self.wheels[axis].take(now) {
                self.controller.pulser(axis, count, &mut self.world);
                self.settle();
            }
        }
    }

    /// The next count of a hand wheel.
    pub(super) fn next_turn(&self) -> Ticks {
        self.wheels.iter().map(|wheel| wheel.next()).min().unwrap_or(Ticks::MAX)
    }
}
