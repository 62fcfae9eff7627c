//! What the server tells an editor that it can do.

use crate::{
    answers::legend,
    protocol::{
        CompletionOptions, Full, RenameOptions, RenameProvider, SemanticTokensOptions,
        SemanticTokensProvider, ServerCapabilities, SignatureHelpOptions, TextDocumentSync,
        TextDocumentSyncKind, TextDocumentSyncOptions,
    },
    text::Encoding,
};

/// What the server can do, when characters are counted so.
pub(crate) fn capabilities(encoding: Encoding) -> ServerCapabilities {
    let characters = |list: &[&str]| Some(list.iter().map(|&character| character.to_owned()).collect());
    ServerCapabilities {
        position_encoding: Some(encoding.kind()),
        // A program is a few thousand lines at most: it is sent and read as a whole.
        text_document_sync: Some(TextDocumentSync::Options(TextDocumentSyncOptions {
            open_close: Some(true),
            change: Some(TextDocumentSyncKind::Full),
            ..TextDocumentSyncOptions::default()
        })),
        completion_provider: Some(CompletionOptions {
            trigger_characters: characters(&["#", " ", ",", "="]),
            ..CompletionOptions::default()
        }),
        signature_help_provider: Some(SignatureHelpOptions {
            trigger_characters: characters(&[" ", ",", ":"]),
            ..SignatureHelpOptions::default()
        }),
        hover_provider: Some(true.into()),
        definition_provider: Some(true.into()),
        references_provider: Some(true.into()),
        document_highlight_provider: Some(true.into()),
        document_symbol_provider: Some(true.into()),
        folding_range_provider: Some(true.into()),
        document_formatting_provider: Some(true.into()),
        rename_provider: Some(RenameProvider::RenameOptions(RenameOptions {
            prepare_provider: Some(true),
            ..RenameOptions::default()
        })),
        semantic_tokens_provider: Some(SemanticTokensProvider::SemanticTokensOptions(
            SemanticTokensOptions {
                legend: legend(),
                full: Some(Full::Bool(true)),
                ..SemanticTokensOptions::default()
            },
        )),
        ..ServerCapabilities::default()
    }
}
