//! One entry a command: name, what follows it, what it takes, and what people want to know.

/// What follows the name of a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Nothing.
    Bare,
    /// An axis: `PX`.
    Axis,
    /// One of the first so many axes: `JMAXX`.
    AxisOf(u8),
    /// An axis, or nothing, which means the first one: `SYNO`.
    AxisOrFirst,
    /// An axis, or nothing, which reads that of the first one and sets that of all: `ERCD=1`.
    AxisOrEach,
    /// An axis or nothing, which means all of them or the global value: `ACC`, `ACCX`.
    MaybeAxis,
    /// A number in this range: `V12`.
    Index(u16, u16),
    /// A number in this range or nothing, which means all of them: `DI`, `DI3`.
    MaybeIndex(u16, u16),
    /// An axis and a direction: `HX+`.
    Way,
    /// A direction with an axis or, for all of them, without: `JX+`, `J-`.
    MaybeWay,
    /// An axis and a number: `TX1000`.
    AxisNumber,
    /// Targets, each after the letter of its axis: `X1000Y-200`. The name is empty.
    Targets,
    /// So many numbers with `:` between: `I1000:-200`.
    Numbers(u8),
    /// An axis, a direction and a number in this range: `HX-12`.
    WayMode(u8, u8),
    /// Two different axes, which way to turn, and so many numbers: `CIRXYP1000:0`.
    Plane(u8),
    /// Which way to turn, and so many numbers; the plane is that of the first two axes: `CIRTP1000:0:500`.
    Helix(u8),
}

/// What a command remembers, reads or takes after `=`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value {
    /// Nothing: it acts.
    None,
    /// A number that is kept as it was written, from `low` to `high`.
    Kept {
        /// Digits after the point; the numbers here are without the point.
        decimals: u8,
        /// The least number.
        low: i32,
        /// The greatest number.
        high: i32,
        /// From the factory.
        default: i32,
        /// Whether it survives the power being switched off, once stored.
        stored: bool,
    },
    /// Something that the device works out: readable, and writable with numbers in a range.
    Device {
        /// Whether the bare command reads it.
        read: bool,
        /// From where to where numbers can be written.
        write: Option<(i32, i32)>,
    },
    /// Text: readable or writable or both.
    Text {
        /// Whether the bare command reads it.
        read: bool,
        /// Whether it can be written.
        write: bool,
    },
}

impl Value {
    /// Whether the command without `=` reads or does something.
    pub const fn can_ask(self) -> bool {
        match self {
            Self::None | Self::Kept { .. } => true,
            Self::Device { read, .. } | Self::Text { read, .. } => read,
        }
    }

    /// Whether the command takes `=` and a value.
    pub const fn can_set(self) -> bool {
        match self {
            Self::None => false,
            Self::Kept { .. } => true,
            Self::Device { write, .. } => write.is_some(),
            Self::Text { write, .. } => write,
        }
    }

    /// Digits after the point.
    pub const fn decimals(self) -> u8 {
        match self {
            Self::Kept { decimals, .. } => decimals,
            _ => 0,
        }
    }

    /// The numbers that can be written.
    pub const fn range(self) -> Option<(i32, i32)> {
        match self {
            Self::Kept { low, high, .. } => Some((low, high)),
            Self::Device { write, .. } => write,
            Self::None | Self::Text { .. } => None,
        }
    }
}

/// What people want to know of a command.
#[cfg(feature = "std")]
#[derive(Clone, Copy, Debug)]
pub struct About {
    /// Its name: words that begin with capitals, without spaces.
    pub title: &'static str,
    /// Unit of its value; empty for a plain number or none.
    pub unit: &'static str,
    /// What it does, in a sentence.
    pub text: &'static str,
    /// The manual's section.
    pub section: &'static str,
    /// How it is written.
    pub example: &'static str,
    /// The test that holds its effect.
    pub test: &'static str,
}

/// A command; `I` is the device's list of them.
#[derive(Clone, Copy, Debug)]
pub struct Command<I: 'static> {
    /// Which one.
    pub id: I,
    /// What it begins with.
    pub name: &'static str,
    /// What follows the name.
    pub form: Form,
    /// What it remembers, reads or takes.
    pub value: Value,
    /// For people.
    #[cfg(feature = "std")]
    pub about: About,
}

impl<I> Command<I> {
    /// How many numbers it remembers on a device with so many axes.
    pub const fn places(&self, axes: usize) -> usize {
        match (self.value, self.form) {
            (Value::None | Value::Device { .. } | Value::Text { .. }, _) => 0,
            (_, Form::Axis | Form::AxisOrFirst | Form::AxisOrEach) => axes,
            (_, Form::AxisOf(count)) => count as usize,
            (_, Form::MaybeAxis) => 1 + axes,
            (_, Form::Index(low, high)) => (high - low) as usize + 1,
            _ => 1,
        }
    }
}

/// A list of commands, each of which knows where it stands in its table.
pub trait Id: Copy + PartialEq + 'static {
    /// The position of its entry.
    fn position(self) -> usize;
}

/// A table of commands and the list of their names. The position of an entry in the list is its number
/// in flash: new ones go to the end.
///
/// ```text
/// Id "NAME" form, value; "unit" "section" "example" "text" test;
/// ```
macro_rules! commands {
    ($(#[$doc:meta])* $table:ident: $ids:ident { $($id:ident $name:literal $form:expr, $value:expr;
        $unit:literal $section:literal $example:literal $text:literal $test:ident;)* }) => {
        /// The commands.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $ids {
            $(#[doc = $text] $id,)*
        }

        impl $crate::ascii::command::Id for $ids {
            fn position(self) -> usize {
                self as usize
            }
        }

        $(#[$doc])*
        pub static $table: &[$crate::ascii::Command<$ids>] = &[$($crate::ascii::Command {
            id: $ids::$id,
            name: $name,
            form: $form,
            value: $value,
            #[cfg(feature = "std")]
            about: $crate::ascii::command::About {
                title: stringify!($id),
                unit: $unit,
                text: $text,
                section: $section,
                example: $example,
                test: stringify!($test),
            },
        }),*];
    };
}
pub(crate) use commands;
