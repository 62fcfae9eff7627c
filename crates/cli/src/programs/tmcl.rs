//! TMCL programs: `pulsetrain asm` and `disasm`, and what `check`, `run` and `fmt` do with them.

use super::{Loaded, about, read, say, show, world::World, write};
use crate::{
    FAILED, Failure, Outcome,
    args::{AsmArgs, DisasmArgs},
};
use debugger::Code;
use std::{fmt::Write as _, path::Path};
use tmcl::{
    Command,
    asm::{Assembly, Environment, Place, Program, Symbol, assemble},
    disasm, image,
};

/// Assembles a source and writes what was asked for.
pub fn asm(args: &AsmArgs) -> Outcome {
    let assembly = assembled(&args.input)?;
    let Some(program) = &assembly.program else { return Err(Failure::Told(FAILED)) };
    if let Some(path) = &args.output {
        write(path, &image::to_bytes(&program.commands))?;
    }
    if let Some(path) = &args.symbols {
        write(path, program.symbol_file().as_bytes())?;
    }
    if args.list { show(&listing(&assembly, program)) } else { Ok(()) }
}

/// Prints machine code as a source that assembles back to it.
pub fn disasm(args: &DisasmArgs) -> Outcome {
    show(&disasm::disassemble(&commands(&args.input)?))
}

/// Looks for mistakes in a source without writing anything.
pub fn check_source(path: &Path) -> Outcome {
    if assembled(path)?.has_errors() { Err(Failure::Told(FAILED)) } else { Ok(()) }
}

/// Looks for commands that a module will refuse.
pub fn check_code(path: &Path) -> Outcome {
    let module = World::default();
    for (address, command) in commands(path)?.into_iter().enumerate() {
        if let Some(problem) = module.check(command) {
            let text = disasm::command(command);
            eprintln!("warning: {}: command {address}, {text}: {problem}", path.display());
        }
    }
    Ok(())
}

/// What a source assembles to.
pub fn load_source(path: &Path) -> Result<Loaded, Failure> {
    let assembly = assembled(path)?;
    let program = assembly.program.ok_or(Failure::Told(FAILED))?;
    let place = |place: &Place| format!("{}:{}", assembly.files[place.file].name, place.line);
    let places = program.map.iter().map(place).collect();
    let label = |symbol: Symbol| Some((symbol.name, u32::try_from(symbol.value).ok()?));
    let labels = program.symbols.into_iter().filter_map(label).collect();
    Ok(Loaded { program: sim::Program::Tmcl(program.commands), places, labels })
}

/// Machine code whose checksums are right.
pub fn load_code(path: &Path) -> Result<Loaded, Failure> {
    Ok(Loaded { program: sim::Program::Tmcl(commands(path)?), places: Vec::new(), labels: Vec::new() })
}

/// A source for the debugger, and what there is to say about it.
pub fn translate(name: &str, source: &[u8]) -> Result<(Option<Code>, String), Failure> {
    let assembly = assemble(name, source, &World::default());
    let said = assembly.render(false);
    Ok((Code::tmcl(assembly), said))
}

/// Machine code for the debugger.
pub fn translate_code(path: &Path) -> Result<(Option<Code>, String), Failure> {
    translate(&super::name_of_code(path), disasm::disassemble(&commands(path)?).as_bytes())
}

/// Assembles a file and shows what there is to say about it.
fn assembled(path: &Path) -> Result<Assembly, Failure> {
    let assembly = assemble(&path.display().to_string(), &read(path)?, &World::default());
    say(|color| assembly.render(color));
    Ok(assembly)
}

fn commands(path: &Path) -> Result<Vec<Command>, Failure> {
    image::from_bytes(&read(path)?).map_err(|error| about(path, &error))
}

/// Each command with its address, its record, and the line that it comes from.
fn listing(assembly: &Assembly, program: &Program) -> String {
    let mut text = String::new();
    let records = image::to_bytes(&program.commands);
    for (address, ((command, place), record)) in
        program.commands.iter().zip(&program.map).zip(records.chunks(image::RECORD_LENGTH)).enumerate()
    {
        let bytes: Vec<_> = record.iter().map(|byte| format!("{byte:02X}")).collect();
        let (source, line) = (&assembly.files[place.file].name, place.line);
        let command = disasm::command(*command);
        writeln!(text, "{address:>4}  {}  {command:<24} // {source}:{line}", bytes.join(" "))
            .expect("a string takes everything");
    }
    text
}
