//! Counters of encoders, from shaft positions.

use super::{
    fitting::Encoder,
    shaft::{Edge, Shaft, Side},
    zone::{NEVER, Zone},
};
use crate::config::{AxisConfig, EncoderPlace};

/// Positions in a revolution: 200 full steps of 256.
pub(crate) const TURN: i64 = 200 * 256;

const FRACTION_BITS: u32 = 32;

/// An encoder and the counter behind it.
#[derive(Clone, Debug)]
pub(crate) struct Counter {
    side: Side,
    /// Counts are `position · numerator / denominator`, rounded to the nearest.
    numerator: i64,
    denominator: i128,
    mark: Zone,
    /// What it has not counted while it was broken.
    missed: i64,
    /// Where it stands if it is.
    broken_at: Option<i64>,
}

impl Counter {
    pub fn new(encoder: Encoder, axis: &AxisConfig) -> Self {
        // The configuration allows ratios from 1e-6 to 1e6 only.
        let ratio = (axis.encoder_ratio * (1_i64 << FRACTION_BITS) as f64).round() as i64;
        match encoder {
            Encoder::BuiltIn(counts) => {
                let count = TURN / counts;
                Self {
                    side: Side::Motor,
                    numerator: ratio,
                    denominator: i128::from(count) << FRACTION_BITS,
                    // Where a counter that started at the mark would show a multiple of the turn.
                    mark: Zone::repeated(-(count / 2), count - count / 2 - 1, TURN),
                    missed: 0,
                    broken_at: None,
                }
            }
            Encoder::External => Self {
                side: match axis.encoder_at {
                    EncoderPlace::Motor => Side::Motor,
                    EncoderPlace::Load => Side::Load,
                },
                numerator: ratio,
                denominator: 1 << FRACTION_BITS,
                mark: Zone::marks(axis.index_every),
                missed: 0,
                broken_at: None,
            },
        }
    }

    /// Counts from where the shaft first stood. They are absolute, as those of a built-in encoder within
    /// a revolution are: who wants to count from power-up takes the first reading for 0.
    pub fn count(&self, shaft: &Shaft) -> i64 {
        self.broken_at.unwrap_or_else(|| self.turned(shaft) - self.missed)
    }

    /// Stops counting, or goes on from where it stands.
    pub fn set_broken(&mut self, broken: bool, shaft: &Shaft) {
        let count = self.count(shaft);
        self.missed = self.turned(shaft) - count;
        self.broken_at = broken.then_some(count);
    }

    /// What it would have counted had it never been broken.
    fn turned(&self, shaft: &Shaft) -> i64 {
        let scaled = i128::from(shaft.position(self.side)) * i128::from(self.numerator);
        (scaled + self.denominator / 2).div_euclid(self.denominator) as i64
    }

    /// Counts for positions, in lowest terms.
    pub fn ratio(&self) -> (i64, i64) {
        let (mut a, mut b) = (i128::from(self.numerator.abs()), self.denominator);
        while b != 0 {
            (a, b) = (b, a % b);
        }
        // A configuration has no more than 64 bits in either.
        (self.numerator / a as i64, (self.denominator / a) as i64)
    }

    /// The positions at which it has counted so far down or up from where it stands; they turn around where
    /// it counts backwards.
    pub fn edge(&self, shaft: &Shaft, down: u32, up: u32) -> Edge {
        if self.broken_at.is_some() {
            return Edge { side: self.side, below: -NEVER, above: NEVER };
        }
        let now = self.turned(shaft);
        // The first position with at least this count, along the direction in which it counts up.
        let step = i128::from(self.numerator.abs());
        let first = |count: i64| {
            let scaled = i128::from(count) * self.denominator - self.denominator / 2;
            let first = scaled.div_euclid(step) + i128::from(scaled.rem_euclid(step) != 0);
            first.clamp(-i128::from(NEVER), i128::from(NEVER)) as i64
        };
        let (below, above) = (first(now - i64::from(down) + 1) - 1, first(now + i64::from(up)));
        let (below, above) = if self.numerator > 0 { (below, above) } else { (-above, -below) };
        Edge { side: self.side, below, above }
    }

    /// Where the index or null channel is on.
    pub fn mark(&self) -> (Side, Zone) {
        (self.side, self.mark)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(encoder: Encoder, encoder_ratio: f64, positions: &[(i64, i64)]) {
        let counter = Counter::new(encoder, &AxisConfig { encoder_ratio, ..AxisConfig::of_model("") });
        for (position, count) in positions {
            let mut shaft = Shaft::new(0, None);
            shaft.turn(*position);
            assert_eq!(counter.count(&shaft), *count, "ratio {encoder_ratio} at {position}");
        }
    }

    #[test]
    fn a_built_in_encoder_counts_its_part_of_a_turn() {
        let sensostep = Encoder::BuiltIn(1024);
        check(
            sensostep,
            1.0,
            &[(0, 0), (24, 0), (25, 1), (50, 1), (-25, 0), (-26, -1), (TURN, 1024), (-TURN, -1024)],
        );
        check(sensostep, 0.5, &[(TURN, 512), (-TURN, -512)]);
    }

    #[test]
    fn edges_are_where_the_count_is_reached() {
        for encoder in [Encoder::External, Encoder::BuiltIn(1024)] {
            for encoder_ratio in [1.0, -1.0, 4.0, -2.5, 0.25, 0.1, -0.3] {
                let axis = AxisConfig { encoder_ratio, ..AxisConfig::of_model("") };
                let counter = Counter::new(encoder, &axis);
                let at = |position| {
                    let mut shaft = Shaft::new(0, None);
                    shaft.turn(position);
                    shaft
                };
                for place in -60..60 {
                    let now = counter.count(&at(place));
                    for (down, up) in [(1, 1), (2, 7), (5, 3)] {
                        let reached = |position: &i64| {
                            let count = counter.count(&at(*position));
                            count <= now - i64::from(down) || count >= now + i64::from(up)
                        };
                        let below = (-10_000..place).rev().find(reached).unwrap();
                        let above = (place + 1..10_000).find(reached).unwrap();
                        let expected = Edge { side: counter.side, below, above };
                        let got = counter.edge(&at(place), down, up);
                        assert_eq!(got, expected, "{encoder:?} {encoder_ratio} at {place}, {down} {up}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_broken_one_goes_on_from_where_it_stands() {
        let mut counter = Counter::new(Encoder::External, &AxisConfig::of_model(""));
        let mut shaft = Shaft::new(0, None);
        shaft.turn(100);
        for (broken, turn, count) in [(true, 30, 100), (true, 5, 100), (false, 7, 107), (false, -10, 97)] {
            counter.set_broken(broken, &shaft);
            shaft.turn(turn);
            assert_eq!(counter.count(&shaft), count);
        }
        assert_eq!(counter.edge(&shaft, 1, 1), Edge { side: Side::Load, below: 131, above: 133 });
        counter.set_broken(true, &shaft);
        assert_eq!(counter.edge(&shaft, 1, 1), Edge { side: Side::Load, below: -NEVER, above: NEVER });
    }

    #[test]
    fn an_external_encoder_counts_pulses() {
        check(
            Encoder::External,
            1.0,
            &[(0, 0), (1, 1), (-1, -1), (i64::from(i32::MAX), i64::from(i32::MAX))],
        );
        check(Encoder::External, -0.25, &[(400, -100), (-400, 100)]);
        check(Encoder::External, 0.1, &[(10_000_000, 1_000_000)]);
    }
}
