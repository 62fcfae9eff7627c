//! The bits of a status word, as whoever shows them names them.

/// A bit of the status word of an axis.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bit {
    /// Which one, from 0.
    pub number: u8,
    /// What it is called.
    pub name: String,
    /// Whether it says that something went wrong.
    pub is_error: bool,
}

/// The names of the bits that are 1.
pub(crate) fn flags(bits: &[Bit], word: u32) -> Vec<String> {
    let name = |number: u8| match bits.iter().find(|bit| bit.number == number) {
        Some(bit) => bit.name.clone(),
        None => format!("bit {number}"),
    };
    (0..u32::BITS as u8).filter(|number| word >> number & 1 != 0).map(name).collect()
}

/// What is wrong, if something is.
pub(crate) fn errors(bits: &[Bit], word: u32) -> Option<String> {
    let on =
        bits.iter().filter(|bit| bit.is_error && word.checked_shr(bit.number.into()).unwrap_or(0) & 1 != 0);
    let names: Vec<_> = on.map(|bit| bit.name.as_str()).collect();
    (!names.is_empty()).then(|| names.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_bits() {
        let bit = |number, name: &str, is_error| Bit { number, name: name.into(), is_error };
        let bits =
            [bit(0, "accelerating", false), bit(7, "+limit error", true), bit(8, "-limit error", true)];
        let check = |word, names: &[&str], wrong: Option<&str>| {
            assert_eq!(flags(&bits, word), names, "{word}");
            assert_eq!(errors(&bits, word).as_deref(), wrong, "{word}");
        };
        check(0, &[], None);
        check(1, &["accelerating"], None);
        check(
            0b1_1000_0001,
            &["accelerating", "+limit error", "-limit error"],
            Some("+limit error, -limit error"),
        );
        check(1 << 31, &["bit 31"], None);
    }
}
