//! What a language has to say about a text, in bytes of it.

use crate::{Files, ascript, document::Document, tmcl, uri};
use ::ascript::Dialect;
use devices::{Language, Model};
use source::{MAX_SOURCE_BYTES, Source, Span};
use std::collections::BTreeMap;

/// What a text is written in.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Tongue {
    Tmcl,
    /// A-SCRIPT of this dialect, or of that in which the text is right.
    Ascript(Option<&'static Dialect>),
}

impl Tongue {
    /// What a document is written in: as its editor says, or its name, or the model.
    pub(crate) fn of(uri: &str, language: &str, model: Option<&Model>) -> Option<Self> {
        let spoken = model.map(|model| match model.language {
            Language::Tmcl => Self::Tmcl,
            Language::Ascript(dialect) => Self::Ascript(Some(dialect)),
        });
        let ascript = match spoken {
            Some(Self::Ascript(dialect)) => Self::Ascript(dialect),
            _ => Self::Ascript(None),
        };
        match language {
            "tmcl" => return Some(Self::Tmcl),
            "ascript" | "a-script" => return Some(ascript),
            _ => (),
        }
        match uri::extension(uri).as_deref() {
            Some("tmc" | "inc") => Some(Self::Tmcl),
            Some("prg") => Some(ascript),
            _ => spoken,
        }
    }
}

/// Something that is to be said about a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Finding {
    pub(crate) span: Span,
    pub(crate) is_error: bool,
    /// The manual's name for an error, if it has one.
    pub(crate) code: Option<String>,
    pub(crate) message: String,
}

/// A text that is understood as far as it is right.
pub(crate) trait Program: Send {
    /// Errors and warnings, in the order of the text.
    fn findings(&self) -> Vec<Finding>;

    /// URIs of the files that it was made of besides its own.
    fn includes(&self) -> &[String] {
        &[]
    }
}

/// What is around a document.
pub(crate) struct Surroundings<'a> {
    pub(crate) documents: &'a BTreeMap<String, Document>,
    pub(crate) files: &'a dyn Files,
}

impl Surroundings<'_> {
    /// The text of a file, from an editor's window if it is open.
    pub(crate) fn read(&self, uri: &str) -> Option<Vec<u8>> {
        let open = self.documents.values().find(|document| uri::same(&document.uri, uri));
        open.map_or_else(|| self.files.read(uri), |document| Some(document.source.text.clone().into_bytes()))
    }
}

/// Reads a text.
pub(crate) fn read(source: &Source, tongue: Option<Tongue>, around: &Surroundings<'_>) -> Box<dyn Program> {
    match tongue {
        None => Box::new(Unread(None)),
        Some(_) if source.text.len() > MAX_SOURCE_BYTES => Box::new(Unread(Some(Finding {
            span: 0..0,
            is_error: true,
            code: None,
            message: format!("a source file has at most {MAX_SOURCE_BYTES} bytes"),
        }))),
        Some(Tongue::Tmcl) => Box::new(tmcl::read(source, around)),
        Some(Tongue::Ascript(dialect)) => Box::new(ascript::read(source, dialect)),
    }
}

/// A text that is not read.
struct Unread(Option<Finding>);

impl Program for Unread {
    fn findings(&self) -> Vec<Finding> {
        self.0.iter().cloned().collect()
    }
}

/// The bytes of a place that a compiler names.
pub(crate) fn span_of(source: &Source, place: &source::Place) -> Span {
    let line = source.line_span(place.line.min(source.line_count()));
    let text = source.slice(&line);
    let at = |column: usize| {
        let offset = text.char_indices().nth(column - 1).map_or(text.len(), |(offset, _)| offset);
        line.start + offset
    };
    at(place.column)..at(place.end_column)
}

/// What is said and what might help, in one text.
pub(crate) fn with_hint(message: &str, hint: Option<&str>) -> String {
    hint.map_or_else(|| message.to_owned(), |hint| format!("{message} ({hint})"))
}
