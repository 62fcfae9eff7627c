//! The controllers at the desk: those that were there from the start, and those that came.

use super::{
    link::Place,
    seat::{Seat, Summary},
};
use crate::{
    Error,
    group::{Group, Served},
    http::{Answer, Failure},
    images::Images,
    random_seed,
};
use axum::http::StatusCode;
use devices::Model;
use host::Action;
use sim::{DeviceConfig, VirtualDevice};
use std::{
    num::NonZero,
    sync::{Arc, PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard},
};

/// Most controllers that may come: those on one bus share a thread, others have one each.
const MAX_ADDED: usize = 100;

/// All controllers.
pub(crate) struct Desk {
    seats: RwLock<Vec<Arc<Seat>>>,
    /// Seconds of device time a second of wall clock.
    speed: f64,
    images: Images,
}

/// Why a controller does not come, or go.
#[derive(Debug, thiserror::Error)]
pub(crate) enum DeskError {
    /// Its name is taken.
    #[error("there is a controller `{0}` already")]
    Taken(String),
    /// There are too many.
    #[error("no more than {MAX_ADDED} controllers can be added")]
    TooMany,
    /// It was there from the start.
    #[error("`{0}` was there from the start and stays")]
    Stays(String),
    /// Nobody knows how to talk to it.
    #[error("nobody knows how to talk to a {0}")]
    Unknown(&'static str),
    /// The device does not start.
    #[error(transparent)]
    Start(#[from] Error),
}

impl From<DeskError> for Failure {
    fn from(error: DeskError) -> Self {
        let status = match error {
            DeskError::Taken(_) | DeskError::TooMany | DeskError::Stays(_) => StatusCode::CONFLICT,
            DeskError::Unknown(_) | DeskError::Start(_) => StatusCode::UNPROCESSABLE_ENTITY,
        };
        Self::new(status, error.to_string())
    }
}

impl Desk {
    /// A desk with these controllers.
    pub fn new(seats: Vec<Arc<Seat>>, speed: f64, images: Images) -> Self {
        Self { seats: RwLock::new(seats), speed, images }
    }

    /// The controller of this name.
    ///
    /// # Errors
    /// There is none.
    pub fn find(&self, name: &str) -> Answer<Arc<Seat>> {
        let seats = self.seats();
        let found = seats.iter().find(|seat| seat.name == name);
        found
            .cloned()
            .ok_or_else(|| Failure::unknown("device", name, seats.iter().map(|seat| seat.name.as_str())))
    }

    /// All of them, as the list shows them.
    pub fn summaries(&self) -> Vec<Summary> {
        self.seats().iter().map(|seat| seat.summary()).collect()
    }

    /// Switches devices on; those that share a bus share a thread. Either all of them come or none.
    ///
    /// # Errors
    /// [`DeskError`].
    pub fn add_devices(&self, devices: &[DeviceConfig]) -> Result<Vec<Summary>, DeskError> {
        let mut seats = self.seats_mut();
        check_room(&seats, devices.iter().map(|device| device.name.as_str()))?;
        let mut added = Vec::new();
        for devices in groups(devices) {
            added.extend(self.start(&devices)?);
        }
        let summaries = added.iter().map(|seat| seat.summary()).collect();
        seats.extend(added);
        Ok(summaries)
    }

    fn start(&self, devices: &[DeviceConfig]) -> Result<Vec<Arc<Seat>>, Error> {
        let mut group = Group::open(devices, NonZero::new(1))?;
        let seed = random_seed();
        let mut started = Vec::new();
        for (number, config) in devices.iter().enumerate() {
            let flash = self.images.load(config)?;
            let unit = group.add(VirtualDevice::with_flash(config, flash, seed), self.speed);
            started.push((config.model, unit, group.endpoints(number), group.ports(number)));
        }
        let served = Arc::new(Served::begin(group)?);
        let seat = |(model, unit, endpoints, ports): (_, _, _, Vec<_>)| {
            Seat::of_unit(model, unit, endpoints, &ports, Some(Arc::clone(&served)))
        };
        Ok(started.into_iter().map(seat).collect())
    }

    /// Connects a real controller. Whether it is there shows in its state.
    ///
    /// # Errors
    /// [`DeskError`].
    pub fn add_real(
        &self,
        name: String,
        model: &'static Model,
        place: Place,
        address: Option<u8>,
    ) -> Result<Summary, DeskError> {
        let mut seats = self.seats_mut();
        check_room(&seats, [name.as_str()])?;
        let seat = Seat::real(name, model, place, address).ok_or(DeskError::Unknown(model.name))?;
        let summary = seat.summary();
        seats.push(seat);
        Ok(summary)
    }

    /// Takes a controller away that came after the start. What a device has in flash is on disk then.
    ///
    /// # Errors
    /// There is none of this name, or it stays.
    pub fn remove(&self, name: &str) -> Answer<()> {
        let seat = self.find(name)?;
        if !seat.is_removable() {
            return Err(DeskError::Stays(name.into()).into());
        }
        seat.close();
        let mut seats = self.seats_mut();
        seats.retain(|it| !Arc::ptr_eq(it, &seat));
        if !seats.iter().any(|it| it.shares_threads(&seat)) {
            seat.end();
        }
        drop(seats);
        if seat.device().is_some() {
            self.images.forget(name).map_err(|error| DeskError::Start(error.into()))?;
        }
        Ok(())
    }

    /// Stops the axes whose jogs somebody holds: nobody will hear any more that he does.
    pub async fn stop_held(&self) {
        let seats = self.seats().clone();
        for seat in seats {
            for axis in seat.holds.axes() {
                // Who does not answer now cannot be told later.
                let _ = seat.ask(async |it| it.act(&Action::Stop { axis: Some(axis) }).await).await;
            }
        }
    }

    /// Takes all away that came after the start.
    pub fn close(&self) {
        for seat in self.seats_mut().drain(..) {
            seat.close();
            seat.end();
        }
    }

    fn seats(&self) -> RwLockReadGuard<'_, Vec<Arc<Seat>>> {
        self.seats.read().unwrap_or_else(PoisonError::into_inner)
    }

    fn seats_mut(&self) -> RwLockWriteGuard<'_, Vec<Arc<Seat>>> {
        self.seats.write().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Whether controllers of these names may come.
fn check_room<'a>(seats: &[Arc<Seat>], names: impl IntoIterator<Item = &'a str>) -> Result<(), DeskError> {
    let mut room = MAX_ADDED.saturating_sub(seats.iter().filter(|seat| seat.is_removable()).count());
    for name in names {
        if seats.iter().any(|seat| seat.name == name) {
            return Err(DeskError::Taken(name.into()));
        }
        room = room.checked_sub(1).ok_or(DeskError::TooMany)?;
    }
    Ok(())
}

/// Devices that have to be served together, because they share endpoints.
fn groups(devices: &[DeviceConfig]) -> Vec<Vec<DeviceConfig>> {
    let mut groups: Vec<Vec<DeviceConfig>> = Vec::new();
    for device in devices {
        let shares = |other: &DeviceConfig| {
            device.listen.iter().any(|it| it.can_be_shared() && other.listen.contains(it))
        };
        let (together, mut apart): (Vec<_>, Vec<_>) =
            groups.into_iter().partition(|group| group.iter().any(shares));
        let mut group: Vec<_> = together.into_iter().flatten().collect();
        group.push(device.clone());
        apart.push(group);
        groups = apart;
    }
    groups
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn devices_on_a_bus_belong_together() {
        let device = |name: &str, listen: &[&str]| DeviceConfig {
            name: name.into(),
            listen: listen.iter().map(|it| it.parse().unwrap()).collect(),
            ..DeviceConfig::new(&devices::MODELS[0])
        };
        let all = [
            device("a", &["tcp:h:1"]),
            device("b", &["tcp:h:2"]),
            device("c", &["tcp:h:0"]),
            device("d", &["tcp:h:0"]),
            device("e", &["tcp:h:2", "tcp:h:1"]),
            device("f", &[]),
        ];
        let names: Vec<Vec<_>> = groups(&all)
            .iter()
            .map(|group| group.iter().map(|device| device.name.clone()).collect())
            .collect();
        assert_eq!(names, [vec!["c"], vec!["d"], vec!["a", "b", "e"], vec!["f"]]);
    }
}
