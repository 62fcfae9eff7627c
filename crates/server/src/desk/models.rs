//! What there is to choose from.

use super::catalog::Catalog;
use crate::http::{Answer, Failure, Place, at};
use axum::Json;
use devices::MODELS;
use serde::Serialize;
use sim::fault::KINDS;
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

/// A kind of fault that virtual controllers can be given.
#[derive(Debug, Serialize, TS, ToSchema)]
pub(crate) struct FaultKind {
    /// Its name.
    pub name: &'static str,
    /// What it does.
    pub text: &'static str,
    /// The keys that it must have, beside those of every fault.
    pub needs: &'static [&'static str],
    /// The keys that it may have.
    pub may: &'static [&'static str],
    /// Whether it lasts, so that it can have a `duration`.
    pub lasts: bool,
}

/// The kinds of faults
#[utoipa::path(get, path = "/api/faults", tag = "faults", responses((status = 200, body = [FaultKind])))]
pub(crate) async fn fault_kinds() -> Json<Vec<FaultKind>> {
    let kind = |row: &sim::fault::KindRow| FaultKind {
        name: row.name,
        text: row.text,
        needs: row.needs,
        may: row.may,
        lasts: row.lasts,
    };
    Json(KINDS.iter().map(kind).collect())
}
