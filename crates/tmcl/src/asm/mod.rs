//! The assembler: source text to commands.
//!
//! Every error is found in one go: a wrong line is reported and passed over. Statements are read first
//! (includes in place), then labels get their addresses, then operands their values, so that a symbol may
//! be used before its definition.

mod assembler;
mod diagnostic;
mod fmt;
mod lexer;
mod load;
mod parser;
mod symbols;

/// What a source says before it is known what it means, for editors.
pub mod syntax {
    pub use super::lexer::{Spanned, Token, tokens};
    pub use super::parser::{Expression, Node, Operator, Statement, SyntaxError, parse};
}

pub use diagnostic::{Diagnostic, Severity};
pub use fmt::format;
pub use load::{INTERRUPTS_FILE, MAX_FILES, MAX_INCLUDE_DEPTH};
pub use source::{MAX_SOURCE_BYTES, Source};

use crate::isa::Command;
use source::Span;
use std::fmt::Write;

/// The mnemonic that writes a command's fields as they are: opcode, type, motor, value.
pub const RAW_MNEMONIC: &str = "DATA";

/// Most messages about a source and what it includes.
pub const MAX_MESSAGES: usize = 500;

/// What the assembler has to be told about the world.
pub trait Environment {
    /// The file that a source includes; `from` is the name of that source. [`INTERRUPTS_FILE`] need not be
    /// given.
    fn include(&self, name: &str, from: &str) -> Option<Include>;

    /// What is to be said against a command that the module will refuse, as a parameter out of its range.
    fn check(&self, command: Command) -> Option<String> {
        let _ = command;
        None
    }
}

/// An include file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Include {
    /// A name that no other file has.
    pub name: String,
    /// Its content.
    pub text: Vec<u8>,
}

/// A world without files, for sources that include nothing but [`INTERRUPTS_FILE`].
#[derive(Clone, Copy, Debug, Default)]
pub struct NoFiles;

impl Environment for NoFiles {
    fn include(&self, _: &str, _: &str) -> Option<Include> {
        None
    }
}

/// What comes out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assembly {
    /// The program, unless there are errors.
    pub program: Option<Program>,
    /// Errors and warnings, in the order of files and lines.
    pub diagnostics: Vec<Diagnostic>,
    /// The files that were read; the first is the main one.
    pub files: Vec<Source>,
    /// What is defined in them, by name, even if there are errors.
    pub definitions: Vec<Definition>,
}

/// Where a label or constant is defined.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Definition {
    /// The name.
    pub name: String,
    /// Its value; `None` if what it is defined by is wrong.
    pub value: Option<i64>,
    /// Whether it is the address of a command.
    pub label: bool,
    /// The file, as an index of [`Assembly::files`].
    pub file: usize,
    /// Where the name stands in it.
    pub span: Span,
}

/// A program, and where it comes from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Program {
    /// The commands, from address 0.
    pub commands: Vec<Command>,
    /// For each command, its place in the source. The `STOP` that the assembler appends has that of the
    /// command before it.
    pub map: Vec<Place>,
    /// Labels and constants, by name.
    pub symbols: Vec<Symbol>,
}

/// A place in a source.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// The file, as an index of [`Assembly::files`].
    pub file: usize,
    /// The line, from 1.
    pub line: usize,
}

/// A name for a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// The name.
    pub name: String,
    /// Its value.
    pub value: i64,
    /// Whether it is the address of a command.
    pub label: bool,
    /// Where it is defined.
    pub place: Place,
}

impl Assembly {
    /// All messages, as a compiler prints them; empty if there are none.
    pub fn render(&self, color: bool) -> String {
        let mut text = String::new();
        for diagnostic in &self.diagnostics {
            text.push_str(&diagnostic.render(color));
            text.push('\n');
        }
        text
    }

    /// Whether there are errors, and so no program.
    pub fn has_errors(&self) -> bool {
        self.program.is_none()
    }
}

impl Program {
    /// The addresses of the commands that a line became.
    pub fn addresses(&self, place: Place) -> impl Iterator<Item = usize> {
        self.map.iter().enumerate().filter(move |&(_, &other)| other == place).map(|(address, _)| address)
    }

    /// A listing of labels, by address, and constants, by name: what a host needs to start a routine
    /// (manual 8.6).
    pub fn symbol_file(&self) -> String {
        let mut labels: Vec<&Symbol> = self.symbols.iter().filter(|symbol| symbol.label).collect();
        labels.sort_by_key(|symbol| symbol.value);
        let constants = self.symbols.iter().filter(|symbol| !symbol.label);
        let mut text = String::from("Labels\n");
        for symbol in labels {
            writeln!(text, "{:>5} {}", symbol.value, symbol.name).expect("a string takes everything");
        }
        text.push_str("\nConstants\n");
        for symbol in constants {
            writeln!(text, "{} = {}", symbol.name, symbol.value).expect("a string takes everything");
        }
        text
    }
}

/// Assembles a source and what it includes.
pub fn assemble(name: &str, source: &[u8], environment: &dyn Environment) -> Assembly {
    assembler::assemble(name, source, environment)
}

#[cfg(test)]
mod tests;
