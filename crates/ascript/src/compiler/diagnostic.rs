//! What the compiler has to say about a source.

use source::{Level, Place, Source, Span};
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

impl ErrorKind {
    /// All of them, in the order of the table.
    pub const ALL: [Self; 19] = [
        Self::Unknown,
        Self::Bit,
        Self::Token,
        Self::Equals,
        Self::Assignment,
        Self::OperationArgument,
        Self::NotNumberOrVariable,
        Self::VariableRange,
        Self::MissingEquals,
        Self::Gosub,
        Self::SubNumber,
        Self::Sub,
        Self::EndSub,
        Self::Prg,
        Self::PrgNumber,
        Self::MissingEnd,
        Self::MissingEndWhile,
        Self::MissingEndIf,
        Self::Other,
    ];
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
    /// Where.
    pub place: Place,
    /// What is the matter.
    pub message: String,
    /// What might help.
    pub hint: Option<String>,
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
        Self { severity, place: Place::new(source, span), message, hint }
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

    fn level(&self) -> Level {
        if self.kind().is_some() { Level::Error } else { Level::Warning }
    }

    /// The message with its line of source, as a compiler prints it.
    pub fn render(&self, color: bool) -> String {
        self.place.render(self.level(), &self.title(), self.hint.as_deref(), color)
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.place.line(self.level(), &self.title(), self.hint.as_deref()))
    }
}
