//! Errors and warnings while a program is typed.

use crate::editor::Editor;
use lsp::{Files, MAX_DOCUMENTS, MAX_TEXT_BYTES};
use serde_json::json;

const MAIN: &str = "file:///project/main.tmc";
const AXIS: &str = "file:///project/lib/axis%20one.inc";

/// What is said about a program.
#[track_caller]
fn check(model: Option<&str>, uri: &str, text: &str, expected: &[&str]) {
    let mut editor = Editor::new(model);
    editor.open(uri, text);
    assert_eq!(editor.marked(uri), expected, "{text}");
}

#[test]
fn tmcl() {
    check(None, MAIN, "MVP ABS, 0, 1000\nSTOP\n", &[]);
    check(
        None,
        MAIN,
        "#include TMCLParam.tmc\n\tSAP APMaxAcceleration, 0, 9999\nLoop: /* */\nJA Lop // \u{1F600}\n",
        &[
            "1:1-1:31 warning the module skips this: maximum acceleration goes from 1 to 2047",
            "2:6-2:7 error expected a label, a name or a command, found `/`",
            "3:3-3:6 error `Lop` is not defined (did you mean `Loop`?)",
        ],
    );
    check(
        None,
        MAIN,
        "SAP 5, 0, 9999\n",
        &["0:0-0:14 warning the module skips this: maximum acceleration goes from 1 to 2047"],
    );
}

#[test]
fn ascript() {
    let uri = "file:///a.prg";
    check(Some("pmx-2ed"), uri, "PRG 0\nX1000\nWAITX\nEND\n", &[]);
    check(
        Some("pmx-2ed"),
        uri,
        "; \u{1F600}\nCIRXYP0:0\nV1==2\nGOSUB 3\nEND\n",
        &[
            "1:0-1:6 error Unknown Error: there is no statement `CIRXYP` (the Commander core has it, the Performax 2ED \
             has not)",
            "2:3-2:4 error Error: one `=` is enough (assignments and conditions have a single `=`)",
            "3:0-3:7 warning there is no subroutine 3 (unless the device has one, this is an error when the program \
             comes here)",
        ],
    );
    // Places behind a byte order mark are those of the text.
    check(
        Some("pmx-2ed"),
        uri,
        "\u{FEFF}V1==2\nEND",
        &["0:4-0:5 error Error: one `=` is enough (assignments and conditions have a single `=`)"],
    );
    // Nobody said for which controller: the first one for which it is right.
    check(None, uri, "CIRXYP0:0\nEND\n", &[]);
    check(
        None,
        uri,
        "CIRXP0:0\nHLHOMEX+\nEND\n",
        &["0:0-0:5 error Unknown Error: there is no statement `CIRXP`"],
    );
}

#[test]
fn places_are_in_the_editors_units() {
    for (encodings, character) in [(json!(["utf-8", "utf-16"]), 8), (json!([]), 6), (json!(["utf-32"]), 5)] {
        let capabilities = json!({"general": {"positionEncodings": encodings}});
        let mut editor = Editor::with(None, Box::new(lsp::NoFiles), json!({}), &capabilities);
        editor.open(MAIN, "\u{1F600} JA");
        let expected = format!("0:0-0:{} error", character - 4);
        assert!(editor.marked(MAIN)[0].starts_with(&expected), "{:?} {encodings}", editor.marked(MAIN));
    }
}

#[test]
fn a_source_is_as_long_as_the_compiler_reads() {
    let long = "STOP\n".repeat((1 << 20) / 5 + 1);
    check(None, MAIN, &long, &["0:0-0:0 error a source file has at most 1048576 bytes"]);
    let long = format!("STOP\n{}\n", "a: ".repeat(2000));
    check(None, MAIN, &long, &["1:0-1:0 error a line has at most 4096 bytes here"]);
    check(None, "file:///readme", "hello", &[]);
}

#[test]
fn so_many_documents_are_looked_at() {
    let mut editor = Editor::new(None);
    for number in 0..MAX_DOCUMENTS + 1 {
        editor.open(&format!("file:///{number}.tmc"), "A");
    }
    let last = format!("file:///{MAX_DOCUMENTS}.tmc");
    assert_eq!((editor.marked("file:///0.tmc").len(), editor.marked(&last).len()), (1, 0));
    editor.close("file:///0.tmc");
    editor.open(&last, "A");
    assert_eq!(editor.marked(&last).len(), 1);
    editor.change(&last, &" ".repeat(MAX_TEXT_BYTES));
    assert_eq!(editor.marked(&last).len(), 0);
}

/// Files of a project.
struct Project;

impl Files for Project {
    fn read(&self, uri: &str) -> Option<Vec<u8>> {
        (uri == AXIS).then(|| b"Speed = 500\nROR 0, Sped\n".to_vec())
    }
}

#[test]
fn included_files() {
    let mut editor = Editor::with(None, Box::new(Project), json!({}), &json!({}));
    editor.open(MAIN, "STOP\n#include \"lib/axis one.inc\"\nROL 0, Speed\n");
    assert_eq!(
        editor.marked(MAIN),
        ["1:10-1:26 error axis one.inc, line 2: `Sped` is not defined (did you mean `Speed`?)"]
    );
    // What is in a window counts, not what is in the file.
    editor.open(AXIS, "Speed = 500\n");
    assert_eq!(editor.marked(MAIN), [""; 0]);
    editor.change(AXIS, "Sped = 500\n");
    assert_eq!(editor.marked(MAIN), ["2:7-2:12 error `Speed` is not defined (did you mean `Sped`?)"]);
    editor.close(AXIS);
    assert_eq!(editor.marked(MAIN).len(), 1);
    assert!(editor.marked(AXIS).is_empty());
}
