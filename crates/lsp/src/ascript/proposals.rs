//! What may be typed next.

use super::{
    Ascript,
    words::{about, kind_of},
};
use crate::program::{Proposal, TokenKind};
use ::ascript::{
    compiler::{Token as Piece, spellings, tokens},
    isa::{Access, Entry, Index, Kind, Suffix, words},
};
use source::{Source, Span};

/// Up to so many things of a kind are proposed one by one.
const FEW: u8 = 8;

/// What words that begin a block need besides, to be filled in.
const BLOCKS: [(&str, &str); 4] = [
    ("PRG", "PRG ${1:0}\n\t$0\nEND"),
    ("SUB", "SUB ${1:0}\n\t$0\nENDSUB"),
    ("IF", "IF ${1:DI1=1}\n\t$0\nENDIF"),
    ("WHILE", "WHILE ${1:1=1}\n\t$0\nENDWHILE"),
];

/// What may be typed at a place.
pub(super) fn proposals(program: &Ascript, at: usize) -> (Span, Vec<Proposal>) {
    let start = program.source.line_span(program.source.line(at)).start;
    let before = Source::new("", program.source.slice(&(start..at)).as_bytes());
    let Some(line) = tokens(&before).pop() else { return (at..at, Vec::new()) };
    if line.comment.is_some() {
        return (at..at, Vec::new());
    }
    let mut pieces = &line.tokens[..];
    // The beginning of what is being typed: letters, and digits right behind them.
    let mut typed = before.text.len();
    for kind in [Piece::Number, Piece::Word] {
        if let [rest @ .., (piece, span)] = pieces
            && *piece == kind
            && span.end == typed
        {
            (pieces, typed) = (rest, span.start);
        }
    }
    let proposals = match pieces {
        [] => statements(program),
        [(Piece::Word, word)] if matches!(&before.text[word.clone()], "GOSUB" | "SUB") => {
            subroutines(program)
        }
        _ => values(program),
    };
    (start + typed..at, proposals)
}

fn statements(program: &Ascript) -> Vec<Proposal> {
    let fits = |entry: &&Entry| {
        let access = entry.access(program.dialect.family);
        entry.kind != Kind::Comment && access.is_some_and(|access| access.writes() || access == Access::Flow)
    };
    words(program.dialect.family).filter(fits).flat_map(|entry| spelled(program, entry)).collect()
}

fn values(program: &Ascript) -> Vec<Proposal> {
    let fits = |entry: &&Entry| {
        let access = entry.access(program.dialect.family);
        matches!(entry.kind, Kind::Register | Kind::Variable) && access.is_some_and(Access::reads)
    };
    words(program.dialect.family).filter(fits).flat_map(|entry| spelled(program, entry)).collect()
}

/// A word with all that can stand behind it, as far as that is not too much.
fn spelled(program: &Ascript, entry: &'static Entry) -> Vec<Proposal> {
    let labels: Vec<String> = match entry.suffix {
        Suffix::Targets => return Vec::new(),
        Suffix::Index(Index::Variable) => {
            let mut used: Vec<_> =
                program.names.iter().map(|name| &name.key).filter(|key| key.starts_with('V')).collect();
            used.sort_unstable_by_key(|key| (key.len(), *key));
            used.dedup();
            used.into_iter().cloned().collect()
        }
        Suffix::Index(index) if entry.kind != Kind::Structure => {
            let (first, last) = index.range(program.dialect);
            if last > FEW {
                vec![entry.name.into()]
            } else {
                (first..=last).map(|number| format!("{}{number}", entry.name)).collect()
            }
        }
        Suffix::Direction | Suffix::Home => {
            let axes = spellings(entry, program.dialect).into_iter();
            axes.flat_map(|axis| ["+", "-"].map(|direction| format!("{axis}{direction}"))).collect()
        }
        _ => spellings(entry, program.dialect),
    };
    let proposal = |label: String| {
        let block = BLOCKS.iter().find(|(word, _)| *word == label);
        let mut proposal = Proposal::new(label, kind_of(entry), entry.form(program.dialect));
        proposal.text = about(program, entry);
        proposal.snippet = block.map(|(_, snippet)| (*snippet).into());
        proposal
    };
    labels.into_iter().map(proposal).collect()
}

/// The subroutines that there are.
fn subroutines(program: &Ascript) -> Vec<Proposal> {
    let begins = program.names.iter().filter(|name| name.defines && name.key.starts_with("SUB"));
    let proposal = |name: &crate::program::Name| {
        let line = program.source.line(name.span.start);
        let comment = program.tokens[line - 1].comment.clone();
        let comment = comment.map_or("", |span| program.source.slice(&span).trim_start_matches(';').trim());
        Proposal::new(program.source.slice(&name.span), TokenKind::Label, comment)
    };
    begins.map(proposal).collect()
}
