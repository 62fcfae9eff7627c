//! A source file.

use std::ops::Range;

/// Most bytes of a source that are read.
pub const MAX_SOURCE_BYTES: usize = 1 << 20;

/// Bytes of a source's text.
pub type Span = Range<usize>;

/// A source file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// Its name, as messages show it.
    pub name: String,
    /// Its text.
    pub text: String,
    /// Where each line begins.
    lines: Vec<usize>,
}

impl Source {
    /// A file of these bytes: UTF-8 or, if they are none, Latin-1.
    pub fn new(name: impl Into<String>, bytes: &[u8]) -> Self {
        let text = match std::str::from_utf8(bytes) {
            Ok(text) => text.to_owned(),
            Err(_) => bytes.iter().copied().map(char::from).collect(),
        };
        let mut lines = vec![0];
        let bytes = text.as_bytes();
        for (index, &byte) in bytes.iter().enumerate() {
            if byte == b'\n' || byte == b'\r' && bytes.get(index + 1) != Some(&b'\n') {
                lines.push(index + 1);
            }
        }
        Self { name: name.into(), text, lines }
    }

    /// How many lines there are; the text behind the last line end is one, even if it is empty.
    pub fn line_count(&self) -> usize {
        self.lines.len()
    }

    /// The line, from 1, in which a byte of the text stands.
    pub fn line(&self, offset: usize) -> usize {
        self.lines.partition_point(|&start| start <= offset)
    }

    /// The column, from 1 and in characters, of a byte of the text.
    pub fn column(&self, offset: usize) -> usize {
        let start = self.lines[self.line(offset) - 1];
        self.text[start..offset].chars().count() + 1
    }

    /// Where a line's text is, without its end.
    pub fn line_span(&self, line: usize) -> Span {
        let start = self.lines[line - 1];
        let end = self.lines.get(line).copied().unwrap_or(self.text.len());
        start..start + self.text[start..end].trim_end_matches(['\r', '\n']).len()
    }

    /// The text at a place.
    pub fn slice(&self, span: &Span) -> &str {
        &self.text[span.clone()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places() {
        let source = Source::new("a", "Größe\r\nb\rc\n".as_bytes());
        let check = |offset, line, column| {
            assert_eq!((source.line(offset), source.column(offset)), (line, column), "{offset}");
        };
        check(0, 1, 1);
        check("Größ".len(), 1, 5);
        check(source.text.find('b').expect("b"), 2, 1);
        check(source.text.find('c').expect("c"), 3, 1);
        check(source.text.len(), 4, 1);
        let lines: Vec<&str> =
            (1..=source.line_count()).map(|n| source.slice(&source.line_span(n))).collect();
        assert_eq!(lines, ["Größe", "b", "c", ""]);
    }

    #[test]
    fn encodings() {
        assert_eq!(Source::new("a", b"Gr\xF6\xDFe").text, "Größe");
    }
}
