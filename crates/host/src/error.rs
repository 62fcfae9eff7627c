//! Why something was not done.

use crate::wire::WireError;
use thiserror::Error;

/// Why a controller did not do what it was asked for.
#[derive(Debug, Error)]
pub enum Error {
    /// There was no reply.
    #[error(transparent)]
    Wire(#[from] WireError),
    /// The controller refused.
    #[error("`{request}` is refused: {words}")]
    Refused {
        /// The request, as people write it.
        request: String,
        /// The controller's own words, or those of its status.
        words: String,
    },
    /// The reply is not one to this request.
    #[error("`{reply}` is no reply to `{request}`")]
    Malformed {
        /// The request, as people write it.
        request: String,
        /// What came, as text or bytes.
        reply: String,
    },
    /// This controller cannot do that at all.
    #[error("this controller has no {0}")]
    Unsupported(&'static str),
    /// There is no such parameter, axis or output.
    #[error("this controller has no `{0}`")]
    NoSuch(String),
    /// A value is not of the kind that is needed, or is out of range before it could be sent.
    #[error("{0}")]
    Value(String),
    /// Everything was stopped meanwhile, and so was this.
    #[error("everything was stopped meanwhile")]
    Interrupted,
    /// Somebody else answers.
    #[error("a {found} answers")]
    OtherModel {
        /// Who it says it is.
        found: String,
    },
}

/// What comes of asking a controller.
pub type Result<T, E = Error> = core::result::Result<T, E>;
