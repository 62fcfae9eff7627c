//! The pulse train: what the kernel gives out instead of single pulses.
//!
//! A train is a run of pulses in one direction whose spacing changes smoothly: a third-order polynomial
//! in the number of the pulse. A cruise is one train however long it is; a ramp is a few dozen. Whoever
//! needs single edges expands the train with three additions an edge.
//!
//! An axis that moves together with others does not step at every pulse of the one that sets the pace. The
//! polynomial then numbers slots, and a mask says at which of them the axis steps. Axes that step in the
//! same slot do so in the same clock.
//!
//! Times count the controller's clock from power-up. Spacings have 32 bits of fraction of one clock, so
//! that rounding does not add up: an edge happens at the clock in which its exact time lies.

/// A time or a span in clocks of the controller, from power-up.
pub type Ticks = u64;

/// Clocks with 32 bits of fraction: the unit of spacings inside a train.
pub type SubTicks = u64;

/// Bits of fraction in [`SubTicks`].
pub const FRACTION_BITS: u32 = 32;

/// No train lasts this many clocks or more, so that offsets inside it fit [`SubTicks`].
pub const MAX_DURATION: Ticks = 1 << 31;

/// Which way the position counter moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// The counter falls.
    Negative,
    /// The counter rises.
    Positive,
}

impl Direction {
    /// −1 or +1.
    pub const fn sign(self) -> i64 {
        match self {
            Self::Negative => -1,
            Self::Positive => 1,
        }
    }

    /// The direction that takes a counter over `distance`; positive for 0.
    pub const fn of(distance: i64) -> Self {
        if distance < 0 { Self::Negative } else { Self::Positive }
    }

    /// The other one.
    pub const fn reversed(self) -> Self {
        match self {
            Self::Negative => Self::Positive,
            Self::Positive => Self::Negative,
        }
    }
}

/// The [`Train::mask`] of a plain train.
pub const EVERY_SLOT: u64 = 0;

/// The most slots of a train that steps in some of them only.
pub const MAX_SLOTS: u32 = u64::BITS;

/// A moment with its fraction of a clock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Moment {
    /// Whole clocks.
    pub ticks: Ticks,
    /// Fraction of a clock in 2⁻³².
    pub fraction: u32,
}

impl Moment {
    /// The beginning of a clock.
    pub const fn at(ticks: Ticks) -> Self {
        Self { ticks, fraction: 0 }
    }

    /// The moment `span` later.
    pub const fn after(self, span: SubTicks) -> Self {
        let (fraction, carry) = self.fraction.overflowing_add(span as u32);
        Self { ticks: self.ticks + (span >> FRACTION_BITS) + carry as u64, fraction }
    }

    /// The span from `earlier` to this moment, if it is one and fits.
    pub const fn since(self, earlier: Self) -> Option<SubTicks> {
        let whole = self.ticks.wrapping_sub(earlier.ticks);
        let span = ((whole as u128) << FRACTION_BITS) + self.fraction as u128;
        match span.checked_sub(earlier.fraction as u128) {
            Some(span) if self.ticks >= earlier.ticks && span <= u64::MAX as u128 => Some(span as u64),
            _ => None,
        }
    }
}

/// A run of pulses in one direction.
///
/// Slot `k` (from 1) lies `k·interval + C(k,2)·add + C(k,3)·jerk` after `start`. A plain train makes a pulse
/// in each of `count` slots.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Train {
    /// The moment from which the first spacing counts.
    pub start: Moment,
    /// From `start` to the first slot.
    pub interval: SubTicks,
    /// How much the second spacing is longer than the first.
    pub add: i64,
    /// How much `add` grows from one spacing to the next.
    pub jerk: i64,
    /// How many pulses.
    pub count: u32,
    /// Which way.
    pub direction: Direction,
    /// In which slots the pulses are, the first slot in the lowest bit: `count` bits; or [`EVERY_SLOT`].
    pub mask: u64,
}

impl Train {
    /// The train that makes a pulse in each slot whose bit is set; `None` if there is none.
    ///
    /// # Panics
    /// If this train is not plain or has more than [`MAX_SLOTS`] slots.
    pub(crate) fn masked(&self, mask: u64) -> Option<Self> {
        assert!(self.mask == EVERY_SLOT && self.count <= MAX_SLOTS, "too long to be masked");
        let count = mask.count_ones();
        // All ones up to the last: plain.
        let mask = if mask & mask.wrapping_add(1) == 0 { EVERY_SLOT } else { mask };
        (count > 0).then_some(Self { count, mask, ..*self })
    }

    /// As many of the slots as a mask has bits, and the rest if there are more.
    ///
    /// # Panics
    /// If this train is not plain.
    pub(crate) fn first_slots(&self) -> (Self, Option<Self>) {
        assert!(self.mask == EVERY_SLOT, "slots are pulses");
        if self.count <= MAX_SLOTS {
            return (*self, None);
        }
        let (slots, rest) = self.split(MAX_SLOTS);
        (slots, Some(rest))
    }

    /// The train of one of the pulses of a plain train.
    ///
    /// # Panics
    /// If this train is not plain.
    pub(crate) fn alone(&self, k: u32) -> Self {
        assert!(self.mask == EVERY_SLOT, "slots are pulses");
        let start = self.moment(k - 1);
        let interval = self.offset(k).wrapping_sub(self.offset(k - 1));
        Self { start, interval, add: 0, jerk: 0, count: 1, ..*self }
    }

    /// The slot of pulse `k`; 0 for `k` = 0.
    #[inline]
    pub const fn slot(&self, k: u32) -> u32 {
        if self.mask == EVERY_SLOT { k } else { nth_bit(self.mask, k) }
    }

    /// From `start` to pulse `k`; 0 for `k` = 0.
    #[inline]
    pub const fn offset(&self, k: u32) -> SubTicks {
        let k = self.slot(k) as u64;
        let pairs = k.wrapping_mul(k.wrapping_sub(1)) / 2;
        // At most MAX_BLOCK slots have a jerk, and then this product is small.
        let triples = if self.jerk == 0 || k < 3 { 0 } else { pairs * (k - 2) / 3 };
        k.wrapping_mul(self.interval)
            .wrapping_add(pairs.wrapping_mul(self.add as u64))
            .wrapping_add(triples.wrapping_mul(self.jerk as u64))
    }

    /// The exact moment of pulse `k`.
    pub const fn moment(&self, k: u32) -> Moment {
        self.start.after(self.offset(k))
    }

    /// The clock in which pulse `k` happens.
    pub const fn edge(&self, k: u32) -> Ticks {
        self.moment(k).ticks
    }

    /// The clock of the first slot, which is the first pulse of a plain train.
    #[inline]
    pub(crate) const fn first_slot(&self) -> Ticks {
        self.start.after(self.interval).ticks
    }

    /// The clock of the last pulse.
    pub const fn end(&self) -> Ticks {
        self.edge(self.count)
    }

    /// How many of the pulses have happened when clock `now` is over.
    pub fn count_until(&self, now: Ticks) -> u32 {
        if now >= self.end() {
            return self.count;
        }
        if (self.add, self.jerk, self.mask) == (0, 0, EVERY_SLOT) {
            // A cruise may be long: one division.
            let span = Moment::at(now + 1).since(self.start).unwrap_or(0);
            return span.saturating_sub(1).checked_div(self.interval).unwrap_or(0) as u32;
        }
        // Spacings are positive, so edges are sorted.
        let (mut done, mut after) = (0, self.count);
        while after - done > 1 {
            let middle = done + (after - done) / 2;
            if self.edge(middle) <= now { done = middle } else { after = middle }
        }
        done
    }

    /// The first `k` pulses and the rest.
    ///
    /// # Panics
    /// If `k` is 0 or not less than the count: both parts must have pulses.
    pub fn split(&self, k: u32) -> (Self, Self) {
        assert!(k > 0 && k < self.count, "a train splits between its pulses");
        let slot = self.slot(k);
        let jerk = i64::from(slot).wrapping_mul(self.jerk);
        let pairs = (u64::from(slot) * u64::from(slot - 1) / 2) as i64;
        // Behind its last pulse and before its first a part has no slots that count.
        let [before, after] = match self.mask {
            EVERY_SLOT => [EVERY_SLOT; 2],
            mask => [mask & (u64::MAX >> (MAX_SLOTS - slot)), mask >> slot],
        };
        let head = Self { count: k, mask: before, ..*self };
        let tail = Self {
            start: self.moment(k),
            interval: self
                .interval
                .wrapping_add(i64::from(slot).wrapping_mul(self.add) as u64)
                .wrapping_add(pairs.wrapping_mul(self.jerk) as u64),
            add: self.add.wrapping_add(jerk),
            count: self.count - k,
            mask: after,
            ..*self
        };
        (head, tail)
    }

    /// The clocks of the pulses, in order.
    pub fn edges(&self) -> Edges {
        Edges {
            ticks: self.start.ticks,
            offset: u64::from(self.start.fraction),
            interval: self.interval,
            add: self.add as u64,
            jerk: self.jerk as u64,
            left: self.count,
            mask: self.mask,
        }
    }

    /// Writes the clocks of the pulses to the front of `edges` and gives their number, which is the
    /// smaller one of the count and the room.
    #[inline]
    pub fn expand(&self, edges: &mut [Ticks]) -> usize {
        // The trains of slow ramps are so short that a loop takes longer than its turns.
        if let (3, EVERY_SLOT, Some(edges)) = (self.count, self.mask, edges.first_chunk_mut::<3>()) {
            let first = u64::from(self.start.fraction).wrapping_add(self.interval);
            let spacing = self.interval.wrapping_add(self.add as u64);
            let second = first.wrapping_add(spacing);
            let change = self.add.wrapping_add(self.jerk);
            let third = second.wrapping_add(spacing).wrapping_add(change as u64);
            *edges = [first, second, third].map(|offset| self.start.ticks + (offset >> FRACTION_BITS));
            return edges.len();
        }
        self.expand_all(edges)
    }

    /// The same for a train of any length.
    fn expand_all(&self, edges: &mut [Ticks]) -> usize {
        let count = edges.len().min(self.count as usize);
        let edges = &mut edges[..count];
        let mut all = self.edges();
        if self.mask == EVERY_SLOT {
            for edge in edges {
                *edge = all.slot();
            }
        } else if count == self.count as usize && (self.add, self.jerk) == (0, 0) {
            let mut mask = self.mask;
            for edge in edges {
                let slot = u64::from(mask.trailing_zeros()) + 1;
                *edge = all.ticks + ((all.offset + slot * self.interval) >> FRACTION_BITS);
                mask &= mask.wrapping_sub(1);
            }
        } else if count == self.count as usize {
            // Every slot is written, over the one before if that was empty: no branch to mispredict.
            let (mut at, mut mask) = (0, self.mask);
            while mask != 0 {
                edges[at] = all.slot();
                at += (mask & 1) as usize;
                mask >>= 1;
            }
        } else {
            edges.iter_mut().zip(all).for_each(|(edge, clock)| *edge = clock);
        }
        count
    }
}

/// The number of the `k`th bit that is set, from 1; 0 for `k` = 0.
const fn nth_bit(mask: u64, k: u32) -> u32 {
    let (mut below, mut left, mut width) = (0, k, MAX_SLOTS);
    if k == 0 {
        return 0;
    }
    // Halves, down to the bit.
    while width > 1 {
        width /= 2;
        let ones = ((mask >> below) & ((1 << width) - 1)).count_ones();
        if ones < left {
            left -= ones;
            below += width;
        }
    }
    below + 1
}

/// Iterator over the clocks of a train's pulses.
#[derive(Clone, Debug)]
pub struct Edges {
    ticks: Ticks,
    offset: SubTicks,
    interval: SubTicks,
    add: u64,
    jerk: u64,
    left: u32,
    mask: u64,
}

impl Edges {
    /// No pulses.
    pub(crate) const fn none() -> Self {
        Self { ticks: 0, offset: 0, interval: 0, add: 0, jerk: 0, left: 0, mask: EVERY_SLOT }
    }

    /// Visits `next`, which is the pulse that was given out last, and those before `end`; the first one after.
    #[inline]
    pub(crate) fn until(&mut self, next: Ticks, end: Ticks, mut visit: impl FnMut(Ticks)) -> Option<Ticks> {
        let (mut edges, mut next) = (self.clone(), Some(next));
        if edges.mask == EVERY_SLOT {
            // The same without a look at the mask.
            let mut clock = next?;
            while clock < end {
                visit(clock);
                if edges.left == 0 {
                    next = None;
                    break;
                }
                edges.left -= 1;
                clock = edges.slot();
                next = Some(clock);
            }
        } else {
            while let Some(clock) = next.filter(|clock| *clock < end) {
                visit(clock);
                next = edges.next();
            }
        }
        *self = edges;
        next
    }

    /// The clock of the next slot.
    #[inline]
    fn slot(&mut self) -> Ticks {
        self.offset = self.offset.wrapping_add(self.interval);
        self.interval = self.interval.wrapping_add(self.add);
        self.add = self.add.wrapping_add(self.jerk);
        self.ticks + (self.offset >> FRACTION_BITS)
    }
}

impl Iterator for Edges {
    type Item = Ticks;

    #[inline]
    fn next(&mut self) -> Option<Ticks> {
        if self.left == 0 {
            return None;
        }
        self.left -= 1;
        if self.mask != EVERY_SLOT {
            let empty = self.mask.trailing_zeros();
            (0..empty).for_each(|_| {
                self.slot();
            });
            self.mask = self.mask >> empty >> 1;
        }
        Some(self.slot())
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.left as usize, Some(self.left as usize))
    }
}

impl ExactSizeIterator for Edges {}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp() -> Train {
        Train {
            start: Moment { ticks: 1000, fraction: 1 << 31 },
            interval: 300 << 32,
            add: -(7 << 30),
            jerk: 1 << 27,
            count: 64,
            direction: Direction::Positive,
            mask: EVERY_SLOT,
        }
    }

    /// A plain train and some with a mask.
    fn trains() -> Vec<Train> {
        let masks =
            [1 << 63, 1 << 63 | 1, 0x5555_5555_5555_5555, u64::MAX - 1, 0xF0F0_0000_0000_1230, 1 << 20];
        let even = Train { interval: (300 << 32) + 0x9E37_79B9, add: 0, jerk: 0, ..ramp() };
        let both = [ramp(), even];
        both.iter()
            .flat_map(|train| masks.iter().filter_map(|&mask| train.masked(mask)).chain([*train]))
            .collect()
    }

    #[test]
    fn the_polynomial_and_the_iterator_agree() {
        for train in trains() {
            let edges: Vec<_> = train.edges().collect();
            assert_eq!(edges.len(), train.count as usize);
            for (k, edge) in (1..).zip(&edges) {
                assert_eq!(train.edge(k), *edge, "pulse {k} of {train:?}");
            }
            assert!(edges.is_sorted());
            for room in [0, 1, edges.len() / 2, edges.len(), 100] {
                let mut written = vec![0; room];
                let count = train.expand(&mut written);
                assert_eq!(count, room.min(edges.len()));
                assert_eq!(written[..count], edges[..count], "{train:?}");
            }
        }
    }

    #[test]
    fn a_mask_picks_slots() {
        for train in trains() {
            let slots: Vec<_> = Train { count: 64, mask: EVERY_SLOT, ..train }.edges().collect();
            let mask = if train.mask == EVERY_SLOT { u64::MAX } else { train.mask };
            let picked = (0..64).filter(|bit| mask >> bit & 1 == 1).map(|bit| slots[bit]);
            assert!(train.edges().eq(picked), "{train:?}");
        }
        // A mask without a gap is none.
        assert_eq!(ramp().masked(u64::MAX), Some(ramp()));
        assert_eq!(ramp().masked(0x7F), Some(Train { count: 7, ..ramp() }));
        assert_eq!(ramp().masked(0), None);
    }

    #[test]
    fn a_pulse_alone_is_where_it_was() {
        for k in 1..=64 {
            let alone = ramp().alone(k);
            assert_eq!(
                (alone.count, alone.moment(1), alone.start),
                (1, ramp().moment(k), ramp().moment(k - 1))
            );
        }
    }

    #[test]
    fn splitting_keeps_every_edge() {
        for train in trains() {
            let whole: Vec<_> = train.edges().collect();
            for k in 1..train.count {
                let (head, tail) = train.split(k);
                let both: Vec<_> = head.edges().chain(tail.edges()).collect();
                assert_eq!(both, whole, "split of {train:?} at {k}");
                assert_eq!([head.end(), tail.end()], [train.edge(k), train.end()]);
            }
        }
    }

    #[test]
    fn counting_stops_between_edges() {
        for train in trains() {
            for k in 1..=train.count {
                assert_eq!(train.count_until(train.edge(k) - 1), k - 1);
                assert_eq!(train.count_until(train.edge(k)), k);
            }
            assert_eq!(train.count_until(0), 0);
        }
    }

    #[test]
    fn moments_carry() {
        let moment = Moment { ticks: 5, fraction: u32::MAX };
        assert_eq!(moment.after(1), Moment::at(6));
        assert_eq!(Moment::at(6).since(moment), Some(1));
        assert_eq!(moment.since(Moment::at(6)), None);
    }
}
