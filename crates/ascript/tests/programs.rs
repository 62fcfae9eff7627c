//! Programs: those of the manuals in `examples/ascript`, and made-up ones.

use ascript::dialect::{COMMANDER, PERFORMAX_2};
use ascript::line::TEXT_LENGTH;
use ascript::reference::{self, Choices};
use ascript::{Dialect, Line, compile, decompile, format, image};
use proptest::prelude::*;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/ascript");

/// The examples for a dialect, with their file names.
fn examples(folder: &str) -> Vec<(String, String)> {
    let files = std::fs::read_dir(format!("{FOLDER}/{folder}")).expect("the folder is there");
    let mut examples: Vec<(String, String)> = files
        .map(|file| {
            let path = file.expect("a file").path();
            (path.display().to_string(), std::fs::read_to_string(&path).expect("text"))
        })
        .collect();
    examples.sort();
    examples
}

fn lines(name: &str, source: &str, dialect: &Dialect) -> Vec<Line> {
    let compilation = compile(name, source.as_bytes(), dialect);
    compilation.code.as_ref().unwrap_or_else(|| panic!("{}", compilation.render(false))).lines.clone()
}

/// What holds for every program that compiles.
fn check(name: &str, source: &str, dialect: &Dialect) {
    let compiled = lines(name, source, dialect);
    for line in &compiled {
        let text = line.to_string();
        assert!(text.len() <= TEXT_LENGTH && text.is_ascii(), "{text}");
        assert_eq!(Line::parse(&text, dialect), Some(*line), "{text}");
        assert_eq!(Line::from_bytes(&line.to_bytes(), dialect), Some(*line), "{text}");
    }

    let decompiled = decompile(&compiled, dialect).expect("it was compiled");
    assert_eq!(lines(name, &decompiled, dialect), compiled, "{decompiled}");
    // The decompiler writes as the formatter does.
    assert_eq!(format(name, decompiled.as_bytes(), dialect), Ok(decompiled));

    let formatted = format(name, source.as_bytes(), dialect).expect("it compiles");
    assert_eq!(lines(name, &formatted, dialect), compiled, "{formatted}");
    assert_eq!(format(name, formatted.as_bytes(), dialect).as_ref(), Ok(&formatted));

    let file = image::to_file(&compiled, dialect);
    assert_eq!(image::from_file(&file, dialect), Ok(compiled));
}

#[test]
fn examples_of_the_manuals() {
    for (folder, dialect, count) in [("performax", &PERFORMAX_2, 8), ("commander", &COMMANDER, 10)] {
        let examples = examples(folder);
        assert_eq!(examples.len(), count, "{folder}");
        for (name, source) in &examples {
            check(name, source, dialect);
            reference::compare(source, dialect);
            let layout = format(name, source.as_bytes(), dialect);
            assert_eq!(layout.as_ref(), Ok(source), "{name} is not in its layout");
            assert_eq!(compile(name, source.as_bytes(), dialect).diagnostics, [], "{name}");
        }
    }
}

/// Spaces and comments where they can be.
fn spread(source: &str, choices: &[u8]) -> String {
    let mut spread = String::new();
    let choices = choices.iter().chain(&[0]).cycle();
    for (line, choice) in source.lines().zip(choices) {
        let space = ["", " ", "\t", "  "][usize::from(choice % 4)];
        // Spaces may stand wherever a number, a word or an operator begins.
        let mut last = 'A';
        spread.push_str(space);
        for character in line.chars() {
            let class = |c: char| (c.is_alphabetic(), c.is_ascii_digit(), "<>=!".contains(c));
            let glued = class(last) == class(character) && (last.is_alphanumeric() || "<>=!".contains(last));
            if !glued && !last.is_whitespace() {
                spread.push_str(space);
            }
            spread.push(character);
            last = character;
        }
        if choice % 3 == 0 {
            spread.push_str(" ; comment  ");
        }
        spread.push_str(if choice % 5 == 0 { "\r\n\r\n  ; more\r\n" } else { "\n" });
    }
    spread
}

fn dialects() -> impl Strategy<Value = &'static Dialect> {
    prop_oneof![Just(&PERFORMAX_2), Just(&COMMANDER)]
}

proptest! {
    #[test]
    fn machine_and_interpreter_agree(dialect in dialects(), choices in prop::collection::vec(any::<u8>(), 0..2000)) {
        reference::compare(&reference::program(&mut Choices::new(&choices), dialect), dialect);
    }

    #[test]
    fn there_and_back(dialect in dialects(), choices in prop::collection::vec(any::<u8>(), 0..500)) {
        let source = reference::program(&mut Choices::new(&choices), dialect);
        check("made up", &source, dialect);
        let spread = spread(&source, &choices);
        assert_eq!(lines("spread", &spread, dialect), lines("made up", &source, dialect));
        check("spread", &spread, dialect);
    }

    #[test]
    fn any_text_is_compiled_or_refused(dialect in dialects(), text in "[A-Z0-9=+~:;<> \n-]{0,60}|\\PC{0,60}") {
        let compilation = compile("any", text.as_bytes(), dialect);
        compilation.render(false);
        if !compilation.has_errors() {
            check("any", &text, dialect);
        }
    }
}
