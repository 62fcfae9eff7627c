//! An axis that goes evenly with the slots of its path.
//!
//! It steps in those slots in which its ideal position comes nearest to the next one (Bresenham's rule, in
//! whole numbers).

use super::window::{WINDOW, bits};
use crate::speed::{MAX_SPEED, Speed};
use crate::train::{Direction, MAX_SLOTS, Train};
use crate::wide;
use core::hint::select_unpredictable;

/// Parts of a window whose bits are found together.
const PARTS: u32 = 4;

/// In how many slots an axis steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Density {
    /// It takes no part.
    None,
    /// Less than one in the length of a mask.
    Few,
    /// More.
    Some,
    /// All of them.
    All,
}

/// What the axis does on the way.
#[derive(Clone, Copy, Debug)]
pub struct Straight {
    /// How many pulses, in how many slots, and which way.
    way: u32,
    slots: u32,
    direction: Direction,
    density: Density,
    /// The window that was looked at last: in which slots the axis steps.
    window: i64,
    mask: u64,
    /// By how much the ideal position is, after it, beyond the middle between the last pulse and the one before,
    /// in parts of a pulse: twice the slots. 0 to one less than a pulse.
    beyond: u64,
    /// What a part of a window adds to that, without whole pulses.
    part: u64,
    /// The slot of the next pulse, where there are few.
    next: i64,
}

impl Straight {
    /// No way.
    pub const NONE: Self = Self {
        way: 0,
        slots: 0,
        direction: Direction::Positive,
        density: Density::None,
        window: i64::MIN,
        mask: 0,
        beyond: 0,
        part: 0,
        next: 0,
    };

    /// A way that takes so many slots: as many as pulses, or more.
    pub fn new(way: i32, slots: u32) -> Self {
        let (direction, way) = (Direction::of(way.into()), way.unsigned_abs());
        let part = u64::from(way) * u64::from(2 * WINDOW / PARTS) % (2 * u64::from(slots.max(1)));
        let density = match way {
            0 => Density::None,
            way if way == slots => Density::All,
            way if way < slots / MAX_SLOTS => Density::Few,
            _ => Density::Some,
        };
        // No window is known.
        let new =
            Self { way, slots, direction, density, window: i64::MIN, mask: 0, beyond: 0, part, next: 0 };
        let next = if way == 0 { 0 } else { new.slot_of(1) };
        Self { next, ..new }
    }

    /// In how many of the slots the axis steps.
    #[inline]
    pub fn density(&self) -> Density {
        self.density
    }

    /// Which way, forward on the path or backward.
    pub fn direction(&self, ahead: bool) -> Direction {
        if ahead { self.direction } else { self.direction.reversed() }
    }

    /// The speed of the axis, for the speed of the slots.
    pub fn speed(&self, slots: u64) -> Speed {
        let all = u64::from(self.slots.max(1));
        let sum = u128::from(slots) * u128::from(self.way) + u128::from(all / 2);
        let speed = wide::quotient(sum, all.into());
        speed.min(MAX_SPEED.into()) as Speed
    }

    /// Parts of a pulse: all of it, and what a slot adds.
    fn parts(&self) -> [u64; 2] {
        [self.slots, self.way].map(|parts| 2 * u64::from(parts))
    }

    /// The ideal position after a slot and half a pulse, in parts.
    fn ideal(&self, slot: i64) -> i128 {
        2 * i128::from(self.way) * i128::from(slot) + i128::from(self.slots)
    }

    /// Pulses made after a slot.
    fn pulses(&self, slot: i64) -> i64 {
        quotient(self.ideal(slot), 2 * i64::from(self.slots))
    }

    /// The slot after which so many pulses are made.
    fn slot_of(&self, pulse: i64) -> i64 {
        let missing = i128::from(self.slots) * (2 * i128::from(pulse) - 1);
        // Rounded up.
        -quotient(-missing, 2 * i64::from(self.way))
    }

    /// Slots from `slot` to the one in which the axis has made so many more pulses; `None` if not in `count`.
    #[inline]
    pub fn slots_to(&self, room: i64, slot: i64, count: u32, ahead: bool) -> Option<u64> {
        // Mostly there is more room than that.
        let near = self.density != Density::None && room > 0 && room <= count.into();
        near.then(|| self.slots_of(room, slot, ahead))
    }

    /// Slots in which it makes so many pulses.
    #[cold]
    fn slots_of(&self, pulses: i64, slot: i64, ahead: bool) -> u64 {
        let now = self.pulses(slot);
        if ahead {
            (self.slot_of(now + pulses) - slot) as u64
        } else {
            (slot - self.slot_of(now - pulses + 1) + 1) as u64
        }
    }

    /// Pulses that are further apart than a mask is long, in a train of the path that begins after `slot`, one
    /// by one.
    pub fn follow(&mut self, path: &Train, slot: i64, ahead: bool, mut emit: impl FnMut(&Train)) {
        let slots = i64::from(path.count);
        if ahead {
            while self.next <= slot + slots {
                emit(&path.alone((self.next - slot) as u32));
                self.next = self.slot_of(self.pulses(self.next) + 1);
            }
        } else {
            let end = slot - slots;
            let mut pulse = self.pulses(slot);
            self.next = self.slot_of(pulse + 1);
            while self.slot_of(pulse) > end {
                self.next = self.slot_of(pulse);
                emit(&path.alone((slot + 1 - self.next) as u32));
                pulse -= 1;
            }
        }
    }

    /// In which of some slots after `slot` it steps: 1 to 64, the first in the lowest bit.
    #[inline]
    pub fn mask(&mut self, slot: i64, count: u32, ahead: bool) -> u64 {
        let [mask] = bits(slot, count, ahead, |window| [self.window(window)]);
        mask
    }

    /// The bits of a window.
    #[inline]
    fn window(&mut self, window: i64) -> u64 {
        if window != self.window {
            self.look_at(window);
        }
        self.mask
    }

    fn look_at(&mut self, window: i64) {
        let [whole, step] = self.parts();
        if window - 1 != self.window {
            let ideal = self.ideal(window * i64::from(WINDOW));
            self.beyond = ideal.rem_euclid(whole.into()) as u64;
        }
        // All parts at the same time, none of which waits for another.
        let mut parts = [(self.beyond, 0); PARTS as usize];
        for part in 1..parts.len() {
            let next = parts[part - 1].0 + self.part;
            parts[part].0 = if next < whole { next } else { next - whole };
        }
        for _ in 0..WINDOW / PARTS {
            for (beyond, mask) in &mut parts {
                let missed = *beyond < whole - step;
                *beyond = select_unpredictable(missed, *beyond + step, beyond.wrapping_sub(whole - step));
                *mask = *mask << 1 | u64::from(!missed);
            }
        }
        let mask = parts.iter().fold(0, |all, (_, mask)| all << (WINDOW / PARTS) | mask);
        self.mask = mask.reverse_bits();
        self.beyond = parts[parts.len() - 1].0;
        self.window = window;
    }
}

/// Rounded down; rarely by a division that takes long.
fn quotient(value: i128, by: i64) -> i64 {
    match i64::try_from(value) {
        Ok(value) => value.div_euclid(by),
        Err(_) => value.div_euclid(by.into()) as i64,
    }
}
