//! What is on the pins from outside, as the host wrote it, and as the shafts stand that the pulses have turned.
//!
//! A mark may be one pulse wide, and gone before the main loop looks. So the player's interrupt looks where a level
//! changes on the way, and remembers it in [`Seen`].

use super::page::{Input, PINS};
use super::zone::Zone;
use crate::registers::PAGE;
use core::sync::atomic::{AtomicU32, Ordering};
use runtime::hardware::MAX_AXES;
use tock_registers::interfaces::Readable;

/// Words of a set of pins.
pub const SET_WORDS: usize = PINS / 32;

/// Pins, one bit each.
pub struct PinSet([AtomicU32; SET_WORDS]);

impl PinSet {
    const fn empty() -> Self {
        Self([const { AtomicU32::new(0) }; SET_WORDS])
    }

    fn put(&self, pin: usize) {
        self.0[pin / 32].fetch_or(1 << (pin % 32), Ordering::Relaxed);
    }

    fn take(&self, pin: usize) -> bool {
        let bit = 1 << (pin % 32);
        self.0[pin / 32].fetch_and(!bit, Ordering::Relaxed) & bit != 0
    }
}

/// Levels that the player's interrupt has seen since the main loop looked last: low, high.
static SEEN: [PinSet; 2] = [const { PinSet::empty() }; 2];

/// The pins whose level depends on the odometer of each axis.
static ON_AXIS: [PinSet; MAX_AXES] = [const { PinSet::empty() }; MAX_AXES];

/// The axes whose windows may be others now.
static STALE: AtomicU32 = AtomicU32::new(0);

/// The kinds of [`Input`].
mod kind {
    pub const VALUE: u32 = 1;
    pub const ZONE: u32 = 2;
}

/// What an input says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Nothing is on it.
    Rest,
    /// A level or a value.
    Value(i32),
    /// A switch or mark of an axis; the level outside of it.
    Zone { axis: usize, zone: Zone, rest: bool },
}

impl Source {
    /// As the host wrote it. An axis that there is not counts as nothing.
    pub fn of(pin: usize) -> Self {
        let Some(input): Option<&Input> = PAGE.input.get(pin) else { return Self::Rest };
        match input.kind.get() {
            kind::VALUE => Self::Value(input.value.get() as i32),
            kind::ZONE if input.value.get() < MAX_AXES as u32 => Self::Zone {
                axis: input.value.get() as usize,
                zone: Zone {
                    first: input.first.get() as i32,
                    last: input.last.get() as i32,
                    every: input.every.get(),
                },
                rest: input.rest.get() != 0,
            },
            _ => Self::Rest,
        }
    }
}

/// The odometer of an axis, in net pulses that were played.
pub fn odometer(axis: usize) -> i32 {
    PAGE.odometer[axis].get() as i32
}

/// What the main loop is told of a pin's level.
pub struct Levels {
    /// What it was told last.
    told: [u32; SET_WORDS],
}

impl Levels {
    pub const fn new() -> Self {
        Self { told: [0; SET_WORDS] }
    }

    /// The level of a pin: what it is now or, for once, what it has been since the last call. `rest` where nothing
    /// is on it.
    pub fn level(&mut self, pin: usize, rest: bool) -> bool {
        let (axis, zone, rest) = match Source::of(pin) {
            Source::Rest => return rest,
            Source::Value(value) => return value != 0,
            Source::Zone { axis, zone, rest } => (axis, zone, rest),
        };
        // First what has been, then what is: a change between the two is seen twice, and not missed.
        let seen = [SEEN[0].take(pin), SEEN[1].take(pin)];
        let (inside, ..) = zone.look(odometer(axis));
        let now = inside != rest;
        let bit = 1 << (pin % 32);
        let told = self.told[pin / 32] & bit != 0;
        let level = if now == told && seen[usize::from(!now)] { !now } else { now };
        self.told[pin / 32] = if level { self.told[pin / 32] | bit } else { self.told[pin / 32] & !bit };
        level
    }
}

/// Takes up what the host has changed since the last time. From the main loop.
pub fn refresh(pins: usize) {
    let mut on_axis = [[0; SET_WORDS]; MAX_AXES];
    for pin in 0..pins {
        if let Source::Zone { axis, .. } = Source::of(pin) {
            on_axis[axis][pin / 32] |= 1 << (pin % 32);
        }
    }
    for (set, words) in ON_AXIS.iter().zip(on_axis) {
        for (word, value) in set.0.iter().zip(words) {
            word.store(value, Ordering::Relaxed);
        }
    }
    STALE.store(u32::MAX, Ordering::Release);
}

/// The player's view of an axis: until where no input changes.
pub struct Window {
    below: i32,
    above: i32,
    /// The levels of its pins.
    levels: [u32; SET_WORDS],
}

impl Window {
    pub const fn new() -> Self {
        Self { below: 0, above: 0, levels: [0; SET_WORDS] }
    }

    /// A pulse took the axis to this odometer.
    #[inline]
    pub fn pass(&mut self, axis: usize, odometer: i32) {
        let inside = self.below < odometer && odometer < self.above;
        if !inside || STALE.load(Ordering::Relaxed) & 1 << axis != 0 {
            self.look(axis, odometer);
        }
    }

    #[cold]
    fn look(&mut self, axis: usize, odometer: i32) {
        STALE.fetch_and(!(1 << axis), Ordering::Acquire);
        let (mut below, mut above) = (i64::from(i32::MIN) - 1, i64::from(i32::MAX) + 1);
        for (index, word) in ON_AXIS[axis].0.iter().enumerate() {
            let mut left = word.load(Ordering::Relaxed);
            while left != 0 {
                let bit = left & left.wrapping_neg();
                left ^= bit;
                let pin = index * 32 + bit.trailing_zeros() as usize;
                let Source::Zone { axis: on, zone, rest } = Source::of(pin) else { continue };
                if on != axis {
                    continue;
                }
                let (inside, low, high) = zone.look(odometer);
                (below, above) = (below.max(low), above.min(high));
                let level = inside != rest;
                if level != (self.levels[index] & bit != 0) {
                    self.levels[index] ^= bit;
                    SEEN[usize::from(level)].put(pin);
                }
            }
        }
        // An odometer at the end of its range looks at every pulse.
        self.below = below.max(i64::from(i32::MIN)) as i32;
        self.above = above.min(i64::from(i32::MAX)) as i32;
    }
}
