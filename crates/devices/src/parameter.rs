//! One entry a parameter: everything that is known of it stands in its device's table.
//!
//! Reading, writing, storing, validation, include files, help and the conformance matrix derive from the
//! entry. What only hosts need is left out of a build without `std`.

/// What may be done with a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Access(u8);

impl Access {
    /// It can be read.
    pub const R: Self = Self(1);
    /// Read and written.
    pub const RW: Self = Self(3);
    /// Read, written, and stored on command.
    pub const RWE: Self = Self(7);
    /// Read, written, and stored whenever it is written.
    pub const RWA: Self = Self(11);

    /// Whether it can be written.
    pub const fn writable(self) -> bool {
        self.0 & 2 != 0
    }

    /// Whether a store command applies to it.
    pub const fn storable(self) -> bool {
        self.0 & 4 != 0
    }

    /// Whether writing stores it.
    pub const fn automatic(self) -> bool {
        self.0 & 8 != 0
    }

    /// The letters of the manuals: `R`, `RW`, `RWE`, `RWA`.
    pub const fn letters(self) -> &'static str {
        match self.0 {
            1 => "R",
            3 => "RW",
            7 => "RWE",
            _ => "RWA",
        }
    }
}

/// What hosts and people want to know of a parameter.
#[cfg(feature = "std")]
#[derive(Clone, Copy, Debug)]
pub struct About {
    /// Its name in the manual.
    pub name: &'static str,
    /// Its symbol in the assembler's include file.
    pub symbol: &'static str,
    /// Unit of the value; empty for a plain number.
    pub unit: &'static str,
    /// What it does, in a sentence.
    pub text: &'static str,
    /// The test that holds its effect.
    pub test: &'static str,
}

/// A parameter.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Its number in commands.
    pub number: u8,
    /// The least value.
    pub low: i32,
    /// The greatest value. Less than `low` means that all 32 bits count, without a sign.
    pub high: i32,
    /// What may be done with it.
    pub access: Access,
    /// Its value from the factory.
    pub default: i32,
    /// For people.
    #[cfg(feature = "std")]
    pub about: About,
}

impl Parameter {
    /// Whether it can have this value.
    pub const fn allows(&self, value: i32) -> bool {
        self.high < self.low || self.low <= value && value <= self.high
    }
}

/// Says that a table has no entry of a number.
const NONE: u8 = u8::MAX;

/// A table of parameters: its entries, sorted by number, and where each number stands.
#[derive(Debug)]
pub struct Table {
    entries: &'static [Parameter],
    places: [u8; 256],
}

impl Table {
    /// # Panics
    /// At compile time, if the entries are not sorted.
    pub(crate) const fn new(entries: &'static [Parameter]) -> Self {
        let mut places = [NONE; 256];
        let mut place = 0;
        while place < entries.len() {
            let number = entries[place].number;
            assert!(place == 0 || entries[place - 1].number < number, "entries are sorted by number");
            places[number as usize] = place as u8;
            place += 1;
        }
        Self { entries, places }
    }

    /// The entry with this number.
    #[inline]
    pub fn find(&self, number: u8) -> Option<&'static Parameter> {
        self.entries.get(usize::from(self.places[usize::from(number)]))
    }

    /// The entries, by number.
    pub fn iter(&self) -> core::slice::Iter<'static, Parameter> {
        self.entries.iter()
    }
}

impl IntoIterator for &Table {
    type Item = &'static Parameter;
    type IntoIter = core::slice::Iter<'static, Parameter>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

/// The values of a table's parameters.
#[derive(Clone, Debug)]
pub struct Values<const COUNT: usize> {
    table: &'static Table,
    values: [i32; COUNT],
}

impl<const COUNT: usize> Values<COUNT> {
    /// The defaults.
    ///
    /// # Panics
    /// If the table has another length.
    pub const fn new(table: &'static Table) -> Self {
        assert!(table.entries.len() == COUNT, "values for each entry");
        let mut values = Self { table, values: [0; COUNT] };
        values.reset();
        values
    }

    /// The defaults again.
    pub const fn reset(&mut self) {
        let mut place = 0;
        while place < COUNT {
            self.values[place] = self.table.entries[place].default;
            place += 1;
        }
    }

    /// A value.
    ///
    /// # Panics
    /// If the table has no such number.
    pub fn get(&self, number: u8) -> i32 {
        self.values[self.place(number)]
    }

    /// Sets a value, whether it is in range or not.
    ///
    /// # Panics
    /// If the table has no such number.
    pub fn set(&mut self, number: u8, value: i32) {
        self.values[self.place(number)] = value;
    }

    fn place(&self, number: u8) -> usize {
        let place = self.table.places[usize::from(number)];
        assert!(place != NONE, "no parameter has this number");
        place.into()
    }
}

/// A table of parameters and a constant for the number of each.
///
/// ```text
/// NUMBER NAME symbol, "name" [low, high] ACCESS = default "unit" "text" test;
/// ```
macro_rules! parameters {
    ($(#[$doc:meta])* $table:ident { $($number:literal $constant:ident $symbol:ident, $name:literal
        [$low:expr, $high:expr] $access:ident = $default:literal $unit:literal $text:literal $test:ident;)* }) => {
        $(#[doc = $text] pub const $constant: u8 = $number;)*

        /// How many entries the table has.
        pub const COUNT: usize = [$($number as u8),*].len();

        $(#[$doc])*
        pub static $table: &$crate::parameter::Table = &$crate::parameter::Table::new(&[$($crate::parameter::Parameter {
            number: $number,
            low: $low,
            high: $high,
            access: $crate::parameter::Access::$access,
            default: $default,
            #[cfg(feature = "std")]
            about: $crate::parameter::About {
                name: $name,
                symbol: stringify!($symbol),
                unit: $unit,
                text: $text,
                test: stringify!($test),
            },
        }),*]);
    };
}
pub(crate) use parameters;

#[cfg(test)]
mod tests {
    use super::*;

    parameters! {
        /// A table.
        TABLE {
            3 LOW Low, "low" [-5, 7] RW = 0 "" "With a sign." none;
            9 ALL All, "all" [0, -1] RWA = 0 "" "All bits." none;
        }
    }

    #[test]
    fn values_begin_with_the_defaults() {
        let mut values = Values::<COUNT>::new(TABLE);
        values.set(ALL, -3);
        assert_eq!((values.get(LOW), values.get(ALL)), (0, -3));
    }

    #[test]
    fn ranges() {
        let low = TABLE.find(LOW).unwrap();
        assert!(low.allows(-5) && low.allows(7) && !low.allows(8) && !low.allows(-6));
        let all = TABLE.find(ALL).unwrap();
        assert!(all.allows(i32::MIN) && all.allows(-1));
        assert!(TABLE.find(4).is_none());
    }
}
