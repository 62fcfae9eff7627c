//! Round numbers along an axis.

/// Where the ticks of an axis are, and how they are written.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Ticks {
    /// The numbers, in order.
    pub values: Vec<f64>,
    exponent: i32,
    decimals: usize,
}

/// Most digits behind the point.
const MAX_DECIMALS: f64 = 12.0;

/// At most `most` ticks from `low` to `high`: 1, 2 or 5 and a power of ten apart; one tick where there is no room
/// between them.
pub(super) fn ticks(low: f64, high: f64, most: usize) -> Ticks {
    if low >= high {
        return Ticks { values: vec![low], exponent: 0, decimals: 0 };
    }
    let coarse = (high - low) / most.max(1) as f64;
    let power = 10_f64.powf(coarse.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .map(|factor| factor * power)
        .into_iter()
        .find(|step| *step > coarse * (1.0 - 1e-9));
    let step = step.unwrap_or(10.0 * power);
    let first = (low / step - 1e-9).ceil();
    let last = (high / step + 1e-9).floor();
    // Adding 0 turns −0 into 0.
    let values: Vec<_> = (first as i64..=last as i64).map(|number| number as f64 * step + 0.0).collect();
    let largest = values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    // Thousands and millions are said once, beside the unit.
    let exponent = match largest {
        1e4.. => ((largest.log10() + 1e-9) / 3.0).floor() as i32 * 3,
        _ => 0,
    };
    let decimals = (exponent as f64 - step.log10() - 1e-9).ceil().clamp(0.0, MAX_DECIMALS) as usize;
    Ticks { values, exponent, decimals }
}

impl Ticks {
    /// A number without its power of ten.
    pub fn label(&self, value: f64) -> String {
        let text = format!("{:.*}", self.decimals, value / 10_f64.powi(self.exponent));
        text.replace('-', "−")
    }

    /// The power of ten, to be written before the unit; empty if there is none.
    pub fn power(&self) -> String {
        let digits = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
        match self.exponent {
            0 => String::new(),
            exponent => {
                let exponent: String =
                    exponent.to_string().bytes().map(|digit| digits[usize::from(digit - b'0')]).collect();
                format!("10{exponent} ")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(low: f64, high: f64, most: usize, expected: &[&str], power: &str) {
        let ticks = ticks(low, high, most);
        let labels: Vec<_> = ticks.values.iter().map(|value| ticks.label(*value)).collect();
        assert_eq!(labels, expected);
        assert_eq!(ticks.power(), power);
    }

    #[test]
    fn numbers_are_round() {
        check(0.0, 1.0, 5, &["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"], "");
        check(0.0, 2.6, 9, &["0.0", "0.5", "1.0", "1.5", "2.0", "2.5"], "");
        check(-3.0, 54.0, 6, &["0", "10", "20", "30", "40", "50"], "");
        check(-3000.0, 54_000.0, 6, &["0", "10", "20", "30", "40", "50"], "10³ ");
        check(-1.3e6, 1.3e6, 6, &["−1.0", "−0.5", "0.0", "0.5", "1.0"], "10⁶ ");
        check(0.0, 0.0012, 4, &["0.0000", "0.0005", "0.0010"], "");
        check(7.0, 7.0, 4, &["7"], "");
        check(100.0, 100.2, 4, &["100.00", "100.05", "100.10", "100.15", "100.20"], "");
    }
}
