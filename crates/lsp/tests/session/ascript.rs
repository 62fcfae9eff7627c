//! What editors are told about A-SCRIPT.

use crate::editor::{Cursor, Editor, apply, colours};
use lsp::NoFiles;
use serde_json::json;

const MAIN: &str = "file:///project/main.prg";

fn cursor(text: &str) -> Cursor {
    Cursor::new(Some("pmx-2ed"), MAIN, text)
}

#[test]
fn proposals() {
    #[track_caller]
    fn check(text: &str, has: &[&str], has_not: &[&str]) {
        let all = cursor(text).proposals();
        let labels: Vec<_> =
            all.iter().map(|proposal| proposal.split(' ').next().expect("a label")).collect();
        for label in has {
            assert!(labels.contains(label), "{text} {label}: {labels:?}");
        }
        for label in has_not {
            assert!(!labels.contains(label), "{text} {label}: {labels:?}");
        }
    }
    let statements = ["PRG", "ENDWHILE", "HSPDX", "JOGY-", "DO8", "DELAY", "ABS", "X", "SCVX"];
    check("|", &statements, &["DI1", "MSTX", "CIRXYP", "V1", ";", "JOGZ+"]);
    check("V12=1\nHS|", &["HSPD", "V12"], &["DI1"]);
    check("V1=|", &["DI1", "MSTX", "PX", "V1", "AI2"], &["WAITX", "PRG", "SCVX "]);
    check("IF D|", &["DI1", "DI8", "DO"], &["DELAY"]);
    check("V1=V2+|", &["EX"], &["JOGX+"]);
    check("; D|", &[], &["DI1"]);
    assert_eq!(cursor("GOSUB |\nEND\nSUB 3 ; home all\nENDSUB").proposals(), ["3 (home all)"]);
    let mut commander = Cursor::new(Some("cmd-4cr"), MAIN, "|");
    let labels = commander.proposals();
    assert!(labels.contains(&"CIRXYP (CIR[A1][A2][P/N][1]:[2])".into()), "{labels:?}");
    assert!(labels.contains(&"IO (IO[1-32])".into()), "{labels:?}");
}

#[test]
fn places_to_fill_in() {
    let item = json!({"completionItem": {"snippetSupport": true}});
    let capabilities = json!({"textDocument": {"completion": item}});
    let editor = Editor::with(None, Box::new(NoFiles), json!({}), &capabilities);
    let all = Cursor::with(editor, MAIN, "|").proposals();
    assert!(all.contains(&"IF -> IF ${1:DI1=1}\n\t$0\nENDIF (IF)".into()), "{all:?}");
}

#[test]
fn hover() {
    #[track_caller]
    fn check(text: &str, expected: Option<&str>) {
        let hover = cursor(text).hover();
        assert_eq!(hover.as_deref(), expected, "{text}");
    }
    check(
        "V1=M|STX",
        Some(
            "```ascript\nMST[axis]\n```\nStatus of an axis. Read only.\n\nExample: `V1=MSTX&7`. Performax 2ED manual \
             7.12.",
        ),
    );
    check(
        "X1000Y|2000",
        Some("```ascript\nY[position]\n```\nMoves axis Y.\n\nExample: `Y-1000`. Performax 2ED manual 7.8.1."),
    );
    let all = cursor("V1=DI|").hover().expect("a word");
    let one = cursor("V1=DI|1").hover().expect("a word");
    assert!(all.contains("All digital inputs.") && one.contains("A digital input."), "{all} {one}");
    let variable = cursor("V1=2\nV2=1\nV1=|V1+1").hover().expect("a variable");
    assert!(variable.ends_with("It gets its values in lines 1, 3."), "{variable}");
    let call = cursor("GOSUB |2\nEND\nSUB 2\nENDSUB").hover().expect("a subroutine");
    assert!(call.ends_with("It begins in line 3."), "{call}");
    let needs_axis = cursor("JO|G").hover().expect("a word");
    assert!(needs_axis.contains("JOG[axis][+/-]"), "{needs_axis}");
    check("V1=|5", None);
    check("CIR|XYP0:0", None);
    check("; X|1", None);
    check("|", None);
}

#[test]
fn signatures() {
    #[track_caller]
    fn check(text: &str, expected: Option<&str>) {
        let found = Cursor::new(Some("cmd-4cr"), MAIN, text).signature();
        assert_eq!(found.as_deref(), expected, "{text}");
    }
    check("CIRXYP|", Some("CIR[A1][A2][P/N]«[1]»:[2]"));
    check("ARCXYN0:V1:|", Some("ARC[A1][A2][P/N][1]:[2]:«[3]»"));
    check("CIRTP0:1:2:3|", Some("CIRT[P/N][1]:[2]:[3]"));
    check("HOMEX+|", Some("HOME[axis][+/-]«[mode]»"));
    check("JOGX+|", None);
    check("X1|", None);
}

const NAMES: &str = "PRG 0\nV1=V2+1\nGOSUB 3\nIF V01>5\nSR1=1\nENDIF\nEND\nPRG 1\nEND\nSUB 3\nV1=0\nENDSUB\n";

fn in_names(at: &str) -> (Cursor, String) {
    let text = NAMES.replacen(at, &format!("{}|{}", &at[..1], &at[1..]), 1);
    (cursor(&text), text)
}

#[test]
fn definitions_and_references() {
    let check = |at: &str, definition: &[&str], references: &[&str]| {
        let (mut cursor, _) = in_names(at);
        assert_eq!(cursor.places("definition", json!({})), definition, "{at}");
        let all = json!({"context": {"includeDeclaration": true}});
        assert_eq!(cursor.places("references", all), references, "{at}");
    };
    check("3\nIF", &["9:4"], &["2:6", "9:4"]);
    check("V01", &["1:0", "10:0"], &["1:0", "3:3", "10:0"]);
    check("V2", &[], &["1:3"]);
    check("1=1", &["7:4"], &["4:2", "7:4"]);
    check("ENDIF", &[], &[]);
}

#[test]
fn renaming() {
    let check = |at: &str, to: &str, expected: Result<&str, &str>| {
        let (mut cursor, text) = in_names(at);
        let found = cursor.renamed(&text, to);
        assert_eq!(found.as_deref().map_err(String::as_str), expected, "{at} {to}");
    };
    let sub = NAMES.replace("GOSUB 3", "GOSUB 7").replace("SUB 3\nV", "SUB 7\nV");
    check("3\nIF", "7", Ok(&sub));
    check("3\nIF", "SUB 7", Ok(&sub));
    check("V2", "9", Ok(&NAMES.replace("V2", "V9")));
    check("V01", "V7", Ok(&NAMES.replace("V01", "V7").replace("V1", "V7")));
    check("V01", "V2", Err("`V2` is used already"));
    check("V01", "V64", Err("it has a number from 0 to 63"));
    check("V01", "PRG 1", Err("it has a number from 0 to 63"));
    check("V01", "x", Err("it has a number from 0 to 63"));
    check("3\nIF", "32", Err("it has a number from 0 to 31"));
    check("ENDIF", "1", Err("nothing here has a name"));
}

#[test]
fn outline_and_folds() {
    let mut cursor = cursor("; a\n; b\nPRG 0\nIF DI1=1\nX1\nELSE\nX2\nENDIF\nEND|\n\nSUB 31\nENDSUB\n");
    let parts = cursor.whole("documentSymbol");
    let parts: Vec<_> = parts
        .as_array()
        .expect("a list")
        .iter()
        .map(|part| {
            format!("{} {}-{}", part["name"], part["range"]["start"]["line"], part["range"]["end"]["line"])
        })
        .collect();
    assert_eq!(parts, ["\"PRG 0\" 2-8", "\"SUB 31\" 10-11"]);
    let folds = cursor.whole("foldingRange");
    let folds: Vec<_> = folds
        .as_array()
        .expect("a list")
        .iter()
        .map(|fold| format!("{}-{}", fold["startLine"], fold["endLine"]))
        .collect();
    assert_eq!(folds, ["0-1", "3-7", "2-8", "10-11"]);
}

#[test]
fn formatting() {
    let text = "PRG0 ; first\nWHILE  DI 1 = 1;wait\nX 100\nENDWHILE\n END\n\n|\n";
    let edits = cursor(text).whole("formatting");
    assert_eq!(
        apply(&text.replace('|', ""), &edits),
        "PRG 0                       ; first\n  WHILE DI1=1               ;wait\n    X100\n  ENDWHILE\nEND\n"
    );
    assert_eq!(cursor("V1==|2\nEND").whole("formatting"), json!(null));
}

#[test]
fn pieces() {
    let text = "PRG 0 ; \u{1F600}\nV1=~DI1&5\nX1000YV2\nJOGX+\nFOO1\nSR1=2\nDELAY=1\n";
    let mut editor = Editor::new(Some("pmx-2ed"));
    editor.open(MAIN, text);
    assert_eq!(
        colours(&mut editor, MAIN, text),
        [
            "PRG keyword",
            "0 number*",
            "; \u{1F600} comment",
            "V1 variable*",
            "= operator",
            "~ operator",
            "DI1 property",
            "& operator",
            "5 number",
            "X method",
            "1000 number",
            "Y method",
            "V2 variable",
            "JOGX method",
            "+ operator",
            "1 number",
            "SR1 method",
            "= operator",
            "2 number",
            "DELAY method",
            "= operator",
            "1 number",
        ]
    );
}
