//! Any text in an editor, changed and asked about: no panic, and every answer is JSON without an error.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lsp::{Files, Server};
use serde_json::{Value, json};

/// What an editor asks about a place, and about all of a document.
const QUESTIONS: [&str; 12] = [
    "completion",
    "hover",
    "signatureHelp",
    "definition",
    "references",
    "documentHighlight",
    "prepareRename",
    "documentSymbol",
    "foldingRange",
    "semanticTokens/full",
    "formatting",
    "rename",
];

/// A question or something else, where, and a text.
type Step<'a> = (u8, u16, u16, &'a str);

/// Every file has the same content.
struct OneFile(Vec<u8>);

impl Files for OneFile {
    fn read(&self, _: &str) -> Option<Vec<u8>> {
        Some(self.0.clone())
    }
}

fn say(server: &mut Server, message: &Value) -> Vec<Value> {
    let answers = server.handle(&message.to_string());
    answers.iter().map(|answer| serde_json::from_str(answer).expect("JSON")).collect()
}

fuzz_target!(|session: (u8, &str, &[u8], Vec<Step<'_>>)| {
    let (kind, text, include, steps) = session;
    let models = devices::MODELS;
    let model = models.get(usize::from(kind) % (models.len() + 1));
    let uri = if kind < 128 { "file:///a.tmc" } else { "file:///a.prg" };
    let mut server = Server::new(model, Box::new(OneFile(include.to_vec())));
    let hello = json!({"processId": null, "rootUri": null, "capabilities": {}});
    say(&mut server, &json!({"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": hello}));
    let document = json!({"uri": uri, "languageId": "", "version": 1, "text": text});
    let open = json!({"textDocument": document});
    say(&mut server, &json!({"jsonrpc": "2.0", "method": "textDocument/didOpen", "params": open}));
    for (step, line, character, text) in steps {
        if let Some(question) = QUESTIONS.get(usize::from(step)) {
            let params = json!({
                "textDocument": {"uri": uri},
                "position": {"line": line, "character": character},
                "context": {"includeDeclaration": true, "triggerKind": 1, "isRetrigger": false},
                "options": {"tabSize": 4, "insertSpaces": true},
                "newName": text,
            });
            let method = format!("textDocument/{question}");
            let answers =
                say(&mut server, &json!({"jsonrpc": "2.0", "id": 2, "method": method, "params": params}));
            assert!(answers.len() == 1 && (*question == "rename" || answers[0].get("result").is_some()));
        } else if step < 128 {
            let change =
                json!({"textDocument": {"uri": uri, "version": 2}, "contentChanges": [{"text": text}]});
            say(
                &mut server,
                &json!({"jsonrpc": "2.0", "method": "textDocument/didChange", "params": change}),
            );
        } else {
            server.handle(text);
            // It may have been a good-bye.
            let last = server.handle(r#"{"jsonrpc": "2.0", "id": 3, "method": "textDocument/hover"}"#);
            if last.first().is_none_or(|answer| answer.contains("-32600")) {
                break;
            }
        }
    }
});
