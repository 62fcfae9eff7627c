//! The programs of `examples/`.

use devices::{Language, Model};
use sim::Program;
use std::{
    fs,
    path::{Path, PathBuf},
};
use tmcl::asm::{Environment, Include};

/// The programs of a model, with the names of their files, in the order of these.
pub fn of_model(model: &Model) -> Vec<(String, Program)> {
    let folder = match model.name {
        "pd42-1140" => "tmcl",
        "pmx-2ed" => "ascript/performax",
        _ => "ascript/commander",
    };
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../examples").join(folder);
    let files = fs::read_dir(&folder).expect("there are examples");
    let mut paths: Vec<_> = files.map(|entry| entry.expect("the folder is readable").path()).collect();
    paths.sort();
    let named = |path: PathBuf| {
        let name = path.file_name()?.to_string_lossy().into_owned();
        program(model, &path).map(|program| (name, program))
    };
    paths.into_iter().filter_map(named).collect()
}

/// The program in a file; none if it includes files that are for the command line to find.
fn program(model: &Model, path: &Path) -> Option<Program> {
    let (name, source) = (path.display().to_string(), fs::read(path).expect("the example is readable"));
    match model.language {
        Language::Tmcl => {
            let assembly = tmcl::asm::assemble(&name, &source, &Nothing);
            assembly.program.map(|program| Program::Tmcl(program.commands))
        }
        Language::Ascript(dialect) => {
            let code = ascript::compile(&name, &source, dialect).code.expect(&name);
            Some(Program::Ascript(code.lines))
        }
    }
}

/// No files beside the source.
struct Nothing;

impl Environment for Nothing {
    fn include(&self, _: &str, _: &str) -> Option<Include> {
        None
    }
}
