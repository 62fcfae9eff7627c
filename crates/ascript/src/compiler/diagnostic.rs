//! What the compiler has to say about a source.

use super::source::{Source, Span};
use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use std::fmt;
use thiserror::Error;

/// The kinds of errors, with their names in table 5-43 of the CMD manual.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq, Hash)]
pub enum ErrorKind {
    /// The word is none of the language.
    #[error("Unknown Error")]
    Unknown,
    /// There is no bit of this number.
    #[error("BIT Error")]
    Bit,
    /// Something stands where nothing of the kind can stand.
    #[error("Token Error")]
    Token,
    /// What is left of `=` cannot be assigned to.
    #[error("= Error")]
    Equals,
    /// What a variable is assigned has no value.
    #[error("Assignment Error")]
    Assignment,
    /// An operand behind an operator, or of a condition, has no value.
    #[error("Operation Argument Error")]
    OperationArgument,
    /// A register can be assigned a number or a variable only.
    #[error("Error not Number of Var")]
    NotNumberOrVariable,
    /// There is no variable of this number.
    #[error("Var Range Error")]
    VariableRange,
    /// There is no `=`.
    #[error("Missing =")]
    MissingEquals,
    /// `GOSUB` of a number that no subroutine can have.
    #[error("Error GOSUB")]
    Gosub,
    /// A subroutine is not named by a number.
    #[error("Error SUB Number")]
    SubNumber,
    /// `SUB` of a number that no subroutine can have, or that another one has.
    #[error("Error SUB")]
    Sub,
    /// A subroutine has no `ENDSUB`.
    #[error("Error ENDSUB")]
    EndSub,
    /// `PRG` of a number that no program can have, or that another one has.
    #[error("Error PRG")]
    Prg,
    /// A program is not named by a number.
    #[error("Error PRG Number")]
    PrgNumber,
    /// A program has no `END`.
    #[error("Missing END")]
    MissingEnd,
    /// A loop has no `ENDWHILE`.
    #[error("Missing ENDWHILE")]
    MissingEndWhile,
    /// A condition has no `ENDIF`.
    #[error("Missing ENDIF")]
    MissingEndIf,
    /// Anything else.
    #[error("Error")]
    Other,
}

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Severity {
    /// There are no compiled lines.
    Error(ErrorKind),
    /// There are, but they may not do what was meant.
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
    span: Span,
}

/// What is found at a place, before it is known in which file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Finding {
    pub(crate) severity: Severity,
    pub(crate) span: Span,
    pub(crate) message: String,
    pub(crate) hint: Option<String>,
}

impl Finding {
    pub(crate) fn error(kind: ErrorKind, span: Span, message: impl Into<String>) -> Self {
        Self { severity: Severity::Error(kind), span, message: message.into(), hint: None }
    }

    pub(crate) fn hint(self, hint: impl Into<String>) -> Self {
        Self { hint: Some(hint.into()), ..self }
    }
}

impl Diagnostic {
    /// A finding about some bytes of a source, which are all in one line.
    pub(crate) fn new(source: &Source, finding: Finding) -> Self {
        let Finding { severity, span, message, hint } = finding;
        let line = source.line(span.start);
        let text = source.line_span(line);
        let start = span.start.min(text.end);
        let end = span.end.clamp(start, text.end);
        let column = source.column(start);
        Self {
            severity,
            file: source.name.clone(),
            line,
            column,
            end_column: column + source.slice(&(start..end)).chars().count(),
            message,
            hint,
            line_text: source.slice(&text).to_owned(),
            span: start - text.start..end - text.start,
        }
    }

    /// The name of the error in the manual; `None` for a warning.
    pub const fn kind(&self) -> Option<ErrorKind> {
        match self.severity {
            Severity::Error(kind) => Some(kind),
            Severity::Warning => None,
        }
    }

    /// The message, behind the error's name.
    fn title(&self) -> String {
        match self.severity {
            Severity::Error(kind) => format!("{kind}: {}", self.message),
            Severity::Warning => self.message.clone(),
        }
    }

    /// The message with its line of source, as a compiler prints it.
    pub fn render(&self, color: bool) -> String {
        let level = if self.kind().is_some() { Level::ERROR } else { Level::WARNING };
        let title = self.title();
        let snippet = Snippet::source(self.line_text.as_str())
            .line_start(self.line)
            .path(self.file.as_str())
            .annotation(AnnotationKind::Primary.span(self.span.clone()));
        let mut group = level.primary_title(title.as_str()).element(snippet);
        if let Some(hint) = &self.hint {
            group = group.element(Level::HELP.message(hint.as_str()));
        }
        let renderer = if color { Renderer::styled() } else { Renderer::plain() };
        renderer.render(&[group])
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let severity = if self.kind().is_some() { "error" } else { "warning" };
        write!(f, "{}:{}:{}: {severity}: {}", self.file, self.line, self.column, self.title())?;
        match &self.hint {
            Some(hint) => write!(f, " ({hint})"),
            None => Ok(()),
        }
    }
}

/// The candidate that is spelled most like `word`, if any is near enough to be what was meant.
pub(crate) fn nearest(word: &str, candidates: impl Iterator<Item = String>) -> Option<String> {
    // At least one character must be right.
    let length = word.chars().count();
    let bound = length.div_ceil(3).min(3).min(length.saturating_sub(1));
    let upper = word.to_uppercase();
    candidates
        .map(|candidate| (strsim::damerau_levenshtein(&upper, &candidate), candidate))
        .filter(|(distance, _)| *distance <= bound)
        .min()
        .map(|(_, candidate)| candidate)
}
