//! Words as people write them: names of axes as moves, and what a wrong word may have meant.

use crate::dialect::{self, Dialect};
use crate::isa::{Entry, Index, Kind, Place, Suffix, Word, words};
use source::nearest;

/// The move of each axis.
pub(super) const MOVES: [Word; 4] = [Word::X, Word::Y, Word::Z, Word::U];

/// The axis that a word is the name of.
pub(super) fn target_axis(letters: &str, dialect: &Dialect) -> Option<u8> {
    let mut characters = letters.chars();
    characters.next().and_then(|name| dialect.axis(name)).filter(|_| characters.next().is_none())
}

/// What an index counts.
pub(super) const fn things(index: Index) -> &'static str {
    match index {
        Index::Program => "programs",
        Index::Subroutine => "subroutines",
        Index::Variable => "variables",
        Index::Input => "digital inputs",
        Index::Output => "digital outputs",
        Index::Enable => "enable outputs",
        Index::Port => "configurable inputs and outputs",
        Index::AnalogInput => "analog inputs",
        Index::PwmOutput => "PWM outputs",
    }
}

/// What may have been meant by a word that is none.
pub(super) fn hint(letters: &str, numbered: bool, dialect: &Dialect) -> Option<String> {
    let upper = letters.to_uppercase();
    if upper != letters && is_word(&upper, numbered, dialect) {
        return Some(format!("words are in upper case: `{upper}`"));
    }
    let mut others = [&dialect::PERFORMAX_2, &dialect::COMMANDER].into_iter();
    if let Some(other) = others.find(|other| is_word(letters, numbered, other)) {
        return Some(format!("the {} has it, the {} has not", other.name, dialect.name));
    }
    if let Some(entry) = words(dialect.family).find(|entry| entry.name == letters) {
        return match entry.suffix {
            Suffix::Axis | Suffix::Direction | Suffix::Home => {
                Some(format!("`{letters}` needs an axis, as `{letters}X`"))
            }
            Suffix::Index(_) => Some(format!("`{letters}` needs a number, as `{letters}1`")),
            Suffix::Plane(_) => Some(format!("`{letters}` needs two axes and `P` or `N`, as `{letters}XYP`")),
            Suffix::Helix(_) => Some(format!("`{letters}` needs `P` or `N`, as `{letters}P`")),
            Suffix::None if numbered => Some(format!("`{letters}` has no number")),
            _ => None,
        };
    }
    nearest(letters, names(dialect)).map(|word| format!("did you mean `{word}`?"))
}

fn is_word(letters: &str, numbered: bool, dialect: &Dialect) -> bool {
    Place::from_letters(letters, numbered, dialect).is_some()
        || Place::from_letters(letters, false, dialect).is_some()
        || target_axis(letters, dialect).is_some()
}

/// Every word of a dialect with each of its axes; the numbers behind it are left out.
fn names(dialect: &Dialect) -> impl Iterator<Item = String> {
    let real = |entry: &&Entry| !matches!(entry.kind, Kind::Comment) && !entry.name.is_empty();
    words(dialect.family).filter(real).flat_map(|entry| spellings(entry, dialect))
}

/// A word with each of its axes: `HSPDX`, `CIRXYP`. A direction or a number behind it is left out.
pub fn spellings(entry: &Entry, dialect: &Dialect) -> Vec<String> {
    let (name, axes) = (entry.name, dialect.axes);
    match entry.suffix {
        Suffix::Axis | Suffix::Direction | Suffix::Home => {
            axes.chars().map(|axis| format!("{name}{axis}")).collect()
        }
        Suffix::Plane(_) => {
            let pairs = axes.chars().flat_map(|first| axes.chars().map(move |second| (first, second)));
            let planes = pairs.filter(|(first, second)| first != second);
            let turned = |(first, second)| ["P", "N"].map(|turn| format!("{name}{first}{second}{turn}"));
            planes.flat_map(turned).collect()
        }
        Suffix::Helix(_) => ["P", "N"].map(|turn| format!("{name}{turn}")).into(),
        _ => vec![name.to_owned()],
    }
}
