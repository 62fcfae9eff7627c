//! A document that an editor has open.

use crate::program::Program;
use source::Source;

/// A document and what is known of it.
pub(crate) struct Document {
    pub(crate) uri: String,
    /// What the editor takes it for.
    pub(crate) language: String,
    pub(crate) version: i32,
    pub(crate) source: Source,
    pub(crate) program: Box<dyn Program>,
}
