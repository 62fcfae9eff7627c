//! Devices that begin together: their endpoints, and the threads that serve them.

use crate::{
    Error,
    endpoint::{Door, Line},
    stop::Stop,
    unit::Unit,
    worker::Workers,
};
use devices::Port;
use sim::{Bus, DeviceConfig, Endpoint, VirtualDevice};
use std::{
    mem,
    num::NonZero,
    sync::{Arc, Mutex, PoisonError},
    thread::{self, JoinHandle},
};

/// Devices whose endpoints are open, and which nobody serves yet.
pub(crate) struct Group {
    devices: Vec<DeviceConfig>,
    buses: Vec<Bus>,
    doors: Vec<Door>,
    workers: Workers,
    units: Vec<Arc<Unit>>,
}

impl Group {
    /// Opens the endpoints of these devices, to be served by so many threads: one for each processor without a
    /// number, and never more than endpoints.
    ///
    /// # Errors
    /// An endpoint cannot be opened, or is nothing for its device.
    pub fn open(devices: &[DeviceConfig], workers: Option<NonZero<usize>>) -> Result<Self, Error> {
        for (index, device) in devices.iter().enumerate() {
            for endpoint in &device.listen {
                let place = device.fits(endpoint, &devices[..index]);
                place.map_err(|source| Error::Place { endpoint: endpoint.to_string(), source })?;
            }
        }
        let buses = sim::buses(devices);
        let open = |bus: &Bus| {
            let door = Door::open(&bus.endpoint);
            door.map_err(|source| Error::Listen { endpoint: bus.endpoint.to_string(), source })
        };
        let doors = buses.iter().map(open).collect::<Result<Vec<_>, _>>()?;
        let workers = Workers::new(workers, buses.len())?;
        Ok(Self { devices: devices.to_vec(), buses, doors, workers, units: Vec::new() })
    }

    /// Switches the next device on, in the order of the devices.
    pub fn add(&mut self, device: VirtualDevice, speed: f64) -> Arc<Unit> {
        let number = self.units.len();
        let config = &self.devices[number];
        let home = self.buses.iter().position(|bus| bus.members.contains(&number));
        let unit = self.workers.add_unit(home, |alarm| Unit::new(config, device, speed, alarm));
        self.units.push(Arc::clone(&unit));
        unit
    }

    /// The endpoints of a device with their real ports, in the order in which it names them.
    pub fn endpoints(&self, number: usize) -> Vec<String> {
        let listen = &self.devices[number].listen;
        let mut own: Vec<_> =
            self.buses.iter().zip(&self.doors).filter(|(bus, _)| bus.members.contains(&number)).collect();
        own.sort_by_key(|(bus, _)| listen.iter().position(|endpoint| *endpoint == bus.endpoint));
        own.into_iter().map(|(bus, door)| door.name(&bus.endpoint)).collect()
    }

    /// The ports that a device is connected by.
    pub fn ports(&self, number: usize) -> Vec<Port> {
        self.buses.iter().filter(|bus| bus.members.contains(&number)).map(port).collect()
    }

    /// Serves all of them, until it is over.
    ///
    /// # Errors
    /// The system refuses a thread.
    pub fn serve(mut self, stop: &Stop) -> Result<Vec<JoinHandle<()>>, Error> {
        for (number, (bus, door)) in self.buses.iter().zip(self.doors).enumerate() {
            let port = |member: &usize| (Arc::clone(&self.units[*member]), port(bus));
            self.workers.add_door(number, door, Line::new(bus.members.iter().map(port).collect()));
        }
        let spawn = |worker: crate::worker::Worker| {
            let stop = stop.watch();
            spawn("worker", move || worker.work(stop))
        };
        self.workers.into_iter().map(spawn).collect()
    }
}

/// A thread with a name.
///
/// # Errors
/// The system refuses it.
pub(crate) fn spawn(name: &str, work: impl FnOnce() + Send + 'static) -> Result<JoinHandle<()>, Error> {
    thread::Builder::new().name(name.into()).spawn(work).map_err(Error::system("thread"))
}

/// The port that a device on this bus is connected by.
fn port(bus: &Bus) -> Port {
    match bus.endpoint {
        Endpoint::SlcanTcp { .. } => Port::Can,
        _ if bus.is_shared() => Port::Rs485,
        _ => Port::Usb,
    }
}

/// The threads of a group; they end with it.
pub(crate) struct Served {
    stop: Mutex<Option<Stop>>,
    threads: Mutex<Vec<JoinHandle<()>>>,
}

impl Served {
    /// Serves a group.
    ///
    /// # Errors
    /// The system refuses.
    pub fn begin(group: Group) -> Result<Self, Error> {
        let stop = Stop::new()?;
        let threads = group.serve(&stop)?;
        Ok(Self { stop: Mutex::new(Some(stop)), threads: Mutex::new(threads) })
    }

    /// Closes the endpoints; when it returns, they can be opened again.
    pub fn end(&self) {
        drop(self.stop.lock().unwrap_or_else(PoisonError::into_inner).take());
        let threads = mem::take(&mut *self.threads.lock().unwrap_or_else(PoisonError::into_inner));
        for thread in threads {
            // A thread that panicked has said so.
            let _ = thread.join();
        }
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        self.end();
    }
}
