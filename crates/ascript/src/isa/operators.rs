//! Operators of calculations and comparisons of conditions (PMX manual 7.19.6, CMD manual 2.7.2 and 2.7.6).

use core::fmt;

/// What a line does with its operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Operator {
    /// Nothing: the value is that of the first operand.
    Copy = 0,
    /// All bits inverted, of the first operand.
    Not = 1,
    /// Sum.
    Add = 2,
    /// Difference.
    Subtract = 3,
    /// Product.
    Multiply = 4,
    /// Quotient, rounded down.
    Divide = 5,
    /// What [`Divide`](Self::Divide) leaves over; it has the sign of the divisor.
    Modulus = 6,
    /// Arithmetic shift to the right, by the low five bits of the second operand.
    ShiftRight = 7,
    /// Shift to the left, by the low five bits of the second operand.
    ShiftLeft = 8,
    /// Bitwise and.
    And = 9,
    /// Bitwise or.
    Or = 10,
}

impl Operator {
    /// All of them, in the order of their numbers, with the symbol between or before the operands.
    pub const ALL: [(Self, &'static str); 11] = [
        (Self::Copy, ""),
        (Self::Not, "~"),
        (Self::Add, "+"),
        (Self::Subtract, "-"),
        (Self::Multiply, "*"),
        (Self::Divide, "/"),
        (Self::Modulus, "%"),
        (Self::ShiftRight, ">>"),
        (Self::ShiftLeft, "<<"),
        (Self::And, "&"),
        (Self::Or, "|"),
    ];

    /// How many operands it has.
    pub const fn operands(self) -> usize {
        match self {
            Self::Copy | Self::Not => 1,
            _ => 2,
        }
    }

    /// How it is written.
    pub const fn symbol(self) -> &'static str {
        Self::ALL[self as usize].1
    }

    /// The operator of two operands that is written so.
    pub fn from_symbol(symbol: &str) -> Option<Self> {
        Self::ALL[2..].iter().find(|(_, text)| *text == symbol).map(|&(operator, _)| operator)
    }

    /// The operator of a number.
    pub fn from_number(number: u8) -> Option<Self> {
        Self::ALL.get(usize::from(number)).map(|&(operator, _)| operator)
    }

    /// The result, in 32 bits that wrap; `None` for a division by zero. Operators of one operand ignore `y`.
    #[inline(always)]
    pub const fn apply(self, x: i32, y: i32) -> Option<i32> {
        Some(match self {
            Self::Copy => x,
            Self::Not => !x,
            Self::Add => x.wrapping_add(y),
            Self::Subtract => x.wrapping_sub(y),
            Self::Multiply => x.wrapping_mul(y),
            Self::Divide | Self::Modulus if y == 0 => return None,
            Self::Divide => {
                let rest = x.wrapping_rem(y);
                x.wrapping_div(y) - (rest != 0 && (rest < 0) != (y < 0)) as i32
            }
            Self::Modulus => {
                let rest = x.wrapping_rem(y);
                if rest != 0 && (rest < 0) != (y < 0) { rest + y } else { rest }
            }
            Self::ShiftRight => x.wrapping_shr(y as u32),
            Self::ShiftLeft => x.wrapping_shl(y as u32),
            Self::And => x & y,
            Self::Or => x | y,
        })
    }
}

impl fmt::Display for Operator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol())
    }
}

/// What a condition asks of its two sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Comparison {
    /// They are equal.
    Equal = 0,
    /// They differ.
    NotEqual = 1,
    /// The left one is greater.
    Greater = 2,
    /// The left one is less.
    Less = 3,
    /// The left one is greater, or they are equal.
    GreaterOrEqual = 4,
    /// The left one is less, or they are equal.
    LessOrEqual = 5,
}

impl Comparison {
    /// All of them, in the order of their numbers, with their symbols.
    pub const ALL: [(Self, &'static str); 6] = [
        (Self::Equal, "="),
        (Self::NotEqual, "!="),
        (Self::Greater, ">"),
        (Self::Less, "<"),
        (Self::GreaterOrEqual, ">="),
        (Self::LessOrEqual, "<="),
    ];

    /// How it is written.
    pub const fn symbol(self) -> &'static str {
        Self::ALL[self as usize].1
    }

    /// The comparison that is written so.
    pub fn from_symbol(symbol: &str) -> Option<Self> {
        Self::ALL.iter().find(|(_, text)| *text == symbol).map(|&(comparison, _)| comparison)
    }

    /// The comparison of a number.
    pub fn from_number(number: u8) -> Option<Self> {
        Self::ALL.get(usize::from(number)).map(|&(comparison, _)| comparison)
    }

    /// The one that says the same with the sides exchanged.
    pub const fn mirrored(self) -> Self {
        match self {
            Self::Greater => Self::Less,
            Self::Less => Self::Greater,
            Self::GreaterOrEqual => Self::LessOrEqual,
            Self::LessOrEqual => Self::GreaterOrEqual,
            same => same,
        }
    }

    /// Whether it holds.
    #[inline(always)]
    pub const fn holds(self, left: i32, right: i32) -> bool {
        match self {
            Self::Equal => left == right,
            Self::NotEqual => left != right,
            Self::Greater => left > right,
            Self::Less => left < right,
            Self::GreaterOrEqual => left >= right,
            Self::LessOrEqual => left <= right,
        }
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_symbols() {
        for (number, (operator, symbol)) in Operator::ALL.into_iter().enumerate() {
            assert_eq!(operator as usize, number);
            assert_eq!(Operator::from_number(number as u8), Some(operator));
            assert_eq!(Operator::from_symbol(symbol), (operator.operands() == 2).then_some(operator));
        }
        for (number, (comparison, symbol)) in Comparison::ALL.into_iter().enumerate() {
            assert_eq!(comparison as usize, number);
            assert_eq!(Comparison::from_number(number as u8), Some(comparison));
            assert_eq!(Comparison::from_symbol(symbol), Some(comparison));
        }
    }

    #[test]
    fn operators() {
        use Operator::*;
        let check = |operator: Operator, x, y, expected| {
            assert_eq!(operator.apply(x, y), expected, "{x} {operator} {y}");
        };
        check(Copy, 7, 0, Some(7));
        check(Not, 0, 9, Some(-1));
        check(Add, 2, 3, Some(5));
        check(Add, i32::MAX, 1, Some(i32::MIN));
        check(Subtract, 2, 3, Some(-1));
        check(Subtract, i32::MIN, 1, Some(i32::MAX));
        check(Multiply, -4, 3, Some(-12));
        check(Multiply, 0x4000_0000, 4, Some(0));
        check(Divide, 7, 2, Some(3));
        check(Divide, -7, 2, Some(-4));
        check(Divide, 7, -2, Some(-4));
        check(Divide, -7, -2, Some(3));
        check(Divide, -8, 2, Some(-4));
        check(Divide, i32::MIN, -1, Some(i32::MIN));
        check(Divide, 1, 0, None);
        check(Modulus, 7, 5, Some(2));
        check(Modulus, -7, 5, Some(3));
        check(Modulus, 7, -5, Some(-3));
        check(Modulus, -7, -5, Some(-2));
        check(Modulus, i32::MIN, -1, Some(0));
        check(Modulus, 1, 0, None);
        check(ShiftRight, -8, 1, Some(-4));
        check(ShiftRight, 8, 33, Some(4));
        check(ShiftLeft, 3, 2, Some(12));
        check(ShiftLeft, 1, 31, Some(i32::MIN));
        check(ShiftLeft, 1, -31, Some(2));
        check(And, 0b1100, 0b1010, Some(0b1000));
        check(Or, 0b1100, 0b1010, Some(0b1110));
    }

    #[test]
    fn quotient_and_modulus_fit_together() {
        for x in -20..=20 {
            for y in (-7..=7).filter(|&y| y != 0) {
                let quotient = Operator::Divide.apply(x, y).expect("no zero");
                let rest = Operator::Modulus.apply(x, y).expect("no zero");
                assert_eq!(quotient * y + rest, x);
                assert!(quotient <= x / y && (rest == 0 || (rest < 0) == (y < 0)), "{x} {y}");
            }
        }
    }

    #[test]
    fn comparisons() {
        for (comparison, _) in Comparison::ALL {
            let holds = [(1, 2), (2, 2), (3, 2)].map(|(left, right)| comparison.holds(left, right));
            let expected = match comparison {
                Comparison::Equal => [false, true, false],
                Comparison::NotEqual => [true, false, true],
                Comparison::Greater => [false, false, true],
                Comparison::Less => [true, false, false],
                Comparison::GreaterOrEqual => [false, true, true],
                Comparison::LessOrEqual => [true, true, false],
            };
            assert_eq!(holds, expected, "{comparison}");
            for (left, right) in [(1, 2), (2, 2), (3, 2), (i32::MIN, i32::MAX)] {
                assert_eq!(comparison.holds(left, right), comparison.mirrored().holds(right, left));
            }
        }
    }
}
