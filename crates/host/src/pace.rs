//! How much is asked of a controller that is looked at all the time. What moves is asked for each time; the rest each
//! time too while that is quick, else a share of it, in turn.

use std::time::Duration;

/// How long a look may take for what does not move.
const ROOM: Duration = Duration::from_millis(50);

/// Whose turn it is.
#[derive(Debug, Default)]
pub(crate) struct Turns {
    /// The question that comes next; `None` before all were asked once.
    next: Option<usize>,
}

impl Turns {
    /// The questions, of so many, that are asked this time. So many others took so long just now.
    pub fn take(&mut self, count: usize, asked: u32, took: Duration) -> Vec<usize> {
        let each = took.checked_div(asked).unwrap_or_default();
        let room = ROOM.as_micros() / each.as_micros().max(1);
        let room = usize::try_from(room).unwrap_or(usize::MAX);
        let (first, share) = match self.next {
            None => (0, count),
            Some(next) => (next, room.clamp(1, count.max(1)).min(count)),
        };
        self.next = Some((first + share).checked_rem(count).unwrap_or(0));
        (first..first + share).map(|number| number % count).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_or_a_share() {
        let mut turns = Turns::default();
        let mut check = |count, each_ms: u64, expected: &[usize]| {
            assert_eq!(turns.take(count, 10, Duration::from_millis(10 * each_ms)), expected);
        };
        // At first all, however long it takes.
        check(5, 100, &[0, 1, 2, 3, 4]);
        check(5, 100, &[0]);
        check(5, 25, &[1, 2]);
        check(5, 20, &[3, 4]);
        check(5, 15, &[0, 1, 2]);
        check(5, 15, &[3, 4, 0]);
        check(5, 1, &[1, 2, 3, 4, 0]);
        check(5, 0, &[1, 2, 3, 4, 0]);
        check(0, 1, &[]);
    }
}
