//! The slow end of a ramp.
//!
//! Near standstill the speed changes so much from pulse to pulse that no block is longer than one, and each
//! pulse takes a root and a reciprocal. But as long as its limits stay, a ramp begins with the same pulses
//! every time, and another ends with the same: they are remembered. Three of them make a train, which can
//! have any three spacings.

use crate::room::Room;
use crate::speed::{Growth, Pace, Scale, Speed, SpeedSquared};
use crate::train::{Direction, EVERY_SLOT, Moment, SubTicks, Train};

/// Pulses that are remembered: as many as a word has bits.
pub const LENGTH: u32 = u64::BITS;

/// The pulses of a train with free spacings.
pub const TRIPLE: u32 = 3;

/// What a ramp is at its slow end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Key {
    pub scale: Scale,
    /// v² at the end.
    pub slow: SpeedSquared,
    pub growth: Growth,
    /// Whether the ramp leads away from it.
    pub rises: bool,
}

/// The pulses of a ramp that are nearest to its slow end.
#[derive(Clone, Debug)]
pub(crate) struct Foot {
    key: Key,
    /// A bit for each pulse.
    known: u64,
    pulses: Room<Pulses>,
}

/// What is known of pulses: their spacings, and the speeds with which they end.
#[derive(Clone, Debug)]
struct Pulses {
    spacings: [SubTicks; LENGTH as usize],
    ends: [Speed; LENGTH as usize],
}

impl Pulses {
    const UNKNOWN: Self = Self { spacings: [0; LENGTH as usize], ends: [0; LENGTH as usize] };
}

impl Foot {
    /// Nothing is known of any ramp.
    pub const fn new(scale: Scale, rises: bool) -> Self {
        let key = Key { scale, slow: 0, growth: 0, rises };
        Self { key, known: 0, pulses: Room::EMPTY }
    }

    /// Forgets everything if the ramp is another one.
    pub fn suit(&mut self, key: Key) {
        if self.key != key {
            (self.key, self.known) = (key, 0);
        }
    }

    /// The train of 1 to 3 pulses, how long it takes, and the speed with which it ends. `at` pulses lie between
    /// its first one and the slow end; `from` is the pace with which that one begins.
    #[inline(always)]
    pub fn train(
        &mut self,
        at: u32,
        count: u32,
        start: Moment,
        direction: Direction,
        from: &Pace,
    ) -> (Train, SubTicks, Speed) {
        let rises = self.key.rises;
        let last = if rises { at + (count - 1) } else { at - (count - 1) };
        let lowest = at.min(last);
        let all = (1 << count) - 1;
        if self.known >> lowest & all != all {
            self.learn(at, count, *from);
        }
        let pulses = self.pulses.get().expect("what is known has its place");
        let known = &pulses.spacings[lowest as usize..][..count as usize];
        let (interval, add, jerk, span) = match (known, rises) {
            (&[a, b, c], true) | (&[c, b, a], false) => {
                let add = b.wrapping_sub(a) as i64;
                (a, add, c.wrapping_sub(b) as i64 - add, a + b + c)
            }
            (&[a, b], true) | (&[b, a], false) => (a, b.wrapping_sub(a) as i64, 0, a + b),
            _ => (known[0], 0, 0, known[0]),
        };
        let train = Train { start, interval, add, jerk, count, direction, mask: EVERY_SLOT };
        (train, span, pulses.ends[last as usize])
    }

    /// Finds the spacings and the ends of some pulses.
    #[cold]
    #[inline(never)]
    fn learn(&mut self, at: u32, count: u32, from: Pace) {
        if self.pulses.get().is_none() {
            self.pulses.set(Some(Pulses::UNKNOWN));
        }
        let pulses = self.pulses.get_mut().expect("it was put there");
        let mut from = from.complete();
        let Key { scale, slow, growth, rises } = self.key;
        for pulse in 0..count {
            let at = if rises { at + pulse } else { at - pulse };
            let end = from.next(slow + growth * u64::from(if rises { at + 1 } else { at }));
            pulses.spacings[at as usize] = scale.mean_spacing(from.speed, end.speed);
            pulses.ends[at as usize] = end.speed;
            self.known |= 1 << at;
            from = end;
        }
    }
}

/// The slow ends of a braking ramp and of one that speeds up.
#[derive(Clone, Debug)]
pub(crate) struct Feet([Foot; 2]);

impl Feet {
    /// Nothing is known of any ramp.
    pub const fn new(scale: Scale) -> Self {
        Self([Foot::new(scale, false), Foot::new(scale, true)])
    }

    /// The foot of ramps that rise, or that fall.
    #[inline]
    pub const fn of(&mut self, rises: bool) -> &mut Foot {
        &mut self.0[rises as usize]
    }

    /// Forgets everything about a foot if the ramp is another one.
    pub fn suit(&mut self, key: Key) {
        self.of(key.rises).suit(key);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::speed::{root, square};

    /// Pulse for pulse what single pulses would be, to the last bit; and again from memory.
    #[track_caller]
    fn check(slow: u32, growth: Growth) {
        let key = Key { scale: Scale::new(38), slow: square(slow), growth, rises: true };
        let paces: Vec<_> = (0..=LENGTH.into()).map(|k| Pace::of_square(key.slow + growth * k)).collect();
        let start = Moment { ticks: 77, fraction: 1 << 30 };
        for rises in [true, false, true] {
            let mut foot = Foot::new(key.scale, rises);
            foot.suit(Key { rises, ..key });
            for at in (0..LENGTH).chain(0..LENGTH) {
                for count in 1..=TRIPLE.min(if rises { LENGTH - at } else { at + 1 }) {
                    let pace =
                        |number: u32| paces[if rises { at + number } else { at + 1 - number } as usize];
                    let (train, span, end) = foot.train(at, count, start, Direction::Positive, &pace(0));
                    let mut moment = start;
                    for number in 1..=count {
                        moment =
                            moment.after(key.scale.mean_spacing(pace(number - 1).speed, pace(number).speed));
                        assert_eq!(train.moment(number), moment, "{number} of {count} at {at}");
                    }
                    assert_eq!((train.count, start.after(span), end), (count, moment, pace(count).speed));
                }
            }
        }
    }

    #[test]
    fn a_train_of_three_has_the_spacings_of_single_pulses() {
        check(1 << 12, 1 << 30);
        check(1 << 20, 1 << 36);
        check(123_456_789, 1 << 48);
        check(1 << 30, 7);
    }

    #[test]
    fn another_ramp_is_learnt_anew() {
        let key = Key { scale: Scale::new(38), slow: 1 << 40, growth: 1 << 36, rises: true };
        let mut foot = Foot::new(key.scale, true);
        let from = Pace::of_square(key.slow);
        let mut end = |key| {
            foot.suit(key);
            foot.train(0, 1, Moment::at(0), Direction::Positive, &from).2
        };
        let slow = root((1 << 40) + (1 << 36));
        assert_eq!(end(key), slow);
        assert_eq!(end(Key { growth: 1 << 37, ..key }), root((1 << 40) + (1 << 37)));
        assert_eq!(end(key), slow);
    }
}
