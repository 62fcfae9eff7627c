//! One entry for many devices: `{n}` in names and endpoints is the number of each.

/// What stands for the number of a device: `{n}`, or `{4000+n}` for a number above another one.
const MARK: &str = "n}";

/// The text for the device with this number, which counts from 1.
///
/// # Errors
/// What is wrong with a mark.
pub(super) fn numbered(text: &str, number: usize) -> Result<String, String> {
    let mut parts = text.split('{');
    let mut out = parts.next().unwrap_or("").to_owned();
    for part in parts {
        let wrong = || format!("`{{{part}` is not of the form `{{n}}` or `{{4000+n}}`");
        let (mark, rest) = part.split_once('}').ok_or_else(wrong)?;
        let base = match mark.strip_suffix('n').ok_or_else(wrong)? {
            "" => 0,
            sum => sum.strip_suffix('+').and_then(|base| base.parse::<u32>().ok()).ok_or_else(wrong)?,
        };
        out += &(base as usize + number).to_string();
        out += rest;
    }
    Ok(out)
}

/// Whether a text is another one for each device.
pub(super) fn is_numbered(text: &str) -> bool {
    text.contains('{') && text.contains(MARK)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(text: &str, expected: Result<&str, &str>) {
        assert_eq!(numbered(text, 12), expected.map(str::to_owned).map_err(str::to_owned));
    }

    #[test]
    fn numbers_take_the_place_of_marks() {
        check("stage", Ok("stage"));
        check("stage-{n}", Ok("stage-12"));
        check("tcp:127.0.0.1:{4000+n}", Ok("tcp:127.0.0.1:4012"));
        check("{n}.{0+n}", Ok("12.12"));
    }

    #[test]
    fn other_marks_are_refused() {
        check("a{n", Err("`{n` is not of the form `{n}` or `{4000+n}`"));
        check("a{}", Err("`{}` is not of the form `{n}` or `{4000+n}`"));
        check("a{m}b", Err("`{m}b` is not of the form `{n}` or `{4000+n}`"));
        check("a{-1+n}", Err("`{-1+n}` is not of the form `{n}` or `{4000+n}`"));
        check("a{5n}", Err("`{5n}` is not of the form `{n}` or `{4000+n}`"));
    }
}
