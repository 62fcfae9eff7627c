//! Characters to tokens.

use logos::Logos;
use source::{Source, Span};

/// A token.
#[derive(Logos, Clone, Copy, Debug, PartialEq, Eq)]
#[logos(skip r"[ \t\u{C}\u{A0}\u{FEFF}]+")]
pub enum Token {
    /// The end of a line.
    #[regex(r"\r\n|\n|\r")]
    LineEnd,
    /// From the semicolon to the end of the line.
    #[regex(r";[^\r\n]*", allow_greedy = true)]
    Comment,
    /// Letters; a number behind them is a token of its own.
    #[regex(r"[\p{L}_]+")]
    Word,
    /// Digits.
    #[regex(r"[0-9]+")]
    Number,
    /// `=`.
    #[token("=")]
    Equals,
    /// A comparison, but `=`.
    #[token("!=")]
    #[token(">")]
    #[token("<")]
    #[token(">=")]
    #[token("<=")]
    Comparison,
    /// `+`.
    #[token("+")]
    Plus,
    /// `-`.
    #[token("-")]
    Minus,
    /// An operator between two values, but `+` and `-`.
    #[token("*")]
    #[token("/")]
    #[token("%")]
    #[token(">>")]
    #[token("<<")]
    #[token("&")]
    #[token("|")]
    Operator,
    /// `~`.
    #[token("~")]
    Tilde,
    /// `:`.
    #[token(":")]
    Colon,
    /// A character that means nothing.
    Unknown,
}

/// A line of a source.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tokens {
    /// What is to be compiled.
    pub tokens: Vec<(Token, Span)>,
    /// The comment behind it.
    pub comment: Option<Span>,
}

/// The tokens of each line.
pub fn lines(source: &Source) -> Vec<Tokens> {
    let mut lines = Vec::with_capacity(source.line_count());
    let mut line = Tokens::default();
    for (token, span) in Token::lexer(&source.text).spanned() {
        match token.unwrap_or(Token::Unknown) {
            Token::LineEnd => lines.push(std::mem::take(&mut line)),
            Token::Comment => line.comment = Some(span),
            token => {
                if token == Token::Number {
                    split_variable(source, &mut line.tokens);
                }
                line.tokens.push((token, span));
            }
        }
    }
    lines.push(line);
    lines
}

/// Takes the `V` of a variable, whose number follows, from the word that it is written together with: `XV1`,
/// `CIRXYPV1:V2`.
fn split_variable(source: &Source, tokens: &mut Vec<(Token, Span)>) {
    let Some((Token::Word, word)) = tokens.last_mut() else { return };
    let text = source.slice(word);
    if text.len() > 1 && text.ends_with('V') {
        word.end -= 1;
        let variable = word.end..word.end + 1;
        tokens.push((Token::Word, variable));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tokens() {
        use Token::*;
        let check = |text: &str, expected: &[(Token, &str)]| {
            let source = Source::new("a", text.as_bytes());
            let tokens: Vec<_> = lines(&source).into_iter().flat_map(|line| line.tokens).collect();
            let found: Vec<_> = tokens.iter().map(|(token, span)| (*token, source.slice(span))).collect();
            assert_eq!(found, expected);
        };
        check("X1000YV2 ; x", &[(Word, "X"), (Number, "1000"), (Word, "Y"), (Word, "V"), (Number, "2")]);
        check(
            "V1=~V2",
            &[(Word, "V"), (Number, "1"), (Equals, "="), (Tilde, "~"), (Word, "V"), (Number, "2")],
        );
        check("HOMEX-6", &[(Word, "HOMEX"), (Minus, "-"), (Number, "6")]);
        check(
            "> >> >= < << <= != & |",
            &[
                (Comparison, ">"),
                (Operator, ">>"),
                (Comparison, ">="),
                (Comparison, "<"),
                (Operator, "<<"),
                (Comparison, "<="),
                (Comparison, "!="),
                (Operator, "&"),
                (Operator, "|"),
            ],
        );
        check(
            "1:+2 ? ö",
            &[(Number, "1"), (Colon, ":"), (Plus, "+"), (Number, "2"), (Unknown, "?"), (Word, "ö")],
        );
    }

    #[test]
    fn comments_and_lines() {
        let source = Source::new("a", b"END;a;b\r\n\r ; c\nABS");
        let lines = lines(&source);
        assert_eq!(lines.len(), source.line_count());
        let comments: Vec<_> =
            lines.iter().map(|line| line.comment.as_ref().map(|span| source.slice(span))).collect();
        assert_eq!(comments, [Some(";a;b"), None, Some("; c"), None]);
        let counts: Vec<_> = lines.iter().map(|line| line.tokens.len()).collect();
        assert_eq!(counts, [1, 0, 0, 1]);
    }
}
