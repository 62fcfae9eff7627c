//! Programs that wait in a loop: they ask for an input again and again, and are told the same. Such a round changes
//! nothing, so until something happens outside every further one is the same, and need not be executed.
//!
//! A device that has nothing to gain by that, as on a chip, keeps its programs without this.

use motion::Ticks;

/// What a program's rounds look like.
#[derive(Debug)]
pub struct Rounds<S> {
    seen: Option<Seen<S>>,
    /// What was asked for may be another from here on.
    until: Ticks,
}

/// A moment that may come again.
#[derive(Debug)]
struct Seen<S> {
    situation: S,
    at: Ticks,
    instructions: u64,
    /// How often the program was looked at since, and how often it may be before a later moment is taken.
    looks: u32,
    patience: u32,
}

/// Rounds that need not be executed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Skipped {
    /// How long they take, in the unit of the moments.
    pub time: Ticks,
    /// How many instructions they have.
    pub instructions: u64,
}

impl<S> Rounds<S> {
    /// Nothing was seen yet.
    pub const fn new() -> Self {
        Self { seen: None, until: Ticks::MAX }
    }

    /// Something has happened that the situation does not show.
    pub fn forget(&mut self) {
        *self = Self::new();
    }

    /// What was asked for stays as it is until this moment, not longer.
    pub fn limit(&mut self, until: Ticks) {
        self.until = self.until.min(until);
    }

    /// The program stands somewhere; `is_there` tells whether it stood in this situation before, and `situation`
    /// gives the present one, which is asked for at growing distances. If it did, and nothing was
    /// [forgotten](Self::forget) meanwhile, with how often it comes again until `horizon`.
    pub fn look(
        &mut self,
        at: Ticks,
        instructions: u64,
        horizon: Ticks,
        is_there: impl FnOnce(&S) -> bool,
        situation: impl FnOnce() -> S,
    ) -> Option<Skipped> {
        if at >= self.until {
            self.forget();
        }
        let mut patience = 1;
        if let Some(seen) = &mut self.seen {
            if is_there(&seen.situation) {
                let time = at - seen.at;
                let times = horizon.min(self.until).saturating_sub(at).checked_div(time)?;
                return Some(Skipped {
                    time: times * time,
                    instructions: times * (instructions - seen.instructions),
                });
            }
            seen.looks += 1;
            if seen.looks < seen.patience {
                return None;
            }
            // However long a round is, one of them lies behind a moment in the end (Brent).
            patience = seen.patience.saturating_mul(2);
        }
        self.seen = Some(Seen { situation: situation(), at, instructions, looks: 0, patience });
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A clock that is far away.
    const FAR: Ticks = 1_000_005;

    /// Looks at these situations, one each 10 clocks with 3 instructions: when rounds are skipped, and which.
    fn first(situations: impl IntoIterator<Item = u32>) -> Option<(Ticks, Skipped)> {
        let mut rounds = Rounds::new();
        (0..).zip(situations).find_map(|(number, now)| {
            let at = number * 10;
            rounds.look(at, number * 3, FAR, |seen| *seen == now, || now).map(|skipped| (at, skipped))
        })
    }

    #[test]
    fn a_round_is_found_whatever_its_length() {
        for length in 1..100 {
            let before = (0..7).map(|way| 1_000_000 + way);
            let skipped = first(before.chain((0..1000 + length).map(|way| way % length)));
            let (at, Skipped { time, instructions }) = skipped.expect("it comes again");
            let round = u64::from(length) * 10;
            assert_eq!(time % round, 0, "only whole rounds");
            assert!(at + time <= FAR && at + time + round > FAR, "all of them");
            assert_eq!(instructions, time / 10 * 3);
        }
    }

    #[test]
    fn what_does_not_come_again_is_no_round() {
        assert_eq!(first(0..1000), None);
    }

    #[test]
    fn what_was_forgotten_does_not_count() {
        let mut rounds = Rounds::new();
        assert_eq!(rounds.look(0, 0, 100, |()| true, || ()), None);
        rounds.forget();
        assert_eq!(rounds.look(5, 1, 100, |()| true, || ()), None);
        assert_eq!(rounds.look(9, 3, 18, |()| true, || ()), Some(Skipped { time: 8, instructions: 4 }));
    }

    #[test]
    fn a_limit_ends_rounds_and_begins_others() {
        let mut rounds = Rounds::new();
        assert_eq!(rounds.look(0, 0, 100, |()| true, || ()), None);
        rounds.limit(50);
        assert_eq!(rounds.look(10, 1, 100, |()| true, || ()), Some(Skipped { time: 40, instructions: 4 }));
        assert_eq!(rounds.look(50, 5, 100, |()| true, || ()), None);
        assert_eq!(rounds.look(60, 6, 100, |()| true, || ()), Some(Skipped { time: 40, instructions: 4 }));
    }
}
