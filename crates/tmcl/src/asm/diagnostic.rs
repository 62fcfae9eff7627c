//! What the assembler has to say about a source.

pub use source::Level as Severity;
use source::{Place, Source, Span};
use std::fmt;

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

impl Diagnostic {
    /// A message about some bytes of a source, which are all in one line.
    pub(super) fn new(severity: Severity, source: &Source, span: Span, message: String) -> Self {
        Self { severity, place: Place::new(source, span), message, hint: None }
    }

    /// The message with its line of source, as a compiler prints it.
    pub fn render(&self, color: bool) -> String {
        self.place.render(self.severity, &self.message, self.hint.as_deref(), color)
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.place.line(self.severity, &self.message, self.hint.as_deref()))
    }
}
