//! Lays a program out anew.

use crate::compiler::{self, Diagnostic, compile, parse};
use crate::dialect::Dialect;
use crate::layout::{Row, lay_out};

/// The same program in the usual layout: blocks indented, no spaces but those between a word and what it is
/// about, comments behind statements below each other. Comments and blank lines stay, except for blank lines
/// at the end, and comments of their own that stand at the margin stay there. The compiled lines are the same.
///
/// # Errors
/// What the compiler has against the source, if it has errors.
pub fn format(name: &str, source: &[u8], dialect: &Dialect) -> Result<String, Vec<Diagnostic>> {
    let compilation = compile(name, source, dialect);
    if compilation.has_errors() {
        return Err(compilation.diagnostics);
    }
    let source = compiler::read(name, source)?;
    let (lines, _) = parse(&source, dialect);
    let rows = lines.iter().map(|line| Row {
        statement: line.statement,
        comment: line.comment.as_ref().map(|span| source.slice(span)),
        margin: line.comment.as_ref().is_some_and(|span| source.column(span.start) == 1),
    });
    let text = lay_out(rows);
    let trimmed = text.trim_end_matches('\n');
    Ok(if trimmed.is_empty() { String::new() } else { format!("{trimmed}\n") })
}
