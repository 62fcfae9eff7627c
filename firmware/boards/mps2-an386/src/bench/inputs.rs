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

    fn take(&self) -> [u32; SET_WORDS] {
        self.0.each_ref().map(|word| word.swap(0, Ordering::Relaxed))
    }
}

/// Levels that the player's interrupt has seen since the clock ticked: low, high.
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

/// What the main loop is told of the pins' levels: the same for as long as a tick of its clock.
pub struct Levels {
    /// What it was told last.
    told: [u32; SET_WORDS],
    /// What it had been told when the clock ticked.
    before: [u32; SET_WORDS],
    /// What the player's interrupt had seen by then: low, high.
    seen: [[u32; SET_WORDS]; 2],
}

impl Levels {
    pub const fn new() -> Self {
        Self { told: [0; SET_WORDS], before: [0; SET_WORDS], seen: [[0; SET_WORDS]; 2] }
    }

    /// The clock has ticked.
    pub fn tick(&mut self) {
        self.before = self.told;
        self.seen = SEEN.each_ref().map(PinSet::take);
    }

    /// The level of a pin: what it is now or, for a tick, what it has been in the one before. `rest` where nothing is
    /// on it.
    pub fn level(&mut self, pin: usize, rest: bool) -> bool {
        let (axis, zone, rest) = match Source::of(pin) {
            Source::Rest => return rest,
            Source::Value(value) => return value != 0,
            Source::Zone { axis, zone, rest } => (axis, zone, rest),
        };
        let (inside, ..) = zone.look(odometer(axis));
        let now = inside != rest;
        let (word, bit) = (pin / 32, 1 << (pin % 32));
        let passed = now == (self.before[word] & bit != 0) && self.seen[usize::from(!now)][word] & bit != 0;
        let level = now != passed;
        self.told[word] = if level { self.told[word] | bit } else { self.told[word] & !bit };
        level
    }
}

/// What the host wrote on the inputs, as the main loop saw it last.
pub struct Wiring {
    /// A checksum of all switches and marks.
    sum: u32,
}

impl Wiring {
    pub const fn new() -> Self {
        Self { sum: 0 }
    }

    /// Takes up what the host has changed since the last time.
    pub fn refresh(&mut self, pins: usize) {
        let mut on_axis = [[0; SET_WORDS]; MAX_AXES];
        let mut sum = FNV_START;
        for pin in 0..pins {
            if let Source::Zone { axis, zone, rest } = Source::of(pin) {
                on_axis[axis][pin / 32] |= 1 << (pin % 32);
                let words =
                    [pin as u32, axis as u32, zone.first as u32, zone.last as u32, zone.every, rest.into()];
                sum = words.into_iter().fold(sum, |sum, word| (sum ^ word).wrapping_mul(FNV_PRIME));
            }
        }
        if core::mem::replace(&mut self.sum, sum) == sum {
            return;
        }
        for (set, words) in ON_AXIS.iter().zip(on_axis) {
            for (word, value) in set.0.iter().zip(words) {
                word.store(value, Ordering::Relaxed);
            }
        }
        STALE.store(u32::MAX, Ordering::Release);
    }
}

/// Of the checksum (FNV-1a, a word at a time).
const FNV_START: u32 = 0x811C_9DC5;
const FNV_PRIME: u32 = 0x0100_0193;

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
    #[inline(never)]
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
