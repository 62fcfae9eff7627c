//! The words that stand for numbers in a command.

/// A word and its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Keyword {
    /// The word, in upper case.
    pub name: &'static str,
    /// The content of the field.
    pub number: u8,
}

/// An enum whose numbers are those of a field, with its words.
macro_rules! keywords {
    ($(#[$meta:meta])* $type:ident { $($(#[$doc:meta])* $variant:ident = $number:literal $name:literal,)* }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[repr(u8)]
        pub enum $type { $($(#[$doc])* $variant = $number,)* }

        impl $type {
            /// The words, in the order of their numbers.
            pub const KEYWORDS: &'static [Keyword] = &[$(Keyword { name: $name, number: $number },)*];

            /// What a field with this number says.
            pub const fn from_number(number: u8) -> Option<Self> {
                match number {
                    $($number => Some(Self::$variant),)*
                    _ => None,
                }
            }

            /// The word.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)* }
            }
        }
    };
}

keywords! {
    /// What `CALC` and its relatives do (manual 3.7.16, 3.7.28, 3.7.36 to 3.7.41).
    Operation {
        /// Sum.
        Add = 0 "ADD",
        /// Difference.
        Sub = 1 "SUB",
        /// Product.
        Mul = 2 "MUL",
        /// Quotient, toward zero.
        Div = 3 "DIV",
        /// Remainder, with the sign of the dividend.
        Mod = 4 "MOD",
        /// Bitwise and.
        And = 5 "AND",
        /// Bitwise or.
        Or = 6 "OR",
        /// Bitwise exclusive or.
        Xor = 7 "XOR",
        /// Bitwise complement.
        Not = 8 "NOT",
        /// Copy.
        Load = 9 "LOAD",
        /// Exchange.
        Swap = 10 "SWAP",
        /// Comparison.
        Comp = 11 "COMP",
    }
}

keywords! {
    /// When `JC` jumps and `CALL` calls (manual 3.7.18, 3.7.44).
    Condition {
        /// The last result was zero.
        Zero = 0 "ZE",
        /// It was not.
        NotZero = 1 "NZ",
        /// The last comparison found both equal.
        Equal = 2 "EQ",
        /// It did not.
        NotEqual = 3 "NE",
        /// Greater than the operand, or above zero.
        Greater = 4 "GT",
        /// Greater or equal.
        GreaterEqual = 5 "GE",
        /// Lower.
        Lower = 6 "LT",
        /// Lower or equal.
        LowerEqual = 7 "LE",
        /// A `WAIT` has timed out.
        Timeout = 8 "ETO",
        /// External alarm.
        Alarm = 9 "EAL",
        /// The motor was stopped because the encoder deviated.
        Deviation = 10 "EDV",
        /// A move ended off its target.
        PositionError = 11 "EPO",
        /// The driver was shut down.
        Shutdown = 12 "ESD",
    }
}

keywords! {
    /// What `WAIT` waits for (manual 3.7.22).
    WaitFor {
        /// Time.
        Ticks = 0 "TICKS",
        /// The target position.
        Position = 1 "POS",
        /// The home switch.
        HomeSwitch = 2 "REFSW",
        /// A stop switch.
        LimitSwitch = 3 "LIMSW",
        /// The end of the reference search.
        RefSearch = 4 "RFS",
    }
}

keywords! {
    /// What `CLE` clears (manual 3.7.31).
    Flag {
        /// All error flags.
        All = 0 "ALL",
        /// [`Condition::Timeout`].
        Timeout = 1 "ETO",
        /// [`Condition::Alarm`].
        Alarm = 2 "EAL",
        /// [`Condition::Deviation`].
        Deviation = 3 "EDV",
        /// [`Condition::PositionError`].
        PositionError = 4 "EPO",
        /// [`Condition::Shutdown`].
        Shutdown = 5 "ESD",
    }
}

keywords! {
    /// Where `MVP` and `MVPA` go (manual 3.7.4, 3.7.45).
    MoveKind {
        /// To a position.
        Absolute = 0 "ABS",
        /// A distance from the actual position.
        Relative = 1 "REL",
        /// To a stored coordinate.
        Coordinate = 2 "COORD",
    }
}

keywords! {
    /// What `RFS` does (manual 3.7.13).
    RefSearch {
        /// Starts the search.
        Start = 0 "START",
        /// Stops it.
        Stop = 1 "STOP",
        /// Tells whether it is running.
        Status = 2 "STATUS",
    }
}
