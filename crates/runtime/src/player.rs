//! The player: the interrupt of one timer that puts pulses and outputs on the pins, each in its tick.
//!
//! It plays what is due, finds out what is next, sets the alarm for that and leaves. What is nearer than the way out
//! and in again it waits for. What it finds too late to be played on time moves everything after it: pulses never come
//! in a burst, the plan as a whole is behind from then on.

use crate::hardware::{MAX_AXES, Pins, Timer, TimerTicks};
use crate::queues::{Event, Shared, What, starved};
use crate::segment::Segment;
use core::sync::atomic::{AtomicU32, Ordering::Relaxed};
use heapless::spsc::Consumer;
use motion::Direction;

/// Leaving the interrupt and entering it again takes about this part of a second.
const NEAR: u32 = 1_000_000;

/// Lateness is made up for up to this part of a second; beyond that the plan moves.
const TOLERANCE: u32 = 50_000;

/// Moments that are played before the main loop gets a share again, however near the next one is.
const MAX_MOMENTS: u32 = 64;

/// That share, as a part of a second.
const SHARE: u32 = 100_000;

/// The end of the interrupt.
pub struct Player<'q, const AXES: usize> {
    queues: [Consumer<'q, Segment>; AXES],
    /// What of each axis is played now, from the next pulse on.
    lanes: [Segment; AXES],
    /// Which of them have a pulse.
    busy: u8,
    /// What the direction pins say.
    directions: [Option<Direction>; AXES],
    events: Consumer<'q, Event>,
    /// Events played. Wraps.
    order: u16,
    /// How far the pins are behind the plan. Wraps.
    shift: u32,
    shared: &'q Shared,
}

/// What happens next: pulses of these axes, or an event where there are none.
struct Next {
    due: TimerTicks,
    axes: u8,
}

impl<'q, const AXES: usize> Player<'q, AXES> {
    const ALL: u8 = (1 << AXES) - 1;

    pub(crate) fn new(
        queues: [Consumer<'q, Segment>; AXES],
        events: Consumer<'q, Event>,
        shared: &'q Shared,
    ) -> Self {
        const { assert!(AXES <= MAX_AXES, "too many axes") };
        Self {
            queues,
            lanes: [Segment::NONE; AXES],
            busy: 0,
            directions: [None; AXES],
            events,
            order: 0,
            shift: 0,
            shared,
        }
    }

    /// The whole interrupt: of the alarm, and of [`kick`](crate::Hardware::kick).
    pub fn play<T: Timer>(&mut self, timer: &mut T, pins: &mut impl Pins) {
        let entered = timer.now();
        let mut now = entered;
        let mut pulses = 0;
        let mut moments = MAX_MOMENTS;
        self.take_up(!self.busy & Self::ALL, pins);
        let alarm = loop {
            let Some(Next { due, axes }) = self.next() else { break None };
            let mut due = due.wrapping_add(self.shift);
            let late = loop {
                let late = now.wrapping_sub(due) as i32;
                if late >= 0 || late < -((T::HZ / NEAR) as i32) {
                    break late;
                }
                now = timer.now();
            };
            if late < 0 {
                break Some(due);
            }
            if moments == 0 {
                break Some(now.wrapping_add(T::HZ / SHARE));
            }
            moments -= 1;
            let mut late = late as u32;
            if late > T::HZ / TOLERANCE {
                self.slip(late);
                (due, late) = (now, 0);
            }
            if axes == 0 {
                self.play_event(pins);
            } else {
                pulses += axes.count_ones();
                self.play_pulses(axes, due, late, pins);
            }
            now = timer.now();
        };
        timer.set_alarm(alarm);
        self.shared.starved.store(starved(!self.busy, !self.events.ready()), Relaxed);
        add(&self.shared.pulses, pulses);
        add(&self.shared.ticks, now.wrapping_sub(entered));
    }

    /// What comes next, if anything is queued.
    #[inline]
    fn next(&self) -> Option<Next> {
        let mut axes = self.busy;
        if let Some(event) = self.events.peek() {
            // Segments that were queued after it wait for it, and it for those that were queued before.
            for (axis, lane) in self.lanes.iter().enumerate() {
                if lane.order.wrapping_sub(self.order) as i16 > 0 {
                    axes &= !(1 << axis);
                }
            }
            if axes == 0 {
                return Some(Next { due: event.due, axes });
            }
        }
        let mut next: Option<Next> = None;
        for (axis, lane) in self.lanes.iter().enumerate().filter(|(axis, _)| axes >> axis & 1 != 0) {
            let due = lane.due();
            match &mut next {
                Some(next) if next.due == due => next.axes |= 1 << axis,
                Some(next) if (due.wrapping_sub(next.due) as i32) > 0 => {}
                _ => next = Some(Next { due, axes: 1 << axis }),
            }
        }
        next
    }

    #[inline]
    fn play_pulses(&mut self, axes: u8, due: TimerTicks, late: u32, pins: &mut impl Pins) {
        pins.step(axes);
        let mut ended = 0;
        for (axis, lane) in self.lanes.iter_mut().enumerate().filter(|(axis, _)| axes >> axis & 1 != 0) {
            pins.played(axis, lane.direction, due, late);
            if !lane.go_on() {
                ended |= 1 << axis;
            }
        }
        pins.step_end(axes);
        if ended != 0 {
            self.busy &= !ended;
            self.take_up(ended, pins);
        }
    }

    /// Takes up the next segments of these axes.
    fn take_up(&mut self, axes: u8, pins: &mut impl Pins) {
        for axis in (0..AXES).filter(|axis| axes >> axis & 1 != 0) {
            let Some(segment) = self.queues[axis].dequeue() else { continue };
            self.lanes[axis] = segment;
            self.busy |= 1 << axis;
            if self.directions[axis] != Some(segment.direction) {
                self.directions[axis] = Some(segment.direction);
                pins.direction(axis, segment.direction);
            }
        }
    }

    #[cold]
    fn play_event(&mut self, pins: &mut impl Pins) {
        let Some(event) = self.events.dequeue() else { return };
        self.order = self.order.wrapping_add(1);
        match event.what {
            What::Drive(axis, drive) => pins.drive(axis.into(), drive),
            What::Output(pin, on) => pins.output(pin.into(), on),
            What::Release(pin) => pins.release(pin.into()),
            What::Analog(pin, value) => pins.output_analog(pin.into(), value),
        }
    }

    /// The plan is behind by so much more.
    #[cold]
    fn slip(&mut self, ticks: u32) {
        self.shift = self.shift.wrapping_add(ticks);
        self.shared.shift.store(self.shift, Relaxed);
        add(&self.shared.slips, 1);
    }
}

/// Adds to a counter that nobody else writes.
fn add(counter: &AtomicU32, amount: u32) {
    counter.store(counter.load(Relaxed).wrapping_add(amount), Relaxed);
}
