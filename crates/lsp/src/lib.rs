//! The language server for TMCL and A-SCRIPT: what an editor is told about a program while it is typed.
//!
//! A [`Server`] is a state machine without I/O: the text of a message goes in
//! ([Language Server Protocol](https://microsoft.github.io/language-server-protocol/specifications/lsp/3.18/specification/),
//! JSON-RPC), the texts of those that it answers come out. Over standard input and output it serves editors, over a
//! WebSocket a page.
//!
//! What is right and wrong is said by the compilers themselves, and what stands in hover texts and completions by the
//! tables of words, commands and parameters. Nothing about a language is written here a second time.
//!
//! - `server` is the conversation: its phases, the documents that are open, each request.
//! - `program` is what a language has to say about a text; `tmcl` and `ascript` say it.
//! - `answers` says it in the types and units of an editor; `text` counts characters as editors do, `layout` makes
//!   small changes of a new layout, `uri` finds files beside each other.
//! - `protocol` has the types of messages.

mod answers;
mod ascript;
mod capabilities;
mod document;
mod layout;
mod program;
mod protocol;
mod server;
mod text;
mod tmcl;
pub mod uri;

pub use server::{MAX_DOCUMENTS, MAX_TEXT_BYTES, Server};

/// Where files are that no editor has opened: what a source includes.
pub trait Files {
    /// The content of a file; `None` if there is none, or it is not for this one to read.
    fn read(&self, uri: &str) -> Option<Vec<u8>>;
}

/// A world without files.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoFiles;

impl Files for NoFiles {
    fn read(&self, _: &str) -> Option<Vec<u8>> {
        None
    }
}
