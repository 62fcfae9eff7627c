//! Words that were perhaps meant.

/// The candidate that is spelled most like `word`, if any is near enough to be what was meant.
pub fn nearest<S: AsRef<str> + Ord>(word: &str, candidates: impl Iterator<Item = S>) -> Option<S> {
    // At least one character must be right.
    let length = word.chars().count();
    let bound = length.div_ceil(3).min(3).min(length.saturating_sub(1));
    let upper = word.to_uppercase();
    candidates
        .map(|candidate| (strsim::damerau_levenshtein(&upper, &candidate.as_ref().to_uppercase()), candidate))
        .filter(|&(distance, _)| distance <= bound)
        .min()
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_word() {
        let check = |word, expected| {
            assert_eq!(nearest(word, ["MVP", "MST", "WAIT", "CALCVA"].into_iter()), expected, "{word}");
        };
        check("MPV", Some("MVP"));
        check("mvp", Some("MVP"));
        check("WIAT", Some("WAIT"));
        check("UNAIT", Some("WAIT"));
        check("CALVCA", Some("CALCVA"));
        check("XYZ", None);
        check("M", None);
        check("", None);
    }
}
