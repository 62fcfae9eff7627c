//! What a language has to say about a text, in bytes of it.

use crate::{Files, ascript, document::Document, tmcl, uri};
use ::ascript::Dialect;
use devices::{Language, Model};
use source::{MAX_SOURCE_BYTES, Source, Span};
use std::collections::BTreeMap;

/// Longest line that is looked at: work and memory grow with the square of it.
const MAX_LINE_BYTES: usize = 4096;

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

/// What a piece of a text is, for its colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum TokenKind {
    Comment,
    /// A command, or a word of the language's own.
    Keyword,
    /// Something that the device does.
    Action,
    /// A label, a subroutine or a program.
    Label,
    /// A name for a number.
    Constant,
    Variable,
    /// A parameter or a register.
    Parameter,
    /// A word that stands for a number in one place.
    Option,
    Number,
    Operator,
    Directive,
    File,
}

/// A piece of a text, within a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Token {
    pub(crate) span: Span,
    pub(crate) kind: TokenKind,
    /// Whether it is defined here.
    pub(crate) defines: bool,
}

/// A place where a name stands: of a label, a constant, a variable, a subroutine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Name {
    /// The same at all places of the same name.
    pub(crate) key: String,
    /// The text that it is in: 0 is the program's own, others are those that [`Program::file`] gives.
    pub(crate) file: usize,
    pub(crate) span: Span,
    /// Whether it is defined here, or gets a value.
    pub(crate) defines: bool,
}

/// A part of a program that has a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Part {
    pub(crate) name: String,
    pub(crate) detail: String,
    /// Whether it is executed; a constant is not.
    pub(crate) is_code: bool,
    /// All of it.
    pub(crate) span: Span,
    /// Its name.
    pub(crate) name_span: Span,
}

/// Lines that can be folded away behind the first of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Fold {
    /// From 1.
    pub(crate) first: usize,
    pub(crate) last: usize,
    pub(crate) is_comment: bool,
}

/// Something that may be typed next.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Proposal {
    pub(crate) label: String,
    pub(crate) kind: TokenKind,
    /// One line beside the label.
    pub(crate) detail: String,
    /// More of it, as Markdown.
    pub(crate) text: String,
    /// What is inserted, if it is not the label.
    pub(crate) insert: Option<String>,
    /// The same with places to fill in, for editors that can.
    pub(crate) snippet: Option<String>,
    /// What it is found by, if that is not the label.
    pub(crate) filter: Option<String>,
}

impl Proposal {
    pub(crate) fn new(label: impl Into<String>, kind: TokenKind, detail: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            kind,
            detail: detail.into(),
            text: String::new(),
            insert: None,
            snippet: None,
            filter: None,
        }
    }
}

/// How a command is written, while it is typed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Signature {
    pub(crate) form: String,
    /// Bytes of the form that are its parameters, and what there is to say about them.
    pub(crate) parameters: Vec<(Span, String)>,
    /// The one that is being typed.
    pub(crate) active: usize,
    pub(crate) text: String,
}

/// A text that is understood as far as it is right.
pub(crate) trait Program: Send {
    /// Errors and warnings, in the order of the text.
    fn findings(&self) -> Vec<Finding>;

    /// URIs of the files that it was made of besides its own.
    fn includes(&self) -> &[String] {
        &[]
    }

    /// A file that names stand in; `None` for the program's own, and for one that is no file.
    fn file(&self, _number: usize) -> Option<&Source> {
        None
    }

    /// The pieces of the text, in its order.
    fn tokens(&self) -> Vec<Token>;

    /// All names, in the order of files and places.
    fn names(&self) -> &[Name];

    /// What a name becomes that is to be called so.
    ///
    /// # Errors
    /// Why it cannot be called so.
    fn renamed(&self, name: &Name, to: &str) -> Result<String, String>;

    /// Its parts, in the order of the text.
    fn outline(&self) -> Vec<Part>;

    /// What can be folded, in any order.
    fn folds(&self) -> Vec<Fold>;

    /// What may be typed at a place, and the bytes before it that are its beginning.
    fn proposals(&self, at: usize) -> (Span, Vec<Proposal>);

    /// What there is to say about a place, as Markdown, and the place.
    fn hover(&self, at: usize) -> Option<(Span, String)>;

    /// How the command is written that is being typed.
    fn signature(&self, at: usize) -> Option<Signature>;

    /// The text in its usual layout; `None` if it has to be right first.
    fn formatted(&self) -> Option<String>;
}

/// Which name stands at a place of the program's own text. Behind its last character is still there.
pub(crate) fn name_at(names: &[Name], at: usize) -> Option<&Name> {
    names.iter().find(|name| name.file == 0 && name.span.start <= at && at <= name.span.end)
}

/// Comments of their own that stand below each other.
pub(crate) fn comment_folds(lines: impl Iterator<Item = (usize, bool)>) -> Vec<Fold> {
    let mut folds: Vec<Fold> = Vec::new();
    for (line, _) in lines.filter(|(_, is_comment)| *is_comment) {
        match folds.last_mut() {
            Some(fold) if fold.last + 1 == line => fold.last = line,
            _ => folds.push(Fold { first: line, last: line, is_comment: true }),
        }
    }
    folds.retain(|fold| fold.first < fold.last);
    folds
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
    let refused = |at: usize, message| {
        Box::new(Unread(Some(Finding { span: at..at, is_error: true, code: None, message })))
    };
    let Some(tongue) = tongue else { return Box::new(Unread(None)) };
    if source.text.len() > MAX_SOURCE_BYTES {
        return refused(0, format!("a source file has at most {MAX_SOURCE_BYTES} bytes"));
    }
    let mut lines = (1..=source.line_count()).map(|line| source.line_span(line));
    if let Some(long) = lines.find(|line| line.len() > MAX_LINE_BYTES) {
        return refused(long.start, format!("a line has at most {MAX_LINE_BYTES} bytes here"));
    }
    match tongue {
        Tongue::Tmcl => Box::new(tmcl::read(source, around)),
        Tongue::Ascript(dialect) => Box::new(ascript::read(source, dialect)),
    }
}

/// A text that is not read.
struct Unread(Option<Finding>);

impl Program for Unread {
    fn findings(&self) -> Vec<Finding> {
        self.0.iter().cloned().collect()
    }

    fn tokens(&self) -> Vec<Token> {
        Vec::new()
    }

    fn names(&self) -> &[Name] {
        &[]
    }

    fn renamed(&self, _: &Name, _: &str) -> Result<String, String> {
        Err("nothing here has a name".into())
    }

    fn outline(&self) -> Vec<Part> {
        Vec::new()
    }

    fn folds(&self) -> Vec<Fold> {
        Vec::new()
    }

    fn proposals(&self, at: usize) -> (Span, Vec<Proposal>) {
        (at..at, Vec::new())
    }

    fn hover(&self, _: usize) -> Option<(Span, String)> {
        None
    }

    fn signature(&self, _: usize) -> Option<Signature> {
        None
    }

    fn formatted(&self) -> Option<String> {
        None
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
