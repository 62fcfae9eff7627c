//! Lays a source out anew: the formatter.
//!
//! Only white space and the case of mnemonics change. Every line stays the line that it was, so places in
//! messages and listings stay the same, and so does the program.

use super::RAW_MNEMONIC;
use super::lexer::{self, Spanned, Token};
use super::parser;
use crate::isa;
use source::Source;

/// Where commands begin, and comments that stand deeper than the labels.
const INDENT: usize = 4;

/// Mnemonics are filled up to this width, which most of them have.
const MNEMONIC_WIDTH: usize = 4;

/// Where comments behind code begin, if there is room.
const COMMENT_COLUMN: usize = 28;

/// A byte order mark is kept: some editors need it.
const BYTE_ORDER_MARK: char = '\u{FEFF}';

/// The same source in the usual layout: labels, constants and directives at the margin, commands indented,
/// the `=` of neighbouring constants and the comments behind code below each other. Comments and blank
/// lines stay, except for blank lines at the end. A line that is none is left as it is.
///
/// The result is in the encoding of the source, and has the line ends of its first line.
pub fn format(source: &[u8]) -> Vec<u8> {
    let is_utf8 = std::str::from_utf8(source).is_ok();
    let source = Source::new("", source);
    let text = source.text.as_str();
    let (mark, text) = match text.strip_prefix(BYTE_ORDER_MARK) {
        Some(rest) => (true, rest),
        None => (false, text),
    };
    let end = if text.find('\n').is_some_and(|at| text[..at].ends_with('\r')) { "\r\n" } else { "\n" };

    let mut lines: Vec<_> = split(text).map(Line::read).collect();
    while lines.last().is_some_and(Line::is_blank) {
        lines.pop();
    }
    let mut out = String::with_capacity(text.len());
    if mark {
        out.push(BYTE_ORDER_MARK);
    }
    let mut margin = None;
    for block in lines.chunk_by(|above, below| above.name().is_some() && below.name().is_some()) {
        let names = block.iter().filter_map(|line| line.name()).map(|name| name.chars().count()).max();
        for line in block {
            let text = line.code.text(names.unwrap_or(0));
            out.push_str(line.laid_out(text, &mut margin).trim_end_matches(' '));
            out.push_str(end);
        }
    }
    if is_utf8 { out.into_bytes() } else { out.chars().map(|character| character as u8).collect() }
}

/// The lines of a text, without their ends.
fn split(text: &str) -> impl Iterator<Item = &str> {
    text.split('\n').flat_map(|line| line.strip_suffix('\r').unwrap_or(line).split('\r'))
}

/// A line, taken apart.
struct Line<'a> {
    code: Code<'a>,
    comment: Option<Comment<'a>>,
}

enum Code<'a> {
    Nothing,
    /// Something at the margin: a directive, or labels with what follows.
    Margin(String),
    Constant {
        name: &'a str,
        value: String,
    },
    Command(String),
    /// Something that is not understood.
    Other(&'a str),
}

#[derive(Clone, Copy)]
struct Comment<'a> {
    /// Where it stood.
    column: usize,
    /// From the slashes on.
    text: &'a str,
}

impl<'a> Line<'a> {
    fn read(text: &'a str) -> Self {
        let tokens = lexer::lines(text).pop().unwrap_or_default();
        let end = tokens.last().map_or(0, |(token, span)| match token {
            // It has the comment in it.
            Token::Directive => span.start,
            _ => span.end,
        });
        let slashes = text[end..].find("//").map(|at| end + at);
        if !parser::parse(&Source::new("", text.as_bytes())).1.is_empty() {
            return Self { code: Code::Other(text.trim_ascii_end()), comment: None };
        }
        let (code, comment) = text.split_at(slashes.unwrap_or(text.len()));
        let comment =
            slashes.map(|at| Comment { column: column(&text[..at]), text: comment.trim_ascii_end() });
        Self { code: Code::read(code, &tokens), comment }
    }

    fn is_blank(&self) -> bool {
        self.comment.is_none() && matches!(self.code, Code::Nothing)
    }

    /// The name of a constant.
    fn name(&self) -> Option<&'a str> {
        if let Code::Constant { name, .. } = self.code { Some(name) } else { None }
    }

    /// The line with its comment. `margin` is where the comment of the line before stood and stands now: a
    /// comment that begins right below it goes on with it.
    fn laid_out(&self, mut text: String, margin: &mut Option<(usize, usize)>) -> String {
        let Some(Comment { column, text: comment }) = self.comment else {
            *margin = None;
            return text;
        };
        let place = match (&self.code, *margin) {
            (Code::Nothing, Some((before, after))) if before == column => after,
            (Code::Nothing, _) => {
                *margin = None;
                if column == 0 { 0 } else { INDENT }
            }
            _ => {
                let place = COMMENT_COLUMN.max(text.chars().count() + 1);
                *margin = Some((column, place));
                place
            }
        };
        fill(&mut text, place);
        text + comment
    }
}

impl<'a> Code<'a> {
    /// A line that is right, from its tokens.
    fn read(text: &'a str, tokens: &[Spanned]) -> Self {
        let [(first, span), rest @ ..] = tokens else { return Self::Nothing };
        match (first, rest) {
            (Token::Directive, _) => Self::Margin(text[span.start..].trim_end().to_owned()),
            (_, [(Token::Equals, _), value @ ..]) => {
                Self::Constant { name: &text[span.clone()], value: operands(text, value) }
            }
            (_, [(Token::Colon, _), ..]) => Self::Margin(labelled(text, tokens)),
            _ => Self::Command(command(text, tokens, MNEMONIC_WIDTH)),
        }
    }

    /// The code at its place. `names` is the length of the longest name in the block of constants.
    fn text(&self, names: usize) -> String {
        let mut line = String::new();
        match self {
            Self::Nothing => {}
            Self::Margin(text) => line.push_str(text),
            Self::Constant { name, value } => {
                line.push_str(name);
                fill(&mut line, names);
                line.push_str(" = ");
                line.push_str(value);
            }
            Self::Command(text) => {
                fill(&mut line, INDENT);
                line.push_str(text);
            }
            Self::Other(text) => line.push_str(text),
        }
        line
    }
}

/// Labels and what follows them on their line.
fn labelled(text: &str, mut tokens: &[Spanned]) -> String {
    let mut line = String::new();
    while let [(_, name), (Token::Colon, _), rest @ ..] = tokens {
        line.push_str(&text[name.clone()]);
        line.push_str(if rest.is_empty() { ":" } else { ": " });
        tokens = rest;
    }
    match tokens {
        [] => {}
        [(Token::Directive, span)] => line.push_str(text[span.start..].trim_end()),
        [(_, name), (Token::Equals, _), value @ ..] => {
            line.push_str(&text[name.clone()]);
            line.push_str(" = ");
            line.push_str(&operands(text, value));
        }
        tokens => line.push_str(&command(text, tokens, 0)),
    }
    line
}

/// A mnemonic, filled up to a width, and its operands.
fn command(text: &str, tokens: &[Spanned], width: usize) -> String {
    let [(_, name), rest @ ..] = tokens else { return String::new() };
    let mut line = text[name.clone()].to_owned();
    if isa::by_mnemonic(&line).is_some() || line.eq_ignore_ascii_case(RAW_MNEMONIC) {
        line.make_ascii_uppercase();
    }
    if !rest.is_empty() {
        fill(&mut line, width);
        line.push(' ');
        line.push_str(&operands(text, rest));
    }
    line
}

/// Expressions with commas between them.
fn operands(text: &str, tokens: &[Spanned]) -> String {
    let mut line = String::new();
    // Whether the next token begins an operand, so that `+` and `-` are signs.
    let mut begins = true;
    for (token, span) in tokens {
        let word = &text[span.clone()];
        let is_operator = matches!(token, Token::Plus | Token::Minus | Token::Star | Token::Slash);
        match token {
            Token::Comma => line.push_str(", "),
            _ if is_operator && !begins => {
                line.push(' ');
                line.push_str(word);
                line.push(' ');
            }
            _ => line.push_str(word),
        }
        begins = is_operator || matches!(token, Token::Comma | Token::Open);
    }
    line
}

/// The column, from 0, behind a text; tabs go to multiples of 8.
fn column(text: &str) -> usize {
    text.chars()
        .fold(0, |column, character| if character == '\t' { (column / 8 + 1) * 8 } else { column + 1 })
}

/// Fills a line up to a column.
fn fill(line: &mut String, column: usize) {
    let length = line.chars().count();
    line.extend(std::iter::repeat_n(' ', column.saturating_sub(length)));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asm::{Assembly, NoFiles, assemble};
    use proptest::prelude::*;

    #[track_caller]
    fn check(input: &str, expected: &str) {
        let formatted = format(input.as_bytes());
        assert_eq!(String::from_utf8(formatted.clone()).expect("UTF-8"), expected);
        assert_eq!(String::from_utf8(format(&formatted)).expect("UTF-8"), expected, "the second time");
    }

    #[test]
    fn commands() {
        check("mvp ABS,0,100\n\tRORA   0\nstop", "    MVP  ABS, 0, 100\n    RORA 0\n    STOP\n");
        check("  calcx add , 1", "    CALCX add, 1\n");
        check("data 1,2,3,4", "    DATA 1, 2, 3, 4\n");
    }

    #[test]
    fn expressions() {
        check("SAP 4,0,-(A+2)*3/ - 4", "    SAP  4, 0, -(A + 2) * 3 / -4\n");
        check("SAP $4,%1,+0x1F-1", "    SAP  $4, %1, +0x1F - 1\n");
    }

    #[test]
    fn labels() {
        check(" Loop :\nMST 0", "Loop:\n    MST  0\n");
        check("a:b :  mst 0 // x", "a: b: MST 0                 // x\n");
        check("a: B=1", "a: B = 1\n");
        check("a:   #nostop", "a: #nostop\n");
    }

    #[test]
    fn constants() {
        check(
            "A=1\n LongName =2*3\nÄÖ=3\n\nB  = 4",
            "A        = 1\nLongName = 2 * 3\nÄÖ       = 3\n\nB = 4\n",
        );
    }

    #[test]
    fn directives() {
        check(
            "  #include  a.inc//why\n# nostop ",
            "#include  a.inc             // why\n# nostop\n".replace("// why", "//why").as_str(),
        );
    }

    #[test]
    fn comments() {
        check("// a  \n  // b\nMST 0//c", "// a\n    // b\n    MST  0                  //c\n");
        check(
            "MST 0  // c\n       // d\n       // e\n // f\n       // g",
            "    MST  0                  // c\n                            // d\n                            // e\n    // f\n    // g\n",
        );
        let long = "    SAP  LongNameOfAParameter, LongNameOfAMotor, 1";
        check(&format!("{long}// a"), &format!("{long} // a\n"));
    }

    #[test]
    fn blank_lines() {
        check("\n\nMST 0\n \t\n\nSTOP\n\n\n", "\n\n    MST  0\n\n\n    STOP\n");
        check("", "");
        check("\n \n", "");
    }

    #[test]
    fn lines_that_are_wrong_are_left() {
        check("  MVP ABS,,1 // x  \n\tJA ? 1\n\"a//b", "  MVP ABS,,1 // x\n\tJA ? 1\n\"a//b\n");
    }

    #[test]
    fn line_ends_and_encodings() {
        check("MST 0\r\nSTOP\n", "    MST  0\r\n    STOP\r\n");
        check("MST 0\rSTOP", "    MST  0\n    STOP\n");
        check("\u{FEFF}MST 0\r\n", "\u{FEFF}    MST  0\r\n");
        assert_eq!(format(b"Gr\xF6\xDFe:MST 0//\xE4"), b"Gr\xF6\xDFe: MST 0                //\xE4\n");
    }

    fn source() -> impl Strategy<Value = String> {
        let word = prop::sample::select(vec![
            "MVP",
            "mst",
            "Wait",
            "STOP",
            "JA",
            "ABS",
            "l1",
            "l2",
            "Äh",
            "0",
            "$1F",
            "%10",
            "7",
            "+",
            "-",
            "*",
            "/",
            "(",
            ")",
            ",",
            ",",
            "=",
            ":",
            ":",
            " ",
            "  ",
            "\t",
            "// note",
            "//",
            "#nostop",
            "#include a",
            "?",
            "\u{A0}",
            "MVP ABS, 0, 1",
            "SAP 4,0,A",
            "A=1",
            "Bcd =A*2",
            "l1:",
            "\n",
            "\n",
            "\n",
            "\r\n",
            "\r",
        ]);
        prop::collection::vec(word, 0..40).prop_map(|words| words.concat())
    }

    fn assembled(text: &[u8]) -> Assembly {
        assemble("test", text, &NoFiles)
    }

    proptest! {
        /// The same program, from the same lines; a wrong one is as wrong as before.
        #[test]
        fn only_the_looks_change(text in source()) {
            let formatted = format(text.as_bytes());
            let (before, after) = (assembled(text.as_bytes()), assembled(&formatted));
            prop_assert_eq!(&before.program, &after.program);
            let said = |assembly: &Assembly| -> Vec<_> {
                assembly.diagnostics.iter().map(|diagnostic| (diagnostic.place.line, diagnostic.severity)).collect()
            };
            prop_assert_eq!(said(&before), said(&after));
        }

        #[test]
        fn twice_is_once(text in source()) {
            let once = format(text.as_bytes());
            prop_assert_eq!(String::from_utf8(format(&once)), String::from_utf8(once));
        }

        #[test]
        fn any_text(text in ".{0,80}") {
            let once = format(text.as_bytes());
            prop_assert_eq!(String::from_utf8(format(&once)), String::from_utf8(once));
        }
    }
}
