//! The main loop: keeps a controller so far ahead of its pins that their interrupt always has what it needs.
//!
//! With each tick of the board's clock the controller is told what has changed, and advanced to a [horizon](HORIZON)
//! from now. What it gives out lies in queues until it is due. Bytes and inputs are told at the clock that it has
//! reached, so they act a horizon later at most.
//!
//! If the loop was away for too long (flash erases), time has stood still for the controller: its clock slips. Pulses
//! never come closer together than planned.

use crate::clock::Clock;
use crate::figures::Figures;
use crate::hardware::{Hardware, MAX_PORTS, TICK_HZ, Timer};
use crate::inputs::{Pins, analog_inputs, is_between};
use crate::outside::Outside;
use crate::queues::Plan;
use crate::serial::CHUNK_BYTES;
use devices::{Controller, PinKind};
use embedded_io::{Read as _, ReadReady as _};
use motion::Ticks;

/// How far ahead the controller is after each tick, in ticks.
pub const HORIZON: u32 = 2;

/// The plan must end so much later than now, as a part of a second, or the clock slips: the time that it takes to
/// make the next pulses.
const LEAD: u32 = 10_000;

/// Ticks from one look at analog inputs, ports and the watchdog to the next.
const HOUSEKEEPING: u32 = TICK_HZ / 1000;

/// An idle controller is advanced so often a second all the same.
const IDLE_HZ: u32 = 10;

/// How often a controller may stop at one and the same clock before that is a fault of its.
const MAX_STANDSTILL: u32 = 1000;

/// A controller with everything around it.
pub struct Loop<'q, 'c, C: Controller + ?Sized, H: Hardware, const AXES: usize> {
    controller: &'c mut C,
    outside: Outside<'q, H, AXES>,
    /// The plan is complete up to this tick.
    until: u64,
    /// The clock that the controller was advanced to. It may be behind if nothing happened.
    reached: Ticks,
    /// Ticks so far. Wraps.
    ticks: u32,
    started: bool,
}

impl<'q, 'c, C: Controller + ?Sized, H: Hardware, const AXES: usize> Loop<'q, 'c, C, H, AXES> {
    /// A controller that begins at its clock 0 with the first [turn](Self::turn).
    ///
    /// # Panics
    /// If the board has other axes than the controller, too many ports, or a timer that does not go with its clock.
    pub fn new(controller: &'c mut C, mut hardware: H, plan: Plan<'q, AXES>) -> Self {
        assert!(controller.axes().len() == AXES, "the queues are for other axes");
        assert!(hardware.ports().len() <= MAX_PORTS, "too many ports");
        let now = u64::from(hardware.now());
        let until = now + u64::from(H::Timer::HZ / TICK_HZ * HORIZON);
        let clock = Clock::new(controller.clock_hz(), H::Timer::HZ, until);
        let mut pins = Pins::new(controller.pins());
        for axis in 0..AXES {
            pins.pulsers[axis] = hardware.pulser(axis);
        }
        let outside = Outside::new(hardware, plan, clock, pins, now);
        Self { controller, outside, until, reached: 0, ticks: 0, started: false }
    }

    /// Tells the controller what is not at rest, and lets it begin. Not where the loop is made: a small stack has no
    /// room for both.
    fn start(&mut self) {
        self.poll_analog();
        self.poll_pins(true);
        self.advance_to(0);
        // From here on the clock must go with the timer; setting the outputs may have taken long.
        let now = self.outside.look();
        self.begin_at(now + u64::from(H::Timer::HZ / TICK_HZ * HORIZON));
    }

    /// What the hardware has to say.
    pub fn hardware(&mut self) -> &mut H {
        &mut self.outside.hardware
    }

    /// What was done so far.
    pub fn figures(&self) -> &Figures {
        &self.outside.figures
    }

    /// Does whatever there is to do now. Most of the time that is nothing: each interrupt wakes the loop, those of the
    /// player too.
    pub fn turn(&mut self) {
        if !core::mem::replace(&mut self.started, true) {
            self.start();
        }
        self.receive();
        if self.outside.hardware.ticked() {
            self.outside.look();
            self.ticks = self.ticks.wrapping_add(1);
            let housekeeping = self.ticks.is_multiple_of(HOUSEKEEPING);
            self.poll_pins(housekeeping);
            self.poll_counters();
            if housekeeping {
                self.poll_analog();
            }
            self.go_on();
            if housekeeping {
                self.outside.hardware.feed();
                self.outside.hardware.report(&self.outside.figures);
            }
        }
        self.outside.pump();
    }

    /// Sleeps until there may be something to do.
    pub fn rest(&mut self) {
        self.outside.rest();
    }

    /// Gives the controller bytes, as many as it can answer.
    fn receive(&mut self) {
        for number in 0..self.outside.hardware.ports().len() {
            if !self.outside.outboxes[number].has_room() {
                continue;
            }
            let (port, serial) = &mut self.outside.hardware.ports()[number];
            let Ok(true) = serial.read_ready() else { continue };
            let (port, mut bytes) = (*port, [0; CHUNK_BYTES]);
            let Ok(count @ 1..) = serial.read(&mut bytes) else { continue };
            // Pauses count from now.
            self.outside.look();
            self.catch_up();
            self.controller.receive(port, &bytes[..count], &mut self.outside);
        }
    }

    /// Tells the controller of levels that have changed. General ports are not looked at as often as switches.
    fn poll_pins(&mut self, ports: bool) {
        let ports = ports && self.outside.now >= self.outside.pins.released_at + self.outside.shift;
        for (number, pin) in self.controller.pins().iter().enumerate() {
            let looked_at = match pin.kind {
                PinKind::Port => ports && self.outside.pins.driven(number).is_none(),
                kind => kind.is_told(),
            };
            if looked_at {
                let level = self.outside.hardware.level(number);
                if self.outside.pins.tell(number, level) {
                    self.catch_up();
                    self.controller.input(number, level, &mut self.outside);
                }
            }
        }
    }

    /// Tells it of analog inputs that it compares.
    fn poll_analog(&mut self) {
        for (index, (number, _)) in analog_inputs(self.controller.pins()) {
            if self.controller.watches(number) {
                let value = self.outside.hardware.analog(number);
                if self.outside.pins.tell_analog(index, value) {
                    self.catch_up();
                    self.controller.analog_changed(number, &mut self.outside);
                }
            }
        }
    }

    /// Tells it of encoders that have left its windows, and of counts at pulser inputs.
    fn poll_counters(&mut self) {
        for axis in 0..AXES {
            if let Some(window) = self.controller.encoder_window(axis)
                && !is_between(self.outside.hardware.encoder(axis), window)
            {
                self.catch_up();
                self.controller.encoder_moved(axis, &mut self.outside);
            }
            if self.controller.has_pulser(axis) {
                let count = self.outside.hardware.pulser(axis);
                let counts =
                    count.wrapping_sub(core::mem::replace(&mut self.outside.pins.pulsers[axis], count));
                if counts != 0 && self.controller.watches_pulser(axis) {
                    self.catch_up();
                    self.controller.pulser(axis, counts, &mut self.outside);
                }
            }
        }
    }

    /// Makes the plan complete up to the horizon.
    fn go_on(&mut self) {
        let now = self.outside.look();
        let earliest = now + u64::from(H::Timer::HZ / LEAD);
        if earliest > self.until {
            self.outside.figures.slips += 1;
            self.outside.figures.slipped_ticks += earliest - self.until;
            self.begin_at(earliest);
        }
        self.until = self.until.max(now + u64::from(H::Timer::HZ / TICK_HZ * HORIZON));
        let (hz, target) = (self.controller.clock_hz(), self.outside.clock.at(self.until));
        // Of a running program the next millisecond is all that `wake` tells.
        let unknown = self.reached + Ticks::from(hz / 1000 + 1);
        let idle = !self.controller.is_moving() && self.controller.wake() > target.max(unknown);
        if target > self.reached && (!idle || target - self.reached > Ticks::from(hz / IDLE_HZ)) {
            self.advance_to(target);
        }
    }

    /// The plan goes on at a later tick.
    fn begin_at(&mut self, tick: u64) {
        self.outside.clock.slip(tick.saturating_sub(self.until));
        self.until = self.until.max(tick);
    }

    /// Before something happens to the controller its clock is that up to which the plan is complete.
    fn catch_up(&mut self) {
        let clock = self.outside.clock.at(self.until);
        if clock > self.reached {
            self.advance_to(clock);
        }
    }

    fn advance_to(&mut self, clock: Ticks) {
        self.outside.clock.move_on(self.reached);
        let mut standstill = 0;
        loop {
            let reached = self.controller.advance(clock, &mut self.outside);
            self.outside.figures.advances += 1;
            standstill = if reached == self.reached { standstill + 1 } else { 0 };
            self.reached = reached;
            // It stops where another would have to look after windows. Here they are always open.
            if reached >= clock {
                return;
            }
            assert!(standstill < MAX_STANDSTILL, "the controller makes no progress");
        }
    }
}

/// Runs a controller on a board, for ever.
///
/// # Panics
/// As [`Loop::new`].
pub fn run<C, H, const AXES: usize>(controller: &mut C, hardware: H, plan: Plan<'_, AXES>) -> !
where
    C: Controller + ?Sized,
    H: Hardware,
{
    let mut main = Loop::new(controller, hardware, plan);
    loop {
        main.turn();
        main.rest();
    }
}
