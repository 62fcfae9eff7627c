//! What editors are told about TMCL.

use crate::editor::{Cursor, Editor, apply, colours};
use lsp::{Files, NoFiles};
use serde_json::{Value, json};

const MAIN: &str = "file:///project/main.tmc";

fn cursor(text: &str) -> Cursor {
    Cursor::new(None, MAIN, text)
}

#[test]
fn proposals() {
    #[track_caller]
    fn check(text: &str, expected: &[&str]) {
        let all = cursor(text).proposals();
        let found: Vec<_> = all.iter().take(expected.len()).map(String::as_str).collect();
        assert_eq!(found, expected, "{text}");
        assert!(!expected.is_empty() || all.is_empty(), "{text}: {all:?}");
    }
    check("|", &["ROR (ROR <motor>, <velocity>)", "ROL (ROL <motor>, <velocity>)", "MST (MST <motor>)"]);
    check("Loop: MV|", &["ROR (ROR <motor>, <velocity>)"]);
    check("MVP |", &["ABS (0)", "REL (1)", "COORD (2)"]);
    check("MVP abs, |", &["0 (the motor)"]);
    // A number where the symbol is not defined, and where numbers are typed.
    check(
        "SAP |",
        &["APTargetPosition -> 0 (0: Target position)", "APActualPosition -> 1 (1: Actual position)"],
    );
    check("#include TMCLParam.tmc\nSAP APM|", &["APTargetPosition (0: Target position)"]);
    check("#include TMCLParam.tmc\nGAP 1|, 0", &["APTargetPosition -> 0 (0: Target position)"]);
    check("SGP 66, |", &["0 (parameters of the module)", "2 (user variables)", "3 (interrupts)"]);
    check("EI |", &["TI_TIMER0 -> 0 (0: period of timer 0)"]);
    check("#include Interrupts.inc\nEI |", &["TI_TIMER0 (0: period of timer 0)"]);
    check("A = 1\nStart:\nSTOP\nEnd: JA |", &["End (address 1)", "Start (address 0)"]);
    check("A = 1\nStart: ROR 0, |", &["A (= 1)"]);
    check("A = 1\nB = |", &["A (= 1)"]);
    check(
        "#|",
        &["#include (Reads another file here, once.)", "#nostop (Appends no `STOP` to the program.)"],
    );
    check("#include TM|", &["TMCLParam.tmc (Symbols of all parameters of the module.)"]);
    check("STOP // MV|", &[]);
    check("MST 0, |", &[]);
    check("MST 0 |", &["0 (the motor)"]);
}

#[test]
fn places_to_fill_in() {
    let item = json!({"completionItem": {"snippetSupport": true}});
    let capabilities = json!({"textDocument": {"completion": item}});
    let editor = Editor::with(None, Box::new(NoFiles), json!({}), &capabilities);
    let all = Cursor::with(editor, MAIN, "|").proposals();
    let text =
        "MVP -> MVP ${1|ABS,REL,COORD|}, ${2:0}, ${3:position} (MVP <ABS|REL|COORD>, <motor>, <position>)";
    assert!(all.iter().any(|proposal| proposal == text), "{all:?}");
}

#[test]
fn hover() {
    #[track_caller]
    fn check(text: &str, expected: Option<&str>) {
        let hover = cursor(text).hover();
        assert_eq!(hover.as_deref(), expected, "{text}");
    }
    check(
        "L: m|vp ABS, 0, 5",
        Some(
            "```tmcl\nMVP <ABS|REL|COORD>, <motor>, <position>\n```\nMoves to a position, by a distance or to a \
             coordinate.\n\nExample: `MVP ABS, 0, 90000`. Manual 3.7.4.",
        ),
    );
    check("MVP REL|, 0, 5", Some("`REL` is 1 here."));
    let speed = "**Maximum positioning speed** (parameter 4, `APMaxPositioningSpeed`)\n\nTop speed of positioning \
                 ramps.\n\n1 to 2047 int, 1000 from the factory, RWE.";
    check("SAP |4, 0, 500", Some(speed));
    check("S = 4\nSAP |S, 0, 500", Some(speed));
    check("#include TMCLParam.tmc\nA = APMaxPositioningSpee|d", Some(speed));
    let address = cursor("GGP |66, 0").hover().expect("a parameter");
    assert!(address.starts_with("**Serial address** (parameter 66"), "{address}");
    check("GGP |66, 2", None);
    check("GGP 66, |2", Some("Bank 2: user variables."));
    check("EI |27", Some("Interrupt 27, `TI_LEFT_STOP0`: left stop switch of axis 0 changes."));
    check("EI |255", Some("All interrupts."));
    check("STOP\nL|oop: JA Loop", Some("Label `Loop`, address 1."));
    check("A = 2 * 3\nROR 0, |A", Some("`A = 6`"));
    check("A = B\nROR 0, |A", Some("`A` has no value."));
    check("#incl|ude x", Some("Reads another file here, once."));
    check("#include Inter|rupts.inc", Some("Symbols of all interrupts."));
    check("ROR 0, 5|00", None);
    check("// RO|R", None);
    check("|", None);
}

#[test]
fn signatures() {
    #[track_caller]
    fn check(text: &str, expected: Option<&str>) {
        assert_eq!(cursor(text).signature().as_deref(), expected, "{text}");
    }
    check("MVP |", Some("MVP «<ABS|REL|COORD>», <motor>, <position>"));
    check("L: MVP ABS, (1|", Some("MVP <ABS|REL|COORD>, «<motor>», <position>"));
    check("MVP ABS, 0,|", Some("MVP <ABS|REL|COORD>, <motor>, «<position>»"));
    check("MVP ABS, 0, 1, |", Some("MVP <ABS|REL|COORD>, <motor>, <position>"));
    check("MVP|", None);
    check("STOP // |", None);
}

/// A file beside the program.
struct Axis;

impl Files for Axis {
    fn read(&self, uri: &str) -> Option<Vec<u8>> {
        (uri == "file:///project/axis.inc").then(|| b"Speed = 500\nHalf = Speed / 2\n".to_vec())
    }
}

const NAMES: &str = "#include axis.inc\n#include TMCLParam.tmc\nTarget = Speed * 4\nLoop:\n  MVP ABS, 0, Target\n  \
                     ROR 0, Speed\n  SAP APMaxAcceleration, 0, 100\n  JA Loop\n";

fn in_names(at: &str) -> Cursor {
    let text = NAMES.replacen(at, &format!("{}|{}", &at[..1], &at[1..]), 1);
    Cursor::with(Editor::with(None, Box::new(Axis), json!({}), &json!({})), MAIN, &text)
}

#[test]
fn definitions_and_references() {
    let check = |at: &str, definition: &[&str], references: &[&str]| {
        let mut cursor = in_names(at);
        assert_eq!(cursor.places("definition", json!({})), definition, "{at}");
        let all = json!({"context": {"includeDeclaration": true}});
        assert_eq!(cursor.places("references", all), references, "{at}");
        let less = json!({"context": {"includeDeclaration": false}});
        assert_eq!(cursor.places("references", less).len() + definition.len(), references.len(), "{at}");
    };
    check("Loop\n", &["3:0"], &["3:0", "7:5"]);
    check("Target\n", &["2:0"], &["2:0", "4:14"]);
    check("Speed\n", &["axis.inc0:0"], &["2:9", "5:9", "axis.inc0:0", "axis.inc1:7"]);
    check("APMaxAcceleration", &[], &["6:6"]);
    check("ABS", &[], &[]);
    assert_eq!(in_names("Speed\n").places("documentHighlight", json!({})), ["2:9", "5:9"]);
}

#[test]
fn renaming() {
    let check = |at: &str, to: &str, expected: Result<&str, &str>| {
        let found = in_names(at).renamed(NAMES, to);
        let expected = expected.map(|name| NAMES.replace(at.trim(), name)).map_err(str::to_owned);
        assert_eq!(found, expected, "{at} {to}");
    };
    check("Loop\n", "Again", Ok("Again"));
    check("Speed\n", "Tempo", Ok("Tempo"));
    check("Loop\n", "Loop", Ok("Loop"));
    check("Loop\n", "Speed", Err("`Speed` is already defined"));
    let letters = "a name has letters, digits and `_`, and begins with none of the digits";
    check("Loop\n", "1st", Err(letters));
    check("Loop\n", "two words", Err(letters));
    check("Loop\n", "", Err(letters));
    check("APMaxAcceleration", "A", Err("`APMaxAcceleration` is a name of the module's"));
    check("ABS", "A", Err("nothing here has a name"));
    assert_eq!(in_names("Speed\n").ask("prepareRename", json!({}))["placeholder"], "Speed");
    assert_eq!(in_names("APMaxAcceleration").ask("prepareRename", json!({})), Value::Null);
    // The file beside it is changed too.
    let edit = in_names("Speed\n").ask("rename", json!({"newName": "Tempo"}));
    assert_eq!(edit["changes"]["file:///project/axis.inc"].as_array().map(Vec::len), Some(2));
}

#[test]
fn outline_and_folds() {
    let text = "// Constants\n// of the axis\nSpeed = 500\nStart: ROR 0, Speed\n  WAIT TICKS, 0, 10\n\n// Again\n\
                Loop:\n  JA Loop|\n\n";
    let mut cursor = cursor(text);
    let parts = cursor.whole("documentSymbol");
    let parts: Vec<_> = parts
        .as_array()
        .expect("a list")
        .iter()
        .map(|part| format!("{} {} {}", part["name"], part["detail"], part["range"]["end"]["line"]))
        .collect();
    assert_eq!(parts, ["\"Speed\" \"= 500\" 2", "\"Start\" \"address 0\" 6", "\"Loop\" \"address 2\" 8"]);
    let folds = cursor.whole("foldingRange");
    let folds: Vec<_> = folds
        .as_array()
        .expect("a list")
        .iter()
        .map(|fold| format!("{}-{} {}", fold["startLine"], fold["endLine"], fold["kind"]))
        .collect();
    assert_eq!(folds, ["0-1 \"comment\"", "3-5 null", "7-8 null"]);
}

#[test]
fn formatting() {
    let text = "start: ror  0,500 // go\n\n\tja start\n\n|\n";
    let edits = cursor(text).whole("formatting");
    let formatted = String::from_utf8(tmcl::asm::format(text.replace('|', "").as_bytes())).expect("UTF-8");
    assert_eq!(apply(&text.replace('|', ""), &edits), formatted);
    assert_eq!(cursor(&format!("{formatted}|")).whole("formatting"), json!([]));
}

#[test]
fn pieces() {
    let text = "#include \"TMCLParam.tmc\" // all\nSpeed = $1F + 2\nGo: \u{1F600} MVP\nGo2: mvp abs, 0, Speed // \u{1F600}\n\
                SAP APMaxCurrent, 0, 1\nJA Go2\nDATA 1,2,3,4\n";
    let mut editor = Editor::new(None);
    editor.open(MAIN, text);
    assert_eq!(
        colours(&mut editor, MAIN, text),
        [
            "#include macro",
            "TMCLParam.tmc string",
            "// all comment",
            "Speed variable*",
            "= operator",
            "$1F number",
            "+ operator",
            "2 number",
            "Go function*",
            "MVP keyword",
            "Go2 function*",
            "mvp keyword",
            "abs enumMember",
            "0 number",
            "Speed variable",
            "// \u{1F600} comment",
            "SAP keyword",
            "APMaxCurrent property",
            "0 number",
            "1 number",
            "JA keyword",
            "Go2 function",
            "DATA keyword",
            "1 number",
            "2 number",
            "3 number",
            "4 number",
        ]
    );
}
