//! Comparing a position counter with a set position, on whole trains.
//!
//! A condition holds on an arc of the 32-bit circle that the counter runs on. A train is shorter than
//! the circle, so it enters the arc at most once and leaves it at most once: two subtractions tell at
//! which pulses, and the train's polynomial tells the clocks. No pulse is stepped through.

use crate::train::{Direction, Ticks, Train};

/// A condition that a 32-bit position counter meets or not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    /// Counter = comparator.
    Equal(i32),
    /// Counter < comparator.
    Below(i32),
    /// Counter > comparator.
    Above(i32),
}

/// An output changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Change {
    /// With which pulse of the train, from 1.
    pub pulse: u32,
    /// In which clock.
    pub clock: Ticks,
    /// Whether the condition holds from then on.
    pub holds: bool,
}

impl Condition {
    /// Whether the counter meets it.
    pub const fn holds(self, counter: i32) -> bool {
        match self {
            Self::Equal(comparator) => counter == comparator,
            Self::Below(comparator) => counter < comparator,
            Self::Above(comparator) => counter > comparator,
        }
    }

    /// The changes that a train brings, in order, with the counter as it stood before the train.
    pub fn changes(self, counter: i32, train: &Train) -> impl Iterator<Item = Change> + use<> {
        let train = *train;
        let reached = |(position, holds): (i64, bool)| {
            let pulse = pulses_to(counter, position as i32, train.direction);
            (pulse <= train.count && pulse > 0).then(|| Change { pulse, clock: train.edge(pulse), holds })
        };
        let [mut one, mut two] = match self.arc() {
            None => [None, None],
            Some([low, high]) => match train.direction {
                Direction::Positive => [(low, true), (high + 1, false)].map(reached),
                Direction::Negative => [(high, true), (low - 1, false)].map(reached),
            },
        };
        if let (Some(a), Some(b)) = (&one, &two)
            && b.pulse < a.pulse
        {
            core::mem::swap(&mut one, &mut two);
        }
        one.into_iter().chain(two)
    }

    /// How far the counter can go before it changes whether it meets the condition: so many pulses down, and
    /// so many up. `None` if that never changes.
    pub fn room(self, counter: i32) -> Option<[u32; 2]> {
        use Direction::{Negative, Positive};
        let [low, high] = self.arc()?.map(|end| end as i32);
        Some(if self.holds(counter) {
            [pulses_to(counter, low, Negative) + 1, pulses_to(counter, high, Positive) + 1]
        } else {
            [pulses_to(counter, high, Negative), pulses_to(counter, low, Positive)]
        })
    }

    /// The counters that meet it, from the lowest to the highest; `None` if there are none.
    fn arc(self) -> Option<[i64; 2]> {
        let [low, high] = match self {
            Self::Equal(comparator) => [comparator.into(), comparator.into()],
            Self::Below(comparator) => [i32::MIN.into(), i64::from(comparator) - 1],
            Self::Above(comparator) => [i64::from(comparator) + 1, i32::MAX.into()],
        };
        (low <= high).then_some([low, high])
    }
}

/// Pulses from one counter to another; 0 if it is the same one.
const fn pulses_to(from: i32, to: i32, direction: Direction) -> u32 {
    match direction {
        Direction::Positive => to.wrapping_sub(from) as u32,
        Direction::Negative => from.wrapping_sub(to) as u32,
    }
}

/// How far it is from `way` to the next multiples of `period`: down and up. 0 has none.
pub const fn room(period: u32, way: i64) -> Option<[u32; 2]> {
    if period == 0 {
        return None;
    }
    let beyond = way.rem_euclid(period as i64) as u32;
    Some([if beyond == 0 { period } else { beyond }, period - beyond])
}

/// The pulses of a train that end on a multiple of `period`.
///
/// `way` is the counter's way before the train, counted from where the multiples are counted from; it
/// does not wrap, so that multiples stay evenly spaced when the counter does. Reaching the origin again
/// is a hit like every other multiple. A period of 0 is never hit.
pub fn multiples(period: u32, way: i64, train: &Train) -> Multiples {
    let first = match (room(period, way), train.direction) {
        (None, _) => u32::MAX,
        (Some([down, _]), Direction::Negative) => down,
        (Some([_, up]), Direction::Positive) => up,
    };
    let left = if period == 0 || first > train.count { 0 } else { (train.count - first) / period + 1 };
    Multiples { train: *train, way, period, next: first, left }
}

/// A multiple is reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hit {
    /// With which pulse of the train, from 1.
    pub pulse: u32,
    /// In which clock.
    pub clock: Ticks,
    /// The multiple: the way from the origin.
    pub way: i64,
}

/// Iterator over the multiples that a train reaches, in order.
#[derive(Clone, Debug)]
pub struct Multiples {
    train: Train,
    way: i64,
    period: u32,
    next: u32,
    left: u32,
}

impl Iterator for Multiples {
    type Item = Hit;

    fn next(&mut self) -> Option<Hit> {
        self.left = self.left.checked_sub(1)?;
        let pulse = self.next;
        self.next = pulse.saturating_add(self.period);
        let way = self.way + self.train.direction.sign() * i64::from(pulse);
        Some(Hit { pulse, clock: self.train.edge(pulse), way })
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.left as usize, Some(self.left as usize))
    }
}

impl ExactSizeIterator for Multiples {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::train::{EVERY_SLOT, Moment};

    fn train(direction: Direction, count: u32) -> Train {
        // Longer and longer spacings, so that every clock belongs to one pulse.
        Train {
            start: Moment::at(5000),
            interval: 90 << 32,
            add: 3 << 31,
            jerk: 0,
            count,
            direction,
            mask: EVERY_SLOT,
        }
    }

    /// The room as the first change that a train brings.
    fn check_room(condition: Condition, counter: i32) {
        let first = |direction| {
            let train = Train { interval: 1 << 20, add: 0, count: u32::MAX, ..train(direction, 1) };
            condition.changes(counter, &train).next().map(|change| change.pulse)
        };
        let expected = first(Direction::Negative).zip(first(Direction::Positive)).map(Into::into);
        assert_eq!(condition.room(counter), expected, "{condition:?} from {counter}");
    }

    /// Against stepping through every pulse.
    fn check(condition: Condition, counter: i32, train: Train) {
        let mut expected = Vec::new();
        let mut at = counter;
        for (pulse, clock) in (1..).zip(train.edges()) {
            let before = condition.holds(at);
            at = at.wrapping_add(train.direction.sign() as i32);
            if condition.holds(at) != before {
                expected.push(Change { pulse, clock, holds: !before });
            }
        }
        let got: Vec<_> = condition.changes(counter, &train).collect();
        assert_eq!(got, expected, "{condition:?} from {counter}, {train:?}");
    }

    #[test]
    fn changes_are_those_of_single_pulses() {
        use Condition::{Above, Below, Equal};
        let near = |middle: i32| (-12..=12).map(move |offset: i32| middle.wrapping_add(offset));
        for direction in [Direction::Negative, Direction::Positive] {
            for count in [1, 2, 7, 12] {
                let train = train(direction, count);
                for comparator in [0, -1, 1000, i32::MIN, i32::MIN + 1, i32::MAX - 1, i32::MAX] {
                    // Near the comparator, and near the counter's wrap.
                    for counter in near(comparator).chain(near(i32::MAX)) {
                        for condition in [Equal(comparator), Below(comparator), Above(comparator)] {
                            check(condition, counter, train);
                            check_room(condition, counter);
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn a_long_cruise_takes_no_steps() {
        let train = Train {
            start: Moment::at(0),
            interval: 1 << 28,
            add: 0,
            jerk: 0,
            count: u32::MAX,
            direction: Direction::Positive,
            mask: EVERY_SLOT,
        };
        // The counter comes around to one below where it began.
        let changes: Vec<_> = Condition::Equal(-5).changes(-4, &train).collect();
        assert_eq!(changes, [Change { pulse: u32::MAX, clock: u64::from(u32::MAX) >> 4, holds: true }]);
        let changes: Vec<_> = Condition::Above(1 << 30).changes(0, &train).collect();
        let pulses = changes.iter().map(|change| (change.pulse, change.holds)).collect::<Vec<_>>();
        assert_eq!(pulses, [((1 << 30) + 1, true), (1 << 31, false)]);
    }

    fn check_multiples(period: u32, way: i64, train: Train) {
        let mut expected = Vec::new();
        let mut at = way;
        for (pulse, clock) in (1..).zip(train.edges()) {
            at += train.direction.sign();
            if period != 0 && at % i64::from(period) == 0 {
                expected.push(Hit { pulse, clock, way: at });
            }
        }
        let hits = multiples(period, way, &train);
        assert_eq!(hits.len(), expected.len());
        assert_eq!(hits.collect::<Vec<_>>(), expected, "every {period} from {way}, {train:?}");
    }

    #[test]
    fn multiples_are_those_of_single_pulses() {
        for direction in [Direction::Negative, Direction::Positive] {
            for count in [1, 5, 40] {
                for period in [0, 1, 2, 7, 40, 41, u32::MAX] {
                    for way in (-45..45).chain([1 << 40, -(1 << 40)]) {
                        check_multiples(period, way, train(direction, count));
                    }
                }
            }
        }
    }

    #[test]
    fn the_last_multiple_of_a_full_train_is_found() {
        let train = Train { interval: 1 << 20, count: u32::MAX, ..train(Direction::Negative, 1) };
        let train = Train { add: 0, ..train };
        let mut hits = multiples(1 << 31, 0, &train);
        assert_eq!(hits.next().map(|hit| (hit.pulse, hit.way)), Some((1 << 31, -(1 << 31))));
        assert_eq!(hits.next(), None);
        assert_eq!(multiples(u32::MAX, 0, &train).map(|hit| hit.pulse).collect::<Vec<_>>(), [u32::MAX]);
    }
}
