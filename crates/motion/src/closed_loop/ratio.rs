//! Pulses and encoder counts.

/// Motor pulses an encoder count, in thousandths: 0.001 to 999.999 (PMX-2ED-SA manual, `SLR`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ratio(u32);

/// The largest ratio, in thousandths.
pub const MAX_THOUSANDTHS: u32 = 999_999;

impl Ratio {
    /// A pulse a count.
    pub const ONE: Self = Self(1000);

    /// A ratio from its thousandths, 1 to [`MAX_THOUSANDTHS`].
    pub const fn new(thousandths: u32) -> Option<Self> {
        if thousandths == 0 || thousandths > MAX_THOUSANDTHS { None } else { Some(Self(thousandths)) }
    }

    /// In thousandths.
    pub const fn thousandths(self) -> u32 {
        self.0
    }

    /// Encoder counts that make these pulses, or counts a second that make these pulses a second; to the
    /// nearest, halves away from 0.
    pub const fn counts(self, pulses: i64) -> i64 {
        nearest(pulses as i128 * 1000, self.0 as i128)
    }

    /// Pulses that make these counts, or pulses a second; to the nearest, halves away from 0.
    pub const fn pulses(self, counts: i64) -> i64 {
        nearest(counts as i128 * self.0 as i128, 1000)
    }
}

/// A quotient to the nearest whole number, halves away from 0; the nearest end of the range beyond it.
const fn nearest(value: i128, by: i128) -> i64 {
    let half = if value < 0 { -(by / 2) } else { by / 2 };
    let quotient = (value + half) / by;
    if quotient > i64::MAX as i128 {
        i64::MAX
    } else if quotient < i64::MIN as i128 {
        i64::MIN
    } else {
        quotient as i64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(thousandths: u32, counts: i64, pulses: i64) {
        let ratio = Ratio::new(thousandths).unwrap();
        for sign in [1, -1] {
            assert_eq!(ratio.pulses(sign * counts), sign * pulses, "{thousandths} {counts}");
        }
    }

    #[test]
    fn counts_to_the_nearest_pulse() {
        check(1000, 12_345, 12_345);
        check(1, 499, 0);
        check(1, 500, 1);
        check(1, 1_499, 1);
        check(1500, 1, 2);
        check(1500, 3, 5);
        check(333, 3, 1);
        check(999_999, 1, 1000);
        check(999_999, 1_000_000, 999_999_000);
        check(999_999, i64::from(i32::MAX), 2_147_481_499_516);
        assert_eq!(Ratio(999_999).pulses(i64::MAX), i64::MAX);
        assert_eq!(Ratio(999_999).pulses(i64::MIN), i64::MIN);
    }

    #[test]
    fn pulses_to_the_nearest_count() {
        let counts = |thousandths, pulses| Ratio::new(thousandths).unwrap().counts(pulses);
        assert_eq!(counts(1000, -7), -7);
        assert_eq!(counts(1, 1), 1000);
        assert_eq!(counts(999_999, 500), 1);
        assert_eq!(counts(999_999, 499), 0);
        assert_eq!(counts(999_999, -500), -1);
        assert_eq!(counts(3000, 4), 1);
        assert_eq!(counts(3000, 5), 2);
        // An odd ratio: there is no half.
        assert_eq!(counts(3, 1), 333);
        assert_eq!(counts(1, i64::MIN), i64::MIN);
    }

    /// There and back again is the same where a count is a pulse or more, and to half a count where not.
    #[test]
    fn there_and_back() {
        for thousandths in [1, 2, 3, 250, 999, 1000, 1001, 7_777, 999_999] {
            let ratio = Ratio::new(thousandths).unwrap();
            for counts in [0, 1, 2, 77, 1000, 123_456, i64::from(i32::MAX), -5, i64::from(i32::MIN)] {
                let back = ratio.counts(ratio.pulses(counts));
                let coarse = i64::from(500 / thousandths) + 1;
                let allowed = if thousandths < 1000 { coarse } else { 0 };
                assert!(back.abs_diff(counts) <= allowed as u64, "{thousandths} {counts} {back}");
            }
        }
    }

    #[test]
    fn bounds() {
        assert_eq!(Ratio::new(0), None);
        assert_eq!(Ratio::new(1_000_000), None);
        assert_eq!(Ratio::new(1).unwrap().thousandths(), 1);
        assert_eq!(Ratio::new(1000), Some(Ratio::ONE));
    }
}
