//! Accumulator, X register and flags, and the arithmetic on them.

use crate::isa::{Condition, Flag};

/// The flags that `JC` and `CALL` look at: bit `n` is set if condition `n` holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Flags(u16);

const fn bit(condition: Condition) -> u16 {
    1 << condition as u8
}

/// What a result sets: zero or not, and the sign.
const RESULT: u16 = bit(Condition::Zero) | bit(Condition::NotZero) | SIGN;
const SIGN: u16 = bit(Condition::Greater)
    | bit(Condition::GreaterEqual)
    | bit(Condition::Lower)
    | bit(Condition::LowerEqual);

/// What a comparison sets: that, and equal or not.
const COMPARISON: u16 = RESULT | bit(Condition::Equal) | bit(Condition::NotEqual);

const BELOW: u16 =
    bit(Condition::NotZero) | bit(Condition::NotEqual) | bit(Condition::Lower) | bit(Condition::LowerEqual);
const SAME: u16 =
    bit(Condition::Zero) | bit(Condition::Equal) | bit(Condition::GreaterEqual) | bit(Condition::LowerEqual);
const ABOVE: u16 = bit(Condition::NotZero)
    | bit(Condition::NotEqual)
    | bit(Condition::Greater)
    | bit(Condition::GreaterEqual);

impl Flags {
    /// All clear: nothing compared, no error.
    pub(super) const CLEAR: Self = Self(bit(Condition::NotZero) | bit(Condition::NotEqual));

    /// The content of the flags after `left` was compared with `right`.
    const fn of(left: i32, right: i32) -> u16 {
        [BELOW, SAME, ABOVE][(left > right) as usize + (left >= right) as usize]
    }

    /// Sets all but the error flags.
    #[inline(always)]
    pub(super) const fn compare(&mut self, left: i32, right: i32) {
        self.0 = self.0 & !COMPARISON | Self::of(left, right);
    }

    /// Sets zero and sign, and leaves equality alone.
    #[inline(always)]
    pub(super) const fn result(&mut self, value: i32) {
        self.0 = self.0 & !RESULT | Self::of(value, 0) & RESULT;
    }

    /// Whether a condition holds.
    #[inline(always)]
    pub(super) const fn holds(self, condition: u8) -> bool {
        self.0 >> condition & 1 != 0
    }

    /// Sets an error flag.
    pub(super) const fn raise(&mut self, condition: Condition) {
        self.0 |= bit(condition) & !COMPARISON;
    }

    /// What `CLE` does.
    pub(super) const fn clear(&mut self, flag: Flag) {
        self.0 &= match flag {
            Flag::All => COMPARISON,
            Flag::Timeout => !bit(Condition::Timeout),
            Flag::Alarm => !bit(Condition::Alarm),
            Flag::Deviation => !bit(Condition::Deviation),
            Flag::PositionError => !bit(Condition::PositionError),
            Flag::Shutdown => !bit(Condition::Shutdown),
        };
    }

    /// These flags, with the error flags of `other`.
    pub(super) const fn with_errors_of(self, other: Self) -> Self {
        Self(self.0 & COMPARISON | other.0 & !COMPARISON)
    }
}

/// What an interrupt saves and a reset clears.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Registers {
    pub(super) accumulator: i32,
    pub(super) x: i32,
    pub(super) flags: Flags,
}

impl Registers {
    pub(super) const RESET: Self = Self { accumulator: 0, x: 0, flags: Flags::CLEAR };

    /// What a command that reads something does with it in a program.
    #[inline(always)]
    pub(super) const fn read(&mut self, value: i32) {
        self.accumulator = value;
        self.flags.compare(value, 0);
    }
}
