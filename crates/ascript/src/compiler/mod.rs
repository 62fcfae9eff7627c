//! The compiler: source text to compiled lines.
//!
//! Every error is found in one go: a wrong line is reported, with the manual's name for the error, and
//! passed over. Lines are read first, then they become blocks and compiled lines.

mod diagnostic;
mod generate;
mod lexer;
mod parser;
pub mod syntax;
mod words;

pub use diagnostic::{Diagnostic, ErrorKind, Severity};
pub use lexer::{Token, Tokens, lines as tokens};
pub use parser::SourceLine;
pub use source::MAX_SOURCE_BYTES;
pub use words::spellings;

pub(crate) use diagnostic::Finding;
pub(crate) use parser::parse;
pub(crate) use source::Source;

use crate::dialect::Dialect;
use crate::line::Line;

/// Most messages about a source.
pub const MAX_MESSAGES: usize = 500;

/// How deep `IF` and `WHILE` nest.
pub const MAX_NESTING: usize = 32;

/// Compiled lines, and where they come from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Code {
    /// The lines, from address 0.
    pub lines: Vec<Line>,
    /// For each of them its line in the source, from 1.
    pub map: Vec<usize>,
}

/// What comes out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Compilation {
    /// The program, unless there are errors.
    pub code: Option<Code>,
    /// Errors and warnings, in the order of lines.
    pub diagnostics: Vec<Diagnostic>,
}

impl Compilation {
    /// All messages, as a compiler prints them; empty if there are none.
    pub fn render(&self, color: bool) -> String {
        self.diagnostics.iter().map(|diagnostic| diagnostic.render(color) + "\n").collect()
    }

    /// Whether there are errors, and so no program.
    pub fn has_errors(&self) -> bool {
        self.code.is_none()
    }
}

impl Code {
    /// The addresses of the compiled lines that a line of the source became.
    pub fn addresses(&self, source_line: usize) -> impl Iterator<Item = usize> {
        let lines = self.map.iter().enumerate().filter(move |&(_, &line)| line == source_line);
        lines.map(|(address, _)| address)
    }
}

/// Compiles a source, which is UTF-8 or Latin-1. The name is that of the file, for messages.
pub fn compile(name: &str, source: &[u8], dialect: &Dialect) -> Compilation {
    let source = match read(name, source) {
        Ok(source) => source,
        Err(diagnostics) => return Compilation { code: None, diagnostics },
    };
    let (lines, mut findings) = parse(&source, dialect);
    let (code, more) = generate::generate(&lines, dialect);
    findings.extend(more);
    let correct = findings.iter().all(|finding| finding.severity == Severity::Warning);
    Compilation { code: correct.then_some(code), diagnostics: diagnostics(&source, findings) }
}

/// What each line of a source says, for editors.
pub fn statements(source: &Source, dialect: &Dialect) -> Vec<SourceLine> {
    parse(source, dialect).0
}

/// A byte order mark, which some editors put before UTF-8.
const MARK: &[u8] = "\u{FEFF}".as_bytes();

/// A source, unless it is too long.
pub(crate) fn read(name: &str, bytes: &[u8]) -> Result<Source, Vec<Diagnostic>> {
    if bytes.len() <= MAX_SOURCE_BYTES {
        return Ok(Source::new(name, bytes.strip_prefix(MARK).unwrap_or(bytes)));
    }
    let message = format!("a source has at most {MAX_SOURCE_BYTES} bytes");
    Err(diagnostics(&Source::new(name, &[]), vec![Finding::error(ErrorKind::Other, 0..0, message)]))
}

/// Findings about a source, in its order; the first of them if there are too many.
pub(crate) fn diagnostics(source: &Source, mut findings: Vec<Finding>) -> Vec<Diagnostic> {
    findings.sort_by_key(|finding| finding.span.start);
    findings.truncate(MAX_MESSAGES);
    findings.into_iter().map(|finding| Diagnostic::new(source, finding)).collect()
}

#[cfg(test)]
mod tests;
