//! What a device is called on USB.

use core::fmt::{self, Write};

/// Most characters of a name; a caller of the vendor's library has room for one more byte (manual, 3.1.2.3).
pub const MAX_NAME: usize = 15;

/// The name of a device: that of its product and two digits, the number that it is given so that several can
/// be told apart (manual, 3.3). `CMD-4CR-01` is how a CMD-4CR comes from the factory.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Name(heapless::String<MAX_NAME>);

impl Name {
    /// The device of this number of a product, whose name has everything before the digits: `CMD-4CR-`.
    ///
    /// # Panics
    /// If the product's name has more than 13 characters, or the number more than two digits.
    pub fn new(product: &str, number: u8) -> Self {
        assert!(number < 100, "a number has two digits");
        let mut name = heapless::String::new();
        let written = write!(name, "{product}{number:02}");
        assert!(written.is_ok(), "the name of a product is short");
        Self(name)
    }

    /// The name that a text is: printable ASCII characters that end in two digits.
    pub fn parse(text: &str) -> Option<Self> {
        let is_name = match text.as_bytes() {
            [product @ .., b'0'..=b'9', b'0'..=b'9'] => product.iter().all(u8::is_ascii_graphic),
            _ => false,
        };
        heapless::String::try_from(text).ok().filter(|_| is_name).map(Self)
    }

    /// All of it.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// What stands before the digits.
    pub fn product(&self) -> &str {
        &self.0[..self.0.len() - 2]
    }

    /// The digits: 0 to 99.
    pub fn number(&self) -> u8 {
        let digits = self.0.as_bytes().iter().rev().take(2).rev();
        digits.fold(0, |number, digit| number * 10 + (digit - b'0'))
    }
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names() {
        let check = |product: &str, number, expected: &str| {
            let name = Name::new(product, number);
            assert_eq!(name.as_str(), expected);
            assert_eq!((name.product(), name.number()), (product, number));
            assert_eq!(Name::parse(expected), Some(name));
        };
        check("CMD-4CR-", 1, "CMD-4CR-01");
        check("CMD-4CR-", 0, "CMD-4CR-00");
        check("CMD-4CR-", 99, "CMD-4CR-99");
        check("2ED", 42, "2ED42");
        check("", 7, "07");
    }

    #[test]
    fn other_texts_are_no_names() {
        for text in ["", "1", "CMD-4CR", "CMD-4CR-1", "CMD-4CR-0A", "CMD 4CR-01", "CMD-4CR-01\n", "µ-01"] {
            assert_eq!(Name::parse(text), None, "{text:?}");
        }
        assert!(Name::parse("A-LONG-NAME--01").is_some());
        assert!(Name::parse("A-LONGER-NAME-01").is_none());
    }
}
