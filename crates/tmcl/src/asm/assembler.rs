//! Statements to commands.

use super::diagnostic::{Diagnostic, Severity};
use super::load::{Loader, Placed};
use super::parser::{Expression, Node, Span, Statement};
use super::symbols::{Definition, Entry, Reason, Symbols, ValueError};
use super::{Assembly, Environment, MAX_MESSAGES, Place, Program, RAW_MNEMONIC, Symbol};
use crate::isa::{self, Command, Field, Operand, PROGRAM_LENGTH, Role, opcode};
use source::Source;
use source::nearest;

/// The operands of [`RAW_MNEMONIC`]: three bytes and a number.
const RAW_OPERANDS: [&str; 4] = ["opcode", "type", "motor", "value"];

pub(super) fn assemble(name: &str, source: &[u8], environment: &dyn Environment) -> Assembly {
    let mut loader = Loader::new(environment);
    loader.load(name.to_owned(), source);
    let Loader { sources, statements, diagnostics, .. } = loader;
    let mut assembler = Assembler {
        environment,
        sources,
        // All that was said is an error.
        failed: !diagnostics.is_empty(),
        diagnostics,
        symbols: Symbols::default(),
        program: Program::default(),
        too_long: false,
    };
    assembler.define(&statements);
    assembler.encode(&statements);
    assembler.finish(&statements)
}

struct Assembler<'a> {
    environment: &'a dyn Environment,
    sources: Vec<Source>,
    diagnostics: Vec<Diagnostic>,
    /// Whether there is an error, reported or beyond the bound.
    failed: bool,
    symbols: Symbols,
    program: Program,
    too_long: bool,
}

impl Assembler<'_> {
    fn report(&mut self, severity: Severity, file: usize, span: Span, message: String, hint: Option<String>) {
        self.failed |= severity == Severity::Error;
        if self.diagnostics.len() == MAX_MESSAGES {
            return;
        }
        let mut diagnostic = Diagnostic::new(severity, &self.sources[file], span, message);
        diagnostic.hint = hint;
        self.diagnostics.push(diagnostic);
    }

    fn place(&self, file: usize, span: &Span) -> Place {
        Place { file, line: self.sources[file].line(span.start) }
    }

    /// Gives all symbols their definitions, and constants their values.
    fn define(&mut self, statements: &[Placed]) {
        let mut address = 0;
        let mut constants = Vec::new();
        for Placed { file, statement } in statements {
            match statement {
                Statement::Label(span) => self.add(*file, span, Definition::Label(address)),
                Statement::Constant(span, value) => {
                    self.add(*file, span, Definition::Pending(value.clone()));
                    constants.push(self.sources[*file].slice(span).to_owned());
                }
                Statement::Command(..) => address += 1,
                Statement::Include(_) | Statement::NoStop => (),
            }
        }
        for name in constants {
            if let Err(error) = self.symbols.define(&self.sources, &name) {
                self.report_value(error);
            }
        }
    }

    fn add(&mut self, file: usize, span: &Span, definition: Definition) {
        let name = self.sources[file].slice(span);
        match self.symbols.entries.get(name) {
            None => {
                let entry = Entry { file, span: span.clone(), definition };
                self.symbols.entries.insert(name.to_owned(), entry);
            }
            Some(earlier) => {
                let place = self.place(earlier.file, &earlier.span);
                let message = format!("`{name}` is already defined");
                let hint = format!("in {}, line {}", self.sources[place.file].name, place.line);
                self.report(Severity::Error, file, span.clone(), message, Some(hint));
            }
        }
    }

    fn report_value(&mut self, error: ValueError) {
        let ValueError::At(file, span, reason) = error else { return };
        let text = self.sources[file].slice(&span);
        let hint = if reason == Reason::Undefined {
            nearest(text, self.symbols.entries.keys().map(String::as_str))
                .map(|symbol| format!("did you mean `{symbol}`?"))
        } else {
            None
        };
        let message = reason.message(text);
        self.report(Severity::Error, file, span, message, hint);
    }

    /// The value of an operand, which must be in a range; reports what is wrong.
    fn value(
        &mut self,
        file: usize,
        expression: &Expression,
        name: &str,
        range: std::ops::RangeInclusive<i64>,
    ) -> Option<i64> {
        match self.symbols.evaluate(&self.sources, file, expression) {
            Ok(value) if range.contains(&value) => Some(value),
            Ok(value) => {
                let message = format!("{name} {value} is out of range");
                let hint = format!("{} to {}", range.start(), range.end());
                self.report(Severity::Error, file, expression.span.clone(), message, Some(hint));
                None
            }
            Err(error) => {
                self.report_value(error);
                None
            }
        }
    }

    fn encode(&mut self, statements: &[Placed]) {
        for Placed { file, statement } in statements {
            let Statement::Command(mnemonic, operands) = statement else { continue };
            if self.program.commands.len() == PROGRAM_LENGTH {
                let message = format!("the program memory has {PROGRAM_LENGTH} commands");
                self.report(Severity::Error, *file, mnemonic.clone(), message, None);
                self.too_long = true;
                break;
            }
            let before = self.diagnostics.len();
            let command = self.command(*file, mnemonic, operands);
            // The place of a wrong command is kept, so that addresses stay those of the labels.
            self.program.commands.push(command.unwrap_or(Command::EMPTY));
            self.program.map.push(self.place(*file, mnemonic));
            if let Some(command) = command
                && self.diagnostics.len() == before
            {
                self.warn(*file, mnemonic, operands, command);
            }
        }
    }

    fn warn(&mut self, file: usize, mnemonic: &Span, operands: &[Expression], command: Command) {
        let customer = (opcode::UF0..=opcode::UF7).contains(&command.opcode);
        let message = if customer {
            Some("this module has no user functions, it passes the command over".to_owned())
        } else {
            self.environment.check(command)
        };
        if let Some(message) = message {
            let end = operands.last().map_or(mnemonic.end, |operand| operand.span.end);
            self.report(Severity::Warning, file, mnemonic.start..end, message, None);
        }
    }

    fn command(&mut self, file: usize, mnemonic: &Span, operands: &[Expression]) -> Option<Command> {
        let name = self.sources[file].slice(mnemonic);
        if name.eq_ignore_ascii_case(RAW_MNEMONIC) {
            return self.raw(file, mnemonic, operands);
        }
        let Some(entry) = isa::by_mnemonic(name) else {
            let known = isa::TABLE.iter().filter_map(|entry| entry.mnemonic).chain([RAW_MNEMONIC]);
            let hint = nearest(name, known).map(|name| format!("did you mean `{name}`?"));
            let message = format!("unknown command `{name}`");
            self.report(Severity::Error, file, mnemonic.clone(), message, hint);
            return None;
        };
        let optional = entry.operands.iter().filter(|operand| operand.optional).count();
        let most = entry.operands.len();
        if !(most - optional..=most).contains(&operands.len()) {
            self.wrong_count(file, mnemonic, operands, entry.form());
            return None;
        }
        let mut command = Some(Command::new(entry.opcode, 0, 0, 0));
        for (operand, expression) in entry.operands.iter().zip(operands) {
            let value = self.operand(file, operand, expression);
            command = command.zip(value).map(|(mut command, value)| {
                match operand.field {
                    Field::Kind => command.kind = value as u8,
                    Field::Motor => command.motor = value as u8,
                    Field::Value => command.value = value as i32,
                }
                command
            });
        }
        command
    }

    fn wrong_count(&mut self, file: usize, mnemonic: &Span, operands: &[Expression], usage: String) {
        let message = match operands.len() {
            0 => "operands are missing".to_owned(),
            1 => "1 operand does not fit".to_owned(),
            count => format!("{count} operands do not fit"),
        };
        let end = operands.last().map_or(mnemonic.end, |operand| operand.span.end);
        let hint = Some(format!("write `{usage}`"));
        self.report(Severity::Error, file, mnemonic.start..end, message, hint);
    }

    fn raw(&mut self, file: usize, mnemonic: &Span, operands: &[Expression]) -> Option<Command> {
        let [opcode, kind, motor, value] = operands else {
            let usage = format!("{RAW_MNEMONIC} {}", RAW_OPERANDS.map(|name| format!("<{name}>")).join(", "));
            self.wrong_count(file, mnemonic, operands, usage);
            return None;
        };
        let byte = 0..=i64::from(u8::MAX);
        let opcode = self.value(file, opcode, RAW_OPERANDS[0], byte.clone());
        let kind = self.value(file, kind, RAW_OPERANDS[1], byte.clone());
        let motor = self.value(file, motor, RAW_OPERANDS[2], byte);
        let value = self.value(file, value, RAW_OPERANDS[3], i64::from(i32::MIN)..=i64::from(u32::MAX));
        Some(Command::new(opcode? as u8, kind? as u8, motor? as u8, value? as i32))
    }

    fn operand(&mut self, file: usize, operand: &Operand, expression: &Expression) -> Option<i64> {
        let Role::Keyword(words) = operand.role else {
            return self.value(file, expression, operand.name(), operand.range());
        };
        let text = self.sources[file].slice(&expression.span);
        if expression.node == Node::Name {
            if let Some(word) = words.iter().find(|word| word.name.eq_ignore_ascii_case(text)) {
                return Some(i64::from(word.number));
            }
            if !self.symbols.entries.contains_key(text) {
                let hint = match nearest(text, words.iter().map(|word| word.name)) {
                    Some(word) => format!("did you mean `{word}`?"),
                    None => format!(
                        "one of {}",
                        words.iter().map(|word| word.name).collect::<Vec<_>>().join(", ")
                    ),
                };
                let message = format!("`{text}` does not belong here");
                self.report(Severity::Error, file, expression.span.clone(), message, Some(hint));
                return None;
            }
        }
        let value = self.value(file, expression, operand.name(), operand.range())?;
        if words.iter().all(|word| i64::from(word.number) != value) {
            let message = format!("there is no {value} here");
            let list: Vec<_> = words.iter().map(|word| format!("{} ({})", word.name, word.number)).collect();
            let hint = Some(format!("one of {}", list.join(", ")));
            self.report(Severity::Error, file, expression.span.clone(), message, hint);
            return None;
        }
        Some(value)
    }

    fn finish(mut self, statements: &[Placed]) -> Assembly {
        let no_stop = statements.iter().any(|placed| placed.statement == Statement::NoStop);
        let stops = self.program.commands.last().is_some_and(|command| command.opcode == opcode::STOP);
        if !stops && !no_stop && !self.too_long {
            let place = self.program.map.last().copied().unwrap_or(Place { file: 0, line: 1 });
            if self.program.commands.len() == PROGRAM_LENGTH {
                let span = self.sources[place.file].line_span(place.line);
                let message = "there is no room for the `STOP` at the end".to_owned();
                let hint = Some("`#nostop` leaves it out".to_owned());
                self.report(Severity::Error, place.file, span, message, hint);
            }
            self.program.commands.push(Command::STOP);
            self.program.map.push(place);
        }
        let mut definitions = Vec::new();
        for (name, Entry { file, span, definition }) in std::mem::take(&mut self.symbols.entries) {
            let (value, label) = match definition {
                Definition::Label(value) => (Some(value), true),
                Definition::Constant(value) => (Some(value), false),
                Definition::Pending(_) | Definition::Open | Definition::Broken => (None, false),
            };
            if let Some(value) = value {
                let place = self.place(file, &span);
                self.program.symbols.push(Symbol { name: name.clone(), value, label, place });
            }
            definitions.push(super::Definition { name, value, label, file, span });
        }
        let order = |diagnostic: &Diagnostic| {
            let file = self.sources.iter().position(|source| source.name == diagnostic.place.file);
            (file, diagnostic.place.line, diagnostic.place.column)
        };
        self.diagnostics.sort_by_key(order);
        Assembly {
            program: (!self.failed).then_some(self.program),
            diagnostics: self.diagnostics,
            files: self.sources,
            definitions,
        }
    }
}
