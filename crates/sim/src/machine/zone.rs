//! Where along a shaft a switch or a mark is on.

/// No threshold: further away than any pulse.
pub(crate) const NEVER: i64 = i64::MAX / 4;

/// Positions at which an input is on: an interval, maybe repeated, or two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Zone {
    first: i64,
    last: i64,
    more: More,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum More {
    None,
    /// The same again at every multiple of this.
    Every(i64),
    /// A second interval above.
    And {
        first: i64,
        last: i64,
    },
}

impl Zone {
    /// On from the first to the last, both included.
    pub const fn between([first, last]: [i64; 2]) -> Self {
        Self { first, last, more: More::None }
    }

    /// On in one interval, and in another that lies above it with a gap between.
    pub const fn between_two([first, last]: [i64; 2], other: Option<[i64; 2]>) -> Self {
        let more = match other {
            None => More::None,
            Some([first, last]) => More::And { first, last },
        };
        Self { first, last, more }
    }

    /// On at and below `last`.
    pub const fn up_to(last: i64) -> Self {
        Self::between([-NEVER, last])
    }

    /// On at and above `first`.
    pub const fn from(first: i64) -> Self {
        Self::between([first, NEVER])
    }

    /// On nowhere.
    pub const fn nowhere() -> Self {
        Self::between([NEVER, NEVER])
    }

    /// This interval again at every multiple of `every`.
    pub const fn every(self, every: i64) -> Self {
        Self::repeated(self.first, self.last, every)
    }

    /// On so far beyond either end too. Intervals that meet are one.
    pub const fn widened(self, by: i64) -> Self {
        if by == 0 {
            return self;
        }
        let [low, high] = [self.first - by, self.last + by];
        match self.more {
            More::None => Self::between([low, high]),
            More::Every(every) => Self::repeated(low, high, every),
            More::And { first, last } if high + 1 < first - by => {
                Self::between_two([low, high], Some([first - by, last + by]))
            }
            More::And { last, .. } => Self::between([low, last + by]),
        }
    }

    /// On at 0 and every multiple of `every`.
    pub const fn marks(every: i64) -> Self {
        Self::repeated(0, 0, every)
    }

    /// On from `first` to `last` and at every multiple of `every` from there. A mark that is on
    /// everywhere is not one: the interval is cut short of the next.
    pub const fn repeated(first: i64, last: i64, every: i64) -> Self {
        let longest = first + every - 2;
        let last = if last > longest && every > 1 { longest } else { last };
        Self { first, last, more: More::Every(every) }
    }

    /// Its first interval, and after how many positions that comes again.
    pub const fn interval(&self) -> (i64, i64, Option<i64>) {
        let every = if let More::Every(every) = self.more { Some(every) } else { None };
        (self.first, self.last, every)
    }

    /// Whether it is on at `position`.
    pub fn is_on(&self, position: i64) -> bool {
        let folded = self.folded(position);
        let second = matches!(self.more, More::And { first, last } if first <= folded && folded <= last);
        self.first <= folded && folded <= self.last || second
    }

    /// The next position above at which it changes; at least [`NEVER`] if there is none.
    pub fn above(&self, position: i64) -> i64 {
        let folded = self.folded(position);
        let next = if folded < self.first {
            self.first
        } else if folded <= self.last {
            self.last + 1
        } else {
            match self.more {
                More::Every(every) => self.first + every,
                More::And { first, .. } if folded < first => first,
                More::And { last, .. } if folded <= last => last + 1,
                More::And { .. } | More::None => NEVER,
            }
        };
        if next >= NEVER { NEVER } else { position + (next - folded) }
    }

    /// The next position below at which it changes; at most −[`NEVER`] if there is none.
    pub fn below(&self, position: i64) -> i64 {
        let folded = self.folded(position);
        let next = match self.more {
            More::And { last, .. } if folded > last => last,
            More::And { first, .. } if folded >= first => first - 1,
            _ if folded > self.last => self.last,
            _ if folded >= self.first => self.first - 1,
            _ => -NEVER,
        };
        if next <= -NEVER { -NEVER } else { position + (next - folded) }
    }

    /// Whether a way from one position to another passes the whole zone, so that nobody sees it on who
    /// looks at the ends only.
    pub fn is_jumped(&self, from: i64, to: i64) -> bool {
        let change = if to > from { self.above(from) } else { self.below(from) };
        let within = if to > from { change <= to } else { change >= to };
        from != to && within && !self.is_on(from) && !self.is_on(to)
    }

    /// The position that stands for `position` in the first interval and the gap after it.
    fn folded(&self, position: i64) -> i64 {
        match self.more {
            More::Every(every) => self.first + (position - self.first).rem_euclid(every),
            More::And { .. } | More::None => position,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the functions promise, position by position.
    #[track_caller]
    fn check(zone: Zone) {
        for position in -40..=40 {
            let changed = |other: &i64| zone.is_on(*other) != zone.is_on(position);
            let above = (position + 1..100).find(changed).unwrap_or(NEVER);
            let below = (-100..position).rev().find(changed).unwrap_or(-NEVER);
            assert_eq!(
                (zone.below(position), zone.above(position)),
                (below, above),
                "{zone:?} at {position}"
            );
            for other in -40..=40 {
                let (low, high) = (position.min(other), position.max(other));
                let inside = (low..=high).any(|position| zone.is_on(position));
                let expected = inside && !zone.is_on(position) && !zone.is_on(other);
                assert_eq!(zone.is_jumped(position, other), expected, "{zone:?} {position} to {other}");
            }
        }
    }

    #[test]
    fn thresholds_are_where_the_level_changes() {
        check(Zone::between([-7, 3]));
        check(Zone::between([5, 5]));
        check(Zone::between_two([-9, -5], None));
        check(Zone::between_two([-9, -5], Some([2, 2])));
        check(Zone::between_two([-9, -5], Some([-3, 20])));
        check(Zone::up_to(-2));
        check(Zone::from(4));
        check(Zone::repeated(0, 0, 10));
        check(Zone::repeated(-3, 2, 13));
        check(Zone::repeated(0, 0, 2));
    }

    #[test]
    fn zones_are_widened() {
        check(Zone::between([-7, 3]).widened(4));
        check(Zone::between_two([-9, -5], Some([2, 2])).widened(2));
        check(Zone::up_to(-2).widened(5));
        check(Zone::from(4).widened(5));
        check(Zone::repeated(-3, 2, 13).widened(2));
        check(Zone::repeated(-3, 2, 13).widened(20));
        check(Zone::nowhere());
        assert_eq!(Zone::between([-7, 3]).widened(4), Zone::between([-11, 7]));
        assert_eq!(Zone::between_two([0, 5], Some([10, 15])).widened(2), Zone::between([-2, 17]));
        assert_eq!(Zone::up_to(-2).widened(5).above(0), 4);
    }

    #[test]
    fn a_mark_leaves_a_gap() {
        check(Zone::repeated(-5, 5, 4));
    }
}
