//! A hand wheel at the MPG input of an axis.

use motion::Ticks;
use std::collections::VecDeque;

/// Most counts that a hand wheel may have to give.
pub const MAX_COUNTS: u64 = 1 << 31;

/// Most times that it may still have to be turned.
const MAX_TURNS: usize = 1024;

/// There is no room for so many counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct TooMany;

/// Counts that come one by one, evenly spaced.
#[derive(Clone, Debug)]
pub(super) struct Wheel {
    counts_per_second: u32,
    clock_hz: u32,
    /// How far it is still to be turned, and which way, one after the other.
    turns: VecDeque<i64>,
    /// When it last stood still, and how many counts it has given since.
    since: Ticks,
    given: u64,
}

impl Wheel {
    pub fn new(counts_per_second: u32, clock_hz: u32) -> Self {
        Self { counts_per_second, clock_hz, turns: VecDeque::new(), since: 0, given: 0 }
    }

    /// Turns it on from where it will be when it has been turned as far as it was told before.
    pub fn turn(&mut self, counts: i64, now: Ticks) -> Result<(), TooMany> {
        let left: u64 = self.turns.iter().map(|turn| turn.unsigned_abs()).sum();
        if counts.unsigned_abs() > MAX_COUNTS - left || self.turns.len() == MAX_TURNS {
            return Err(TooMany);
        }
        if self.turns.is_empty() {
            (self.since, self.given) = (now, 0);
        }
        match self.turns.back_mut() {
            _ if counts == 0 => {}
            Some(last) if last.signum() == counts.signum() => *last += counts,
            _ => self.turns.push_back(counts),
        }
        Ok(())
    }

    /// When the next count comes; [`Ticks::MAX`] if none does.
    pub fn next(&self) -> Ticks {
        if self.turns.is_empty() {
            return Ticks::MAX;
        }
        let clocks = u128::from(self.given + 1) * u128::from(self.clock_hz);
        self.since.saturating_add(clocks.div_ceil(self.counts_per_second.into()) as Ticks)
    }

    /// The next count, 1 or -1, if it is due at `now`.
    pub fn take(&mut self, now: Ticks) -> Option<i32> {
        if self.next() > now {
            return None;
        }
        let turn = self.turns.front_mut()?;
        let count = turn.signum();
        *turn -= count;
        if *turn == 0 {
            self.turns.pop_front();
        }
        self.given += 1;
        Some(count as i32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_come_one_by_one() {
        let mut wheel = Wheel::new(300, 1000);
        for (counts, now) in [(2, 10), (1, 10), (0, 10), (-2, 11)] {
            wheel.turn(counts, now).unwrap();
        }
        let given: Vec<_> = (0..100).filter_map(|now| Some((now, wheel.take(now)?))).collect();
        // A count every 3 1/3 clocks, not before it is due.
        assert_eq!(given, [(14, 1), (17, 1), (20, 1), (24, -1), (27, -1)]);
        wheel.turn(-1, 500).unwrap();
        assert_eq!(wheel.next(), 504);
    }

    #[test]
    fn what_is_to_come_is_bounded() {
        let mut wheel = Wheel::new(1, 1);
        assert_eq!(wheel.turn(1 << 31, 0), Ok(()));
        assert_eq!(wheel.turn(1, 0), Err(TooMany));
        assert_eq!(wheel.turn(i64::MIN, 0), Err(TooMany));
        let mut wheel = Wheel::new(1, 1);
        let turned = (0..2000).take_while(|turn| wheel.turn(turn % 2 * 2 - 1, 0).is_ok()).count();
        assert_eq!(turned, MAX_TURNS);
    }
}
