//! Any text: no panic, every place lies in it, and what it is laid out to stays.

use crate::editor::{Editor, apply};
use proptest::prelude::*;
use serde_json::{Value, json};

const QUESTIONS: [&str; 7] = [
    "completion",
    "hover",
    "signatureHelp",
    "definition",
    "references",
    "documentHighlight",
    "prepareRename",
];
const WHOLE: [&str; 4] = ["documentSymbol", "foldingRange", "semanticTokens/full", "formatting"];

/// Pieces of programs, and of what is none.
fn pieces() -> impl Strategy<Value = String> {
    let piece = prop_oneof![
        4 => prop::sample::select(vec![
            "MVP", "SAP", "GGP", "JA", "EI", "ABS", "Loop", "Loop:", "A", "=", "4", "66", "0", ",", ", ", "(", ")",
            "-", "$", "%1", "//", "#", "#include ", "TMCLParam.tmc", "Interrupts.inc", "#nostop", "STOP",
        ]),
        4 => prop::sample::select(vec![
            "PRG", "SUB", "GOSUB", "END", "ENDSUB", "IF ", "ELSE", "ENDIF", "WHILE ", "V", "V1", "DI", "X", "Y1", "SR",
            "CIRXYP", "HOMEX", "JOGX", "+", ":", ";", "0", "1", "32", "=", "~", "<", "MSTX", "99999999999",
        ]),
        3 => prop::sample::select(vec![" ", "\t", "\n", "\n", "\r\n", "\r"]),
        1 => prop::sample::select(vec!["\u{FEFF}", "\u{1F600}", "ö", "\0", "\"", "<"]),
    ];
    prop::collection::vec(piece, 0..40).prop_map(|pieces| pieces.concat())
}

/// How long each line is, in units of 16 bits.
fn lines(text: &str) -> Vec<u64> {
    let text = text.replace("\r\n", "\n").replace('\r', "\n");
    text.split('\n').map(|line| line.encode_utf16().count() as u64).collect()
}

/// All ranges in an answer lie in the text.
fn within(answer: &Value, lines: &[u64]) {
    match answer {
        Value::Array(list) => list.iter().for_each(|value| within(value, lines)),
        Value::Object(fields) => {
            if let (Some(line), Some(character)) = (fields.get("line"), fields.get("character")) {
                let length = lines[line.as_u64().expect("a number") as usize];
                assert!(character.as_u64().expect("a number") <= length, "{answer}");
            }
            fields.values().for_each(|value| within(value, lines));
        }
        _ => (),
    }
}

fn try_out(model: &str, uri: &str, text: &str) {
    let mut editor = Editor::new(Some(model));
    editor.open(uri, text);
    let lines = lines(text);
    let document = json!({"uri": uri});
    for (line, length) in lines.iter().enumerate() {
        for character in 0..=*length {
            let position = json!({"line": line, "character": character});
            for question in QUESTIONS {
                let params = json!({
                    "textDocument": document, "position": position, "context": {"includeDeclaration": true, "triggerKind": 1, "isRetrigger": false},
                });
                let method = format!("textDocument/{question}");
                let answer = editor.request(&method, &params);
                assert!(answer.get("code").is_none(), "{answer}");
                within(&answer, &lines);
            }
            let params = json!({"textDocument": document, "position": position, "newName": "V9"});
            editor.request("textDocument/rename", &params);
        }
    }
    for question in WHOLE {
        let params = json!({"textDocument": document, "options": {"tabSize": 4, "insertSpaces": true}});
        let answer = editor.request(&format!("textDocument/{question}"), &params);
        assert!(answer.get("code").is_none(), "{answer}");
        within(&answer, &lines);
        if question == "semanticTokens/full" {
            let mut line = 0;
            let mut end = 0;
            for token in answer["data"].as_array().expect("a list").chunks(5) {
                let number = |at: usize| token[at].as_u64().expect("a number");
                let start = if number(0) == 0 { end + number(1) } else { number(1) };
                line += number(0) as usize;
                assert!(number(2) > 0 && start + number(2) <= lines[line], "{text:?}");
                end = start;
            }
        }
        if question == "formatting" && text.is_ascii() && !text.contains('\r') && answer.is_array() {
            let formatted = apply(text, &answer);
            editor.change(uri, &formatted);
            assert_eq!(editor.request("textDocument/formatting", &params), json!([]), "{text:?}");
            editor.change(uri, text);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_text(text in pieces()) {
        try_out("pd42-1140", "file:///a.tmc", &text);
        try_out("pmx-2ed", "file:///a.prg", &text);
        try_out("cmd-4cr", "file:///a.prg", &text);
    }
}
