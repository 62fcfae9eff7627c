//! Counters of encoders, from shaft positions.

use super::{
    fitting::Encoder,
    shaft::{Shaft, Side},
    zone::Zone,
};
use crate::config::AxisConfig;

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
                }
            }
            Encoder::External => Self {
                side: Side::Load,
                numerator: ratio,
                denominator: 1 << FRACTION_BITS,
                mark: Zone::repeated(0, 0, axis.index_every),
            },
        }
    }

    /// Counts from where the shaft first stood. They are absolute, as those of a built-in encoder within
    /// a revolution are: who wants to count from power-up takes the first reading for 0.
    pub fn count(&self, shaft: &Shaft) -> i64 {
        let scaled = i128::from(shaft.position(self.side)) * i128::from(self.numerator);
        (scaled + self.denominator / 2).div_euclid(self.denominator) as i64
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
