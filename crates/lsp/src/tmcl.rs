//! TMCL.

use crate::{
    program::{Finding, Program, Surroundings, span_of, with_hint},
    uri,
};
use ::tmcl::{
    Command,
    asm::{
        Assembly, Environment, Include, MAX_INCLUDE_DEPTH, Severity, assemble,
        syntax::{Statement, parse},
    },
};
use devices::pd42::trial::Module;
use source::{Source, Span};
use std::cell::RefCell;

/// A TMCL program.
pub(crate) struct Tmcl {
    assembly: Assembly,
    /// The program's own statements.
    statements: Vec<Statement>,
    inclusions: Vec<Inclusion>,
    includes: Vec<String>,
}

/// That a file includes another one.
struct Inclusion {
    from: String,
    /// As it is named there.
    name: String,
    to: String,
}

/// The module, and the files around a source.
struct World<'a> {
    module: Module,
    around: &'a Surroundings<'a>,
    inclusions: RefCell<Vec<Inclusion>>,
}

impl Environment for World<'_> {
    fn include(&self, name: &str, from: &str) -> Option<Include> {
        let uri = uri::beside(from, name);
        let Some(text) = self.around.read(&uri) else { return self.module.include(name, from) };
        let inclusion = Inclusion { from: from.to_owned(), name: name.to_owned(), to: uri.clone() };
        self.inclusions.borrow_mut().push(inclusion);
        Some(Include { name: uri, text })
    }

    fn check(&self, command: Command) -> Option<String> {
        self.module.check(command)
    }
}

/// Reads a program and what it includes.
pub(crate) fn read(source: &Source, around: &Surroundings<'_>) -> Tmcl {
    let world = World { module: Module::new(), around, inclusions: RefCell::default() };
    let assembly = assemble(&source.name, source.text.as_bytes(), &world);
    let inclusions = world.inclusions.into_inner();
    let includes = inclusions.iter().map(|inclusion| inclusion.to.clone()).collect();
    Tmcl { assembly, statements: parse(source).0, inclusions, includes }
}

impl Tmcl {
    /// The program's own text.
    fn source(&self) -> &Source {
        &self.assembly.files[0]
    }

    /// Where the program names a file that it was made of, or the file that includes that.
    fn inclusion(&self, file: &str) -> Option<Span> {
        let (mut file, mut name) = (file, "");
        for _ in 0..=MAX_INCLUDE_DEPTH {
            let inclusion = self.inclusions.iter().find(|inclusion| inclusion.to == file)?;
            (file, name) = (&inclusion.from, &inclusion.name);
            if file == self.source().name {
                break;
            }
        }
        self.statements.iter().find_map(|statement| match statement {
            Statement::Include(span) if self.source().slice(span) == name => Some(span.clone()),
            _ => None,
        })
    }
}

impl Program for Tmcl {
    fn findings(&self) -> Vec<Finding> {
        let mut findings: Vec<_> = self
            .assembly
            .diagnostics
            .iter()
            .filter_map(|diagnostic| {
                let place = &diagnostic.place;
                let message = with_hint(&diagnostic.message, diagnostic.hint.as_deref());
                let is_error = diagnostic.severity == Severity::Error;
                let (span, message) = if place.file == self.source().name {
                    (span_of(self.source(), place), message)
                } else {
                    // Another file is not this one's to mark: what is wrong there is wrong with including it.
                    let message = format!("{}, line {}: {message}", uri::name(&place.file), place.line);
                    (self.inclusion(&place.file)?, message)
                };
                Some(Finding { span, is_error, code: None, message })
            })
            .collect();
        findings.sort_by_key(|finding| finding.span.start);
        findings
    }

    fn includes(&self) -> &[String] {
        &self.includes
    }
}
