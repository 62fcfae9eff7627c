//! What the assembler has to know of the world: the module that a program is for, and the files beside the source.

use devices::pd42::trial::Module;
use std::{fs, io::Read, path::Path};
use tmcl::{
    Command,
    asm::{Environment, Include, MAX_SOURCE_BYTES},
};

/// The module and the files beside the source.
#[derive(Default)]
pub struct World {
    module: Module,
}

impl Environment for World {
    fn include(&self, name: &str, from: &str) -> Option<Include> {
        let path = Path::new(from).parent().unwrap_or(Path::new("")).join(name);
        let limit = MAX_SOURCE_BYTES as u64 + 1;
        let mut text = Vec::new();
        let read = fs::File::open(&path).and_then(|file| file.take(limit).read_to_end(&mut text));
        if read.is_ok() {
            return Some(Include { name: path.display().to_string(), text });
        }
        self.module.include(name, from)
    }

    fn check(&self, command: Command) -> Option<String> {
        self.module.check(command)
    }
}
