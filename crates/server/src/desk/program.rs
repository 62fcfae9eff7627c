//! Programs of a controller: compiling, up and down, running.

use super::parameters::values;
use crate::http::{Answer, Body, Place, Shared, at, json};
use ascript::compiler;
use axum::{Json, extract::State, http::StatusCode};
use devices::{Language, Model, guide::VARIABLES, pd42::trial};
use host::{Code, ProgramAction, Value};
use serde::{Deserialize, Serialize};
use source::Level;
use std::{collections::BTreeMap, fmt::Write};
use tmcl::asm;
use ts_rs::TS;
use utoipa::ToSchema;

/// The name of a source that has none, for messages.
const NAME: &str = "program";

/// A program as people write it.
#[derive(Serialize, Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SourceText {
    /// It.
    source: String,
}

/// What a source was compiled to.
#[derive(Debug, Default, Serialize, TS, ToSchema)]
pub(crate) struct Compiled {
    /// Whether there is a program.
    ok: bool,
    /// How many lines or commands it has in the controller.
    size: usize,
    /// Addresses, and the lines of the source that they come from.
    lines: Vec<(usize, usize)>,
    /// What it was compiled to, for people.
    listing: String,
    /// Its names and their values, one a line.
    symbols: String,
    /// What there is to say about the source.
    diagnostics: Vec<Diagnostic>,
}

/// A message about a source.
#[derive(Debug, Serialize, TS, ToSchema)]
pub(crate) struct Diagnostic {
    /// Line, from 1.
    line: usize,
    /// Column, from 1.
    column: usize,
    /// What is the matter.
    message: String,
    /// Whether there is no program because of it.
    is_error: bool,
}

/// Compile a program
#[utoipa::path(
    post, path = "/api/devices/{device}/program/compile", tag = "programs",
    request_body = SourceText, responses((status = 200, body = Compiled))
)]
pub(crate) async fn compile(State(site): Shared, place: Place<String>, body: Body) -> Answer<Json<Compiled>> {
    let seat = site.desk.find(&at(place)?)?;
    let SourceText { source } = json(body)?;
    Ok(Json(translate(seat.model, &source).0))
}

/// Compile a program, and replace what is in the controller if it is right
#[utoipa::path(
    put, path = "/api/devices/{device}/program", tag = "programs",
    request_body = SourceText, responses((status = 200, body = Compiled))
)]
pub(crate) async fn download(
    State(site): Shared,
    place: Place<String>,
    body: Body,
) -> Answer<Json<Compiled>> {
    let seat = site.desk.find(&at(place)?)?;
    let SourceText { source } = json(body)?;
    let (compiled, code) = translate(seat.model, &source);
    if let Some(code) = code {
        seat.ask(async |it| it.download(&code).await).await?;
    }
    Ok(Json(compiled))
}

/// The program that is in the controller, decompiled
#[utoipa::path(get, path = "/api/devices/{device}/program", tag = "programs", responses((status = 200, body = SourceText)))]
pub(crate) async fn upload(State(site): Shared, place: Place<String>) -> Answer<Json<SourceText>> {
    let seat = site.desk.find(&at(place)?)?;
    let code = seat.ask(async |it| it.upload().await).await?;
    let source = code.source().map_err(|why| {
        let message = format!("what is in the controller is no program: {why}");
        crate::http::Failure::new(StatusCode::CONFLICT, message)
    })?;
    Ok(Json(SourceText { source }))
}

/// Run, stop, pause or step a program
#[utoipa::path(
    post, path = "/api/devices/{device}/programs/{program}", tag = "programs",
    request_body = ProgramAction, responses((status = 204))
)]
pub(crate) async fn control(
    State(site): Shared,
    place: Place<(String, u8)>,
    body: Body,
) -> Answer<StatusCode> {
    let (name, number) = at(place)?;
    let seat = site.desk.find(&name)?;
    let action: ProgramAction = json(body)?;
    seat.ask(async |it| it.program(number, action).await).await?;
    Ok(StatusCode::NO_CONTENT)
}

/// The variables of programs
#[utoipa::path(
    get, path = "/api/devices/{device}/variables", tag = "programs",
    responses((status = 200, body = BTreeMap<String, Value>))
)]
pub(crate) async fn variables(
    State(site): Shared,
    place: Place<String>,
) -> Answer<Json<BTreeMap<String, Value>>> {
    let seat = site.desk.find(&at(place)?)?;
    let settings = (seat.model.guide.settings)();
    let variables = settings.iter().filter(|it| it.group == VARIABLES);
    let values = seat.ask(async |it| values(it, variables).await).await?;
    Ok(Json(values))
}

/// What a source is for a model, and the program if there is one.
fn translate(model: &Model, source: &str) -> (Compiled, Option<Code>) {
    match model.language {
        Language::Tmcl => assemble(source),
        Language::Ascript(dialect) => {
            let compilation = compiler::compile(NAME, source.as_bytes(), dialect);
            let diagnostics = compilation.diagnostics.iter();
            let diagnostics = diagnostics
                .map(|it| Diagnostic::new(&it.place, it.kind().is_some(), it.message.clone()))
                .collect();
            let Some(compiler::Code { lines, map }) = compilation.code else {
                return (Compiled { diagnostics, ..Compiled::default() }, None);
            };
            let mut compiled = Compiled::new(diagnostics, map.iter().copied());
            for (address, line) in lines.iter().enumerate() {
                let text = line.to_string();
                writeln!(compiled.listing, "{address:>4}  {text}").expect("a string takes everything");
                if matches!(line, ascript::Line::Program(_) | ascript::Line::Subroutine(_)) {
                    writeln!(compiled.symbols, "{text} {address}").expect("a string takes everything");
                }
            }
            (compiled, Some(Code::Ascript(dialect, lines)))
        }
    }
}

fn assemble(source: &str) -> (Compiled, Option<Code>) {
    let assembly = asm::assemble(NAME, source.as_bytes(), &trial::Module::new());
    let diagnostics = assembly.diagnostics.iter();
    let diagnostics = diagnostics
        .map(|it| Diagnostic::new(&it.place, it.severity == Level::Error, it.message.clone()))
        .collect();
    let Some(program) = assembly.program else {
        return (Compiled { diagnostics, ..Compiled::default() }, None);
    };
    // What comes from a built-in file has no line here, and is no command either.
    let mut compiled = Compiled::new(diagnostics, program.map.iter().map(|place| place.line));
    compiled.symbols = program.symbol_file();
    for (address, command) in program.commands.iter().enumerate() {
        let text = tmcl::disasm::command(*command);
        writeln!(compiled.listing, "{address:>4}  {text}").expect("a string takes everything");
    }
    (compiled, Some(Code::Tmcl(program.commands)))
}

impl Compiled {
    /// A program whose commands come from these lines.
    fn new(diagnostics: Vec<Diagnostic>, map: impl Iterator<Item = usize>) -> Self {
        let lines: Vec<_> = map.enumerate().collect();
        Self { ok: true, size: lines.len(), lines, diagnostics, ..Self::default() }
    }
}

impl Diagnostic {
    fn new(place: &source::Place, is_error: bool, message: String) -> Self {
        Self { line: place.line, column: place.column, message, is_error }
    }
}
