//! Characters to tokens.

use logos::Logos;
use std::ops::Range;

/// A token.
#[derive(Logos, Clone, Copy, Debug, PartialEq, Eq)]
#[logos(skip r"[ \t\u{C}\u{A0}\u{FEFF}]+")]
pub enum Token {
    /// The end of a line.
    #[regex(r"\r\n|\n|\r")]
    LineEnd,
    /// From the slashes to the end of the line.
    #[regex(r"//[^\r\n]*", allow_greedy = true)]
    Comment,
    /// A mnemonic, a keyword or a symbol.
    #[regex(r"[\p{L}_][\p{L}\p{N}_]*")]
    Name,
    /// A number.
    #[regex(r"[0-9]+")]
    Decimal,
    /// A number behind `$` or `0x`.
    #[regex(r"(\$|0[xX])[0-9A-Fa-f]+")]
    Hexadecimal,
    /// A number behind `%` or `0b`.
    #[regex(r"(%|0[bB])[01]+")]
    Binary,
    /// `#` and everything behind it, comment included.
    #[regex(r"#[^\r\n]*", allow_greedy = true)]
    Directive,
    /// `:`.
    #[token(":")]
    Colon,
    /// `,`.
    #[token(",")]
    Comma,
    /// `=`.
    #[token("=")]
    Equals,
    /// `+`.
    #[token("+")]
    Plus,
    /// `-`.
    #[token("-")]
    Minus,
    /// `*`.
    #[token("*")]
    Star,
    /// `/`.
    #[token("/")]
    Slash,
    /// `(`.
    #[token("(")]
    Open,
    /// `)`.
    #[token(")")]
    Close,
    /// A character that means nothing.
    Unknown,
}

/// A token and where it stands.
pub type Spanned = (Token, Range<usize>);

/// All tokens of a text.
pub fn tokens(text: &str) -> impl Iterator<Item = Spanned> {
    Token::lexer(text).spanned().map(|(token, span)| (token.unwrap_or(Token::Unknown), span))
}

/// The tokens of each line that has any, without comments.
pub(super) fn lines(text: &str) -> Vec<Vec<Spanned>> {
    let mut lines = Vec::new();
    let mut line = Vec::new();
    for (token, span) in tokens(text) {
        match token {
            Token::LineEnd => lines.push(std::mem::take(&mut line)),
            Token::Comment => (),
            token => line.push((token, span)),
        }
    }
    lines.push(line);
    lines.retain(|line: &Vec<Spanned>| !line.is_empty());
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tokens() {
        let check = |text: &str, expected: &[(Token, &str)]| {
            let lines = lines(text).concat();
            let found: Vec<_> = lines.into_iter().map(|(token, span)| (token, &text[span])).collect();
            assert_eq!(found, expected);
        };
        use Token::*;
        check("Größe: MVP // x", &[(Name, "Größe"), (Colon, ":"), (Name, "MVP")]);
        check(
            "$1F 0x1f %101 0b1 10",
            &[
                (Hexadecimal, "$1F"),
                (Hexadecimal, "0x1f"),
                (Binary, "%101"),
                (Binary, "0b1"),
                (Decimal, "10"),
            ],
        );
        check(
            "A=-(1+2)*3/4",
            &[
                (Name, "A"),
                (Equals, "="),
                (Minus, "-"),
                (Open, "("),
                (Decimal, "1"),
                (Plus, "+"),
                (Decimal, "2"),
                (Close, ")"),
                (Star, "*"),
                (Decimal, "3"),
                (Slash, "/"),
                (Decimal, "4"),
            ],
        );
        check("#include a.inc // why\rSTOP", &[(Directive, "#include a.inc // why"), (Name, "STOP")]);
        check("a ? b", &[(Name, "a"), (Unknown, "?"), (Name, "b")]);
    }

    #[test]
    fn empty_lines_vanish() {
        assert_eq!(lines("\n\r\n// only a comment\r \t\nSTOP\n").len(), 1);
    }
}
