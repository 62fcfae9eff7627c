//! Conversations with the server, as editors have them.

mod diagnostics;
mod editor;
mod lifecycle;
