//! A-SCRIPT, as its compiler and the table of its words know it.
//!
//! `words` says which word stands at a place, `proposals` what may be typed there.

mod proposals;
mod words;

use crate::program::{
    Finding, Fold, Name, Part, Program, Proposal, Signature, Token, TokenKind, comment_folds, span_of,
    with_hint,
};
use ::ascript::{
    Dialect, Word,
    compiler::{
        self, Compilation, Severity, SourceLine, Token as Piece, Tokens, compile, statements,
        syntax::Statement,
    },
    format,
    isa::Index,
};
use devices::{Language, MODELS};
use source::{Source, Span};
use std::collections::BTreeSet;

/// The compiler takes off one byte order mark. This one is for it, so that places are those of the text.
const MARK: &str = "\u{FEFF}";

/// An A-SCRIPT program.
pub(crate) struct Ascript {
    source: Source,
    dialect: &'static Dialect,
    compilation: Compilation,
    /// What each line says.
    lines: Vec<SourceLine>,
    /// What each line consists of.
    tokens: Vec<Tokens>,
    names: Vec<Name>,
}

/// Reads a program. Where nobody said which controller it is for, it is the first one for which it is right.
pub(crate) fn read(source: &Source, dialect: Option<&'static Dialect>) -> Ascript {
    let marked = [MARK, &source.text].concat();
    let compiled = |dialect| (dialect, compile(&source.name, marked.as_bytes(), dialect));
    let (dialect, compilation) = match dialect {
        Some(dialect) => compiled(dialect),
        None => {
            let mut all = dialects().map(compiled);
            let first = all.next().expect("there are controllers with A-SCRIPT");
            if first.1.has_errors() {
                all.find(|(_, compilation)| !compilation.has_errors()).unwrap_or(first)
            } else {
                first
            }
        }
    };
    let (lines, tokens) = (statements(source, dialect), compiler::tokens(source));
    let names = names_in(source, &tokens);
    Ascript { source: source.clone(), dialect, compilation, lines, tokens, names }
}

fn dialects() -> impl Iterator<Item = &'static Dialect> {
    MODELS.iter().filter_map(|model| match model.language {
        Language::Ascript(dialect) => Some(dialect),
        Language::Tmcl => None,
    })
}

/// Things with numbers that have a place where they begin or get a value: a word, whether that is one, and what the
/// number counts.
const NUMBERED: [(&str, bool, Index); 5] = [
    ("PRG", true, Index::Program),
    ("SUB", true, Index::Subroutine),
    ("GOSUB", false, Index::Subroutine),
    ("SR", false, Index::Program),
    ("V", true, Index::Variable),
];

/// Where a name stands that is a word with a number. That of a variable is both, else the number.
fn names_in(source: &Source, lines: &[Tokens]) -> Vec<Name> {
    let mut names = Vec::new();
    for Tokens { tokens, .. } in lines {
        for (at, pair) in tokens.windows(2).enumerate() {
            let [(Piece::Word, word), (Piece::Number, number)] = pair else { continue };
            let letters = source.slice(word);
            let Some(&(_, begins, index)) = NUMBERED.iter().find(|(name, ..)| *name == letters) else {
                continue;
            };
            let Ok(value) = source.slice(number).parse::<u32>() else { continue };
            let is_variable = index == Index::Variable;
            // A variable gets a value where it stands before `=` at the beginning of a line.
            let assigned = at == 0 && matches!(tokens.get(2), Some((Piece::Equals, _)));
            let defines = begins && (assigned || !is_variable);
            let span = if is_variable { word.start..number.end } else { number.clone() };
            names.push(Name { key: key(index, value), file: 0, span, defines });
        }
    }
    names
}

/// What a thing with a number is called.
fn key(index: Index, number: u32) -> String {
    match index {
        Index::Variable => format!("V{number}"),
        Index::Program => format!("PRG {number}"),
        _ => format!("SUB {number}"),
    }
}

impl Ascript {
    /// The line of a place, from 0, and its tokens.
    fn line(&self, at: usize) -> (usize, &Tokens) {
        let line = self.source.line(at) - 1;
        (line, &self.tokens[line])
    }

    /// The lines that statements are in, from 1.
    fn statements(&self) -> impl Iterator<Item = (usize, &Span, Statement)> {
        let lines = self.lines.iter().zip(1..);
        lines.filter_map(|(line, number)| line.statement.map(|statement| (number, &line.span, statement)))
    }
}

/// What a statement begins; `None` if it begins nothing.
fn block_of(statement: &Statement) -> Option<Word> {
    match statement {
        Statement::Program(_) => Some(Word::Prg),
        Statement::Subroutine(_) => Some(Word::Sub),
        Statement::If(_) => Some(Word::If),
        Statement::While(_) => Some(Word::While),
        _ => None,
    }
}

/// What a statement ends.
fn end_of(statement: &Statement) -> Option<Word> {
    match statement {
        Statement::End => Some(Word::Prg),
        Statement::EndSubroutine => Some(Word::Sub),
        Statement::EndIf => Some(Word::If),
        Statement::EndWhile => Some(Word::While),
        _ => None,
    }
}

impl Program for Ascript {
    fn findings(&self) -> Vec<Finding> {
        let finding = |diagnostic: &compiler::Diagnostic| Finding {
            span: span_of(&self.source, &diagnostic.place),
            is_error: diagnostic.severity != Severity::Warning,
            code: diagnostic.kind().map(|kind| kind.to_string()),
            message: with_hint(&diagnostic.message, diagnostic.hint.as_deref()),
        };
        self.compilation.diagnostics.iter().map(finding).collect()
    }

    fn tokens(&self) -> Vec<Token> {
        let defined: BTreeSet<usize> =
            self.names.iter().filter(|name| name.defines).map(|name| name.span.start).collect();
        let mut tokens = Vec::new();
        for line in &self.tokens {
            let mut pieces = &line.tokens[..];
            while let [(piece, span), rest @ ..] = pieces {
                pieces = rest;
                let mut span = span.clone();
                let kind = match piece {
                    Piece::Word => {
                        let (kind, numbered) = words::kind(self, &span, rest.first());
                        if let (true, Some((_, number))) = (numbered, rest.first()) {
                            span.end = number.end;
                            pieces = &rest[1..];
                        }
                        kind
                    }
                    Piece::Number => Some(TokenKind::Number),
                    Piece::Equals
                    | Piece::Comparison
                    | Piece::Plus
                    | Piece::Minus
                    | Piece::Operator
                    | Piece::Tilde => Some(TokenKind::Operator),
                    _ => None,
                };
                if let Some(kind) = kind {
                    let defines = defined.contains(&span.start);
                    tokens.push(Token { span, kind, defines });
                }
            }
            tokens.extend(line.comment.clone().map(|span| Token {
                span,
                kind: TokenKind::Comment,
                defines: false,
            }));
        }
        tokens
    }

    fn names(&self) -> &[Name] {
        &self.names
    }

    fn renamed(&self, name: &Name, to: &str) -> Result<String, String> {
        let index = match name.key.as_bytes().first() {
            Some(b'V') => Index::Variable,
            Some(b'P') => Index::Program,
            _ => Index::Subroutine,
        };
        // `7`, or with its word: `V7`, `SUB 7`.
        let (word, number) = to.split_at(to.len() - to.bytes().rev().take_while(u8::is_ascii_digit).count());
        let (first, last) = index.range(self.dialect);
        let number = match number.parse::<u32>() {
            Ok(number) if (first.into()..=last.into()).contains(&number) => number,
            _ => return Err(format!("it has a number from {first} to {last}")),
        };
        let key = key(index, number);
        if !word.is_empty() && !key.starts_with(word.trim_end()) {
            return Err(format!("it has a number from {first} to {last}"));
        }
        if key != name.key && self.names.iter().any(|other| other.key == key) {
            return Err(format!("`{key}` is used already"));
        }
        Ok(if index == Index::Variable { key } else { number.to_string() })
    }

    fn outline(&self) -> Vec<Part> {
        let mut parts: Vec<Part> = Vec::new();
        for (_, span, statement) in self.statements() {
            match block_of(&statement) {
                Some(Word::Prg | Word::Sub) => parts.push(Part {
                    name: statement.to_string(),
                    detail: String::new(),
                    is_code: true,
                    span: span.clone(),
                    name_span: span.clone(),
                }),
                _ => {
                    if let Some(part) = parts.last_mut() {
                        part.span.end = span.end;
                    }
                }
            }
        }
        parts
    }

    fn folds(&self) -> Vec<Fold> {
        let is_comment = |tokens: &Tokens| tokens.tokens.is_empty() && tokens.comment.is_some();
        let mut folds =
            comment_folds(self.tokens.iter().zip(1..).map(|(line, number)| (number, is_comment(line))));
        let mut open: Vec<(Word, usize)> = Vec::new();
        for (line, _, statement) in self.statements() {
            if let Some(word) = block_of(&statement) {
                open.push((word, line));
            }
            if let Some(word) = end_of(&statement)
                && let Some(at) = open.iter().rposition(|(begun, _)| *begun == word)
            {
                folds.push(Fold { first: open[at].1, last: line, is_comment: false });
                open.truncate(at);
            }
        }
        folds.retain(|fold| fold.first < fold.last);
        folds
    }

    fn proposals(&self, at: usize) -> (Span, Vec<Proposal>) {
        proposals::proposals(self, at)
    }

    fn hover(&self, at: usize) -> Option<(Span, String)> {
        words::hover(self, at)
    }

    fn signature(&self, at: usize) -> Option<Signature> {
        words::signature(self, at)
    }

    fn formatted(&self) -> Option<String> {
        let marked = [MARK, &self.source.text].concat();
        format(&self.source.name, marked.as_bytes(), self.dialect).ok()
    }
}
