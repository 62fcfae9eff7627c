//! `lsp`: an editor at its standard input and output.

mod common;

use common::command;
use serde_json::{Value, json};
use std::{
    io::Write,
    path::Path,
    process::{Output, Stdio},
};

/// Says these things one after the other, and hears all that comes back.
fn talk(directory: &Path, arguments: &[&str], messages: &[Value]) -> (Output, Vec<Value>) {
    let mut child = command(directory, &[&["lsp"], arguments].concat())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    for message in messages {
        let text = message.to_string();
        write!(input, "Content-Length: {}\r\n\r\n{text}", text.len()).unwrap();
    }
    drop(input);
    let output = child.wait_with_output().unwrap();
    let mut rest = output.stdout.as_slice();
    let mut heard = Vec::new();
    while !rest.is_empty() {
        let end = rest.windows(4).position(|bytes| bytes == b"\r\n\r\n").expect("a header");
        let header = str::from_utf8(&rest[..end]).unwrap();
        let length: usize = header.strip_prefix("Content-Length: ").expect("a length").parse().unwrap();
        let message;
        (message, rest) = rest[end + 4..].split_at(length);
        heard.push(serde_json::from_slice(message).unwrap());
    }
    (output, heard)
}

fn request(id: u32, method: &str, params: Value) -> Value {
    json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params })
}

fn notification(method: &str, params: Value) -> Value {
    json!({ "jsonrpc": "2.0", "method": method, "params": params })
}

fn hello() -> [Value; 2] {
    let params = json!({ "processId": null, "rootUri": null, "capabilities": {} });
    [request(1, "initialize", params), notification("initialized", json!({}))]
}

#[test]
fn a_session() {
    let directory = common::directory(&[("axis speeds.inc", "Speed = 500\n")]);
    let uri = format!("file://{}/main.tmc", directory.display());
    let text = "#include \"axis speeds.inc\"\nROR 0, Speed\nROL 0, Sped\n";
    let document = json!({ "uri": uri, "languageId": "tmcl", "version": 7, "text": text });
    let place = json!({ "textDocument": { "uri": uri }, "position": { "line": 1, "character": 8 } });
    let [first, second] = hello();
    let (output, heard) = talk(
        &directory,
        &[],
        &[
            first,
            second,
            notification("textDocument/didOpen", json!({ "textDocument": document })),
            request(2, "textDocument/definition", place.clone()),
            request(3, "textDocument/hover", place),
            request(4, "shutdown", Value::Null),
            notification("exit", Value::Null),
        ],
    );
    assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
    let [hello, marks, definition, hover, good_bye] = &heard[..] else { panic!("{heard:?}") };
    assert_eq!(hello["result"]["serverInfo"]["name"], "pulsetrain");
    assert_eq!((&marks["params"]["version"], &marks["params"]["uri"]), (&json!(7), &json!(uri)));
    let message = &marks["params"]["diagnostics"][0]["message"];
    assert_eq!(message, "`Sped` is not defined (did you mean `Speed`?)");
    let file = format!("file://{}/axis%20speeds.inc", directory.display());
    assert_eq!(definition["result"][0]["uri"], file);
    assert_eq!(hover["result"]["contents"]["value"], "`Speed = 500`");
    assert_eq!(good_bye, &json!({ "jsonrpc": "2.0", "id": 4, "result": null }));
}

#[test]
fn the_model_is_an_argument() {
    let directory = common::directory(&[]);
    let document =
        json!({ "uri": "file:///a.prg", "languageId": "", "version": 1, "text": "CIRXYP0:0\nEND\n" });
    let open = notification("textDocument/didOpen", json!({ "textDocument": document }));
    for (model, mistakes) in [("pmx-2ed", 1), ("cmd-4cr", 0)] {
        let [first, second] = hello();
        let arguments = ["--device", model];
        let (_, heard) = talk(&directory, &arguments, &[first, second, open.clone()]);
        assert_eq!(heard[1]["params"]["diagnostics"].as_array().map(Vec::len), Some(mistakes), "{model}");
    }
    let (output, _) = talk(&directory, &["--device", "pmx"], &[]);
    assert_eq!(output.status.code(), Some(1));
}

#[test]
fn what_comes_to_a_bad_end() {
    let directory = common::directory(&[]);
    let [first, _] = hello();
    // An editor that leaves without a word.
    let (output, _) = talk(&directory, &[], &[first, notification("exit", Value::Null)]);
    assert_eq!(output.status.code(), Some(1));
    // One that is no editor.
    let mut child =
        command(&directory, &["lsp"]).stdin(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(b"hello\r\n\r\n").unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(
        String::from_utf8_lossy(&output.stderr).starts_with("error: a message begins with"),
        "{output:?}"
    );
}
