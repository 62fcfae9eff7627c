//! What calls have in common: parts of a request, and what goes wrong with them.

use super::{Failure, Site};
use axum::{
    body::Bytes,
    extract::{
        Path, State,
        rejection::{BytesRejection, PathRejection},
    },
    http::StatusCode,
};
use serde::{Serialize, de::DeserializeOwned};
use std::sync::Arc;
use ts_rs::TS;
use utoipa::ToSchema;

/// What the calls need.
pub(crate) type Shared = State<Arc<Site>>;

/// Names in the path.
pub(crate) type Place<T> = Result<Path<T>, PathRejection>;

/// What was sent.
pub(crate) type Body = Result<Bytes, BytesRejection>;

/// What a call gives.
pub(crate) type Answer<T> = Result<T, Failure>;

/// What a call says that did not do what it should.
#[derive(Debug, Serialize, TS, ToSchema)]
pub(crate) struct Problem {
    /// Why, in a sentence.
    pub error: String,
    /// Who has control, if that is why.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub holder: Option<String>,
}

/// The names in the path.
pub(crate) fn at<T>(place: Place<T>) -> Answer<T> {
    place.map(|Path(place)| place).map_err(|why| Failure::new(why.status(), why.body_text()))
}

/// What was sent, as JSON of some form: 400 if it is no JSON, 422 if it has another form.
pub(crate) fn json<T: DeserializeOwned>(body: Body) -> Answer<T> {
    let bytes = body.map_err(|why| Failure::new(why.status(), why.body_text()))?;
    serde_json::from_slice(&bytes).map_err(|why| {
        if why.is_data() {
            return unprocessable(format!("the body has another form: {why}"));
        }
        Failure::new(StatusCode::BAD_REQUEST, format!("the body is not JSON: {why}"))
    })
}

/// It is understood, and cannot be done.
pub(crate) fn unprocessable(message: impl Into<String>) -> Failure {
    Failure::new(StatusCode::UNPROCESSABLE_ENTITY, message)
}
