//! Conversations with the server, as editors have them.

mod ascript;
mod diagnostics;
mod editor;
mod lifecycle;
mod tmcl;
