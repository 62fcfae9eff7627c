//! Program files: `pulsetrain asm`, `disasm` and `check`, and what `run` loads.

use crate::{
    FAILED, Failure, Outcome,
    args::{AsmArgs, CheckArgs, DisasmArgs},
    module::Module,
};
use std::{
    fmt::Write as _,
    fs::File,
    io::{IsTerminal, Read, Write, stderr, stdout},
    path::Path,
};
use tmcl::{
    Command,
    asm::{Assembly, Environment, Program, assemble},
    disasm, image,
};

/// Largest program file that is read; far above what a module holds.
const MAX_FILE_BYTES: u64 = 4 << 20;

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

/// Looks for mistakes without writing anything.
pub fn check(args: &CheckArgs) -> Outcome {
    if is_source(&args.file)? {
        let assembly = assembled(&args.file)?;
        return if assembly.has_errors() { Err(Failure::Told(FAILED)) } else { Ok(()) };
    }
    let module = Module::new();
    for (address, command) in commands(&args.file)?.into_iter().enumerate() {
        if let Some(problem) = module.check(command) {
            let text = disasm::command(command);
            eprintln!("warning: {}: command {address}, {text}: {problem}", args.file.display());
        }
    }
    Ok(())
}

/// The machine code of a program file; a source is assembled.
pub fn load(path: &Path) -> Result<Vec<u8>, Failure> {
    if !is_source(path)? {
        return Ok(image::to_bytes(&commands(path)?));
    }
    match assembled(path)?.program {
        Some(program) => Ok(image::to_bytes(&program.commands)),
        None => Err(Failure::Told(FAILED)),
    }
}

fn is_source(path: &Path) -> Result<bool, Failure> {
    match path.extension().and_then(|extension| extension.to_str()) {
        Some(extension) if extension.eq_ignore_ascii_case("tmc") => Ok(true),
        Some(extension) if extension.eq_ignore_ascii_case("bin") => Ok(false),
        _ => Err(Failure::Line(format!("{}: a program is a .tmc or a .bin file", path.display()))),
    }
}

/// Assembles a file and shows what there is to say about it.
fn assembled(path: &Path) -> Result<Assembly, Failure> {
    let assembly = assemble(&path.display().to_string(), &read(path)?, &Module::new());
    // Whoever closed standard error does not want to know.
    let _ = stderr().write_all(assembly.render(stderr().is_terminal()).as_bytes());
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

fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|file| file.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes));
    read.map_err(|error| about(path, &error))?;
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(Failure::Line(format!(
            "{}: a program has at most {MAX_FILE_BYTES} bytes",
            path.display()
        )));
    }
    Ok(bytes)
}

fn write(path: &Path, bytes: &[u8]) -> Outcome {
    std::fs::write(path, bytes).map_err(|error| about(path, &error))
}

fn about(path: &Path, error: &dyn std::error::Error) -> Failure {
    Failure::Line(format!("{}: {error}", path.display()))
}

/// Prints; a reader that has seen enough, as `head`, is no error.
pub fn show(text: &str) -> Outcome {
    match stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        result => Ok(result?),
    }
}
