//! Conversations with the server, as editors have them.

mod anything;
mod ascript;
mod diagnostics;
mod editor;
mod lifecycle;
mod tmcl;
