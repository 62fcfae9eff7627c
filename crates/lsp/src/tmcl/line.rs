//! What is being typed at a place.

use super::Tmcl;
use ::tmcl::{
    asm::syntax::{Spanned, Token, tokens},
    isa::{self, Instruction},
};
use source::Span;

/// What is being typed.
pub(super) enum Typed {
    /// A comment, or the name of a label.
    Nothing,
    /// The beginning of a statement.
    Statement,
    /// The number of an operand, from 0, of a command.
    Operand(&'static Instruction, usize),
    /// The value of a constant, or an operand of an unknown command.
    Value,
    /// A directive.
    Directive,
    /// The name of a file behind `#include`.
    File,
}

/// What is being typed before a place, and the bytes of it that were typed already.
pub(super) fn typed(program: &Tmcl, at: usize) -> (Typed, Span) {
    let source = program.source();
    let start = source.line_span(source.line(at)).start;
    let before = &source.text[start..at];
    let mut line: Vec<Spanned> = tokens(before).collect();
    let mut word = at..at;
    match line.last().cloned() {
        Some((Token::Comment, _)) => return (Typed::Nothing, word),
        Some((Token::Directive, span)) => return directive(before, start, &span, at),
        Some((Token::Name | Token::Decimal | Token::Hexadecimal | Token::Binary, span))
            if span.end == before.len() =>
        {
            word = start + span.start..at;
            line.pop();
        }
        _ => (),
    }
    let mut rest = &line[..];
    while let [(Token::Name, _), (Token::Colon, _), more @ ..] = rest {
        rest = more;
    }
    let typed = match rest {
        [] => Typed::Statement,
        [(Token::Name, _), (Token::Equals, _), ..] => Typed::Value,
        [(Token::Name, span), operands @ ..] => {
            let commas = operands.iter().filter(|(token, _)| *token == Token::Comma).count();
            isa::by_mnemonic(&before[span.clone()])
                .map_or(Typed::Value, |instruction| Typed::Operand(instruction, commas))
        }
        _ => Typed::Nothing,
    };
    (typed, word)
}

/// A line that begins with `#`.
fn directive(before: &str, start: usize, span: &Span, at: usize) -> (Typed, Span) {
    let text = &before[span.clone()];
    if text.contains("//") {
        return (Typed::Nothing, at..at);
    }
    match text.find([' ', '\t', '"', '<']) {
        None => (Typed::Directive, start + span.start..at),
        Some(_) => {
            let name = text.rfind([' ', '\t', '"', '<']).map_or(0, |space| space + 1);
            (Typed::File, start + span.start + name..at)
        }
    }
}
