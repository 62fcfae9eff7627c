//! The board as the controller sees it: what it does is put into queues, with the tick at which it happens.

use crate::clock::Clock;
use crate::figures::Figures;
use crate::hardware::{Hardware, MAX_PORTS, Timer, TimerTicks};
use crate::inputs::Pins;
use crate::queues::{EVENT_BIT, Event, Plan, What};
use crate::serial::Outbox;
use core::sync::atomic::Ordering::Relaxed;
use devices::{Board, Drive, Port};
use motion::{Ticks, Train};

/// Everything that is not the controller.
pub(crate) struct Outside<'q, H: Hardware, const AXES: usize> {
    pub hardware: H,
    pub plan: Plan<'q, AXES>,
    pub clock: Clock,
    pub pins: Pins,
    pub outboxes: [Outbox; MAX_PORTS],
    pub figures: Figures,
    /// Timer ticks since the start, as of the last look.
    pub now: u64,
    /// How far the pins are behind the plan.
    pub shift: u64,
    /// Slips of the player that are counted.
    slips: u32,
    /// When the main loop woke, and the ticks of the player until then. Both wrap.
    woke: TimerTicks,
    played: u32,
    /// When what the controller does now is due.
    due: u64,
}

impl<'q, H: Hardware, const AXES: usize> Outside<'q, H, AXES> {
    pub fn new(hardware: H, plan: Plan<'q, AXES>, clock: Clock, pins: Pins, now: u64) -> Self {
        let due = clock.tick(0);
        Self {
            hardware,
            plan,
            clock,
            pins,
            outboxes: [const { Outbox::new() }; MAX_PORTS],
            figures: Figures::default(),
            now,
            shift: 0,
            slips: 0,
            played: 0,
            woke: now as TimerTicks,
            due,
        }
    }

    /// Looks at the time and what the player has done; the tick of the plan that is due.
    pub fn look(&mut self) -> u64 {
        extend(&mut self.now, self.hardware.now());
        let (shared, figures) = (self.plan.shared(), &mut self.figures);
        let before = self.shift;
        extend(&mut self.shift, shared.shift.load(Relaxed));
        extend(&mut figures.pulses, shared.pulses.load(Relaxed));
        extend(&mut figures.player_ticks, shared.ticks.load(Relaxed));
        let slips = shared.slips.load(Relaxed);
        figures.slips += slips.wrapping_sub(core::mem::replace(&mut self.slips, slips));
        figures.slipped_ticks += self.shift - before;
        self.now.saturating_sub(self.shift)
    }

    /// Nothing to do until the next interrupt.
    pub fn rest(&mut self) {
        let player = self.plan.shared().ticks.load(Relaxed).wrapping_sub(self.played);
        let awake = self.hardware.now().wrapping_sub(self.woke).wrapping_sub(player);
        self.figures.awake_ticks += u64::from(awake);
        self.hardware.rest();
        self.woke = self.hardware.now();
        self.played = self.plan.shared().ticks.load(Relaxed);
    }

    /// Sends what the ports take.
    pub fn pump(&mut self) {
        for ((_, serial), outbox) in self.hardware.ports().iter_mut().zip(&mut self.outboxes) {
            outbox.pump(serial, self.now);
        }
    }

    /// Queues an event; waits while there is no room.
    fn happen(&mut self, what: What) {
        let event = Event { due: self.due as u32, what };
        while !self.plan.push_event(event) {
            self.rest();
        }
        if self.plan.has_news(EVENT_BIT) {
            self.hardware.kick();
        }
    }
}

impl<H: Hardware, const AXES: usize> Board for Outside<'_, H, AXES> {
    fn clock(&mut self, now: Ticks) {
        self.due = self.clock.tick(now);
    }

    fn pulses(&mut self, axis: usize, train: &Train) {
        let (mut left, order) = (Some(*train), self.plan.order());
        while let Some(segment) = self.clock.next_segment(&mut left, order) {
            while !self.plan.push_segment(axis, segment) {
                self.rest();
            }
            if self.plan.has_news(axis) {
                self.hardware.kick();
            }
        }
    }

    fn drive(&mut self, axis: usize, drive: Drive) {
        self.happen(What::Drive(axis as u8, drive));
    }

    fn send(&mut self, port: Port, bytes: &[u8], delay_ms: u32) {
        let pause = u64::from(delay_ms) * u64::from(H::Timer::HZ / 1000);
        let due = (delay_ms > 0).then_some(self.now + pause);
        let number = self.hardware.ports().iter().position(|(other, _)| *other == port);
        let Some(outbox) = number.and_then(|number| self.outboxes.get_mut(number)) else { return };
        if !outbox.push(bytes, due) {
            self.figures.dropped_replies += 1;
        }
    }

    fn output(&mut self, pin: usize, on: bool) {
        self.pins.drive(pin, on);
        self.happen(What::Output(pin as u8, on));
    }

    fn release(&mut self, pin: usize) {
        self.pins.release(pin);
        self.pins.released_at = self.due + u64::from(H::Timer::HZ / 1000);
        self.happen(What::Release(pin as u8));
    }

    fn output_analog(&mut self, pin: usize, value: i32) {
        self.happen(What::Analog(pin as u8, value));
    }

    fn encoder(&mut self, channel: usize) -> i32 {
        self.hardware.encoder(channel)
    }

    fn digital(&mut self, pin: usize) -> bool {
        match self.pins.driven(pin) {
            Some(level) => level,
            None => self.hardware.level(pin),
        }
    }

    fn load(&mut self, axis: usize) -> u16 {
        self.hardware.load(axis)
    }

    fn analog(&mut self, pin: usize) -> i32 {
        self.hardware.analog(pin)
    }
}

/// Takes a counter of 64 bits to where one of 32 bits that wraps has come.
fn extend(total: &mut u64, low: u32) {
    *total += u64::from(low.wrapping_sub(*total as u32));
}
