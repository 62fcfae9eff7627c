//! What may be typed next.

use super::{
    Tmcl,
    hover::{about_instruction, about_parameter, detail},
    line::{Typed, typed},
};
use crate::program::{Proposal, TokenKind};
use ::tmcl::{
    asm::{INTERRUPTS_FILE, RAW_MNEMONIC},
    isa::{GLOBAL_INTERRUPT, INTERRUPTS, Instruction, Role, TABLE, VARIABLE_BANK},
};
use devices::{
    Parameter, Table,
    pd42::{
        axis_parameters,
        trial::{INTERRUPT_BANK, MODULE_BANK, PARAMETERS_FILE, bank},
    },
};
use source::Span;

/// Directives, and what they do.
pub(super) const DIRECTIVES: [(&str, &str); 2] =
    [("#include", "Reads another file here, once."), ("#nostop", "Appends no `STOP` to the program.")];

/// Files that need not be there, and what is in them.
pub(super) const BUILT_IN: [(&str, &str); 2] = [
    (PARAMETERS_FILE, "Symbols of all parameters of the module."),
    (INTERRUPTS_FILE, "Symbols of all interrupts."),
];

/// Banks of global parameters.
pub(super) const BANKS: [(u8, &str); 3] = [
    (MODULE_BANK, "parameters of the module"),
    (VARIABLE_BANK, "user variables"),
    (INTERRUPT_BANK, "interrupts"),
];

/// What may be typed at a place.
pub(super) fn proposals(program: &Tmcl, at: usize) -> (Span, Vec<Proposal>) {
    let (typed, word) = typed(program, at);
    let numeric = program.source().slice(&word).starts_with(|first: char| first.is_ascii_digit());
    let named = |list: &[(&str, &str)], kind| {
        list.iter().map(|(name, text)| Proposal::new(*name, kind, *text)).collect()
    };
    let proposals = match typed {
        Typed::Nothing => Vec::new(),
        Typed::Statement if numeric => Vec::new(),
        Typed::Statement => statements(),
        Typed::Value => constants(program),
        Typed::Directive => named(&DIRECTIVES, TokenKind::Directive),
        Typed::File => named(&BUILT_IN, TokenKind::File),
        Typed::Operand(instruction, index) => match instruction.operands.get(index) {
            Some(operand) => operands(program, operand.role, numeric),
            None => Vec::new(),
        },
    };
    (word, proposals)
}

fn statements() -> Vec<Proposal> {
    let commands = TABLE.iter().filter_map(|entry| {
        let mut proposal = Proposal::new(entry.mnemonic?, TokenKind::Keyword, entry.form());
        proposal.text = about_instruction(entry);
        proposal.snippet = snippet(entry);
        Some(proposal)
    });
    let raw = Proposal::new(RAW_MNEMONIC, TokenKind::Keyword, "a command by its four numbers");
    let directives = DIRECTIVES.map(|(name, text)| Proposal::new(name, TokenKind::Directive, text));
    commands.chain([raw]).chain(directives).collect()
}

/// A command with places for its operands to be filled in.
fn snippet(entry: &Instruction) -> Option<String> {
    let place = |(index, operand): (usize, &::tmcl::isa::Operand)| {
        let number = index + 1;
        match operand.role {
            Role::Keyword(words) => {
                let words: Vec<_> = words.iter().map(|word| word.name).collect();
                format!("${{{number}|{}|}}", words.join(","))
            }
            Role::Motor => format!("${{{number}:0}}"),
            _ => format!("${{{number}:{}}}", operand.name()),
        }
    };
    let needed = entry.operands.iter().filter(|operand| !operand.optional);
    let places: Vec<_> = needed.enumerate().map(place).collect();
    (!places.is_empty()).then(|| format!("{} {}", entry.mnemonic.unwrap_or_default(), places.join(", ")))
}

fn operands(program: &Tmcl, role: Role, numeric: bool) -> Vec<Proposal> {
    let numbered = |list: &[(u8, &str)]| -> Vec<_> {
        list.iter()
            .map(|(number, text)| Proposal::new(number.to_string(), TokenKind::Number, *text))
            .collect()
    };
    let mut proposals = match role {
        Role::Keyword(words) => {
            let option = |word: &::tmcl::isa::Keyword| {
                Proposal::new(word.name, TokenKind::Option, word.number.to_string())
            };
            return words.iter().map(option).collect();
        }
        Role::Address => return labels(program),
        Role::AxisParameter => parameters(program, axis_parameters::TABLE, numeric),
        Role::GlobalParameter => BANKS
            .iter()
            .filter_map(|(number, _)| bank(*number))
            .flat_map(|table| parameters(program, table, numeric))
            .collect(),
        Role::Bank => numbered(&BANKS),
        Role::Motor => numbered(&[(0, "the motor")]),
        Role::Interrupt => interrupts(program, numeric),
        _ => Vec::new(),
    };
    // Those of the module were proposed where they belong.
    proposals.extend(constants(program));
    proposals
}

/// A name for a number, by which it is found and for which the number is inserted where the name is not defined.
fn symbol(
    program: &Tmcl,
    name: &str,
    number: u8,
    kind: TokenKind,
    detail: String,
    numeric: bool,
) -> Proposal {
    let mut proposal = Proposal::new(name, kind, detail);
    if program.definition(name).is_none() || numeric {
        proposal.insert = Some(number.to_string());
    }
    proposal.filter = numeric.then(|| number.to_string());
    proposal
}

fn parameters(program: &Tmcl, table: &'static Table, numeric: bool) -> Vec<Proposal> {
    let proposal = |entry: &'static Parameter| {
        let (number, name) = (entry.number, entry.about.symbol);
        let mut proposal = symbol(program, name, number, TokenKind::Parameter, detail(entry), numeric);
        proposal.text = about_parameter(entry);
        proposal
    };
    table.iter().map(proposal).collect()
}

fn interrupts(program: &Tmcl, numeric: bool) -> Vec<Proposal> {
    let all = INTERRUPTS.iter().map(|interrupt| (interrupt.number, interrupt.symbol, interrupt.event));
    let all = all.chain([(GLOBAL_INTERRUPT, "TI_GLOBAL", "all interrupts")]);
    let proposal = |(number, name, event)| {
        symbol(program, name, number, TokenKind::Constant, format!("{number}: {event}"), numeric)
    };
    all.map(proposal).collect()
}

fn labels(program: &Tmcl) -> Vec<Proposal> {
    let labels = program.assembly.definitions.iter().filter(|definition| definition.label);
    let proposal = |label: &::tmcl::asm::Definition| {
        let address = label.value.map(|value| format!("address {value}")).unwrap_or_default();
        Proposal::new(label.name.clone(), TokenKind::Label, address)
    };
    labels.map(proposal).collect()
}

/// The program's own constants.
fn constants(program: &Tmcl) -> Vec<Proposal> {
    let own = program
        .assembly
        .definitions
        .iter()
        .filter(|definition| !definition.label && !program.is_built_in(definition.file));
    let proposal = |constant: &::tmcl::asm::Definition| {
        let value = constant.value.map(|value| format!("= {value}")).unwrap_or_default();
        Proposal::new(constant.name.clone(), TokenKind::Constant, value)
    };
    own.map(proposal).collect()
}
