//! Reads the main source and all it includes into one list of statements.

use super::diagnostic::{Diagnostic, Severity};
use super::parser::{self, Statement};
use super::{Environment, Include, MAX_MESSAGES};
use crate::isa::interrupts_include;
use source::nearest;
use source::{MAX_SOURCE_BYTES, Source};

/// How deep include files include others.
pub const MAX_INCLUDE_DEPTH: usize = 16;

/// Most files in a program.
pub const MAX_FILES: usize = 256;

/// The built-in file of interrupt symbols.
pub const INTERRUPTS_FILE: &str = "Interrupts.inc";

/// A statement and the number of its file.
pub(super) struct Placed {
    pub(super) file: usize,
    pub(super) statement: Statement,
}

pub(super) struct Loader<'a> {
    environment: &'a dyn Environment,
    pub(super) sources: Vec<Source>,
    pub(super) statements: Vec<Placed>,
    pub(super) diagnostics: Vec<Diagnostic>,
    /// The files that are being read, outermost first.
    open: Vec<usize>,
}

impl<'a> Loader<'a> {
    pub(super) fn new(environment: &'a dyn Environment) -> Self {
        Self {
            environment,
            sources: Vec::new(),
            statements: Vec::new(),
            diagnostics: Vec::new(),
            open: Vec::new(),
        }
    }

    fn report(&mut self, error: Diagnostic) {
        if self.diagnostics.len() < MAX_MESSAGES {
            self.diagnostics.push(error);
        }
    }

    /// Reads a file and what it includes.
    pub(super) fn load(&mut self, name: String, bytes: &[u8]) {
        let bound = bytes.len().min(MAX_SOURCE_BYTES);
        let source = Source::new(name, &bytes[..bound]);
        let file = self.sources.len();
        if bytes.len() > bound {
            let message = format!("a source file has at most {MAX_SOURCE_BYTES} bytes");
            self.report(Diagnostic::new(Severity::Error, &source, 0..0, message));
        }
        let (statements, errors) = parser::parse(&source);
        for error in errors.into_iter().take(MAX_MESSAGES) {
            self.report(Diagnostic::new(Severity::Error, &source, error.span, error.message));
        }
        self.sources.push(source);
        self.open.push(file);
        for statement in statements {
            match &statement {
                Statement::Include(span) => {
                    if let Err((message, hint)) = self.include(file, span.clone()) {
                        let source = &self.sources[file];
                        let mut error = Diagnostic::new(Severity::Error, source, span.clone(), message);
                        error.hint = hint;
                        self.report(error);
                    }
                }
                _ => self.statements.push(Placed { file, statement }),
            }
        }
        self.open.pop();
    }

    /// Reads an include file where it is included. A file that was read before adds nothing.
    fn include(&mut self, file: usize, span: parser::Span) -> Result<(), (String, Option<String>)> {
        let source = &self.sources[file];
        let name = source.slice(&span);
        let built_in = || {
            let text = interrupts_include().into_bytes();
            name.eq_ignore_ascii_case(INTERRUPTS_FILE).then(|| Include { name: INTERRUPTS_FILE.into(), text })
        };
        let Some(include) = self.environment.include(name, &source.name).or_else(built_in) else {
            let hint = nearest(name, ["TMCLParam.tmc", INTERRUPTS_FILE].into_iter());
            return Err((
                format!("cannot find `{name}`"),
                hint.map(|hint| format!("there is a built-in file `{hint}`")),
            ));
        };
        if let Some(earlier) = self.sources.iter().position(|source| source.name == include.name) {
            if self.open.contains(&earlier) {
                return Err((format!("`{name}` includes itself"), None));
            }
            return Ok(());
        }
        if self.open.len() >= MAX_INCLUDE_DEPTH {
            return Err((format!("files include each other at most {MAX_INCLUDE_DEPTH} deep"), None));
        }
        if self.sources.len() >= MAX_FILES {
            return Err((format!("a program has at most {MAX_FILES} files"), None));
        }
        self.load(include.name, &include.text);
        Ok(())
    }
}
