//! What lies between the main loop and the player's interrupt: queues of fixed size with one end each, and a few
//! words that one side writes and the other reads.
//!
//! The order of things: pulses of an axis are in its queue one after the other. Events, which are outputs and driver
//! stages, have a queue of their own and a number. A segment says how many events were queued before it, so the player
//! can put both in the order in which the controller gave them out, whatever the rounding of ticks makes of it.

use crate::hardware::{MAX_AXES, TimerTicks};
use crate::player::Player;
use crate::segment::Segment;
use core::sync::atomic::{AtomicU32, Ordering::Relaxed, Ordering::SeqCst, fence};
use devices::Drive;
use heapless::spsc::{Producer, Queue};

/// Segments that an axis has room for, and one.
pub const SEGMENTS: usize = 16;

/// Events that there is room for, and one: a command may change 32 ports.
pub const EVENTS: usize = 48;

const _: () = assert!(size_of::<Segment>() <= 48 && size_of::<Event>() <= 12, "RAM is scarce");

/// An output or a driver stage changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Event {
    pub due: TimerTicks,
    pub what: What,
}

/// What changes. Pins and axes are numbered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum What {
    Drive(u8, Drive),
    Output(u8, bool),
    Release(u8),
    Analog(u8, i32),
}

/// The bit of [`Shared::starved`] that stands for events; below it is one for each axis.
pub(crate) const EVENT_BIT: usize = MAX_AXES;

/// What both sides see. Only the player writes it, but for `news`.
#[derive(Debug)]
pub(crate) struct Shared {
    /// Something is queued for whoever was starved: set by the main loop before it kicks, cleared by the player.
    pub news: AtomicU32,
    /// Whose queues were empty when the player looked: it does not look again by itself.
    pub starved: AtomicU32,
    /// By how many ticks the pins are behind what is planned. Wraps.
    pub shift: AtomicU32,
    /// How often that has grown.
    pub slips: AtomicU32,
    /// Pulses played. Wraps.
    pub pulses: AtomicU32,
    /// Ticks spent. Wraps.
    pub ticks: AtomicU32,
}

/// The queues: a static of the image.
#[derive(Debug)]
pub struct Queues<const AXES: usize> {
    segments: [Queue<Segment, SEGMENTS>; AXES],
    events: Queue<Event, EVENTS>,
    shared: Shared,
}

impl<const AXES: usize> Queues<AXES> {
    /// Empty queues.
    pub const fn new() -> Self {
        const { assert!(AXES <= MAX_AXES, "too many axes") };
        Self {
            segments: [const { Queue::new() }; AXES],
            events: Queue::new(),
            shared: Shared {
                news: AtomicU32::new(0),
                starved: AtomicU32::new(u32::MAX),
                shift: AtomicU32::new(0),
                slips: AtomicU32::new(0),
                pulses: AtomicU32::new(0),
                ticks: AtomicU32::new(0),
            },
        }
    }

    /// The end of the main loop and that of the interrupt.
    pub fn split(&mut self) -> (Plan<'_, AXES>, Player<'_, AXES>) {
        let mut ends = heapless::Vec::<_, AXES>::new();
        let segments = self.segments.each_mut().map(|queue| {
            let (producer, consumer) = queue.split();
            let pushed = ends.push(consumer);
            assert!(pushed.is_ok(), "there is room for every axis");
            producer
        });
        let ends = ends.into_array().unwrap_or_else(|_| unreachable!("each axis has a queue"));
        let (events, event_end) = self.events.split();
        let plan = Plan { segments, events, order: 0, shared: &self.shared };
        (plan, Player::new(ends, event_end, &self.shared))
    }
}

impl<const AXES: usize> Default for Queues<AXES> {
    fn default() -> Self {
        Self::new()
    }
}

/// The end of the main loop.
pub struct Plan<'q, const AXES: usize> {
    segments: [Producer<'q, Segment>; AXES],
    events: Producer<'q, Event>,
    /// Events queued so far. Wraps.
    order: u16,
    shared: &'q Shared,
}

impl<const AXES: usize> Plan<'_, AXES> {
    pub(crate) fn shared(&self) -> &Shared {
        self.shared
    }

    pub(crate) fn order(&self) -> u16 {
        self.order
    }

    /// Queues a segment; false if there is no room.
    pub(crate) fn push_segment(&mut self, axis: usize, segment: Segment) -> bool {
        self.segments[axis].enqueue(segment).is_ok()
    }

    /// Queues an event; false if there is no room.
    pub(crate) fn push_event(&mut self, event: Event) -> bool {
        // Rust 1.95 may drop the addition where the result is kept as a `bool`, added and branched on
        // (rust-lang/rust#158206).
        if self.events.enqueue(event).is_err() {
            return false;
        }
        self.order = self.order.wrapping_add(1);
        true
    }

    /// Whether the player does not know what was queued for this axis or as an event, and has to be kicked.
    pub(crate) fn has_news(&self, bit: usize) -> bool {
        // An interrupt that comes between finds what is queued, one that came before has set the bit.
        fence(SeqCst);
        let news = self.shared.starved.load(Relaxed) >> bit & 1 != 0;
        if news {
            self.shared.news.store(1, Relaxed);
        }
        news
    }
}
