//! Which word stands at a place, and what there is to say about it.

use super::{Ascript, key};
use crate::program::{Signature, TokenKind};
use ::ascript::{
    Place,
    compiler::Token as Piece,
    isa::{Access, Entry, Index, Kind, Suffix, words},
};
use source::Span;

/// The entry of a word, with a number behind it or not, and whether the number belongs to it.
fn entry(program: &Ascript, letters: &str, numbered: bool) -> Option<(&'static Entry, bool)> {
    let dialect = program.dialect;
    let found = |numbered| Place::from_letters(letters, numbered, dialect).map(|place| place.word.entry());
    let entry = found(numbered).or_else(|| found(false));
    // Words that need a number are known without it too.
    let entry = entry.or_else(|| words(dialect.family).find(|entry| entry.name == letters))?;
    Some((entry, numbered && matches!(entry.suffix, Suffix::Index(_))))
}

/// What kind of piece a word is, and whether the number behind it is part of it. The number of a program or a
/// subroutine is a piece of its own.
pub(super) fn kind(
    program: &Ascript,
    word: &Span,
    next: Option<&(Piece, Span)>,
) -> (Option<TokenKind>, bool) {
    let numbered = next.is_some_and(|(piece, _)| *piece == Piece::Number);
    let Some((entry, numbered)) = entry(program, program.source.slice(word), numbered) else {
        return (None, false);
    };
    let kind = kind_of(entry);
    (Some(kind), numbered && kind != TokenKind::Keyword)
}

/// What kind of piece a word is.
pub(super) fn kind_of(entry: &Entry) -> TokenKind {
    match entry.kind {
        Kind::Comment => TokenKind::Comment,
        Kind::Structure => TokenKind::Keyword,
        Kind::Variable => TokenKind::Variable,
        Kind::Register => TokenKind::Parameter,
        Kind::Action | Kind::Command => TokenKind::Action,
    }
}

/// What there is to say about the word at a place.
pub(super) fn hover(program: &Ascript, at: usize) -> Option<(Span, String)> {
    let (_, line) = program.line(at);
    let tokens = &line.tokens;
    let here = tokens.iter().position(|(_, span)| span.start <= at && at < span.end);
    let index = here.or_else(|| tokens.iter().position(|(_, span)| span.end == at))?;
    // A number is about the word before it.
    let index = match tokens[index].0 {
        Piece::Word => index,
        Piece::Number => index.checked_sub(1)?,
        _ => return None,
    };
    let (Piece::Word, word) = &tokens[index] else { return None };
    let letters = program.source.slice(word);
    let next = tokens.get(index + 1).filter(|(piece, _)| *piece == Piece::Number);
    let (entry, numbered) = entry(program, letters, next.is_some())?;
    let number = next.filter(|_| numbered).map(|(_, span)| span);
    let span = word.start..number.map_or(word.end, |number| number.end);
    let mut text = about(program, entry);
    if let (Suffix::Index(index @ (Index::Variable | Index::Subroutine)), Some(number)) =
        (entry.suffix, number)
        && let Ok(number) = program.source.slice(number).parse()
    {
        text.push_str(&uses(program, &key(index, number)));
    }
    Some((span, text))
}

/// Where a variable gets its values, or what a subroutine's comment says.
fn uses(program: &Ascript, key: &str) -> String {
    let lines = program.names.iter().filter(|name| name.defines && name.key == key);
    let lines: Vec<_> = lines.map(|name| program.source.line(name.span.start).to_string()).collect();
    match (lines.as_slice(), key.starts_with('V')) {
        ([], true) => "\n\nIt gets no value here.".into(),
        ([line], true) => format!("\n\nIt gets its value in line {line}."),
        (lines, true) => format!("\n\nIt gets its values in lines {}.", lines.join(", ")),
        ([], false) => "\n\nIt is not here.".into(),
        (lines, false) => format!("\n\nIt begins in line {}.", lines.join(", ")),
    }
}

/// What there is to say about a word.
pub(super) fn about(program: &Ascript, entry: &Entry) -> String {
    let dialect = program.dialect;
    let access = match entry.access(dialect.family) {
        Some(Access::Read) => " Read only.",
        Some(Access::Write) if entry.kind == Kind::Register => " Write only.",
        _ => "",
    };
    format!(
        "```ascript\n{}\n```\n{}{access}\n\nExample: `{}`. {} manual {}.",
        entry.form(dialect),
        entry.doc.summary,
        entry.doc.example,
        dialect.name,
        entry.section(dialect.family)
    )
}

/// How the statement is written that is being typed, if it has several numbers.
pub(super) fn signature(program: &Ascript, at: usize) -> Option<Signature> {
    let (_, line) = program.line(at);
    let before: Vec<_> = line.tokens.iter().filter(|(_, span)| span.end <= at).collect();
    let [(Piece::Word, word), rest @ ..] = &before[..] else { return None };
    let (entry, _) = entry(program, program.source.slice(word), false)?;
    let form = entry.form(program.dialect);
    let active = match entry.suffix {
        Suffix::Plane(_) | Suffix::Helix(_) => {
            rest.iter().filter(|(piece, _)| *piece == Piece::Colon).count()
        }
        Suffix::Home if entry.arguments(program.dialect) > 0 => 0,
        _ => return None,
    };
    let first = match entry.suffix {
        Suffix::Home => form.find("[mode]")?,
        _ => form.find("[1]")?,
    };
    let mut parameters = Vec::new();
    let mut from = first;
    for part in form[first..].split(':') {
        parameters.push((from..from + part.len(), String::new()));
        from += part.len() + 1;
    }
    Some(Signature { form, parameters, active, text: entry.doc.summary.into() })
}
