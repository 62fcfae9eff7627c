use super::*;
use crate::isa::{PROGRAM_LENGTH, TABLE};
use proptest::prelude::*;

/// A world of a few files, which frowns on `SAP 5, 0, 10000`.
struct World;

impl Environment for World {
    fn include(&self, name: &str, _: &str) -> Option<Include> {
        let text: &[u8] = match name {
            "numbers.inc" => b"One = 1\nTwo = One + One\n",
            "outer.inc" => b"#include numbers.inc\nThree = Two + One\nROL 0, Three\n",
            "self.inc" => b"#include self.inc\n",
            "a.inc" => b"#include b.inc\n",
            "b.inc" => b"#include a.inc\n",
            "wrong.inc" => b"\n  Bad = 1 +\n",
            "latin.inc" => b"Gr\xF6\xDFe = 7 // gro\xDF\n",
            _ => {
                // deep0.inc includes deep1.inc, and so on without end.
                let level: u32 = name.strip_prefix("deep")?.strip_suffix(".inc")?.parse().ok()?;
                let text = format!("#include deep{}.inc\n", level + 1).into_bytes();
                return Some(Include { name: name.into(), text });
            }
        };
        Some(Include { name: name.into(), text: text.to_vec() })
    }

    fn check(&self, command: Command) -> Option<String> {
        (command == Command::new(5, 5, 0, 10000)).then(|| "parameter 5 takes 0 to 2047".into())
    }
}

/// The commands of a source, without the last `STOP`.
fn commands(source: &str) -> Vec<Command> {
    let assembly = assemble("test.tmc", source.as_bytes(), &World);
    let mut program = assembly.program.clone().unwrap_or_else(|| panic!("{}", assembly.render(false)));
    assert_eq!(program.commands.pop(), Some(Command::STOP));
    program.commands
}

/// Everything that is said about a source.
fn messages(source: &[u8]) -> Vec<String> {
    assemble("test.tmc", source, &World).diagnostics.iter().map(ToString::to_string).collect()
}

fn check_errors(source: &str, expected: &[&str]) {
    assert_eq!(messages(source.as_bytes()), expected, "{source}");
    assert!(assemble("test.tmc", source.as_bytes(), &World).has_errors());
}

#[test]
fn the_examples_of_the_table_assemble() {
    for entry in TABLE.iter().filter(|entry| entry.mnemonic.is_some() && entry.opcode != 28) {
        let found = commands(entry.doc.example);
        assert_eq!(found.len(), 1, "{entry:?}");
        assert_eq!(found[0].opcode, entry.opcode, "{entry:?}");
        assert_eq!(crate::disasm::command(found[0]), entry.doc.example);
    }
}

#[test]
fn numbers_and_expressions() {
    let check = |expression: &str, expected: i32| {
        assert_eq!(
            commands(&format!("COMP {expression}")),
            [Command::new(20, 0, 0, expected)],
            "{expression}"
        );
    };
    check("1000", 1000);
    check("$1F", 31);
    check("0x1F", 31);
    check("0XfF", 255);
    check("%101", 5);
    check("0b101", 5);
    check("-5000", -5000);
    check("2 + 3 * 4", 14);
    check("(2 + 3) * 4", 20);
    check("20 - 3 - 4", 13);
    check("20 / 3 / 2", 3);
    check("-7 / 2", -3);
    check("-(2 + 3)", -5);
    check("2 * -3", -6);
    check("--3", 3);
    check("+3", 3);
    check("((((7))))", 7);
    check("-2147483648", i32::MIN);
    check("$FFFFFFFF", -1);
    check("4294967295", -1);
    check("4294967296 / 2 - 1", i32::MAX);
}

#[test]
fn statements() {
    let check = |source: &str, expected: &[(u8, u8, u8, i32)]| {
        let expected: Vec<_> = expected.iter().map(|&(a, b, c, d)| Command::new(a, b, c, d)).collect();
        assert_eq!(commands(source), expected, "{source}");
    };
    check("", &[]);
    check("Loop: JA Loop", &[(22, 0, 0, 0)]);
    check("A: B:\nC: mvp abs, 0, C // go", &[(4, 0, 0, 0)]);
    check("JA End\nMST 0\nEnd:", &[(22, 0, 0, 2), (3, 0, 0, 0)]);
    check("X = Y * 2\nY = 21\nCOMP X", &[(20, 0, 0, 42)]);
    check(
        "Size = End - Start\nStart: MST 0\nMST 0\nEnd: COMP Size",
        &[(3, 0, 0, 0), (3, 0, 0, 0), (20, 0, 0, 2)],
    );
    check("x = 1\nX = 2\nCOMP x\nCOMP X", &[(20, 0, 0, 1), (20, 0, 0, 2)]);
    check("COMP 1\r\nCOMP 2\rCOMP 3\nCOMP 4", &[(20, 0, 0, 1), (20, 0, 0, 2), (20, 0, 0, 3), (20, 0, 0, 4)]);
    check("\u{FEFF}MST 0", &[(3, 0, 0, 0)]);
    check("Größe = 5\nCOMP Größe", &[(20, 0, 0, 5)]);
    check("DATA 129, 1, 0, -1", &[(129, 1, 0, -1)]);
    check("JC 12, 0\nJC esd, 0\nE = 12\nJC E, 0", &[(21, 12, 0, 0); 3]);
    check("STAP 6, 0\nRSAP 6, 0", &[(7, 6, 0, 0), (8, 6, 0, 0)]);
    check("SCO 0, 255, 0\nGCO 0, 255, 0\nGCO 7, 255", &[(30, 0, 255, 0), (31, 0, 255, 0), (31, 7, 255, 0)]);
    check("MST:\nJA MST", &[(22, 0, 0, 0)]);
}

#[test]
fn includes() {
    let check = |source: &str, values: &[i32]| {
        let found: Vec<_> = commands(source).iter().map(|command| command.value).collect();
        assert_eq!(found, values, "{source}");
    };
    check("#include numbers.inc\nCOMP Two", &[2]);
    check("#INCLUDE \"numbers.inc\" // twice is once\n#include <numbers.inc>\nCOMP Two", &[2]);
    check("COMP 9\n#include outer.inc\nCOMP Three", &[9, 3, 3]);
    check("#include latin.inc\nCOMP Größe", &[7]);
    check("# include interrupts.inc\nCOMP TI_GLOBAL\nCOMP TI_INPUT3", &[255, 42]);
}

#[test]
fn latin_1_sources() {
    let assembly = assemble("test.tmc", b"Gr\xF6\xDFe = 5\nCOMP Gr\xF6\xDFe\n", &NoFiles);
    assert_eq!(assembly.program.expect("no errors").commands[0].value, 5);
}

#[test]
fn stop_is_appended_once() {
    let length = |source: &str| {
        assemble("test.tmc", source.as_bytes(), &NoFiles).program.expect("no errors").commands.len()
    };
    assert_eq!(length(""), 1);
    assert_eq!(length("MST 0"), 2);
    assert_eq!(length("MST 0\nSTOP"), 2);
    assert_eq!(length("#nostop\nMST 0"), 1);
    assert_eq!(length(&"STOP\n".repeat(PROGRAM_LENGTH)), PROGRAM_LENGTH);
}

#[test]
fn errors_of_syntax() {
    check_errors(
        "MVP ABS, 0,",
        &["test.tmc:1:12: error: expected a number or a name, found the end of the line"],
    );
    check_errors("COMP 1 2", &["test.tmc:1:8: error: expected the end of the line, found `2`"]);
    check_errors("COMP (1 + 2", &["test.tmc:1:12: error: expected `)`, found the end of the line"]);
    check_errors("  = 5", &["test.tmc:1:3: error: expected a label, a name or a command, found `=`"]);
    check_errors("A = 5 ?", &["test.tmc:1:7: error: expected the end of the line, found `?`"]);
    check_errors("Größe = ?", &["test.tmc:1:9: error: expected a number or a name, found `?`"]);
    check_errors(
        "#pragma x // y",
        &["test.tmc:1:1: error: unknown directive; there are `#include` and `#nostop`"],
    );
    check_errors("#include", &["test.tmc:1:1: error: `#include` needs the name of a file"]);
}

#[test]
fn errors_of_commands() {
    check_errors("MPV ABS, 0, 5", &["test.tmc:1:1: error: unknown command `MPV` (did you mean `MVP`?)"]);
    check_errors("UNAIT POS, 0, 0", &["test.tmc:1:1: error: unknown command `UNAIT` (did you mean `WAIT`?)"]);
    check_errors("FROBNICATE", &["test.tmc:1:1: error: unknown command `FROBNICATE`"]);
    check_errors(
        "MVP",
        &["test.tmc:1:1: error: operands are missing (write `MVP <ABS|REL|COORD>, <motor>, <position>`)"],
    );
    check_errors("STOP 1", &["test.tmc:1:1: error: 1 operand does not fit (write `STOP`)"]);
    check_errors(
        "GCO 1, 0, 0, 0",
        &["test.tmc:1:1: error: 4 operands do not fit (write `GCO <coordinate>, <motor>, [<value>]`)"],
    );
    check_errors(
        "DATA 1",
        &["test.tmc:1:1: error: 1 operand does not fit (write `DATA <opcode>, <type>, <motor>, <value>`)"],
    );
    check_errors("MVP AB, 0, 1", &["test.tmc:1:5: error: `AB` does not belong here (did you mean `ABS`?)"]);
    check_errors(
        "MVP FAR, 0, 1",
        &["test.tmc:1:5: error: `FAR` does not belong here (one of ABS, REL, COORD)"],
    );
    check_errors(
        "MVP 3, 0, 1",
        &["test.tmc:1:5: error: there is no 3 here (one of ABS (0), REL (1), COORD (2))"],
    );
    check_errors(
        "CALCV SWAP, 1, 2",
        &[
            "test.tmc:1:7: error: `SWAP` does not belong here (one of ADD, SUB, MUL, DIV, MOD, AND, OR, XOR, NOT, LOAD, COMP)",
        ],
    );
}

#[test]
fn errors_of_range() {
    check_errors("SAP 256, 0, 0", &["test.tmc:1:5: error: parameter 256 is out of range (0 to 255)"]);
    check_errors("SAP -1, 0, 0", &["test.tmc:1:5: error: parameter -1 is out of range (0 to 255)"]);
    check_errors("MST 1 + 255", &["test.tmc:1:5: error: motor 256 is out of range (0 to 255)"]);
    check_errors("SCO 21, 0, 0", &["test.tmc:1:5: error: coordinate 21 is out of range (0 to 20)"]);
    check_errors("CALCVV ADD, 0, 256", &["test.tmc:1:16: error: variable 256 is out of range (0 to 255)"]);
    check_errors("JA 2048", &["test.tmc:1:4: error: label 2048 is out of range (0 to 2047)"]);
    check_errors(
        "COMP 4294967296",
        &["test.tmc:1:6: error: value 4294967296 is out of range (-2147483648 to 4294967295)"],
    );
    check_errors("DATA 256, 0, 0, 0", &["test.tmc:1:6: error: opcode 256 is out of range (0 to 255)"]);
}

#[test]
fn errors_of_symbols() {
    check_errors("Loop: JA Lop", &["test.tmc:1:10: error: `Lop` is not defined (did you mean `Loop`?)"]);
    check_errors("Loop: JA loop", &["test.tmc:1:10: error: `loop` is not defined (did you mean `Loop`?)"]);
    check_errors("A = 1\nA:", &["test.tmc:2:1: error: `A` is already defined (in test.tmc, line 1)"]);
    check_errors("A = B\nB = A", &["test.tmc:2:5: error: `A` is defined by means of itself"]);
    check_errors("A = X\nCOMP A\nCOMP A", &["test.tmc:1:5: error: `X` is not defined"]);
}

#[test]
fn errors_of_values() {
    let huge = "9223372036854775807";
    check_errors(
        "COMP 99999999999999999999",
        &["test.tmc:1:6: error: the value of `99999999999999999999` does not fit 64 bits"],
    );
    check_errors(
        &format!("COMP {huge} + 1"),
        &[&format!("test.tmc:1:6: error: the value of `{huge} + 1` does not fit 64 bits")],
    );
    check_errors(
        &format!("COMP -(-{huge} - 1)"),
        &[&format!("test.tmc:1:6: error: the value of `-(-{huge} - 1)` does not fit 64 bits")],
    );
    check_errors(
        &format!("COMP (-{huge} - 1) / -1"),
        &[&format!("test.tmc:1:6: error: the value of `(-{huge} - 1) / -1` does not fit 64 bits")],
    );
    check_errors("COMP 5 / (3 - 3)", &["test.tmc:1:6: error: `5 / (3 - 3)` divides by zero"]);
}

#[test]
fn errors_of_includes() {
    check_errors("#include gone.inc", &["test.tmc:1:10: error: cannot find `gone.inc`"]);
    check_errors(
        "#include TMCLParm.tmc",
        &["test.tmc:1:10: error: cannot find `TMCLParm.tmc` (there is a built-in file `TMCLParam.tmc`)"],
    );
    check_errors("#include self.inc", &["self.inc:1:10: error: `self.inc` includes itself"]);
    check_errors("#include a.inc", &["b.inc:1:10: error: `a.inc` includes itself"]);
    check_errors("#include deep0.inc", &["deep14.inc:1:10: error: files include each other at most 16 deep"]);
    check_errors(
        "MST\n#include wrong.inc\nMST",
        &[
            "test.tmc:1:1: error: operands are missing (write `MST <motor>`)",
            "test.tmc:3:1: error: operands are missing (write `MST <motor>`)",
            "wrong.inc:2:12: error: expected a number or a name, found the end of the line",
        ],
    );
}

#[test]
fn all_errors_at_once() {
    check_errors(
        "MVP ABS, 0,\nLoop:\nFOO\nJA Lop\nSAP 256, 300, X\nJA Loop",
        &[
            "test.tmc:1:12: error: expected a number or a name, found the end of the line",
            "test.tmc:3:1: error: unknown command `FOO`",
            "test.tmc:4:4: error: `Lop` is not defined (did you mean `Loop`?)",
            "test.tmc:5:5: error: parameter 256 is out of range (0 to 255)",
            "test.tmc:5:10: error: motor 300 is out of range (0 to 255)",
            "test.tmc:5:15: error: `X` is not defined",
        ],
    );
}

#[test]
fn programs_have_a_bound() {
    check_errors(&"MST 0\n".repeat(2049), &["test.tmc:2049:1: error: the program memory has 2048 commands"]);
    check_errors(
        &"MST 0\n".repeat(2048),
        &["test.tmc:2048:1: error: there is no room for the `STOP` at the end (`#nostop` leaves it out)"],
    );
    let long = format!("{}STOP", "MST 0\n".repeat(2047));
    assert_eq!(commands(&long).len(), 2047);
    assert_eq!(messages(&vec![b'\n'; MAX_SOURCE_BYTES]), [""; 0]);
    assert_eq!(
        messages(&vec![b'\n'; MAX_SOURCE_BYTES + 1]),
        ["test.tmc:1:1: error: a source file has at most 1048576 bytes"]
    );
}

#[test]
fn nesting_has_a_bound() {
    let parentheses = |depth: usize| format!("COMP {}1{}", "(".repeat(depth), ")".repeat(depth));
    assert_eq!(commands(&parentheses(64)).len(), 1);
    check_errors(&parentheses(65), &["test.tmc:1:71: error: an expression nests at most 64 deep"]);
    assert!(messages(format!("COMP {}1", "-".repeat(100_000)).as_bytes())[0].contains("at most 64 deep"));
    assert!(
        messages(format!("COMP 1{}", "+1".repeat(100_000)).as_bytes())[0].contains("at most 256 operators")
    );
    let chain: String = (0..1000).map(|index| format!("C{index} = C{} + 1\n", index + 1)).collect();
    let messages = messages(format!("{chain}C1000 = 0\n").as_bytes());
    assert!(messages[0].contains("depends on more than 64 constants that come later"), "{messages:?}");
}

#[test]
fn warnings() {
    let assembly = assemble("test.tmc", b"SAP 5, 0, 10000\nSAP 5, 0, 100\nUF3 1\n", &World);
    assert_eq!(
        assembly.diagnostics.iter().map(ToString::to_string).collect::<Vec<_>>(),
        [
            "test.tmc:1:1: warning: parameter 5 takes 0 to 2047",
            "test.tmc:3:1: warning: this module has no user functions, it passes the command over",
        ]
    );
    assert_eq!(assembly.program.map(|program| program.commands.len()), Some(4));
}

#[test]
fn rendering() {
    let assembly = assemble("test.tmc", b"Loop:\n  JA  Lop // back\n", &NoFiles);
    let expected = "\
error: `Lop` is not defined
 --> test.tmc:2:7
  |
2 |   JA  Lop // back
  |       ^^^
  |
  = help: did you mean `Loop`?
";
    assert_eq!(assembly.render(false), expected);
    assert!(assembly.render(true).contains('\x1B'));
}

#[test]
fn source_map_and_symbols() {
    let source = b"Two = 2\n#include outer.inc\nLoop: JA Loop\n".as_slice();
    let assembly = assemble("test.tmc", &source[8..], &World);
    let names: Vec<_> = assembly.files.iter().map(|file| file.name.as_str()).collect();
    assert_eq!(names, ["test.tmc", "outer.inc", "numbers.inc"]);
    let program = assembly.program.expect("no errors");
    let places: Vec<_> = program.map.iter().map(|place| (place.file, place.line)).collect();
    assert_eq!(places, [(1, 3), (0, 2), (0, 2)]);
    let loop_symbol = program.symbols.iter().find(|symbol| symbol.name == "Loop").expect("defined");
    assert_eq!((loop_symbol.value, loop_symbol.label), (1, true));
    let expected = "Labels\n    1 Loop\n\nConstants\nOne = 1\nThree = 3\nTwo = 2\n";
    assert_eq!(program.symbol_file(), expected);
}

proptest! {
    /// Whatever the bytes, every message has a place in a file and can be rendered.
    #[test]
    fn any_bytes(source in prop::collection::vec(any::<u8>(), 0..200)) {
        assemble("test.tmc", &source, &World).render(true);
    }

    #[test]
    fn anything_like_a_program(source in "([A-C]:|[A-C] ?= ?|MVP |COMP |JC |ABS|#include |a.inc|ß|[0-9$%x+*/(),-]|//|\r|\n| ){0,60}") {
        let assembly = assemble("test.tmc", source.as_bytes(), &World);
        for diagnostic in &assembly.diagnostics {
            prop_assert!(diagnostic.place.line >= 1 && diagnostic.place.column >= 1);
            prop_assert!(diagnostic.place.end_column >= diagnostic.place.column);
        }
        assembly.render(false);
    }
}

#[test]
fn messages_end_somewhere() {
    for wrong in ["?\n", "FOO\n", "A: A: A:\n"] {
        let assembly = assemble("test.tmc", wrong.repeat(MAX_MESSAGES).as_bytes(), &World);
        assert_eq!((assembly.diagnostics.len(), assembly.has_errors()), (MAX_MESSAGES, true), "{wrong}");
    }
    // An error behind as many warnings is still one.
    let source = format!("{}FOO\n", "SAP 5, 0, 10000\n".repeat(MAX_MESSAGES));
    let assembly = assemble("test.tmc", source.as_bytes(), &World);
    assert!(assembly.diagnostics.len() == MAX_MESSAGES && assembly.has_errors());
}
