//! A place in a source file, and a message about it.

use crate::file::{Source, Span};
use annotate_snippets::{AnnotationKind, Renderer, Snippet};

/// How bad it is what a message says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Level {
    /// There is no program.
    Error,
    /// There is one, but it may not do what was meant.
    Warning,
}

impl Level {
    /// Its name: `error`, `warning`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
        }
    }
}

/// A place in a line of a source, with the text of the line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Name of the file.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// First column, from 1, in characters.
    pub column: usize,
    /// Column behind the last one.
    pub end_column: usize,
    text: String,
    /// Where in the text.
    span: Span,
}

impl Place {
    /// Some bytes of a source. What lies beyond the end of the line in which they begin is left out.
    pub fn new(source: &Source, span: Span) -> Self {
        let line = source.line(span.start);
        let text = source.line_span(line);
        let start = span.start.min(text.end);
        let end = span.end.clamp(start, text.end);
        let column = source.column(start);
        Self {
            file: source.name.clone(),
            line,
            column,
            end_column: column + source.slice(&(start..end)).chars().count(),
            text: source.slice(&text).to_owned(),
            span: start - text.start..end - text.start,
        }
    }

    /// A message about the place with its line of source, as compilers print it.
    pub fn render(&self, level: Level, title: &str, hint: Option<&str>, color: bool) -> String {
        let level = match level {
            Level::Error => annotate_snippets::Level::ERROR,
            Level::Warning => annotate_snippets::Level::WARNING,
        };
        let snippet = Snippet::source(self.text.as_str())
            .line_start(self.line)
            .path(self.file.as_str())
            .annotation(AnnotationKind::Primary.span(self.span.clone()));
        let mut group = level.primary_title(title).element(snippet);
        if let Some(hint) = hint {
            group = group.element(annotate_snippets::Level::HELP.message(hint));
        }
        let renderer = if color { Renderer::styled() } else { Renderer::plain() };
        renderer.render(&[group])
    }

    /// The same in one line.
    pub fn line(&self, level: Level, title: &str, hint: Option<&str>) -> String {
        let hint = hint.map(|hint| format!(" ({hint})")).unwrap_or_default();
        format!("{}:{}:{}: {}: {title}{hint}", self.file, self.line, self.column, level.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_points_at_its_place() {
        let source = Source::new("a.prg", "END\nGröße=1\n".as_bytes());
        let place = Place::new(&source, 4..11);
        assert_eq!((place.line, place.column, place.end_column), (2, 1, 6));
        assert_eq!(
            place.render(Level::Error, "no such word", Some("try END"), false),
            "error: no such word\n --> a.prg:2:1\n  |\n2 | Größe=1\n  | ^^^^^\n  |\n  = help: try END"
        );
        assert_eq!(place.line(Level::Warning, "odd", None), "a.prg:2:1: warning: odd");
        // A place ends with its line.
        assert_eq!(Place::new(&source, 4..14).end_column, 8);
    }
}
