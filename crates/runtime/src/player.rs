//! The player: the interrupt of one timer that puts pulses and outputs on the pins, each in its tick.
//!
//! It plays what is due, finds out what is next, sets the alarm for that and leaves. What is nearer than the way out
//! and in again it waits for. What it finds too late to be played on time moves everything after it: pulses never come
//! in a burst, the plan as a whole is behind from then on.

use crate::hardware::{MAX_AXES, Pins, Timer, TimerTicks};
use crate::queues::{EVENT_BIT, Event, Shared, What};
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
    /// Which of them have a pulse, and whether there is an event: the bits that are not [`Shared::starved`].
    known: u32,
    /// What happens next: pulses of these axes, or [`AN_EVENT`], or nothing.
    next: u32,
    /// When, by the timer.
    due: TimerTicks,
    /// How far the pins are behind the plan. Wraps.
    shift: u32,
    shared: &'q Shared,
    events: Consumer<'q, Event>,
    /// Events played. Wraps.
    order: u16,
    /// What the direction pins say.
    directions: [Option<Direction>; AXES],
}

/// The bit of an event.
const AN_EVENT: u32 = 1 << EVENT_BIT;

/// A player whose interrupt was compiled for its board.
///
/// [`Player::play`] is compiled by whoever calls it. An image is compiled to be small; the interrupt, a few hundred
/// instructions, has to be fast. So a board compiles it, with [`compile_players!`](crate::compile_players).
pub trait Plays<T: Timer, P: Pins> {
    /// The whole interrupt, as [`Player::play`].
    fn interrupt(&mut self, timer: &mut T, pins: &mut P);
}

/// Compiles the player's interrupt for a timer and pins, for each of these numbers of axes.
#[macro_export]
macro_rules! compile_players {
    ($timer:ty, $pins:ty: $($axes:literal)*) => {
        $(impl $crate::Plays<$timer, $pins> for $crate::Player<'_, $axes> {
            #[inline(never)]
            fn interrupt(&mut self, timer: &mut $timer, pins: &mut $pins) {
                self.play(timer, pins);
            }
        })*
    };
}

impl<'q, const AXES: usize> Player<'q, AXES> {
    pub(crate) fn new(
        queues: [Consumer<'q, Segment>; AXES],
        events: Consumer<'q, Event>,
        shared: &'q Shared,
    ) -> Self {
        const { assert!(AXES <= MAX_AXES, "too many axes") };
        Self {
            queues,
            lanes: [Segment::NONE; AXES],
            known: 0,
            next: 0,
            due: 0,
            shift: 0,
            shared,
            events,
            order: 0,
            directions: [None; AXES],
        }
    }

    /// The whole interrupt: of the alarm, and of [`kick`](crate::Hardware::kick).
    #[inline]
    pub fn play<T: Timer>(&mut self, timer: &mut T, pins: &mut impl Pins) {
        let entered = timer.now();
        let (mut now, mut moments) = (entered, MAX_MOMENTS);
        if self.shared.news.load(Relaxed) != 0 {
            self.look_around(pins);
        }
        let alarm = loop {
            if self.next == 0 {
                break None;
            }
            let late = now.wrapping_sub(self.due);
            if (late as i32) < 0 {
                if late.wrapping_neg() > T::HZ / NEAR {
                    break Some(self.due);
                }
                now = timer.now();
                continue;
            }
            if moments == 0 {
                break Some(now.wrapping_add(T::HZ / SHARE));
            }
            moments -= 1;
            let late = if late > T::HZ / TOLERANCE { self.slip(late) } else { late };
            if self.next == AN_EVENT {
                self.play_event(pins);
            } else {
                self.play_pulses(late, pins);
            }
            self.find_next();
            now = timer.now();
        };
        timer.set_alarm(alarm);
        add(&self.shared.ticks, now.wrapping_sub(entered));
    }

    /// Finds out what comes next.
    #[inline]
    fn find_next(&mut self) {
        if self.known & AN_EVENT != 0 {
            self.find_around_event();
        } else {
            self.find_first(self.known);
        }
    }

    /// The first of the pulses of these axes.
    #[inline]
    fn find_first(&mut self, axes: u32) {
        let (mut first, mut next) = (0, 0);
        for (axis, lane) in self.lanes.iter().enumerate() {
            if axes & 1 << axis != 0 {
                let due = lane.due();
                if next == 0 || (due.wrapping_sub(first) as i32) < 0 {
                    (first, next) = (due, 1 << axis);
                } else if due == first {
                    next |= 1 << axis;
                }
            }
        }
        (self.due, self.next) = (first.wrapping_add(self.shift), next);
    }

    /// Segments that were queued after the event wait for it, and it for those that were queued before.
    #[cold]
    #[inline(never)]
    fn find_around_event(&mut self) {
        let mut axes = self.known & !AN_EVENT;
        for (axis, lane) in self.lanes.iter().enumerate() {
            if lane.order.wrapping_sub(self.order) as i16 > 0 {
                axes &= !(1 << axis);
            }
        }
        match self.events.peek() {
            Some(event) if axes == 0 => {
                (self.due, self.next) = (event.due.wrapping_add(self.shift), AN_EVENT)
            }
            _ => self.find_first(axes),
        }
    }

    #[inline]
    fn play_pulses(&mut self, late: u32, pins: &mut impl Pins) {
        let (axes, due) = (self.next, self.due);
        pins.step(axes as u8);
        let mut ended = 0;
        for (axis, lane) in self.lanes.iter_mut().enumerate() {
            if axes & 1 << axis != 0 {
                pins.played(axis, lane.direction, due, late);
                if !lane.go_on() {
                    ended |= 1 << axis;
                }
            }
        }
        pins.step_end(axes as u8);
        if ended != 0 {
            self.known &= !ended;
            self.take_up(ended, pins);
        }
    }

    /// The main loop has queued something for whoever was starved.
    #[inline(never)]
    fn look_around(&mut self, pins: &mut impl Pins) {
        self.shared.news.store(0, Relaxed);
        self.take_up(!self.known, pins);
        self.find_next();
    }

    /// Takes up the next segments of these axes, and looks whether there is an event.
    #[inline(never)]
    fn take_up(&mut self, axes: u32, pins: &mut impl Pins) {
        for axis in 0..AXES {
            if axes & 1 << axis == 0 {
                continue;
            }
            let Some(segment) = self.queues[axis].peek() else { continue };
            self.lanes[axis] = *segment;
            self.queues[axis].dequeue();
            self.known |= 1 << axis;
            let Segment { direction, more, .. } = self.lanes[axis];
            add(&self.shared.pulses, more + 1);
            if self.directions[axis] != Some(direction) {
                self.directions[axis] = Some(direction);
                pins.direction(axis, direction);
            }
        }
        // After the segments: those that wait for an event are not taken up without it.
        self.known = self.known & !AN_EVENT | u32::from(self.events.ready()) << EVENT_BIT;
        self.shared.starved.store(!self.known, Relaxed);
    }

    #[cold]
    #[inline(never)]
    fn play_event(&mut self, pins: &mut impl Pins) {
        let Some(event) = self.events.dequeue() else { return };
        self.order = self.order.wrapping_add(1);
        match event.what {
            What::Drive(axis, drive) => pins.drive(axis.into(), drive),
            What::Output(pin, on) => pins.output(pin.into(), on),
            What::Release(pin) => pins.release(pin.into()),
            What::Analog(pin, value) => pins.output_analog(pin.into(), value),
        }
        self.take_up(0, pins);
    }

    /// The plan is behind by so much more, beginning with what is due now, which is not late then.
    #[cold]
    #[inline(never)]
    fn slip(&mut self, ticks: u32) -> u32 {
        self.due = self.due.wrapping_add(ticks);
        self.shift = self.shift.wrapping_add(ticks);
        self.shared.shift.store(self.shift, Relaxed);
        add(&self.shared.slips, 1);
        0
    }
}

/// Adds to a counter that nobody else writes.
fn add(counter: &AtomicU32, amount: u32) {
    counter.store(counter.load(Relaxed).wrapping_add(amount), Relaxed);
}
