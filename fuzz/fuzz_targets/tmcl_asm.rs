//! Any bytes as a source, with any bytes as its include file: no panic, every message has a place, and a
//! program that comes out survives the disassembler and the formatter.
#![no_main]

use libfuzzer_sys::fuzz_target;
use tmcl::asm::{Environment, Include, NoFiles, assemble, format};
use tmcl::disasm;

struct OneFile<'a>(&'a [u8]);

impl Environment for OneFile<'_> {
    fn include(&self, name: &str, _: &str) -> Option<Include> {
        Some(Include { name: name.to_owned(), text: self.0.to_vec() })
    }
}

fuzz_target!(|sources: (&[u8], &[u8])| {
    let (source, include) = sources;
    let assembly = assemble("fuzz.tmc", source, &OneFile(include));
    for diagnostic in &assembly.diagnostics {
        assert!(
            diagnostic.place.line > 0
                && diagnostic.place.column > 0
                && diagnostic.place.end_column >= diagnostic.place.column
        );
    }
    assembly.render(false);
    let formatted = format(source);
    // Without its odd white space, text in Latin-1 may happen to be UTF-8.
    let is_utf8 = std::str::from_utf8(source).is_ok();
    assert!(!is_utf8 || format(&formatted) == formatted);
    if let Some(program) = assembly.program {
        assert_eq!(program.commands.len(), program.map.len());
        let again = assemble("fuzz.tmc", &formatted, &OneFile(include));
        assert!(!is_utf8 || again.program.as_ref() == Some(&program));
        let again = assemble("again.tmc", disasm::disassemble(&program.commands).as_bytes(), &NoFiles);
        assert_eq!(again.program.map(|again| again.commands), Some(program.commands));
    }
});
