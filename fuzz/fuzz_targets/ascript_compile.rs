//! Any text is compiled or refused. What compiles is had back from its lines, and the formatter keeps it.
#![no_main]

use ascript::dialect::{COMMANDER, PERFORMAX_2};
use ascript::{Dialect, Line, compile, decompile, format, image};
use libfuzzer_sys::fuzz_target;

fn lines(source: &[u8], dialect: &Dialect) -> Option<Vec<Line>> {
    let compilation = compile("fuzz", source, dialect);
    // They are all made alike, and slowly.
    compilation.diagnostics.iter().take(3).for_each(|diagnostic| drop(diagnostic.render(false)));
    compilation.code.map(|code| code.lines)
}

fuzz_target!(|source: &[u8]| {
    for dialect in [&PERFORMAX_2, &COMMANDER] {
        let Some(compiled) = lines(source, dialect) else {
            assert!(format("fuzz", source, dialect).is_err());
            continue;
        };
        let decompiled = decompile(&compiled, dialect).expect("it was compiled");
        assert_eq!(lines(decompiled.as_bytes(), dialect).as_ref(), Some(&compiled));
        let formatted = format("fuzz", source, dialect).expect("it compiles");
        assert_eq!(lines(formatted.as_bytes(), dialect).as_ref(), Some(&compiled));
        assert_eq!(format("fuzz", formatted.as_bytes(), dialect), Ok(formatted));
        assert_eq!(image::from_file(&image::to_file(&compiled, dialect), dialect), Ok(compiled));
    }
});
