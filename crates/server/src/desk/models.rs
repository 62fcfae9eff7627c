//! What there is to choose from.

use super::catalog::Catalog;
use crate::http::{Answer, Failure, Place, Problem, at};
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

/// The models.
#[utoipa::path(get, path = "/api/models", responses((status = 200, description = "The models", body = [ModelInfo])))]
pub(crate) async fn list() -> Json<Vec<ModelInfo>> {
    Json(MODELS.iter().map(|model| ModelInfo { model: model.name, title: model.title }).collect())
}

/// What a model can do.
#[utoipa::path(
    get,
    path = "/api/models/{model}",
    params(("model" = String, Path, description = "Its name")),
    responses(
        (status = 200, description = "Parameters, commands, pins and all else", body = Catalog),
        (status = 404, description = "There is no such model", body = Problem)
    )
)]
pub(crate) async fn one(place: Place<String>) -> Answer<Json<Catalog>> {
    let name = at(place)?;
    let model = devices::model(&name)
        .ok_or_else(|| Failure::unknown("model", &name, MODELS.iter().map(|model| model.name)))?;
    Ok(Json(Catalog::of(model)))
}
