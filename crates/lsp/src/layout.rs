//! From a text to its usual layout, in small changes: an editor keeps its place in them.

use source::{Source, Span};

/// The changes that make a text another one with the same lines, but for blank ones at the end. Line ends stay as
/// they are.
pub(crate) fn edits(source: &Source, formatted: &str) -> Vec<(Span, String)> {
    let lines: Vec<&str> = formatted.lines().collect();
    if lines.len() > source.line_count() {
        return vec![(0..source.text.len(), formatted.to_owned())];
    }
    let mut edits = Vec::new();
    let mut end = 0;
    for (line, new) in (1..).zip(&lines) {
        let span = source.line_span(line);
        end = span.end;
        if source.slice(&span) != *new {
            edits.push((span, (*new).to_owned()));
        }
    }
    let tail = end..source.text.len();
    let new = match source.slice(&tail) {
        _ if lines.is_empty() => "",
        rest if rest.starts_with("\r\n") => "\r\n",
        rest if rest.starts_with('\r') => "\r",
        _ => "\n",
    };
    if source.slice(&tail) != new {
        edits.push((tail, new.to_owned()));
    }
    edits
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(text: &str, formatted: &str, expected: &[(&str, &str)], becomes: &str) {
        let source = Source::new("a", text.as_bytes());
        let edits = edits(&source, formatted);
        let found: Vec<_> = edits.iter().map(|(span, new)| (source.slice(span), new.as_str())).collect();
        assert_eq!(found, expected, "{text:?}");
        let mut text = text.to_owned();
        for (span, new) in edits.into_iter().rev() {
            text.replace_range(span, &new);
        }
        assert_eq!(text, becomes);
    }

    #[test]
    fn only_what_differs_is_changed() {
        check("a\n b\nc\n", "a\nb\nc\n", &[(" b", "b")], "a\nb\nc\n");
        check("a\r\n b\r\n", "a\r\nb\r\n", &[(" b", "b")], "a\r\nb\r\n");
        check("a\r\n b\r\n\r\n", "a\nb\n", &[(" b", "b"), ("\r\n\r\n", "\r\n")], "a\r\nb\r\n");
        check("a", "a\n", &[("", "\n")], "a\n");
        check("a\n\n  \n", "a\n", &[("\n\n  \n", "\n")], "a\n");
        check("", "", &[], "");
        check(" \n", "", &[(" \n", "")], "");
        check("a", "b\nc\n", &[("a", "b\nc\n")], "b\nc\n");
    }
}
