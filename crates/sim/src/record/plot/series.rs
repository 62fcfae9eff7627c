//! Curves in bounded memory: a fixed number of buckets of time that double in width when they run out.

use motion::{
    Moment, SubTicks, Ticks, Train,
    train::{EVERY_SLOT, FRACTION_BITS, MAX_SLOTS},
};

/// Most buckets of a curve. A plot is about 800 points wide.
pub(super) const MAX_BUCKETS: usize = 2048;

/// Width of a bucket at the beginning, in clocks.
const FIRST_WIDTH: Ticks = 16;

/// Which bucket a time lies in.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    origin: Ticks,
    width: Ticks,
}

impl Scale {
    fn bucket(self, at: Ticks) -> usize {
        (at.saturating_sub(self.origin) / self.width) as usize
    }

    fn end(self, bucket: usize) -> Ticks {
        self.origin + (bucket as Ticks + 1) * self.width
    }
}

/// What two buckets become when they merge.
pub(super) trait Merge: Clone + Default {
    /// This bucket and the later one.
    fn merge(&self, later: &Self) -> Self;
}

/// Buckets from a first moment on.
#[derive(Clone, Debug)]
pub(super) struct Buckets<B> {
    scale: Scale,
    buckets: Vec<B>,
}

impl<B: Merge> Buckets<B> {
    pub fn new(origin: Ticks) -> Self {
        Self { scale: Scale { origin, width: FIRST_WIDTH }, buckets: Vec::new() }
    }

    /// Makes room for a moment.
    fn reach(&mut self, at: Ticks) {
        while self.scale.bucket(at) >= MAX_BUCKETS {
            self.scale.width *= 2;
            let merged = self.buckets.chunks(2).map(|pair| match pair {
                [first, second] => first.merge(second),
                _ => pair[0].clone(),
            });
            self.buckets = merged.collect();
        }
        let length = self.scale.bucket(at) + 1;
        if self.buckets.len() < length {
            self.buckets.resize(length, B::default());
        }
    }

    /// The buckets with the time at which each ends.
    pub fn iter(&self) -> impl Iterator<Item = (Ticks, &B)> {
        self.buckets.iter().enumerate().map(|(bucket, content)| (self.scale.end(bucket), content))
    }
}

/// Extremes of a quantity, and its first and last point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Extent {
    pub first: (f64, f64),
    pub low: f64,
    pub high: f64,
    pub last: (f64, f64),
}

impl Extent {
    fn add(extent: &mut Option<Self>, at: f64, value: f64) {
        let last = (at, value);
        *extent = Some(match *extent {
            None => Self { first: last, low: value, high: value, last },
            Some(Self { first, low, high, .. }) => {
                Self { first, low: low.min(value), high: high.max(value), last }
            }
        });
    }

    fn merge(first: Option<Self>, later: Option<Self>) -> Option<Self> {
        match (first, later) {
            (Some(first), Some(later)) => {
                let (low, high) = (first.low.min(later.low), first.high.max(later.high));
                Some(Self { first: first.first, low, high, last: later.last })
            }
            (one, other) => other.or(one),
        }
    }
}

/// A bucket of an axis' curves; times in clocks, positions in pulses, speeds in pulses a clock.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Motion {
    pub position: Option<Extent>,
    pub speed: Option<Extent>,
    /// Where the encoder says that the axis is.
    pub encoder: Option<Extent>,
}

impl Merge for Motion {
    fn merge(&self, later: &Self) -> Self {
        Self {
            position: Extent::merge(self.position, later.position),
            speed: Extent::merge(self.speed, later.speed),
            encoder: Extent::merge(self.encoder, later.encoder),
        }
    }
}

/// The curves of an axis.
#[derive(Clone, Debug)]
pub(super) struct Curves {
    pub buckets: Buckets<Motion>,
    position: i64,
    moved: bool,
    /// When the last pulse was, and its spacing in clocks.
    last: Option<(Moment, f64)>,
    uneven: Option<Uneven>,
    /// The first position of samples; curves are of pulses or of samples.
    sampled: Option<f64>,
    encoder: Encoder,
}

/// What was seen of an encoder.
#[derive(Clone, Copy, Debug)]
struct Encoder {
    last: Option<f64>,
    /// The smallest change of its counter; at most 1 less than its resolution, where that is no whole number.
    step: f64,
    /// The largest distance from the position.
    apart: f64,
}

/// An axis that steps in some slots of a path: its spacing jumps, but not its mean over many pulses.
#[derive(Clone, Copy, Debug)]
struct Uneven {
    since: Moment,
    /// Pulses since then, with their direction.
    pulses: i64,
}

/// Over so many pulses the speed of such an axis is taken.
const EVENED: i64 = MAX_SLOTS as i64;

impl Curves {
    pub fn new(origin: Ticks) -> Self {
        let buckets = Buckets::new(origin);
        let encoder = Encoder { last: None, step: f64::INFINITY, apart: 0.0 };
        let mut curves =
            Self { buckets, position: 0, moved: false, last: None, uneven: None, sampled: None, encoder };
        curves.put(origin, 0.0);
        curves
    }

    /// Whether there were any pulses, or samples of another position than the first.
    pub fn has_moved(&self) -> bool {
        self.moved
    }

    /// Adds what a device said of itself; the speed in pulses a clock.
    pub fn sample(&mut self, at: Ticks, position: f64, speed: f64) {
        if let Some(first) = self.sampled {
            self.moved |= position != first;
        } else {
            // Nothing is known of the time before.
            self.buckets = Buckets::new(self.buckets.scale.origin);
            self.sampled = Some(position);
        }
        self.buckets.reach(at);
        let bucket = self.buckets.scale.bucket(at);
        let content = &mut self.buckets.buckets[bucket];
        Extent::add(&mut content.position, at as f64, position);
        Extent::add(&mut content.speed, at as f64, speed);
    }

    /// Adds what the counters of an axis were at a time until which everything else is known. The encoder is
    /// drawn as far from the curve as it is from the position.
    pub fn encoder(&mut self, at: Ticks, position: f64, encoder: f64) {
        let apart = encoder - position;
        let place = self.sampled.map_or(self.position as f64, |_| position) + apart;
        self.buckets.reach(at);
        let bucket = self.buckets.scale.bucket(at);
        Extent::add(&mut self.buckets.buckets[bucket].encoder, at as f64, place);
        let step = self.encoder.last.replace(encoder).map_or(0.0, |last| (encoder - last).abs());
        if step > 0.0 {
            self.encoder.step = self.encoder.step.min(step);
        }
        self.encoder.apart = self.encoder.apart.max(apart.abs());
    }

    /// Whether the encoder was further from the position than its resolution explains. One that never counted
    /// explains nothing.
    pub fn has_other_encoder(&self) -> bool {
        let Encoder { step, apart, .. } = self.encoder;
        apart > if step.is_finite() { step + 1.0 } else { 0.0 }
    }

    /// Where the curve is at a time; `None` if nothing is known.
    pub fn position_at(&self, at: Ticks) -> Option<f64> {
        let at = at as f64;
        let extents = self.buckets.iter().filter_map(|(_, motion)| motion.position);
        let mut before = None;
        for (time, position) in extents.flat_map(|extent| [extent.first, extent.last]) {
            match before {
                _ if time == at => return Some(position),
                None if time > at => return Some(position),
                Some((from, start)) if time > at => {
                    return Some(start + (position - start) * (at - from) / (time - from));
                }
                _ => before = Some((time, position)),
            }
        }
        before.map(|(_, position)| position)
    }

    /// Adds a train. It touches each bucket that it lasts through once, so that a long cruise costs no
    /// more than a short one.
    pub fn add(&mut self, train: &Train) {
        // One spacing may be longer than the last without a rest between.
        let most = if self.uneven.is_some() { 4.0 } else { 2.0 };
        let pause = self
            .last
            .is_none_or(|(end, spacing)| train.start.ticks.saturating_sub(end.ticks) as f64 > most * spacing);
        if pause {
            self.rest(train.start.ticks);
        }
        let sign = train.direction.sign();
        self.even_out(train);
        // A train may begin anywhere between the pulse before and its own first one.
        let first = match self.last {
            Some((end, _)) => clocks(train.moment(1).since(end).unwrap_or(0)),
            None => spacing(train, 1),
        };
        let spacing = |pulse| if pulse == 1 { first } else { spacing(train, pulse) };
        let (start, end) = (train.start.ticks, train.end());
        self.buckets.reach(end);
        let scale = self.buckets.scale;
        let mut done = 0;
        for bucket in scale.bucket(start)..=scale.bucket(end) {
            let count = train.count_until(scale.end(bucket) - 1);
            for pulse in [done + 1, count] {
                if pulse > done && pulse <= count {
                    let (edge, spacing) = (train.edge(pulse), spacing(pulse));
                    let position = self.position + sign * i64::from(pulse);
                    let content = &mut self.buckets.buckets[bucket];
                    Extent::add(&mut content.position, edge as f64, position as f64);
                    // The speed is that of the middle between two pulses.
                    let middle = edge as f64 - spacing / 2.0;
                    if self.uneven.is_none() {
                        Extent::add(&mut content.speed, middle, sign as f64 / spacing);
                    }
                }
            }
            done = count;
        }
        self.position += sign * i64::from(train.count);
        self.moved = true;
        self.last = Some((train.moment(train.count), spacing(train.count)));
        if let Some(uneven) = &mut self.uneven {
            uneven.pulses += sign * i64::from(train.count);
            if uneven.pulses.abs() >= EVENED {
                self.mean_speed();
            }
        }
    }

    /// Looks whether the spacing of a train says something about the speed.
    fn even_out(&mut self, train: &Train) {
        let turned = |uneven: &Uneven| uneven.pulses * train.direction.sign() < 0;
        if self.uneven.as_ref().is_some_and(turned) {
            self.mean_speed();
        }
        if train.mask != EVERY_SLOT {
            let since = self.last.map_or(train.start, |(end, _)| end);
            self.uneven.get_or_insert(Uneven { since, pulses: 0 });
        } else if i64::from(train.count) > EVENED {
            self.mean_speed();
            self.uneven = None;
        }
    }

    /// The mean speed since it was taken last.
    fn mean_speed(&mut self) {
        let (Some(uneven), Some((end, _))) = (&mut self.uneven, self.last) else { return };
        let span = clocks(end.since(uneven.since).unwrap_or(0));
        let (middle, speed) = (end.ticks as f64 - span / 2.0, uneven.pulses as f64 / span);
        *uneven = Uneven { since: end, pulses: 0 };
        if speed != 0.0 {
            let bucket = self.buckets.scale.bucket(middle as Ticks);
            Extent::add(&mut self.buckets.buckets[bucket].speed, middle, speed);
        }
    }

    /// The axis stood still from its last pulse until `until`.
    pub fn rest(&mut self, until: Ticks) {
        self.buckets.reach(until);
        self.mean_speed();
        self.uneven = None;
        if let Some((end, spacing)) = self.last.take() {
            let stopped = end.ticks + (spacing / 2.0) as Ticks;
            self.put(stopped.min(until), 0.0);
        }
        self.put(until, 0.0);
    }

    /// The recording ends, maybe in the middle of a movement.
    pub fn end(&mut self, at: Ticks) {
        if self.sampled.is_some() {
            return;
        }
        self.mean_speed();
        if self.last.is_none_or(|(end, spacing)| at.saturating_sub(end.ticks) as f64 > 2.0 * spacing) {
            self.rest(at);
        }
    }

    fn put(&mut self, at: Ticks, speed: f64) {
        self.buckets.reach(at);
        let bucket = self.buckets.scale.bucket(at);
        let content = &mut self.buckets.buckets[bucket];
        Extent::add(&mut content.position, at as f64, self.position as f64);
        Extent::add(&mut content.speed, at as f64, speed);
    }
}

/// The spacing before a pulse, in clocks.
fn spacing(train: &Train, pulse: u32) -> f64 {
    let before = train.offset(pulse - 1);
    clocks(train.offset(pulse).wrapping_sub(before))
}

/// A spacing in clocks; at least one, whatever was lost in rounding.
fn clocks(spacing: SubTicks) -> f64 {
    (spacing as f64 / (1_u64 << FRACTION_BITS) as f64).max(1.0)
}

/// A bucket of a pin: the extremes of the values that it was told, and the last one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Levels(pub Option<Span>);

/// Lowest, highest and last value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Span {
    pub low: f64,
    pub high: f64,
    pub last: f64,
}

impl Merge for Levels {
    fn merge(&self, later: &Self) -> Self {
        match (self.0, later.0) {
            (Some(first), Some(later)) => {
                let (low, high) = (first.low.min(later.low), first.high.max(later.high));
                Self(Some(Span { low, high, last: later.last }))
            }
            (first, later) => Self(later.or(first)),
        }
    }
}

impl Buckets<Levels> {
    pub fn add(&mut self, at: Ticks, value: f64) {
        self.reach(at);
        let bucket = self.scale.bucket(at);
        let content = &mut self.buckets[bucket];
        *content = content.merge(&Levels(Some(Span { low: value, high: value, last: value })));
    }

    /// All values together; `None` before the first.
    pub fn span(&self) -> Option<Span> {
        self.buckets.iter().fold(Levels::default(), |all, levels| all.merge(levels)).0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion::Direction;

    fn train(start: Ticks, interval: u64, count: u32, direction: Direction) -> Train {
        Train {
            start: Moment::at(start),
            interval: interval << 32,
            add: 0,
            jerk: 0,
            count,
            direction,
            mask: EVERY_SLOT,
        }
    }

    #[test]
    fn memory_is_bounded_and_extremes_stay() {
        let mut curves = Curves::new(0);
        let mut now = 0;
        for round in 0..10_000 {
            let direction = if round % 2 == 0 { Direction::Positive } else { Direction::Negative };
            // One peak is higher than all others.
            let count = if round / 2 == 70 { 5000 } else { 300 };
            let train = train(now, 100, count, direction);
            curves.add(&train);
            now = train.end() + 1_000_000;
        }
        assert!(curves.buckets.buckets.len() <= MAX_BUCKETS);
        let extents: Vec<_> = curves.buckets.iter().filter_map(|(_, motion)| motion.position).collect();
        assert_eq!(extents.iter().map(|extent| extent.high).fold(0.0, f64::max), 5000.0);
        assert_eq!(extents.iter().map(|extent| extent.low).fold(0.0, f64::min), 0.0);
        let fastest = curves.buckets.iter().filter_map(|(_, motion)| motion.speed).map(|extent| extent.high);
        assert_eq!(fastest.fold(0.0, f64::max), 0.01);
        assert_eq!(curves.position, 0);
    }

    #[test]
    fn a_long_cruise_is_in_every_bucket() {
        let mut curves = Curves::new(0);
        curves.add(&train(0, 1000, 2_000_000, Direction::Negative));
        for (end, motion) in curves.buckets.iter() {
            let Some(position) = motion.position else { continue };
            assert_eq!(position.last.1, -(position.last.0 / 1000.0), "bucket to {end}");
            assert_eq!(motion.speed.map(|speed| speed.last.1), Some(-0.001));
        }
        assert!(curves.buckets.buckets.len() > MAX_BUCKETS / 4);
    }

    /// Two of three slots, in trains of all lengths.
    #[test]
    fn the_speed_of_an_uneven_axis_is_its_mean() {
        let mut curves = Curves::new(0);
        let mut slot = 0;
        for length in (1..=64).cycle().take(2000) {
            let mask =
                (0..length).filter(|bit| (slot + bit) % 3 != 0).fold(0_u64, |mask, bit| mask | 1 << bit);
            let count = mask.count_ones();
            if count > 0 {
                curves.add(&Train { mask, ..train(slot * 1000, 1000, count, Direction::Positive) });
            }
            slot += length;
        }
        let speeds: Vec<_> = curves.buckets.iter().filter_map(|(_, motion)| motion.speed).collect();
        assert!(speeds.len() > 500, "{}", speeds.len());
        for speed in &speeds[2..] {
            for speed in [speed.low, speed.high] {
                assert!((speed * 1000.0 * 1.5 - 1.0).abs() < 0.02, "{speed}");
            }
        }
    }

    #[test]
    fn a_position_lies_between_two_that_are_known() {
        let mut curves = Curves::new(0);
        assert_eq!(curves.position_at(7), Some(0.0));
        curves.sample(1000, 10.0, 0.0);
        curves.sample(3000, 30.0, 0.0);
        for (at, expected) in [(0, 10.0), (1000, 10.0), (1500, 15.0), (3000, 30.0), (9000, 30.0)] {
            assert_eq!(curves.position_at(at), Some(expected), "at {at}");
        }
    }

    #[test]
    fn levels_keep_their_extremes() {
        let mut levels = Buckets::<Levels>::new(0);
        assert_eq!(levels.span(), None);
        for round in 0..100_000 {
            levels.add(round * 1000, if round == 777 { 9.0 } else { (round % 2) as f64 });
        }
        assert_eq!(levels.span(), Some(Span { low: 0.0, high: 9.0, last: 1.0 }));
    }

    #[test]
    fn a_pause_is_a_rest() {
        let mut curves = Curves::new(0);
        curves.add(&train(1_000_000, 100, 100, Direction::Positive));
        curves.add(&train(5_000_000, 100, 100, Direction::Positive));
        let standing = |at: f64| {
            let bucket = curves.buckets.iter().filter_map(|(_, motion)| motion.speed);
            bucket.filter(|speed| speed.last.0 <= at).last().map(|speed| speed.last.1)
        };
        assert_eq!(standing(900_000.0), Some(0.0));
        assert_eq!(standing(4_900_000.0), Some(0.0));
    }
}
