//! Places in a text as editors count them: lines and characters from 0, in one of three units.

use crate::protocol::{Position, PositionEncodingKind, Range};
use source::{Source, Span};

/// In what characters are counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Encoding {
    /// Bytes.
    Utf8,
    /// Units of 16 bits, which every editor knows.
    #[default]
    Utf16,
    /// Characters.
    Utf32,
}

impl Encoding {
    /// The first one of an editor's list that is known here.
    pub(crate) fn choose(offered: &[PositionEncodingKind]) -> Self {
        let known = |kind: &PositionEncodingKind| match kind {
            PositionEncodingKind::UTF8 => Some(Self::Utf8),
            PositionEncodingKind::UTF16 => Some(Self::Utf16),
            PositionEncodingKind::UTF32 => Some(Self::Utf32),
            PositionEncodingKind::Custom(_) => None,
        };
        offered.iter().find_map(known).unwrap_or_default()
    }

    /// Its name in the protocol.
    pub(crate) const fn kind(self) -> PositionEncodingKind {
        match self {
            Self::Utf8 => PositionEncodingKind::UTF8,
            Self::Utf16 => PositionEncodingKind::UTF16,
            Self::Utf32 => PositionEncodingKind::UTF32,
        }
    }

    const fn length(self, character: char) -> usize {
        match self {
            Self::Utf8 => character.len_utf8(),
            Self::Utf16 => character.len_utf16(),
            Self::Utf32 => 1,
        }
    }

    /// How long a text is.
    pub(crate) fn count(self, text: &str) -> u32 {
        text.chars().map(|character| self.length(character)).sum::<usize>() as u32
    }

    /// Where a byte of a source is.
    pub(crate) fn position(self, source: &Source, offset: usize) -> Position {
        let line = source.line(offset);
        let before = source.line_span(line).start..offset;
        Position { line: line as u32 - 1, character: self.count(source.slice(&before)) }
    }

    /// Where some bytes of a source are.
    pub(crate) fn range(self, source: &Source, span: &Span) -> Range {
        Range { start: self.position(source, span.start), end: self.position(source, span.end) }
    }

    /// The byte at a position. What lies beyond the end of a line or of the text is its end, what lies within a
    /// character its beginning.
    pub(crate) fn offset(self, source: &Source, position: Position) -> usize {
        let line = position.line as usize + 1;
        if line > source.line_count() {
            return source.text.len();
        }
        let span = source.line_span(line);
        let mut left = position.character as usize;
        for (at, character) in source.slice(&span).char_indices() {
            let length = self.length(character);
            if left < length {
                return span.start + at;
            }
            left -= length;
        }
        span.end
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_as_editors_count_them() {
        let source = Source::new("a", "Größe\r\n\u{1F600}b\rc".as_bytes());
        let check = |encoding: Encoding, text: &str, line, character| {
            let offset = source.text.find(text).expect(text);
            let position = encoding.position(&source, offset);
            assert_eq!((position.line, position.character), (line, character), "{text} in {encoding:?}");
            assert_eq!(encoding.offset(&source, position), offset, "{text} in {encoding:?}");
        };
        check(Encoding::Utf8, "e", 0, 6);
        check(Encoding::Utf16, "e", 0, 4);
        check(Encoding::Utf8, "b", 1, 4);
        check(Encoding::Utf16, "b", 1, 2);
        check(Encoding::Utf32, "b", 1, 1);
        check(Encoding::Utf16, "c", 2, 0);
    }

    #[test]
    fn places_that_are_none() {
        let source = Source::new("a", "ab\n\u{1F600}\n".as_bytes());
        let check = |line, character, expected| {
            assert_eq!(Encoding::Utf16.offset(&source, Position { line, character }), expected);
        };
        check(0, 99, 2);
        check(1, 1, 3);
        check(1, 2, 7);
        check(2, 5, 8);
        check(9, 0, 8);
        check(u32::MAX, u32::MAX, 8);
    }
}
