//! The programs of a device line by line, for debuggers.
//!
//! Whether somebody looks at each line or nobody does, the device does the same in the same clocks: a line that is
//! looked at is held in the middle of its clock, with all done that comes before it and nothing that comes after.

use super::{MAX_STANDSTILL, PinValue, VirtualDevice, pins};
use crate::tape::Act;
use devices::{
    Lines,
    inspect::{Inspect, Quantity},
};
use motion::Ticks;

impl VirtualDevice {
    /// Lets time pass until a line of a program is due, or until the end of clock `until`. Gives the program's
    /// number if a line is due; it is not executed yet. Something that happens by itself ends it too if `wakes`.
    pub fn advance_to_line(&mut self, until: Ticks, wakes: bool) -> Option<usize> {
        let mut standstill = 0;
        loop {
            // A controller whose supply comes back knows nothing of it.
            self.gate(Lines::None);
            let before = self.now();
            let stop = if wakes { self.stop().min(self.wake()) } else { self.stop() };
            self.step(stop.min(until).max(before));
            if self.is_held() {
                return self.controller.inspect()?.next_program().map(|(_, program)| program);
            }
            let now = self.now();
            if now >= until && self.stop() > now || wakes && now > before {
                return None;
            }
            standstill = if now == before { standstill + 1 } else { 0 };
            assert!(standstill < MAX_STANDSTILL, "{} makes no progress at clock {now}", self.config.name);
        }
    }

    /// Executes the line that [`advance_to_line`](Self::advance_to_line) has come to, in its clock.
    pub fn execute_line(&mut self) {
        self.gate(Lines::One);
        for _ in 0..MAX_STANDSTILL {
            let now = self.now() - self.world.origin;
            let due = |it: &mut dyn Inspect| {
                it.gate().allowed() == Lines::One && it.next_program().is_some_and(|(at, _)| at <= now)
            };
            if !self.controller.inspect().is_some_and(due) {
                return;
            }
            self.step(self.now());
        }
        panic!("{} does not execute a line", self.config.name);
    }

    /// Lets lines pass without holding them.
    pub fn release_lines(&mut self) {
        self.gate(Lines::Any);
        self.gated = false;
    }

    /// Whether a line of a program is due that a debugger holds.
    pub fn is_held(&mut self) -> bool {
        self.is_powered && self.controller.inspect().is_some_and(|it| it.gate().is_held())
    }

    /// The address of a program's next line.
    pub fn address(&mut self, program: usize) -> Option<u16> {
        self.controller.inspect()?.address(program)
    }

    /// Where a program is: see [`Inspect::frames`].
    pub fn frames(&mut self, program: usize) -> Vec<u16> {
        self.controller.inspect().map(|it| it.frames(program)).unwrap_or_default()
    }

    /// The value of a quantity of the controller, or what is on a pin; `None` if nothing has this name. Nothing
    /// is changed by looking at it.
    pub fn value(&mut self, name: &str) -> Option<PinValue> {
        let value = self.controller.inspect().and_then(|it| it.value(name, &mut self.world));
        let pin = || pins::find(self.world.pins, name).ok();
        let level = |pin: usize| pins::from_level(&self.world.pins[pin], self.world.level(pin));
        value.map(PinValue::Number).or_else(|| pin().map(level))
    }

    /// Sets a register of a program that no host can set; false if there is none of this name, or no supply.
    pub fn set_register(&mut self, name: &str, value: i32) -> bool {
        let set = self.is_powered && self.controller.inspect().is_some_and(|it| it.set_register(name, value));
        if set {
            self.tell_tape(|| Act::Register(name.into(), value));
        }
        set
    }

    /// Every quantity of the controller that has a value, pins left out.
    pub fn quantities(&mut self) -> Vec<Quantity> {
        self.controller.inspect().map(|it| it.quantities()).unwrap_or_default()
    }

    /// Lets time pass until `now`, or the first change of an input before it. While a fault waits for a line of a
    /// program, each line is held until it is known whether this is the one: a fault begins before it, in its clock.
    /// Lines take time, and there are so many faults at most: that ends it.
    pub(super) fn step(&mut self, now: Ticks) {
        let mut lines = Lines::None;
        loop {
            let watches = self.is_powered && self.faults.wait_for_lines();
            let is_ours = watches && !self.gated;
            if is_ours {
                self.allow(lines);
            }
            self.step_to_line(now);
            let is_held = watches && self.is_held();
            let has_begun = is_held && self.reach_line();
            if is_ours {
                self.allow(Lines::Any);
            }
            if !is_ours || !is_held {
                return;
            }
            // What has begun may have put another line in the place of this one.
            lines = if has_begun { Lines::None } else { Lines::One };
        }
    }

    /// Faults that wait for the line that is held begin. Whether there was one.
    fn reach_line(&mut self) -> bool {
        let line = self.controller.inspect().and_then(|it| {
            let (_, program) = it.next_program()?;
            Some((program, it.address(program)?))
        });
        line.is_some_and(|(program, address)| self.release_at_line(program, address.into()))
    }

    fn gate(&mut self, lines: Lines) {
        self.gated = true;
        self.allow(lines);
    }

    fn allow(&mut self, lines: Lines) {
        if let Some(it) = self.controller.inspect() {
            it.gate().allow(lines);
        }
    }
}
