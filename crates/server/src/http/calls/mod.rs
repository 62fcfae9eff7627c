//! The calls of virtual devices, a file a topic.

pub mod axes;
pub mod devices;
pub mod faults;
pub mod pins;
pub mod power;

use super::{
    Failure, Site,
    request::{Answer, Body, Place, Shared, at, json, unprocessable},
};
use crate::unit::Unit;
use axum::http::StatusCode;
use serde_json::Value;
use sim::{FaultError, PinError, device::AxisError};
use std::sync::Arc;

impl Site {
    /// The device of this name.
    pub fn unit(&self, name: &str) -> Answer<Arc<Unit>> {
        Ok(Arc::clone(self.desk.find(name)?.unit()?))
    }
}

impl From<PinError> for Failure {
    fn from(error: PinError) -> Self {
        let status = match error {
            PinError::Unknown { .. } => StatusCode::NOT_FOUND,
            _ => StatusCode::UNPROCESSABLE_ENTITY,
        };
        Self::new(status, error.to_string())
    }
}

impl From<AxisError> for Failure {
    fn from(error: AxisError) -> Self {
        let status = match error {
            AxisError::Unknown { .. } | AxisError::NoPulser(_) => StatusCode::NOT_FOUND,
            AxisError::Range => StatusCode::UNPROCESSABLE_ENTITY,
        };
        Self::new(status, error.to_string())
    }
}

impl From<FaultError> for Failure {
    fn from(error: FaultError) -> Self {
        let status = match error {
            FaultError::Unknown(_) => StatusCode::NOT_FOUND,
            FaultError::Wrong(_) | FaultError::TooMany => StatusCode::UNPROCESSABLE_ENTITY,
        };
        Self::new(status, error.to_string())
    }
}

/// A whole number of something; beyond the range it is the last one in it.
fn whole(body: Body, what: &str) -> Answer<i64> {
    let value: Value = json(body)?;
    let number = value.as_f64().filter(|number| number.fract() == 0.0);
    Ok(number.ok_or_else(|| unprocessable(format!("`{value}` is not a number of {what}")))? as i64)
}
