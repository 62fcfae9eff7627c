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

/// A document with a `|` where the cursor is, and its editor.
pub struct Cursor {
    pub editor: Editor,
    uri: &'static str,
    /// Where.
    params: Value,
}

impl Cursor {
    #[track_caller]
    pub fn new(model: Option<&str>, uri: &'static str, text: &str) -> Self {
        Self::with(Editor::new(model), uri, text)
    }

    #[track_caller]
    pub fn with(mut editor: Editor, uri: &'static str, text: &str) -> Self {
        let (before, after) = text.split_once('|').expect("a cursor");
        editor.open(uri, &[before, after].concat());
        let line = before.matches('\n').count();
        let start = before.rfind('\n').map_or(0, |end| end + 1);
        let character = before[start..].encode_utf16().count();
        let params =
            json!({"textDocument": {"uri": uri}, "position": {"line": line, "character": character}});
        Self { editor, uri, params }
    }

    /// Asks about the cursor's place.
    pub fn ask(&mut self, method: &str, more: Value) -> Value {
        let mut params = self.params.clone();
        params.as_object_mut().expect("an object").extend(more.as_object().expect("an object").clone());
        self.editor.request(&format!("textDocument/{method}"), &params)
    }

    /// What is proposed, as `label -> new text`, and the detail behind it.
    pub fn proposals(&mut self) -> Vec<String> {
        let list = self.ask("completion", json!({}));
        let items = list["items"].as_array().expect("a list").iter().map(|item| {
            let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
            let (label, new) = (text(&item["label"]), text(&item["textEdit"]["newText"]));
            let new = if label == new { String::new() } else { format!(" -> {new}") };
            let detail = text(&item["detail"]);
            let detail = if detail.is_empty() { detail } else { format!(" ({detail})") };
            format!("{label}{new}{detail}")
        });
        items.collect()
    }

    /// What there is to say.
    pub fn hover(&mut self) -> Option<String> {
        let hover = self.ask("hover", json!({}));
        Some(hover["contents"]["value"].as_str()?.to_owned())
    }

    /// The form of a command, with its active parameter in `«»`.
    pub fn signature(&mut self) -> Option<String> {
        let help = self.ask("signatureHelp", json!({}));
        let label = help["signatures"][0]["label"].as_str()?;
        let active =
            &help["signatures"][0]["parameters"][help["activeParameter"].as_u64()? as usize]["label"];
        let Some((start, end)) = active[0].as_u64().zip(active[1].as_u64()) else {
            return Some(label.into());
        };
        let (start, end) = (start as usize, end as usize);
        Some(format!("{}«{}»{}", &label[..start], &label[start..end], &label[end..]))
    }

    /// Places as `name line:character`, of other documents than the cursor's.
    pub fn places(&mut self, method: &str, more: Value) -> Vec<String> {
        let found = self.ask(method, more);
        let Some(found) = found.as_array() else { return Vec::new() };
        let places = found.iter().map(|place| {
            let start = &place["range"]["start"];
            let uri = place["uri"].as_str().unwrap_or(self.uri);
            let file = if uri == self.uri { "" } else { uri.rsplit('/').next().expect("a name") };
            format!("{file}{}:{}", start["line"], start["character"])
        });
        places.collect()
    }

    /// The text after a renaming, or why there is none.
    pub fn renamed(&mut self, text: &str, to: &str) -> Result<String, String> {
        let edit = self.ask("rename", json!({"newName": to}));
        match edit["changes"].get(self.uri) {
            Some(edits) => Ok(apply(&text.replace('|', ""), edits)),
            None => Err(edit["message"].as_str().expect("a reason").into()),
        }
    }

    /// The result of a question about the whole document.
    pub fn whole(&mut self, method: &str) -> Value {
        let params =
            json!({"textDocument": {"uri": self.uri}, "options": {"tabSize": 4, "insertSpaces": true}});
        self.editor.request(&format!("textDocument/{method}"), &params)
    }
}

/// A text after some changes. Its lines end with a line feed, and it is ASCII.
pub fn apply(text: &str, edits: &Value) -> String {
    let offset = |place: &Value| {
        let number = |key: &str| place[key].as_u64().expect("a number") as usize;
        text.split_inclusive('\n').take(number("line")).map(str::len).sum::<usize>() + number("character")
    };
    let edits = edits.as_array().expect("a list").iter().map(|edit| {
        let range = &edit["range"];
        (offset(&range["start"])..offset(&range["end"]), edit["newText"].as_str().expect("a text"))
    });
    let mut edits: Vec<_> = edits.collect();
    edits.sort_by_key(|(range, _)| range.start);
    let mut text = text.to_owned();
    for (range, new) in edits.into_iter().rev() {
        text.replace_range(range, new);
    }
    text
}

/// The coloured pieces of a text, as `text kind`, with a `*` where something is defined.
pub fn colours(editor: &mut Editor, uri: &str, text: &str) -> Vec<String> {
    let hello = editor.request("textDocument/semanticTokens/full", &json!({"textDocument": {"uri": uri}}));
    let legend = lsp_legend();
    let (mut line, mut character) = (0, 0);
    let numbers: Vec<usize> = hello["data"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|n| n.as_u64().expect("a number") as usize)
        .collect();
    let lines: Vec<Vec<u16>> = text.lines().map(|line| line.encode_utf16().collect()).collect();
    numbers
        .chunks(5)
        .map(|token| {
            character = if token[0] == 0 { character + token[1] } else { token[1] };
            line += token[0];
            let piece = String::from_utf16_lossy(&lines[line][character..character + token[2]]);
            format!("{piece} {}{}", legend[token[3]], if token[4] & 1 == 1 { "*" } else { "" })
        })
        .collect()
}

/// Names of kinds of pieces, as the server tells them.
fn lsp_legend() -> Vec<String> {
    let mut server = Server::new(None, Box::new(NoFiles));
    let params = json!({"processId": null, "rootUri": null, "capabilities": {}});
    let hello = json!({"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": params});
    let answer: Value = serde_json::from_str(&server.handle(&hello.to_string())[0]).expect("JSON");
    let types = &answer["result"]["capabilities"]["semanticTokensProvider"]["legend"]["tokenTypes"];
    types.as_array().expect("a list").iter().map(|name| name.as_str().expect("a name").into()).collect()
}
