//! What the pieces of a text are.

use super::{Tmcl, keyword};
use crate::program::{Token, TokenKind};
use ::tmcl::{
    asm::{
        RAW_MNEMONIC,
        syntax::{self, Statement},
    },
    isa,
};
use source::Span;
use std::collections::BTreeMap;

/// The pieces of a program's own text, in its order.
pub(super) fn tokens(program: &Tmcl) -> Vec<Token> {
    let source = program.source();
    let words = words(program);
    let mut tokens = Vec::new();
    for (token, span) in syntax::tokens(&source.text) {
        use syntax::Token as Kind;
        let kind = match token {
            Kind::LineEnd | Kind::Unknown | Kind::Colon | Kind::Comma | Kind::Open | Kind::Close => continue,
            Kind::Comment => TokenKind::Comment,
            Kind::Decimal | Kind::Hexadecimal | Kind::Binary => TokenKind::Number,
            Kind::Equals | Kind::Plus | Kind::Minus | Kind::Star | Kind::Slash => TokenKind::Operator,
            Kind::Directive => {
                directive(program, &span, &mut tokens);
                continue;
            }
            Kind::Name => match words.get(&span.start) {
                Some(&(kind, defines)) => {
                    tokens.push(Token { span, kind, defines });
                    continue;
                }
                None => match unread(source.slice(&span)) {
                    Some(kind) => kind,
                    None => continue,
                },
            },
        };
        tokens.push(Token { span, kind, defines: false });
    }
    tokens
}

/// What the words of the statements are, by where they begin, and whether they are defined there.
fn words(program: &Tmcl) -> BTreeMap<usize, (TokenKind, bool)> {
    let source = program.source();
    let mut words = BTreeMap::new();
    for name in program.names.iter().filter(|name| name.file == 0) {
        let Some(definition) = program.definition(&name.key) else { continue };
        let kind = match definition.label {
            true => TokenKind::Label,
            false if program.is_built_in(definition.file) => TokenKind::Parameter,
            false => TokenKind::Constant,
        };
        words.insert(name.span.start, (kind, name.defines));
    }
    for statement in &program.statements {
        let Statement::Command(mnemonic, operands) = statement else { continue };
        let Some(instruction) = isa::by_mnemonic(source.slice(mnemonic)) else { continue };
        words.insert(mnemonic.start, (TokenKind::Keyword, false));
        for (known, operand) in instruction.operands.iter().zip(operands) {
            if keyword(Some(known.role), source, operand).is_some() {
                words.insert(operand.span.start, (TokenKind::Option, false));
            }
        }
    }
    words
}

/// What a word is in a line that is none.
fn unread(word: &str) -> Option<TokenKind> {
    let is_command = isa::by_mnemonic(word).is_some() || word.eq_ignore_ascii_case(RAW_MNEMONIC);
    is_command.then_some(TokenKind::Keyword)
}

/// A directive, the name of its file, and the comment behind it.
fn directive(program: &Tmcl, span: &Span, tokens: &mut Vec<Token>) {
    let text = program.source().slice(span);
    let code = text.find("//").unwrap_or(text.len());
    let word = text[..code].find([' ', '\t', '"', '<']).unwrap_or(code);
    let name = text[word..code].trim_matches([' ', '\t', '"', '<', '>']);
    let start = word + text[word..].find(name).unwrap_or_default();
    let pieces = [
        (0..word, TokenKind::Directive),
        (start..start + name.len(), TokenKind::File),
        (code..text.len(), TokenKind::Comment),
    ];
    for (piece, kind) in pieces.into_iter().filter(|(piece, _)| !piece.is_empty()) {
        let span = span.start + piece.start..span.start + piece.end;
        tokens.push(Token { span, kind, defines: false });
    }
}
