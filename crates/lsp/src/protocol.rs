//! The types of messages: those that are used of [`gen_lsp_types`], and how a message is read and written.

pub(crate) use gen_lsp_types::json_rpc::{Error, Id, RequestObject, ResponseObject};
pub(crate) use gen_lsp_types::{
    ActiveParameter, Code, CompletionItem, CompletionItemKind, CompletionItemTextEdit, CompletionList,
    CompletionOptions, CompletionRequest, CompletionResponse, ConfigurationItem, ConfigurationParams,
    ConfigurationRequest, Contents, Definition, DefinitionRequest, DefinitionResponse, Diagnostic,
    DiagnosticSeverity, DidChangeConfigurationParams, DidChangeTextDocumentParams,
    DidCloseTextDocumentParams, DidOpenTextDocumentParams, DocumentFormattingRequest, DocumentHighlight,
    DocumentHighlightKind, DocumentHighlightRequest, DocumentSymbol, DocumentSymbolRequest,
    DocumentSymbolResponse, Documentation, ErrorCodes, FoldingRange, FoldingRangeKind, FoldingRangeRequest,
    Full, Hover, HoverRequest, InitializeParams, InitializeResult, InsertTextFormat, Location,
    LspNotificationMethod, LspRequestMethod, MarkupContent, MarkupKind, Message, MessageType,
    ParameterInformation, ParameterInformationLabel, Position, PositionEncodingKind,
    PrepareRenamePlaceholder, PrepareRenameRequest, PrepareRenameResult, PublishDiagnosticsNotification,
    PublishDiagnosticsParams, Range, ReferencesRequest, RenameOptions, RenameProvider, RenameRequest,
    Request, SemanticToken, SemanticTokenModifiers, SemanticTokenTypes, SemanticTokens, SemanticTokensLegend,
    SemanticTokensOptions, SemanticTokensProvider, SemanticTokensRequest, ServerCapabilities, ServerInfo,
    ShowMessageNotification, ShowMessageParams, SignatureHelp, SignatureHelpOptions, SignatureHelpRequest,
    SignatureInformation, SymbolKind, TextDocumentContentChangeEvent, TextDocumentPositionParams,
    TextDocumentSync, TextDocumentSyncKind, TextDocumentSyncOptions, TextEdit, Uri, WorkspaceEdit,
};
use serde_json::Value;

/// What comes in.
pub(crate) enum Incoming {
    /// A request, which wants an answer.
    Request(Id, String, Value),
    /// A notification, which wants none.
    Notification(String, Value),
    /// The answer to a request of the server; `None` if it was refused.
    Response(Id, Option<Value>),
}

/// Reads a message.
pub(crate) fn read(text: &str) -> Result<Incoming, Error> {
    let error = |code, error: serde_json::Error| Error { code, message: error.to_string(), data: None };
    let value: Value = serde_json::from_str(text).map_err(|e| error(ErrorCodes::ParseError, e))?;
    if value.get("method").is_none() {
        let response: ResponseObject =
            serde_json::from_value(value).map_err(|e| error(ErrorCodes::InvalidRequest, e))?;
        return Ok(Incoming::Response(response.id().clone(), response.result().cloned()));
    }
    let request: RequestObject =
        serde_json::from_value(value).map_err(|e| error(ErrorCodes::InvalidRequest, e))?;
    let (method, id, params) = request.into_parts();
    let params = params.unwrap_or_default();
    Ok(match id {
        Some(id) => Incoming::Request(id, method, params),
        None => Incoming::Notification(method, params),
    })
}

/// An error with a sentence.
pub(crate) fn error(code: ErrorCodes, message: impl Into<String>) -> Error {
    Error { code, message: message.into(), data: None }
}

/// A text of Markdown.
pub(crate) fn markdown(value: impl Into<String>) -> MarkupContent {
    MarkupContent { kind: MarkupKind::Markdown, value: value.into() }
}
