//! What the assembler has to say about a source.

use super::source::Source;
use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use std::fmt;
use std::ops::Range;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Severity {
    /// There is no program.
    Error,
    /// There is one, but it may not do what was meant.
    Warning,
}

/// A message about a place in a source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// Name of the file.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// First column, from 1, in characters.
    pub column: usize,
    /// Column behind the last one.
    pub end_column: usize,
    /// What is the matter.
    pub message: String,
    /// What might help.
    pub hint: Option<String>,
    /// The text of the line, and where in it the place is.
    line_text: String,
    span: Range<usize>,
}

impl Diagnostic {
    /// A message about some bytes of a source, which are all in one line.
    pub(super) fn new(severity: Severity, source: &Source, span: Range<usize>, message: String) -> Self {
        let line = source.line(span.start);
        let text = source.line_range(line);
        let end = span.end.clamp(span.start, text.end.max(span.start));
        Self {
            severity,
            file: source.name.clone(),
            line,
            column: source.column(span.start),
            end_column: source.column(span.start) + source.slice(&(span.start..end)).chars().count(),
            message,
            hint: None,
            line_text: source.slice(&text).to_owned(),
            span: span.start - text.start..end - text.start,
        }
    }

    /// The message with its line of source, as a compiler prints it.
    pub fn render(&self, color: bool) -> String {
        let level = match self.severity {
            Severity::Error => Level::ERROR,
            Severity::Warning => Level::WARNING,
        };
        let snippet = Snippet::source(self.line_text.as_str())
            .line_start(self.line)
            .path(self.file.as_str())
            .annotation(AnnotationKind::Primary.span(self.span.clone()));
        let mut group = level.primary_title(self.message.as_str()).element(snippet);
        if let Some(hint) = &self.hint {
            group = group.element(Level::HELP.message(hint.as_str()));
        }
        let renderer = if color { Renderer::styled() } else { Renderer::plain() };
        renderer.render(&[group])
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let severity = match self.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
        };
        write!(f, "{}:{}:{}: {severity}: {}", self.file, self.line, self.column, self.message)?;
        match &self.hint {
            Some(hint) => write!(f, " ({hint})"),
            None => Ok(()),
        }
    }
}

/// The candidate that is spelled most like `word`, if any is near enough to be what was meant.
pub(super) fn nearest<'a>(word: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    // At least one character must be right.
    let length = word.chars().count();
    let bound = length.div_ceil(3).min(3).min(length.saturating_sub(1));
    let upper = word.to_uppercase();
    candidates
        .map(|candidate| (strsim::damerau_levenshtein(&upper, &candidate.to_uppercase()), candidate))
        .filter(|&(distance, _)| distance <= bound)
        .min()
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_word() {
        let check = |word, expected| {
            assert_eq!(nearest(word, ["MVP", "MST", "WAIT", "CALCVA"].into_iter()), expected, "{word}");
        };
        check("MPV", Some("MVP"));
        check("mvp", Some("MVP"));
        check("WIAT", Some("WAIT"));
        check("UNAIT", Some("WAIT"));
        check("CALVCA", Some("CALCVA"));
        check("XYZ", None);
        check("M", None);
        check("", None);
    }
}
