//! Curves in bounded memory: a fixed number of buckets of time that double in width when they run out.

use motion::{Moment, SubTicks, Ticks, Train, train::FRACTION_BITS};

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
}

impl Merge for Motion {
    fn merge(&self, later: &Self) -> Self {
        Self {
            position: Extent::merge(self.position, later.position),
            speed: Extent::merge(self.speed, later.speed),
        }
    }
}

/// The curves of an axis.
#[derive(Clone, Debug)]
pub(super) struct Curves {
    pub buckets: Buckets<Motion>,
    position: i64,
    /// When the last pulse was, and its spacing in clocks.
    last: Option<(Moment, f64)>,
}

impl Curves {
    pub fn new(origin: Ticks) -> Self {
        let mut curves = Self { buckets: Buckets::new(origin), position: 0, last: None };
        curves.put(origin, 0.0);
        curves
    }

    /// Pulses from the start of the recording.
    pub fn position(&self) -> i64 {
        self.position
    }

    /// Adds a train. It touches each bucket that it lasts through once, so that a long cruise costs no
    /// more than a short one.
    pub fn add(&mut self, train: &Train) {
        let pause = match self.last {
            // One spacing may be longer than the last without a rest between.
            Some((end, spacing)) => train.start.ticks.saturating_sub(end.ticks) as f64 > 2.0 * spacing,
            None => true,
        };
        if pause {
            self.rest(train.start.ticks);
        }
        // A train may begin anywhere between the pulse before and its own first one.
        let first = match self.last {
            Some((end, _)) => clocks(train.moment(1).since(end).unwrap_or(0)),
            None => spacing(train, 1),
        };
        let spacing = |pulse| if pulse == 1 { first } else { spacing(train, pulse) };
        let (start, end) = (train.start.ticks, train.end());
        self.buckets.reach(end);
        let scale = self.buckets.scale;
        let sign = train.direction.sign();
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
                    Extent::add(&mut content.speed, middle, sign as f64 / spacing);
                }
            }
            done = count;
        }
        self.position += sign * i64::from(train.count);
        self.last = Some((train.moment(train.count), spacing(train.count)));
    }

    /// The axis stood still from its last pulse until `until`.
    pub fn rest(&mut self, until: Ticks) {
        self.buckets.reach(until);
        if let Some((end, spacing)) = self.last.take() {
            let stopped = end.ticks + (spacing / 2.0) as Ticks;
            self.put(stopped.min(until), 0.0);
        }
        self.put(until, 0.0);
    }

    /// The recording ends, maybe in the middle of a movement.
    pub fn end(&mut self, at: Ticks) {
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

/// A bucket of a digital pin: which levels it had, and the last one.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Levels {
    pub off: bool,
    pub on: bool,
    pub last: Option<bool>,
}

impl Merge for Levels {
    fn merge(&self, later: &Self) -> Self {
        Self { off: self.off || later.off, on: self.on || later.on, last: later.last.or(self.last) }
    }
}

impl Buckets<Levels> {
    pub fn add(&mut self, at: Ticks, on: bool) {
        self.reach(at);
        let bucket = self.scale.bucket(at);
        let content = &mut self.buckets[bucket];
        content.on |= on;
        content.off |= !on;
        content.last = Some(on);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion::{Direction, train::EVERY_SLOT};

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
        assert_eq!(curves.position(), 0);
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
