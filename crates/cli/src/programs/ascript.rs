//! A-SCRIPT programs: `pulsetrain compile` and `decompile`, and what `check`, `run` and `fmt` do with them.

use super::{Loaded, about, read, say, show, write};
use crate::{
    FAILED, Failure, Outcome,
    args::{CompileArgs, DecompileArgs},
};
use ascript::{
    Dialect, Line,
    compiler::{Code, compile},
    decompile, image,
};
use devices::{Language, MODELS, Model};
use sim::Program;
use source::Source;
use std::{fmt::Write as _, path::Path};

/// Compiles a source and writes what was asked for.
pub fn compile_file(args: &CompileArgs) -> Outcome {
    let dialect = dialect(args.device)?;
    let code = compiled(&args.input, dialect)?;
    if let Some(path) = &args.output {
        write(path, &image::to_file(&code.lines, dialect))?;
    }
    if args.list { show(&listing(&args.input, &code)) } else { Ok(()) }
}

/// Prints compiled lines as a source that compiles to them again.
pub fn decompile_file(args: &DecompileArgs) -> Outcome {
    let dialect = dialect(args.device)?;
    let lines = lines(&args.input, dialect)?;
    show(&decompile(&lines, dialect).map_err(|error| about(&args.input, &error))?)
}

/// Looks for mistakes in a source without writing anything.
pub fn check_source(path: &Path, dialect: &Dialect) -> Outcome {
    compiled(path, dialect).map(drop)
}

/// Looks whether compiled lines are a program.
pub fn check_code(path: &Path, dialect: &Dialect) -> Outcome {
    decompile(&lines(path, dialect)?, dialect).map(drop).map_err(|error| about(path, &error))
}

/// What a source compiles to.
pub fn load_source(path: &Path, dialect: &Dialect) -> Result<Loaded, Failure> {
    let Code { lines, map } = compiled(path, dialect)?;
    let places = map.into_iter().map(|line| format!("{}:{line}", path.display())).collect();
    let named = (0..).zip(&lines).filter(|(_, line)| matches!(line, Line::Program(_) | Line::Subroutine(_)));
    let labels = named.map(|(number, line)| (line.to_string(), number)).collect();
    Ok(Loaded { program: Program::Ascript(lines), places, labels })
}

/// A file of compiled lines.
pub fn load_code(path: &Path, dialect: &Dialect) -> Result<Loaded, Failure> {
    Ok(Loaded { program: Program::Ascript(lines(path, dialect)?), places: Vec::new(), labels: Vec::new() })
}

/// A source in the usual layout. Where nobody said which controller it is for, any dialect will do in which
/// it is right.
pub fn format(path: &Path, source: &[u8], model: Option<&Model>) -> Result<Vec<u8>, Failure> {
    let name = path.display().to_string();
    let dialects: Vec<_> = match model {
        Some(model) => vec![dialect(model)?],
        None => MODELS.iter().filter_map(|model| dialect(model).ok()).collect(),
    };
    let mut wrong = Vec::new();
    for dialect in dialects {
        match ascript::format(&name, source, dialect) {
            Ok(text) => return Ok(text.into_bytes()),
            Err(diagnostics) => wrong = diagnostics,
        }
    }
    say(|color| wrong.iter().map(|diagnostic| diagnostic.render(color) + "\n").collect());
    Err(Failure::Told(FAILED))
}

/// The dialect of a model's programs.
pub fn dialect(model: &Model) -> Result<&'static Dialect, Failure> {
    match model.language {
        Language::Ascript(dialect) => Ok(dialect),
        Language::Tmcl => Err(Failure::Line(format!("a {} has no A-SCRIPT programs", model.name))),
    }
}

/// A source for the debugger, and what there is to say about it.
pub fn translate(
    name: &str,
    text: &[u8],
    dialect: &Dialect,
) -> Result<(Option<debugger::Code>, String), Failure> {
    let compilation = compile(name, text, dialect);
    let said = compilation.render(false);
    let source = Source::new(name, text);
    Ok((compilation.code.map(|code| debugger::Code::ascript(source, code)), said))
}

/// Compiled lines for the debugger.
pub fn translate_code(path: &Path, dialect: &Dialect) -> Result<(Option<debugger::Code>, String), Failure> {
    let text = decompile(&lines(path, dialect)?, dialect).map_err(|error| about(path, &error))?;
    translate(&super::name_of_code(path), text.as_bytes(), dialect)
}

/// Compiles a file and shows what there is to say about it.
fn compiled(path: &Path, dialect: &Dialect) -> Result<Code, Failure> {
    let compilation = compile(&path.display().to_string(), &read(path)?, dialect);
    say(|color| compilation.render(color));
    compilation.code.ok_or(Failure::Told(FAILED))
}

fn lines(path: &Path, dialect: &Dialect) -> Result<Vec<Line>, Failure> {
    image::from_file(&read(path)?, dialect).map_err(|error| about(path, &error))
}

/// Each compiled line with its number, and the line of the source that it comes from.
fn listing(path: &Path, code: &Code) -> String {
    let mut text = String::new();
    for (number, (line, source)) in code.lines.iter().zip(&code.map).enumerate() {
        let line = line.to_string();
        writeln!(text, "{number:>4}  {line:<32} ; {}:{source}", path.display())
            .expect("a string takes everything");
    }
    text
}
