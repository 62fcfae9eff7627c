//! How a program is laid out: what decompiler and formatter have in common.

use crate::compiler::syntax::Statement;

/// Spaces a level.
const INDENT: usize = 2;

/// Where comments behind statements begin, if there is room.
const COMMENT_COLUMN: usize = 28;

/// Spaces between a statement and its comment at least.
const COMMENT_GAP: usize = 2;

/// A line of a program.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Row<'a> {
    pub(crate) statement: Option<Statement>,
    /// With its `;`.
    pub(crate) comment: Option<&'a str>,
    /// Whether a comment of its own stands at the margin.
    pub(crate) margin: bool,
}

/// The text of these lines.
pub(crate) fn lay_out<'a>(rows: impl IntoIterator<Item = Row<'a>>) -> String {
    let mut text = String::new();
    let mut depth: usize = 0;
    for Row { statement, comment, margin } in rows {
        let mut line = String::new();
        if let Some(statement) = statement {
            depth = depth.saturating_sub(usize::from(statement.closes()));
            line = format!("{:indent$}{statement}", "", indent = depth * INDENT);
            depth += usize::from(statement.opens());
        }
        if let Some(comment) = comment {
            let column = match statement {
                Some(_) => COMMENT_COLUMN.max(line.len() + COMMENT_GAP),
                None if margin => 0,
                None => depth * INDENT,
            };
            line = format!("{line:column$}{}", comment.trim_end());
        }
        text.push_str(&line);
        text.push('\n');
    }
    text
}
