//! What there is to say about a place.

use super::{
    Tmcl, keyword,
    line::{Typed, typed},
    proposals::{BANKS, BUILT_IN, DIRECTIVES},
};
use crate::program::{Signature, name_at};
use ::tmcl::{
    Command,
    asm::syntax::{Expression, Statement},
    isa::{self, Field, GLOBAL_INTERRUPT, INTERRUPTS, Instruction, Role},
};
use devices::{
    Parameter,
    pd42::{
        axis_parameters,
        trial::{bank, parameter},
    },
};
use source::Span;
use std::fmt::Write;

/// What there is to say about a place.
pub(super) fn hover(program: &Tmcl, at: usize) -> Option<(Span, String)> {
    let here = |span: &Span| span.start <= at && at <= span.end;
    for statement in &program.statements {
        match statement {
            Statement::Command(mnemonic, _) if here(mnemonic) => {
                let instruction = isa::by_mnemonic(program.source().slice(mnemonic))?;
                return Some((mnemonic.clone(), about_instruction(instruction)));
            }
            Statement::Command(mnemonic, operands) => {
                let Some(index) = operands.iter().position(|operand| here(&operand.span)) else { continue };
                return operand(program, mnemonic, operands, index).or_else(|| name(program, at));
            }
            Statement::Include(span) if here(span) => {
                let file = program.source().slice(span);
                let (_, text) = BUILT_IN.iter().find(|(name, _)| name.eq_ignore_ascii_case(file))?;
                return Some((span.clone(), (*text).into()));
            }
            _ => (),
        }
    }
    name(program, at).or_else(|| directive(program, at))
}

/// What there is to say about a command.
pub(super) fn about_instruction(entry: &Instruction) -> String {
    let doc = &entry.doc;
    format!(
        "```tmcl\n{}\n```\n{}\n\nExample: `{}`. Manual {}.",
        entry.form(),
        doc.summary,
        doc.example,
        doc.section
    )
}

/// A parameter in a line.
pub(super) fn detail(entry: &Parameter) -> String {
    format!("{}: {}", entry.number, entry.about.name)
}

/// What there is to say about a parameter.
pub(super) fn about_parameter(entry: &Parameter) -> String {
    let Parameter { number, low, high, access, default, about } = entry;
    let mut text =
        format!("**{}** (parameter {number}, `{}`)\n\n{}\n\n", about.name, about.symbol, about.text);
    let unit = if about.unit.is_empty() { String::new() } else { format!(" {}", about.unit) };
    let range = if low <= high { format!("{low} to {high}{unit}") } else { format!("32 bits{unit}") };
    write!(text, "{range}, {default} from the factory, {}.", access.letters())
        .expect("a string takes everything");
    text
}

/// What an operand means at its place.
fn operand(program: &Tmcl, mnemonic: &Span, operands: &[Expression], index: usize) -> Option<(Span, String)> {
    let source = program.source();
    let instruction = isa::by_mnemonic(source.slice(mnemonic))?;
    let (known, expression) = (instruction.operands.get(index)?, &operands[index]);
    if let Some(word) = keyword(Some(known.role), source, expression) {
        return Some((expression.span.clone(), format!("`{}` is {} here.", word.name, word.number)));
    }
    let value = u8::try_from(program.value(expression)?).ok()?;
    let text = match known.role {
        Role::AxisParameter | Role::GlobalParameter => {
            let field = |field| {
                let at = instruction.operands.iter().position(|operand| operand.field == field)?;
                u8::try_from(program.value(operands.get(at)?)?).ok()
            };
            let motor = field(Field::Motor).unwrap_or_default();
            about_parameter(parameter(Command::new(instruction.opcode, value, motor, 0))?)
        }
        Role::Bank => BANKS
            .iter()
            .find(|(number, _)| *number == value)
            .map(|(_, text)| format!("Bank {value}: {text}."))?,
        Role::Interrupt if value == GLOBAL_INTERRUPT => "All interrupts.".into(),
        Role::Interrupt => {
            let interrupt = INTERRUPTS.iter().find(|interrupt| interrupt.number == value)?;
            format!("Interrupt {value}, `{}`: {}.", interrupt.symbol, interrupt.event)
        }
        _ => return None,
    };
    Some((expression.span.clone(), text))
}

/// What a name stands for.
fn name(program: &Tmcl, at: usize) -> Option<(Span, String)> {
    let name = name_at(&program.names, at)?;
    let definition = program.definition(&name.key)?;
    let text = match (definition.value, definition.label) {
        _ if program.is_built_in(definition.file) => {
            let tables = BANKS.iter().filter_map(|(number, _)| bank(*number)).chain([axis_parameters::TABLE]);
            let mut entries = tables.flat_map(|table| table.iter());
            match (entries.find(|entry| entry.about.symbol == name.key), definition.value) {
                (Some(entry), _) => about_parameter(entry),
                (None, value) => format!("`{} = {}`", name.key, value.unwrap_or_default()),
            }
        }
        (Some(address), true) => format!("Label `{}`, address {address}.", name.key),
        (Some(value), false) => format!("`{} = {value}`", name.key),
        (None, _) => format!("`{}` has no value.", name.key),
    };
    Some((name.span.clone(), text))
}

fn directive(program: &Tmcl, at: usize) -> Option<(Span, String)> {
    let source = program.source();
    let line = source.line_span(source.line(at));
    let text = source.slice(&line);
    let start = line.start + text.len() - text.trim_start().len();
    let word = text.trim_start().split([' ', '\t', '"', '<']).next()?;
    let (_, about) = DIRECTIVES.iter().find(|(name, _)| name.eq_ignore_ascii_case(word))?;
    let span = start..start + word.len();
    (span.start <= at && at <= span.end).then(|| (span, (*about).into()))
}

/// How the command is written that is being typed.
pub(super) fn signature(program: &Tmcl, at: usize) -> Option<Signature> {
    let (Typed::Operand(instruction, active), _) = typed(program, at) else { return None };
    let form = instruction.form();
    let mut parameters = Vec::new();
    let mut from = instruction.mnemonic?.len();
    for operand in instruction.operands {
        let text = operand.form();
        let start = from + form[from..].find(&text)?;
        from = start + text.len();
        let range = operand.range();
        let about = match operand.role {
            Role::Keyword(_) => String::new(),
            _ => format!("{} to {}", range.start(), range.end()),
        };
        parameters.push((start..from, about));
    }
    Some(Signature { form, parameters, active, text: instruction.doc.summary.into() })
}
