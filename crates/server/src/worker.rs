//! Threads with an event loop each, between which endpoints and devices are divided.

use crate::{
    Error,
    alarms::Alarms,
    endpoint::{Door, Line},
    stop::Watch,
    unit::Unit,
};
use std::{num::NonZero, sync::Arc, thread};
use tokio::runtime::{Builder, Runtime};

/// All workers.
pub(crate) struct Workers(Vec<Worker>);

impl Workers {
    /// So many workers, or one for each processor, but no more than there are endpoints.
    pub fn new(count: Option<NonZero<usize>>, endpoints: usize) -> Result<Self, Error> {
        let count = count.or_else(|| thread::available_parallelism().ok()).map_or(1, NonZero::get);
        let workers = (0..count.min(endpoints).max(1)).map(|_| Worker::new());
        Ok(Self(workers.collect::<Result<_, _>>()?))
    }

    /// Gives a device to the worker of the endpoint `home`, or to the first one. `make` is told where the alarms
    /// of the device are, and its number there.
    pub fn add_unit(
        &mut self,
        home: Option<usize>,
        make: impl FnOnce((Arc<Alarms>, usize)) -> Unit,
    ) -> Arc<Unit> {
        let worker = self.of_endpoint(home.unwrap_or(0));
        let unit = Arc::new(make((Arc::clone(&worker.alarms), worker.units.len())));
        worker.units.push(Arc::clone(&unit));
        unit
    }

    /// Gives the endpoint with this number to its worker.
    pub fn add_door(&mut self, endpoint: usize, door: Door, line: Line) {
        self.of_endpoint(endpoint).doors.push((door, line));
    }

    fn of_endpoint(&mut self, endpoint: usize) -> &mut Worker {
        let count = self.0.len();
        &mut self.0[endpoint % count]
    }
}

impl IntoIterator for Workers {
    type Item = Worker;
    type IntoIter = std::vec::IntoIter<Worker>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

/// What one thread does.
pub(crate) struct Worker {
    runtime: Runtime,
    alarms: Arc<Alarms>,
    units: Vec<Arc<Unit>>,
    doors: Vec<(Door, Line)>,
}

impl Worker {
    fn new() -> Result<Self, Error> {
        let runtime = Builder::new_current_thread().enable_all().build();
        Ok(Self {
            runtime: runtime.map_err(Error::system("event loop"))?,
            alarms: Arc::default(),
            units: Vec::new(),
            doors: Vec::new(),
        })
    }

    /// Serves endpoints and looks after devices until it is over.
    pub fn work(self, stop: Watch) {
        let Self { runtime, alarms, units, doors } = self;
        runtime.block_on(async {
            for (door, line) in doors {
                tokio::spawn(door.serve(Arc::new(line)));
            }
            tokio::spawn(async move { alarms.attend(&units).await });
            if let Err(error) = stop.over().await {
                eprintln!("warning: nobody can end this worker: {error}");
            }
        });
    }
}
