//! How a conversation begins, what settings do, and how it ends.

use crate::editor::Editor;
use lsp::{NoFiles, Server};
use serde_json::{Value, json};

#[test]
fn hello_comes_first() {
    let mut server = Server::new(None, Box::new(NoFiles));
    let mut say = |message: Value| -> Vec<Value> {
        let answers = server.handle(&message.to_string());
        answers.iter().map(|text| serde_json::from_str(text).expect("JSON")).collect()
    };
    let early = say(json!({"jsonrpc": "2.0", "id": 1, "method": "textDocument/hover", "params": {}}));
    assert_eq!(early[0]["error"]["code"], -32002);
    let hello = json!({"processId": null, "rootUri": null, "capabilities": {}});
    let hello = json!({"jsonrpc": "2.0", "id": "a", "method": "initialize", "params": hello});
    let answer = say(hello.clone());
    assert_eq!((answer.len(), &answer[0]["id"]), (1, &json!("a")));
    assert_eq!(answer[0]["result"]["capabilities"]["positionEncoding"], "utf-16");
    assert_eq!(say(hello)[0]["error"]["code"], -32601);
}

#[test]
fn good_bye() {
    let mut editor = Editor::new(None);
    assert_eq!(editor.request("shutdown", &Value::Null), Value::Null);
    assert_eq!(editor.request("textDocument/hover", &json!({}))["code"], -32600);
    editor.notify("exit", &Value::Null);
    assert!(editor.server.is_over() && !editor.server.is_abrupt());
    assert!(editor.server.handle("{").is_empty());
    let mut editor = Editor::new(None);
    editor.notify("exit", &Value::Null);
    assert!(editor.server.is_over() && editor.server.is_abrupt());
}

#[test]
fn what_is_no_message() {
    let check = |text: &str, code: i64| {
        let answers = Editor::new(None).server.handle(text);
        let answer: Value = serde_json::from_str(&answers[0]).expect("JSON");
        assert_eq!((answers.len(), &answer["error"]["code"]), (1, &json!(code)), "{text}");
    };
    check("{", -32700);
    check(&"[".repeat(100_000), -32700);
    check("7", -32600);
    check("{}", -32600);
    check(r#"{"jsonrpc": "1.0", "id": 1, "method": "x"}"#, -32600);
    check(r#"{"jsonrpc": "2.0", "id": 1, "method": "x"}"#, -32601);
    assert!(Editor::new(None).server.handle(r#"{"jsonrpc": "2.0", "method": "x"}"#).is_empty());
}

#[test]
fn settings_choose_the_model() {
    let uri = "file:///a.prg";
    let arc = "CIRXYP0:0\nEND\n";
    let right = |editor: &Editor| editor.marked(uri).is_empty();
    let mut editor =
        Editor::with(Some("pmx-2ed"), Box::new(NoFiles), json!({"model": "cmd-4cr"}), &json!({}));
    editor.open(uri, arc);
    assert!(right(&editor));

    let capabilities = json!({"workspace": {"configuration": true}});
    let mut editor = Editor::with(Some("pmx-2ed"), Box::new(NoFiles), json!(null), &capabilities);
    editor.open(uri, arc);
    assert!(!right(&editor));
    let question = editor.asked.pop().expect("a question");
    assert_eq!(question["params"]["items"][0]["section"], "pulsetrain");
    editor.send(&json!({"jsonrpc": "2.0", "id": question["id"], "result": [{"model": "cmd-4cr"}]}));
    assert!(right(&editor));
    let settings = |model: &str| json!({"settings": {"pulsetrain": {"model": model}}});
    editor.notify("workspace/didChangeConfiguration", &settings("pmx-2ed"));
    assert!(!right(&editor));
    editor.notify("workspace/didChangeConfiguration", &settings("cmd-4cr"));
    assert!(right(&editor) && editor.asked.is_empty());
    // A model that does not exist is that of the command line.
    editor.notify("workspace/didChangeConfiguration", &settings("pmx"));
    assert!(!right(&editor));
    let warning = editor.asked.pop().expect("a warning");
    assert_eq!(warning["params"]["message"], "unknown model `pmx`, known: pd42-1140, pmx-2ed, cmd-4cr");
    editor.notify("workspace/didChangeConfiguration", &json!({"settings": null}));
    assert_eq!(editor.asked.len(), 1);
}
