//! A controller at the desk, virtual or real.

use super::{
    hold::Holds,
    hub::Hub,
    link::{End, Link, LinkState, Place},
};
use crate::{
    group::Served,
    http::{Answer, Failure},
    unit::Unit,
};
use axum::http::StatusCode;
use devices::{Model, Port};
use host::{Controller, Error, WireError};
use serde::Serialize;
use std::sync::Arc;
use tokio::sync::watch;
use ts_rs::TS;
use utoipa::ToSchema;

/// A controller.
pub(crate) struct Seat {
    /// Its name, unique at the desk.
    pub name: String,
    /// What it is.
    pub model: &'static Model,
    kind: Kind,
    /// The way to it; `None` to a model that nobody knows how to talk to.
    link: Option<Link>,
    /// Those who look at it.
    pub hub: Hub,
    /// Its jogs that somebody holds.
    pub holds: Holds,
}

enum Kind {
    Virtual {
        unit: Arc<Unit>,
        endpoints: Vec<String>,
        /// The threads that serve it, if it came later; they end with the last of its devices.
        served: Option<Arc<Served>>,
    },
    Real {
        place: String,
    },
}

/// A controller in the list.
#[derive(Debug, Serialize, TS, ToSchema)]
pub(crate) struct Summary {
    /// Its name.
    pub name: String,
    /// The name of its model.
    pub model: &'static str,
    /// Its maker's name and what it is.
    pub title: &'static str,
    /// The names of its axes, in its own order.
    pub axis_names: &'static [&'static str],
    /// Whether it is in this process or elsewhere.
    #[ts(type = "\"virtual\" | \"real\"")]
    pub kind: &'static str,
    /// Where others reach it; of a real one, where it is.
    pub endpoints: Vec<String>,
    /// Whether it can be reached.
    pub link: LinkState,
    /// Whether it can be taken from the list.
    pub removable: bool,
}

impl Seat {
    /// A device, with the endpoints and ports at which others reach it.
    pub fn of_unit(
        model: &'static Model,
        unit: Arc<Unit>,
        endpoints: Vec<String>,
        ports: &[Port],
        served: Option<Arc<Served>>,
    ) -> Arc<Self> {
        let end = End::Unit(Arc::clone(&unit), free_port(ports));
        let link = model.name.parse().ok().map(|host| Link::new(end, host, model.guide));
        let name = unit.name.clone();
        Arc::new(Self {
            name,
            model,
            kind: Kind::Virtual { unit, endpoints, served },
            link,
            hub: Hub::default(),
            holds: Holds::default(),
        })
    }

    /// A real controller; `None` if nobody knows how to talk to this model.
    pub fn real(name: String, model: &'static Model, place: Place, address: Option<u8>) -> Option<Arc<Self>> {
        let kind = Kind::Real { place: place.to_string() };
        let link = Link::new(End::Real(place, address.into()), model.name.parse().ok()?, model.guide);
        let (hub, holds) = Default::default();
        let seat = Arc::new(Self { name, model, kind, link: Some(link), hub, holds });
        Hub::attend_always(&seat);
        Some(seat)
    }

    /// The device, which only a virtual controller is.
    ///
    /// # Errors
    /// 409.
    pub fn unit(&self) -> Answer<&Arc<Unit>> {
        match &self.kind {
            Kind::Virtual { unit, .. } => Ok(unit),
            Kind::Real { .. } => {
                let message = format!("`{}` is a real controller: only virtual ones have this", self.name);
                Err(Failure::new(StatusCode::CONFLICT, message))
            }
        }
    }

    /// The device, if it is virtual.
    pub fn device(&self) -> Option<&Arc<Unit>> {
        match &self.kind {
            Kind::Virtual { unit, .. } => Some(unit),
            Kind::Real { .. } => None,
        }
    }

    /// Asks it something over its wire.
    ///
    /// # Errors
    /// What it, or the wire, says.
    pub async fn ask<T>(&self, question: impl AsyncFnOnce(&Controller) -> host::Result<T>) -> Answer<T> {
        let Some(link) = &self.link else {
            let message = format!("nobody knows how to talk to a {}", self.model.name);
            return Err(Failure::new(StatusCode::CONFLICT, message));
        };
        Ok(link.ask(question).await?)
    }

    /// The way to it.
    pub fn link(&self) -> Option<&Link> {
        self.link.as_ref()
    }

    /// Whether it can be reached, and each change of that.
    pub fn link_state(&self) -> watch::Receiver<LinkState> {
        match &self.link {
            Some(link) => link.state(),
            None => watch::Sender::new(LinkState::Connecting).subscribe(),
        }
    }

    /// Whether it may be taken away: it came after the start.
    pub fn is_removable(&self) -> bool {
        match &self.kind {
            Kind::Virtual { served, .. } => served.is_some(),
            Kind::Real { .. } => true,
        }
    }

    /// Nobody needs it any more.
    pub fn close(&self) {
        self.hub.close();
        if let Kind::Virtual { unit, .. } = &self.kind {
            unit.take_away();
        }
    }

    /// Whether the same threads serve another one.
    pub fn shares_threads(&self, other: &Self) -> bool {
        let served = |seat: &Self| match &seat.kind {
            Kind::Virtual { served, .. } => served.as_ref().map(Arc::as_ptr),
            Kind::Real { .. } => None,
        };
        served(self).is_some() && served(self) == served(other)
    }

    /// Its threads end, and its endpoints are closed when it returns, if it came later.
    pub fn end(&self) {
        if let Kind::Virtual { served: Some(served), .. } = &self.kind {
            served.end();
        }
    }

    /// As the list shows it.
    pub fn summary(&self) -> Summary {
        let (kind, endpoints, link) = match &self.kind {
            // A virtual one is there whether somebody talks to it or not, unless it was tried in vain.
            Kind::Virtual { endpoints, .. } => ("virtual", endpoints.clone(), self.state_or_up()),
            Kind::Real { place } => ("real", vec![place.clone()], self.link_state().borrow().clone()),
        };
        Summary {
            name: self.name.clone(),
            model: self.model.name,
            title: self.model.title,
            axis_names: self.model.guide.axes,
            kind,
            endpoints,
            link,
            removable: self.is_removable(),
        }
    }

    fn state_or_up(&self) -> LinkState {
        match self.link_state().borrow().clone() {
            LinkState::Connecting => LinkState::Up,
            state => state,
        }
    }
}

/// The port that nobody else uses, so that what others have half said stays theirs; RS-485 if all are used, where
/// only those listen who are meant.
fn free_port(used: &[Port]) -> Port {
    let candidates = [Port::Rs485, Port::Usb];
    candidates.into_iter().find(|port| !used.contains(port)).unwrap_or(Port::Rs485)
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let status = match &error {
            Error::Wire(WireError::Timeout(_)) => StatusCode::GATEWAY_TIMEOUT,
            Error::Wire(_) | Error::Malformed { .. } | Error::OtherModel { .. } => StatusCode::BAD_GATEWAY,
            Error::NoSuch(_) => StatusCode::NOT_FOUND,
            Error::Unsupported(_) | Error::Interrupted => StatusCode::CONFLICT,
            Error::Refused { .. } | Error::Value(_) => StatusCode::UNPROCESSABLE_ENTITY,
        };
        Self::new(status, error.to_string())
    }
}
