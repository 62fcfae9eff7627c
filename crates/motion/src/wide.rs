//! Division of wide numbers, in one place: on a chip it is some kilobytes of code wherever it is written out.

/// The quotient, rounded down.
///
/// # Panics
/// If the divisor is 0.
#[inline(never)]
pub(crate) const fn quotient(dividend: u128, divisor: u128) -> u128 {
    // Mostly the numbers are not as wide as they could be.
    if (dividend | divisor) >> u64::BITS == 0 {
        return (dividend as u64 / divisor as u64) as u128;
    }
    dividend / divisor
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wide_and_narrow_quotients() {
        let numbers = [1, 3, u64::MAX as u128, 1 << 64, (1 << 64) + 5, u128::MAX / 7, u128::MAX];
        for dividend in numbers.into_iter().chain([0]) {
            for divisor in numbers {
                assert_eq!(quotient(dividend, divisor), dividend / divisor, "{dividend} by {divisor}");
            }
        }
    }
}
