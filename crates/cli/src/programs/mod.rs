//! Program files of all languages: `pulsetrain check` and `fmt`, and what `run` loads.

mod ascript;
mod tmcl;
mod world;

pub use ascript::{compile_file, decompile_file};
pub use tmcl::{asm, disasm};

use crate::{
    FAILED, Failure, Outcome,
    args::{CheckArgs, FmtArgs},
};
use debugger::Code;
use devices::{Language, Model};
use sim::{Program, fault::Place};
use std::{
    fs::File,
    io::{IsTerminal, Read, Write, stderr, stdin, stdout},
    path::Path,
};

/// Largest program file that is read; far above what a controller holds.
const MAX_FILE_BYTES: u64 = 4 << 20;

/// The file that stands for standard input and output.
const STANDARD: &str = "-";

/// What a program file is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    TmclSource,
    TmclCode,
    AscriptSource,
    AscriptCode,
}

/// The extensions of program files.
const EXTENSIONS: [(&str, Kind); 5] = [
    ("tmc", Kind::TmclSource),
    ("bin", Kind::TmclCode),
    ("prg", Kind::AscriptSource),
    ("txt", Kind::AscriptSource),
    ("bin", Kind::AscriptCode),
];

impl Kind {
    /// What the extension of a file says; a model has programs of its own language only.
    fn of(path: &Path, model: Option<&Model>) -> Result<Self, Failure> {
        let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
        let fits = |kind: Self| model.is_none_or(|model| kind.is_for(model));
        let mut known = EXTENSIONS.iter().filter(|(known, _)| extension.eq_ignore_ascii_case(known));
        known.find(|(_, kind)| fits(*kind)).map(|(_, kind)| *kind).ok_or_else(|| {
            let programs = model.map_or("a program".into(), |model| format!("a program of a {}", model.name));
            Failure::Line(format!("{}: {programs} is a {} file", path.display(), names(fits)))
        })
    }

    /// The sources of a model.
    const fn source_of(model: &Model) -> Self {
        match model.language {
            Language::Tmcl => Self::TmclSource,
            Language::Ascript(_) => Self::AscriptSource,
        }
    }

    const fn is_for(self, model: &Model) -> bool {
        match self {
            Self::TmclSource | Self::TmclCode => matches!(model.language, Language::Tmcl),
            Self::AscriptSource | Self::AscriptCode => matches!(model.language, Language::Ascript(_)),
        }
    }
}

/// The extensions of some kinds, as `.a, .b or .c`.
fn names(of: impl Fn(Kind) -> bool) -> String {
    let mut names = Vec::new();
    for (name, _) in EXTENSIONS.iter().filter(|(_, kind)| of(*kind)) {
        let name = format!(".{name}");
        if !names.contains(&name) {
            names.push(name);
        }
    }
    match names.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => names.concat(),
    }
}

/// A program as its controller holds it.
pub struct Loaded {
    /// The program.
    pub program: Program,
    /// Where each of its commands or lines comes from, as `file:line`; nothing is known of machine code.
    pub places: Vec<String>,
    /// Names in the source, with their commands or lines.
    pub labels: Vec<(String, u32)>,
}

impl Loaded {
    /// The command or compiled line at a place in the source, which is this file.
    pub fn find(&self, file: &Path, place: &Place<'_>) -> Result<u32, String> {
        let found = match place {
            Place::Line(line) => {
                let place = format!("{}:{line}", file.display());
                self.places.iter().position(|other| *other == place).map(|address| address as u32)
            }
            Place::Label(label) => {
                let mut labels = self.labels.iter();
                labels.find(|(name, _)| name.eq_ignore_ascii_case(label)).map(|(_, address)| *address)
            }
        };
        found.ok_or_else(|| not_there(file, place))
    }
}

/// The same in a program for the debugger.
pub fn address(code: &Code, file: &Path, place: &Place<'_>) -> Result<u32, String> {
    code.address(place).map(u32::from).ok_or_else(|| not_there(file, place))
}

fn not_there(file: &Path, place: &Place<'_>) -> String {
    match place {
        Place::Line(line) => format!("line: nothing of line {line} of {} is executed", file.display()),
        Place::Label(label) => format!("label: there is no `{label}` in {}", file.display()),
    }
}

/// Looks for mistakes without writing anything.
pub fn check(args: &CheckArgs) -> Outcome {
    let (path, model) = (&args.file, args.device);
    match Kind::of(path, Some(model))? {
        Kind::TmclSource => tmcl::check_source(path),
        Kind::TmclCode => tmcl::check_code(path),
        Kind::AscriptSource => ascript::check_source(path, ascript::dialect(model)?),
        Kind::AscriptCode => ascript::check_code(path, ascript::dialect(model)?),
    }
}

/// Reads a program; a source is translated.
pub fn load(path: &Path, model: &Model) -> Result<Loaded, Failure> {
    match Kind::of(path, Some(model))? {
        Kind::TmclSource => tmcl::load_source(path),
        Kind::TmclCode => tmcl::load_code(path),
        Kind::AscriptSource => ascript::load_source(path, ascript::dialect(model)?),
        Kind::AscriptCode => ascript::load_code(path, ascript::dialect(model)?),
    }
}

/// Reads a program for the debugger. Machine code gets a source. Gives it, if it is right, and what there is to
/// say about it.
pub fn translate(path: &Path, model: &Model) -> Result<(Option<Code>, String), Failure> {
    match Kind::of(path, Some(model))? {
        Kind::TmclSource => tmcl::translate(&path.display().to_string(), &read(path)?),
        Kind::TmclCode => tmcl::translate_code(path),
        Kind::AscriptSource => {
            ascript::translate(&path.display().to_string(), &read(path)?, ascript::dialect(model)?)
        }
        Kind::AscriptCode => ascript::translate_code(path, ascript::dialect(model)?),
    }
}

/// What a source that was made of machine code is called.
fn name_of_code(path: &Path) -> String {
    format!("{} as source", path.display())
}

/// Lays sources out anew, one after the other, whatever becomes of the one before.
pub fn fmt(args: &FmtArgs) -> Outcome {
    let mut outcome = Ok(());
    for path in &args.files {
        if let Err(failure) = lay_out(path, args) {
            if let Failure::Line(line) = failure {
                eprintln!("error: {line}");
            }
            outcome = Err(Failure::Told(FAILED));
        }
    }
    outcome
}

fn lay_out(path: &Path, args: &FmtArgs) -> Outcome {
    let is_standard = path.as_os_str() == STANDARD;
    let (kind, source) = if is_standard {
        let model =
            args.device.ok_or_else(|| Failure::Line("-: say whose program it is, with --device".into()))?;
        (Kind::source_of(model), read_all(stdin(), path)?)
    } else {
        (Kind::of(path, args.device)?, read(path)?)
    };
    let formatted = match kind {
        Kind::TmclSource => ::tmcl::asm::format(&source),
        Kind::AscriptSource => ascript::format(path, &source, args.device)?,
        Kind::TmclCode | Kind::AscriptCode => {
            return Err(Failure::Line(format!("{}: machine code has no layout", path.display())));
        }
    };
    match (args.check, is_standard) {
        (true, _) if formatted == source => Ok(()),
        (true, _) => Err(Failure::Line(format!("{}: the formatter would change it", path.display()))),
        (false, true) => print(&formatted),
        (false, false) if formatted == source => Ok(()),
        (false, false) => write(path, &formatted),
    }
}

fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    read_all(File::open(path).map_err(|error| about(path, &error))?, path)
}

fn read_all(from: impl Read, path: &Path) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    from.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes).map_err(|error| about(path, &error))?;
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

/// Shows diagnostics, in colour on a terminal.
fn say(render: impl FnOnce(bool) -> String) {
    // Whoever closed standard error does not want to know.
    let _ = stderr().write_all(render(stderr().is_terminal()).as_bytes());
}

/// Prints; a reader that has seen enough, as `head`, is no error.
pub fn show(text: &str) -> Outcome {
    print(text.as_bytes())
}

fn print(bytes: &[u8]) -> Outcome {
    match stdout().write_all(bytes) {
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        result => Ok(result?),
    }
}
