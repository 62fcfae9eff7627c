//! An editor of a few lines.

use lsp::{Files, NoFiles, Server};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// An editor with its server.
pub struct Editor {
    pub server: Server,
    requests: i64,
    /// What was said last about each document, as `line:character-line:character severity message`.
    pub marks: BTreeMap<String, Vec<String>>,
    /// Requests of the server that wait for an answer.
    pub asked: Vec<Value>,
}

impl Editor {
    /// An editor that has said hello.
    pub fn new(model: Option<&str>) -> Self {
        Self::with(model, Box::new(NoFiles), json!({}), &json!({}))
    }

    pub fn with(
        model: Option<&str>,
        files: Box<dyn Files + Send>,
        options: Value,
        capabilities: &Value,
    ) -> Self {
        let model = model.map(|name| devices::model(name).expect(name));
        let server = Server::new(model, files);
        let mut editor = Self { server, requests: 100, marks: BTreeMap::new(), asked: Vec::new() };
        let hello = json!({
            "processId": null, "rootUri": null, "capabilities": capabilities, "initializationOptions": options,
        });
        editor.request("initialize", &hello);
        editor.notify("initialized", &json!({}));
        editor
    }

    /// Sends a request and gives its result, or its error.
    pub fn request(&mut self, method: &str, params: &Value) -> Value {
        self.requests += 1;
        let id = self.requests;
        let answers = self.send(&json!({"jsonrpc": "2.0", "id": id, "method": method, "params": params}));
        let answer = answers.into_iter().find(|answer| answer["id"] == id).expect("an answer");
        answer.get("result").or(answer.get("error")).cloned().expect("a result or an error")
    }

    pub fn notify(&mut self, method: &str, params: &Value) {
        let answers = self.send(&json!({"jsonrpc": "2.0", "method": method, "params": params}));
        assert!(answers.is_empty(), "{answers:?}");
    }

    /// Sends a message, takes up what is said about documents, and gives the answers.
    pub fn send(&mut self, message: &Value) -> Vec<Value> {
        let mut answers = Vec::new();
        for text in self.server.handle(&message.to_string()) {
            let message: Value = serde_json::from_str(&text).expect("JSON");
            assert_eq!(message["jsonrpc"], "2.0");
            match message["method"].as_str() {
                Some("textDocument/publishDiagnostics") => self.mark(&message["params"]),
                Some(_) => self.asked.push(message),
                None => answers.push(message),
            }
        }
        answers
    }

    fn mark(&mut self, params: &Value) {
        let marks = params["diagnostics"].as_array().expect("a list").iter().map(|mark| {
            let place = |place: &Value| format!("{}:{}", place["line"], place["character"]);
            let code = mark["code"].as_str().map(|code| format!("{code}: ")).unwrap_or_default();
            let severity = if mark["severity"] == 1 { "error" } else { "warning" };
            let (start, end) = (place(&mark["range"]["start"]), place(&mark["range"]["end"]));
            format!("{start}-{end} {severity} {code}{}", mark["message"].as_str().expect("text"))
        });
        self.marks.insert(params["uri"].as_str().expect("a URI").into(), marks.collect());
    }

    pub fn open(&mut self, uri: &str, text: &str) {
        let document = json!({"uri": uri, "languageId": "plaintext", "version": 1, "text": text});
        self.notify("textDocument/didOpen", &json!({"textDocument": document}));
    }

    pub fn change(&mut self, uri: &str, text: &str) {
        let document = json!({"uri": uri, "version": 2});
        let changes = json!([{"text": text}]);
        self.notify("textDocument/didChange", &json!({"textDocument": document, "contentChanges": changes}));
    }

    pub fn close(&mut self, uri: &str) {
        self.notify("textDocument/didClose", &json!({"textDocument": {"uri": uri}}));
    }

    /// What was said last about a document.
    #[track_caller]
    pub fn marked(&self, uri: &str) -> &[String] {
        &self.marks[uri]
    }
}
