//! Program files of all languages: `pulsetrain check` and `fmt`, and what `run` loads.

mod module;
mod tmcl;

pub use tmcl::{asm, disasm};

use crate::{
    FAILED, Failure, Outcome,
    args::{CheckArgs, FmtArgs},
};
use devices::{Language, Model};
use sim::Program;
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
}

/// The extensions of program files.
const EXTENSIONS: [(&str, Kind); 2] = [("tmc", Kind::TmclSource), ("bin", Kind::TmclCode)];

impl Kind {
    /// What the extension of a file says; a model has programs of its own language only.
    fn of(path: &Path, model: Option<&Model>) -> Result<Self, Failure> {
        let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
        let found = EXTENSIONS.iter().find(|(known, _)| extension.eq_ignore_ascii_case(known));
        let fits = |kind: Self| model.is_none_or(|model| kind.is_for(model));
        found.map(|(_, kind)| *kind).filter(|kind| fits(*kind)).ok_or_else(|| {
            let programs = model.map_or("a program".into(), |model| format!("a program of a {}", model.name));
            Failure::Line(format!("{}: {programs} is a {} file", path.display(), names(fits)))
        })
    }

    /// The sources of a model.
    fn source_of(model: &Model) -> Result<Self, Failure> {
        match model.language {
            Language::Tmcl => Ok(Self::TmclSource),
            Language::Ascript(_) => {
                Err(Failure::Line(format!("-: sources of a {} have no layout", model.name)))
            }
        }
    }

    fn is_for(self, model: &Model) -> bool {
        matches!((self, model.language), (Self::TmclSource | Self::TmclCode, Language::Tmcl))
    }
}

/// The extensions of some kinds, as `.a, .b or .c`.
fn names(of: impl Fn(Kind) -> bool) -> String {
    let names: Vec<_> =
        EXTENSIONS.iter().filter(|(_, kind)| of(*kind)).map(|(name, _)| format!(".{name}")).collect();
    match names.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => names.concat(),
    }
}

/// Looks for mistakes without writing anything.
pub fn check(args: &CheckArgs) -> Outcome {
    match Kind::of(&args.file, Some(args.device))? {
        Kind::TmclSource => tmcl::check_source(&args.file),
        Kind::TmclCode => tmcl::check_code(&args.file),
    }
}

/// A program as its controller holds it; a source is translated.
pub fn load(path: &Path, model: &Model) -> Result<Program, Failure> {
    match Kind::of(path, Some(model))? {
        Kind::TmclSource => tmcl::load_source(path).map(Program::Tmcl),
        Kind::TmclCode => tmcl::commands(path).map(Program::Tmcl),
    }
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
        (Kind::source_of(model)?, read_all(stdin(), path)?)
    } else {
        (Kind::of(path, args.device)?, read(path)?)
    };
    let formatted = match kind {
        Kind::TmclSource => ::tmcl::asm::format(&source),
        Kind::TmclCode => {
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
