//! A contact that opens and closes a few times before it stays.

use motion::Ticks;
use rand_pcg::{Pcg32, rand_core::Rng as _};

/// Longest time that a contact may bounce, in milliseconds.
pub const MAX_BOUNCE_MS: u32 = 1000;

/// A contact comes apart this often at most.
const MAX_REBOUNDS: u32 = 4;

/// When a contact comes apart and together again after each change. The times are random, always the same
/// for the same seed and the same changes.
#[derive(Clone, Debug)]
pub(crate) struct Bounce {
    span: Ticks,
    random: Pcg32,
    /// When the present bouncing is over.
    end: Ticks,
    next: Ticks,
    /// How often it will still come apart or together; apart while it is odd.
    left: u32,
}

impl Bounce {
    /// For so many clocks after each change.
    pub fn new(span: Ticks, random: Pcg32) -> Self {
        Self { span, random, end: 0, next: Ticks::MAX, left: 0 }
    }

    /// The contact was moved: it bounces from now on, whatever it did.
    pub fn begin(&mut self, now: Ticks) {
        self.end = now.saturating_add(self.span);
        self.left = 2 * (1 + self.random.next_u32() % MAX_REBOUNDS);
        self.plan(now);
    }

    /// Whether it is not as its mover says.
    pub const fn is_apart(&self) -> bool {
        !self.left.is_multiple_of(2)
    }

    /// When it comes apart or together; [`Ticks::MAX`] if it stays.
    pub const fn next(&self) -> Ticks {
        self.next
    }

    /// Whether it has come apart or together by `now`, since it was asked last.
    pub fn take(&mut self, now: Ticks) -> bool {
        if self.next > now {
            return false;
        }
        self.left -= 1;
        self.plan(self.next);
        true
    }

    /// The next change, within an even part of the time that is left.
    fn plan(&mut self, now: Ticks) {
        let room = (self.end - now).checked_div(self.left.into()).unwrap_or(0);
        self.next = match room {
            0 if self.left.is_multiple_of(2) => Ticks::MAX,
            0 => now,
            _ => now + 1 + u64::from(self.random.next_u32()) % room,
        };
        if self.next == Ticks::MAX {
            self.left = 0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn changes(span: Ticks, seed: u64, begun: &[Ticks]) -> Vec<Ticks> {
        let mut bounce = Bounce::new(span, Pcg32::new(seed, 3));
        let mut begun = begun.iter().peekable();
        let mut changes = Vec::new();
        for now in 0..10_000 {
            if begun.next_if_eq(&&now).is_some() {
                bounce.begin(now);
            }
            while bounce.take(now) {
                changes.push(now);
            }
        }
        assert!(!bounce.is_apart() && bounce.next() == Ticks::MAX);
        changes
    }

    #[test]
    fn it_ends_in_time_as_its_mover_says() {
        for seed in 0..100 {
            let at = changes(500, seed, &[100]);
            assert!(at.len().is_multiple_of(2) && (2..=8).contains(&at.len()), "{at:?}");
            assert!(at.is_sorted() && at[0] > 100 && at.iter().all(|at| *at <= 600), "{at:?}");
        }
    }

    #[test]
    fn the_seed_decides() {
        assert_eq!(changes(500, 7, &[100, 2000]), changes(500, 7, &[100, 2000]));
        assert_ne!(changes(500, 7, &[100]), changes(500, 8, &[100]));
    }

    #[test]
    fn a_second_change_starts_again() {
        for seed in 0..100 {
            let last = *changes(500, seed, &[100, 150]).last().unwrap();
            assert!((151..=650).contains(&last), "{last}");
        }
    }

    #[test]
    fn there_may_be_no_time_for_it() {
        assert!(changes(0, 1, &[100]).is_empty());
        (0..100).for_each(|seed| {
            let at = changes(3, seed, &[100]);
            assert!(at.iter().all(|at| *at <= 103), "{at:?}");
        });
    }
}
