//! What there is to choose from.

use super::catalog::Catalog;
use crate::http::{Answer, Failure, Place, at};
use axum::Json;
use devices::MODELS;
use serde::Serialize;
use ts_rs::TS;
use utoipa::ToSchema;

/// An entry of the list of models.
#[derive(Debug, Serialize, TS, ToSchema)]
pub(crate) struct ModelInfo {
    /// Its name.
    pub model: &'static str,
    /// Its maker's name and what it is.
    pub title: &'static str,
}

/// The models
#[utoipa::path(get, path = "/api/models", tag = "models", responses((status = 200, body = [ModelInfo])))]
pub(crate) async fn list() -> Json<Vec<ModelInfo>> {
    Json(MODELS.iter().map(|model| ModelInfo { model: model.name, title: model.title }).collect())
}

/// What a model can do
#[utoipa::path(get, path = "/api/models/{model}", tag = "models", responses((status = 200, body = Catalog)))]
pub(crate) async fn one(place: Place<String>) -> Answer<Json<Catalog>> {
    let name = at(place)?;
    let model = devices::model(&name)
        .ok_or_else(|| Failure::unknown("model", &name, MODELS.iter().map(|model| model.name)))?;
    Ok(Json(Catalog::of(model)))
}
