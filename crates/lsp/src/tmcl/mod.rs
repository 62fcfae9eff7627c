//! TMCL, as its assembler and the tables of its module know it.
//!
//! `line` says what is being typed at a place, `proposals` and `hover` what there is to say about it, `tokens` what
//! the pieces of the text are.

mod hover;
mod line;
mod proposals;
mod tokens;

use crate::{
    program::{
        Finding, Fold, Name, Part, Program, Proposal, Signature, Surroundings, Token, comment_folds, span_of,
        with_hint,
    },
    uri,
};
use ::tmcl::{
    Command,
    asm::{
        self, Assembly, Definition, Environment, INTERRUPTS_FILE, Include, MAX_INCLUDE_DEPTH, Severity,
        assemble,
        syntax::{self, Expression, Node, Statement, parse},
    },
    isa::{self, Role},
};
use devices::pd42::trial::{Module, PARAMETERS_FILE};
use source::{Source, Span};
use std::cell::RefCell;

/// A TMCL program.
pub(crate) struct Tmcl {
    assembly: Assembly,
    /// The program's own statements.
    statements: Vec<Statement>,
    names: Vec<Name>,
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
    let mut names = Vec::new();
    for (file, source) in assembly.files.iter().enumerate() {
        names_in(&assembly, file, &parse(source).0, &mut names);
    }
    Tmcl { statements: parse(source).0, names, assembly, inclusions, includes }
}

/// The names in a file.
fn names_in(assembly: &Assembly, file: usize, statements: &[Statement], names: &mut Vec<Name>) {
    let source = &assembly.files[file];
    let mut add = |span: &Span, defines| {
        names.push(Name { key: source.slice(span).to_owned(), file, span: span.clone(), defines });
    };
    for statement in statements {
        match statement {
            Statement::Label(span) => add(span, true),
            Statement::Constant(span, value) => {
                add(span, true);
                symbols(value, &mut |span| add(span, false));
            }
            Statement::Command(mnemonic, operands) => {
                let instruction = isa::by_mnemonic(source.slice(mnemonic));
                let known = instruction.map_or(&[][..], |instruction| instruction.operands);
                for (index, operand) in operands.iter().enumerate() {
                    let role = known.get(index).map(|operand| operand.role);
                    if keyword(role, source, operand).is_none() {
                        symbols(operand, &mut |span| add(span, false));
                    }
                }
            }
            Statement::Include(_) | Statement::NoStop => (),
        }
    }
}

/// The word that an operand is, if it is one of those that belong there.
fn keyword(role: Option<Role>, source: &Source, operand: &Expression) -> Option<&'static isa::Keyword> {
    let Some(Role::Keyword(words)) = role else { return None };
    let text = source.slice(&operand.span);
    words.iter().find(|word| operand.node == Node::Name && word.name.eq_ignore_ascii_case(text))
}

/// The names in an expression.
fn symbols(expression: &Expression, found: &mut impl FnMut(&Span)) {
    match &expression.node {
        Node::Number(_) => (),
        Node::Name => found(&expression.span),
        Node::Negative(operand) => symbols(operand, found),
        Node::Binary(_, left, right) => {
            symbols(left, found);
            symbols(right, found);
        }
    }
}

impl Tmcl {
    /// The program's own text.
    fn source(&self) -> &Source {
        &self.assembly.files[0]
    }

    /// What a name is defined as.
    fn definition(&self, name: &str) -> Option<&Definition> {
        let definitions = &self.assembly.definitions;
        let at = definitions.binary_search_by(|definition| definition.name.as_str().cmp(name)).ok()?;
        Some(&definitions[at])
    }

    /// Whether a file is one of those that need not be there.
    fn is_built_in(&self, file: usize) -> bool {
        [PARAMETERS_FILE, INTERRUPTS_FILE].contains(&self.assembly.files[file].name.as_str())
    }

    /// The number that an operand is, if that is written or named there.
    fn value(&self, operand: &Expression) -> Option<i64> {
        match operand.node {
            Node::Number(value) => value,
            Node::Name => self.definition(self.source().slice(&operand.span))?.value,
            Node::Negative(_) | Node::Binary(..) => None,
        }
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
        let finding = |diagnostic: &asm::Diagnostic| {
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
        };
        let mut findings: Vec<_> = self.assembly.diagnostics.iter().filter_map(finding).collect();
        findings.sort_by_key(|finding| finding.span.start);
        findings
    }

    fn includes(&self) -> &[String] {
        &self.includes
    }

    fn file(&self, number: usize) -> Option<&Source> {
        self.assembly.files.get(number).filter(|_| number > 0 && !self.is_built_in(number))
    }

    fn tokens(&self) -> Vec<Token> {
        tokens::tokens(self)
    }

    fn names(&self) -> &[Name] {
        &self.names
    }

    fn renamed(&self, name: &Name, to: &str) -> Result<String, String> {
        let Some(definition) = self.definition(&name.key) else {
            return Err(format!("`{}` is not defined", name.key));
        };
        if self.is_built_in(definition.file) {
            return Err(format!("`{}` is a name of the module's", name.key));
        }
        let mut tokens = syntax::tokens(to);
        if !matches!(tokens.next(), Some((syntax::Token::Name, span)) if span == (0..to.len())) {
            return Err("a name has letters, digits and `_`, and begins with none of the digits".into());
        }
        match self.definition(to) {
            Some(_) if to != name.key => Err(format!("`{to}` is already defined")),
            _ => Ok(to.to_owned()),
        }
    }

    fn outline(&self) -> Vec<Part> {
        let source = self.source();
        let mut parts: Vec<Part> = Vec::new();
        for statement in &self.statements {
            let (span, is_code) = match statement {
                Statement::Label(span) => (span, true),
                Statement::Constant(span, _) => (span, false),
                _ => continue,
            };
            let name = source.slice(span).to_owned();
            let value = self.definition(&name).and_then(|definition| definition.value);
            let detail = match (value, is_code) {
                (Some(address), true) => format!("address {address}"),
                (Some(value), false) => format!("= {value}"),
                (None, _) => String::new(),
            };
            let line = source.line_span(source.line(span.start));
            parts.push(Part { name, detail, is_code, span: span.start..line.end, name_span: span.clone() });
        }
        // A routine goes on to the next label.
        let mut end = source.text.trim_end().len();
        for part in parts.iter_mut().rev().filter(|part| part.is_code) {
            part.span.end = end.max(part.span.end);
            end = source.text[..part.span.start].trim_end().len();
        }
        parts
    }

    fn folds(&self) -> Vec<Fold> {
        let source = self.source();
        let is_comment = |line: &usize| source.slice(&source.line_span(*line)).trim_start().starts_with("//");
        let mut folds = comment_folds((1..=source.line_count()).map(|line| (line, is_comment(&line))));
        for part in self.outline().iter().filter(|part| part.is_code) {
            let (first, mut last) = (source.line(part.span.start), source.line(part.span.end));
            // Comments before the next label are about that.
            while last > first && is_comment(&last) {
                last -= 1;
            }
            if first < last {
                folds.push(Fold { first, last, is_comment: false });
            }
        }
        folds
    }

    fn proposals(&self, at: usize) -> (Span, Vec<Proposal>) {
        proposals::proposals(self, at)
    }

    fn hover(&self, at: usize) -> Option<(Span, String)> {
        hover::hover(self, at)
    }

    fn signature(&self, at: usize) -> Option<Signature> {
        hover::signature(self, at)
    }

    fn formatted(&self) -> Option<String> {
        String::from_utf8(asm::format(self.source().text.as_bytes())).ok()
    }
}
