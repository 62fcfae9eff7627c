//! The conversation: its phases, the documents that are open, and what each message asks for.

use crate::{
    Files,
    answers::Asked,
    capabilities::capabilities,
    document::Document,
    program::{self, Surroundings, Tongue},
    protocol::{
        CompletionRequest, ConfigurationItem, ConfigurationParams, ConfigurationRequest, DefinitionRequest,
        Diagnostic, DidChangeConfigurationParams, DidChangeTextDocumentParams, DidCloseTextDocumentParams,
        DidOpenTextDocumentParams, DocumentFormattingRequest, DocumentHighlightRequest,
        DocumentSymbolRequest, Error, ErrorCodes, FoldingRangeRequest, HoverRequest, Id, Incoming,
        InitializeParams, InitializeResult, LspNotificationMethod, LspRequestMethod, MessageType,
        PrepareRenameRequest, PublishDiagnosticsNotification, PublishDiagnosticsParams, ReferencesRequest,
        RenameRequest, Request, RequestObject, ResponseObject, SemanticTokensRequest, ServerInfo,
        ShowMessageNotification, ShowMessageParams, SignatureHelpRequest, TextDocumentContentChangeEvent,
        TextDocumentPositionParams, Uri, error, read,
    },
    text::Encoding,
    uri,
};
use devices::{MODELS, Model};
use serde_json::{Value, json};
use source::Source;
use std::collections::BTreeMap;

/// Most documents that are open at a time; what is opened beyond is not looked at.
pub const MAX_DOCUMENTS: usize = 64;

/// Most bytes that they have together; what goes beyond is not looked at.
pub const MAX_TEXT_BYTES: usize = 4 << 20;

/// The section of an editor's settings that is ours.
const SECTION: &str = "pulsetrain";

/// Number of the one request that the server makes.
const ASKED: Id = Id::Number(1);

/// How far the conversation is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    /// Nobody has said hello.
    New,
    Running,
    /// The editor has said that it will leave.
    Closing,
    /// It has left.
    Over,
}

/// A language server in a conversation with one editor.
pub struct Server {
    phase: Phase,
    /// Whether the editor left without saying that it would.
    abrupt: bool,
    files: Box<dyn Files + Send>,
    /// The model that programs are for, if the editor says nothing.
    default_model: Option<&'static Model>,
    model: Option<&'static Model>,
    encoding: Encoding,
    /// Whether the editor knows texts with places to be filled in.
    snippets: bool,
    /// Whether the editor can be asked for its settings.
    has_settings: bool,
    documents: BTreeMap<String, Document>,
    out: Vec<String>,
}

impl Server {
    /// A server for programs of a model; without one, a program is taken for one of the first model whose programs
    /// look like it. `files` has what sources include.
    pub fn new(model: Option<&'static Model>, files: Box<dyn Files + Send>) -> Self {
        Self {
            phase: Phase::New,
            abrupt: false,
            files,
            default_model: model,
            model,
            encoding: Encoding::default(),
            snippets: false,
            has_settings: false,
            documents: BTreeMap::new(),
            out: Vec::new(),
        }
    }

    /// Whether the editor has left, so that nothing more will be answered.
    pub fn is_over(&self) -> bool {
        self.phase == Phase::Over
    }

    /// Whether it left without saying that it would, for which a program's exit status is 1.
    pub fn is_abrupt(&self) -> bool {
        self.abrupt
    }

    /// Takes the text of a message, and gives those of the messages that follow from it, in order. What is no
    /// message is answered with an error.
    pub fn handle(&mut self, text: &str) -> Vec<String> {
        if !self.is_over() {
            match read(text) {
                Err(error) => self.send(&ResponseObject::from_error(Id::Null, error)),
                Ok(Incoming::Request(id, method, params)) => {
                    let answer = self.request(&method, params);
                    self.answer(id, answer);
                }
                Ok(Incoming::Notification(method, params)) => self.notification(&method, params),
                Ok(Incoming::Response(id, result)) if id == ASKED => self.configure(result.as_ref()),
                Ok(Incoming::Response(..)) => (),
            }
        }
        std::mem::take(&mut self.out)
    }

    fn send(&mut self, message: &impl serde::Serialize) {
        self.out.push(serde_json::to_string(message).expect("our own messages are JSON"));
    }

    fn answer(&mut self, id: Id, answer: Result<Value, Error>) {
        match answer {
            Ok(result) => self.send(&json!({"jsonrpc": "2.0", "id": id, "result": result})),
            Err(error) => self.send(&ResponseObject::from_error(id, error)),
        }
    }

    fn request(&mut self, method: &str, params: Value) -> Result<Value, Error> {
        use LspRequestMethod as Method;
        let method = Method::from(method);
        match (self.phase, &method) {
            (Phase::New, Method::Initialize) => value(&self.initialize(&typed(params)?)),
            (Phase::New, _) => Err(error(ErrorCodes::ServerNotInitialized, "`initialize` comes first")),
            (Phase::Running, Method::Shutdown) => {
                self.phase = Phase::Closing;
                Ok(Value::Null)
            }
            (Phase::Running, _) => self.question(&method, params),
            _ => Err(error(ErrorCodes::InvalidRequest, "nothing comes after `shutdown`")),
        }
    }

    /// A question about a document. One that is not open is answered with nothing.
    fn question(&self, method: &LspRequestMethod<'_>, params: Value) -> Result<Value, Error> {
        use LspRequestMethod as Method;
        match method {
            Method::TextDocumentCompletion => query::<CompletionRequest>(params, |params| {
                let (asked, at) = self.at(&params.text_document_position_params)?;
                Some(asked.completion(at))
            }),
            Method::TextDocumentHover => query::<HoverRequest>(params, |params| {
                let (asked, at) = self.at(&params.text_document_position_params)?;
                asked.hover(at)
            }),
            Method::TextDocumentSignatureHelp => query::<SignatureHelpRequest>(params, |params| {
                let (asked, at) = self.at(&params.text_document_position_params)?;
                asked.signature(at)
            }),
            Method::TextDocumentDefinition => query::<DefinitionRequest>(params, |params| {
                let (asked, at) = self.at(&params.text_document_position_params)?;
                asked.definition(at)
            }),
            Method::TextDocumentReferences => query::<ReferencesRequest>(params, |params| {
                let (asked, at) = self.at(&params.text_document_position_params)?;
                asked.references(at, params.context.include_declaration)
            }),
            Method::TextDocumentDocumentHighlight => query::<DocumentHighlightRequest>(params, |params| {
                let (asked, at) = self.at(&params.text_document_position_params)?;
                asked.highlights(at)
            }),
            Method::TextDocumentPrepareRename => query::<PrepareRenameRequest>(params, |params| {
                let (asked, at) = self.at(&params.text_document_position_params)?;
                asked.prepare_rename(at)
            }),
            Method::TextDocumentRename => {
                let params: <RenameRequest as Request>::Params = typed(params)?;
                let Some((asked, at)) = self.at(&params.text_document_position_params) else {
                    return Ok(Value::Null);
                };
                let edit = asked.rename(at, &params.new_name);
                value(&edit.map_err(|message| error(ErrorCodes::InvalidParams, message))?)
            }
            Method::TextDocumentDocumentSymbol => query::<DocumentSymbolRequest>(params, |params| {
                Some(self.asked(&params.text_document.uri)?.symbols())
            }),
            Method::TextDocumentFoldingRange => query::<FoldingRangeRequest>(params, |params| {
                Some(self.asked(&params.text_document.uri)?.folds())
            }),
            Method::TextDocumentSemanticTokensFull => query::<SemanticTokensRequest>(params, |params| {
                Some(self.asked(&params.text_document.uri)?.tokens())
            }),
            Method::TextDocumentFormatting => query::<DocumentFormattingRequest>(params, |params| {
                self.asked(&params.text_document.uri)?.formatting()
            }),
            _ => Err(error(ErrorCodes::MethodNotFound, format!("there is no `{method}` here"))),
        }
    }

    fn asked(&self, uri: &Uri) -> Option<Asked<'_>> {
        let document = self.documents.get(&uri.0)?;
        Some(Asked { document, encoding: self.encoding, snippets: self.snippets })
    }

    /// A document, and the byte of a position in it.
    fn at(&self, params: &TextDocumentPositionParams) -> Option<(Asked<'_>, usize)> {
        let asked = self.asked(&params.text_document.uri)?;
        Some((asked, self.encoding.offset(&asked.document.source, params.position)))
    }

    fn notification(&mut self, method: &str, params: Value) {
        use LspNotificationMethod as Method;
        let method = Method::from(method);
        match (self.phase, method) {
            (phase, Method::Exit) => {
                self.abrupt = phase != Phase::Closing;
                self.phase = Phase::Over;
            }
            (Phase::Running, Method::Initialized) => self.ask_for_settings(),
            (Phase::Running, Method::WorkspaceDidChangeConfiguration) => {
                if let Ok(DidChangeConfigurationParams { settings }) = typed(params) {
                    match settings.get(SECTION) {
                        Some(settings) => self.configure(Some(&json!([settings]))),
                        None => self.ask_for_settings(),
                    }
                }
            }
            (Phase::Running, Method::TextDocumentDidOpen) => {
                typed(params).map_or((), |params| self.open(params))
            }
            (Phase::Running, Method::TextDocumentDidChange) => {
                typed(params).map_or((), |params| self.change(params))
            }
            (Phase::Running, Method::TextDocumentDidClose) => {
                typed(params).map_or((), |params| self.close(&params))
            }
            _ => (),
        }
    }

    fn initialize(&mut self, params: &InitializeParams) -> InitializeResult {
        self.phase = Phase::Running;
        let chosen = params.initialization_options.as_ref().and_then(|options| self.chosen(options));
        self.default_model = chosen.or(self.default_model);
        self.model = self.default_model;
        let client = &params.capabilities;
        let offered = client.general.as_ref().and_then(|general| general.position_encodings.as_deref());
        self.encoding = Encoding::choose(offered.unwrap_or_default());
        let completion = client.text_document.as_ref().and_then(|document| document.completion.as_ref());
        let item = completion.and_then(|completion| completion.completion_item.as_ref());
        self.snippets = item.and_then(|item| item.snippet_support).unwrap_or(false);
        self.has_settings =
            client.workspace.as_ref().and_then(|workspace| workspace.configuration).unwrap_or(false);
        InitializeResult {
            capabilities: capabilities(self.encoding),
            server_info: Some(ServerInfo {
                name: "pulsetrain".into(),
                version: Some(env!("CARGO_PKG_VERSION").into()),
            }),
        }
    }

    fn ask_for_settings(&mut self) {
        if self.has_settings {
            let items = vec![ConfigurationItem { scope_uri: None, section: Some(SECTION.into()) }];
            let request =
                RequestObject::from_request::<ConfigurationRequest>(ASKED, ConfigurationParams { items });
            self.send(&request);
        }
    }

    /// Takes up the editor's settings: a list of one.
    fn configure(&mut self, settings: Option<&Value>) {
        if let Some(settings) =
            settings.and_then(|settings| settings.get(0)).filter(|value| value.is_object())
        {
            self.model = self.chosen(settings).or(self.default_model);
            self.read_again(|_| true);
        }
    }

    /// The model that settings name, if there is such a one; if not, that is said.
    fn chosen(&mut self, settings: &Value) -> Option<&'static Model> {
        let name = settings.get("model").and_then(Value::as_str).filter(|name| !name.is_empty())?;
        let found = MODELS.iter().find(|model| model.name == name);
        if found.is_none() {
            let known: Vec<_> = MODELS.iter().map(|model| model.name).collect();
            let message = format!("unknown model `{name}`, known: {}", known.join(", "));
            let params = ShowMessageParams { kind: MessageType::Warning, message };
            self.send(&RequestObject::from_notification::<ShowMessageNotification>(params));
        }
        found
    }

    fn open(&mut self, params: DidOpenTextDocumentParams) {
        let item = params.text_document;
        self.read(item.uri.0, item.language_id.to_string(), item.version, &item.text);
    }

    fn change(&mut self, params: DidChangeTextDocumentParams) {
        let uri = params.text_document.text_document_identifier.uri.0;
        let Some(document) = self.documents.get(&uri) else { return };
        let language = document.language.clone();
        // The editor was told that changes are whole texts.
        let Some(TextDocumentContentChangeEvent::TextDocumentContentChangeWholeDocument(change)) =
            params.content_changes.into_iter().last()
        else {
            return;
        };
        self.read(uri, language, params.text_document.version, &change.text);
    }

    fn close(&mut self, params: &DidCloseTextDocumentParams) {
        let uri = &params.text_document.uri.0;
        if self.documents.remove(uri).is_some() {
            self.publish(uri, None, Vec::new());
            let uri = uri.clone();
            self.read_again(|document| document.includes(&uri));
        }
    }

    /// Reads a document, says what there is to say about it, and about those that include it.
    fn read(&mut self, uri: String, language: String, version: i32, text: &str) {
        self.documents.remove(&uri);
        let others: usize = self.documents.values().map(|document| document.source.text.len()).sum();
        if self.documents.len() == MAX_DOCUMENTS || others + text.len() > MAX_TEXT_BYTES {
            return self.publish(&uri, None, Vec::new());
        }
        let source = Source::new(uri.clone(), text.as_bytes());
        self.understand(uri.clone(), language, version, source);
        self.read_again(|document| document.includes(&uri));
    }

    fn understand(&mut self, uri: String, language: String, version: i32, source: Source) {
        let tongue = Tongue::of(&uri, &language, self.model);
        let around = Surroundings { documents: &self.documents, files: &*self.files };
        let program = program::read(&source, tongue, &around);
        let document = Document { uri: uri.clone(), language, version, source, program };
        let asked = Asked { document: &document, encoding: self.encoding, snippets: self.snippets };
        let diagnostics = asked.diagnostics();
        self.publish(&uri, Some(version), diagnostics);
        self.documents.insert(uri, document);
    }

    fn read_again(&mut self, which: impl Fn(&Document) -> bool) {
        let uris: Vec<_> = self
            .documents
            .values()
            .filter(|document| which(document))
            .map(|document| document.uri.clone())
            .collect();
        for uri in uris {
            if let Some(Document { uri, language, version, source, .. }) = self.documents.remove(&uri) {
                self.understand(uri, language, version, source);
            }
        }
    }

    fn publish(&mut self, uri: &str, version: Option<i32>, diagnostics: Vec<Diagnostic>) {
        let params = PublishDiagnosticsParams { uri: Uri(uri.to_owned()), version, diagnostics };
        self.send(&RequestObject::from_notification::<PublishDiagnosticsNotification>(params));
    }
}

impl Document {
    fn includes(&self, uri: &str) -> bool {
        self.program.includes().iter().any(|include| uri::same(include, uri))
    }
}

/// Answers a question of this type.
fn query<R: Request>(params: Value, answer: impl FnOnce(R::Params) -> R::Result) -> Result<Value, Error> {
    value(&answer(typed(params)?))
}

/// The parameters of a message.
fn typed<T: serde::de::DeserializeOwned>(params: Value) -> Result<T, Error> {
    serde_json::from_value(params).map_err(|wrong| error(ErrorCodes::InvalidParams, wrong.to_string()))
}

fn value(result: &impl serde::Serialize) -> Result<Value, Error> {
    serde_json::to_value(result).map_err(|wrong| error(ErrorCodes::InternalError, wrong.to_string()))
}
