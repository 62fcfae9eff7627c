//! Devices in real time, with everything that one can plug into them: TCP, pseudo-terminals, CAN
//! adapters, USB HID, shared buses, and the HTTP interface.
//!
//! - Workers, one a processor, are threads with an event loop each. An endpoint belongs to one of them, and so do
//!   the clients that come there: a client is a task that asks the devices itself.
//! - A device belongs to the worker of its first endpoint, which lets it do what happens without being asked, when
//!   it is due. It has a lock, because others may talk to it too.
//! - HTTP runs in one more thread.
//! - With a directory for state, one thread keeps the flash images on disk.
//!
//! All of them end when [`Server::stop`] closes the pipe that they wait on.

mod alarms;
mod breaks;
mod clock;
mod desk;
mod endpoint;
mod group;
mod http;
mod images;
mod ready;
mod samples;
mod signals;
mod stop;
mod unit;
mod worker;

pub use clock::SPEEDS;
pub use desk::typescript;
pub use http::{HttpSettings, Patience, Tls, Token};
pub use signals::Signals;

use desk::{Desk, Seat};
use group::Group;
use http::Http;
use images::Images;
use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
use sim::{
    DeviceConfig, FaultError, PlaceError, Scenario, VirtualDevice,
    flash::ImageError,
    record::{self, RecordError},
    tape::{self, Tape, TapeError},
};
use std::{io, num::NonZero, path::PathBuf, sync::Arc, thread::JoinHandle, time::Duration};
use stop::Stop;
use tokio::runtime::Runtime;
use unit::Unit;

/// What to serve, and how.
pub struct Settings {
    /// The devices, each with its endpoints. The names differ.
    pub devices: Vec<DeviceConfig>,
    /// The HTTP interface; `None` for none.
    pub http: Option<HttpSettings>,
    /// Seconds of device time a second of wall clock, in [`SPEEDS`].
    pub speed: f64,
    /// Where the flash images live; without it they are lost at the end.
    pub state: Option<PathBuf>,
    /// Recordings of every device, by the extension of the file: one file a device, a tape for all together.
    pub record: Vec<PathBuf>,
    /// The faults that the devices have; times count from now on.
    pub scenario: Scenario,
    /// How many threads serve endpoints and devices; without a number one for each processor. There are never more
    /// than endpoints.
    pub workers: Option<NonZero<usize>>,
}

/// Why the server does not start, or does not end well; one line of text.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// An endpoint cannot be opened.
    #[error("{endpoint}: {source}")]
    Listen {
        /// The endpoint.
        endpoint: String,
        /// What the system says.
        source: io::Error,
    },
    /// HTTP would listen where others can connect, without TLS.
    #[error("http {0}: other machines could listen in there; say --tls-cert and --tls-key, or --insecure")]
    Exposed(String),
    /// A certificate or its key cannot be used.
    #[error("{}: {problem}", path.display())]
    Certificate {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        problem: String,
    },
    /// A device cannot be at one of its endpoints.
    #[error("{endpoint}: {source}")]
    Place {
        /// The endpoint.
        endpoint: String,
        /// What is wrong with it.
        source: PlaceError,
    },
    /// A device does not take a fault of the scenario.
    #[error("{device}: {source}")]
    Fault {
        /// The device.
        device: String,
        /// What is wrong with the fault.
        source: FaultError,
    },
    /// Something else that the system refuses.
    #[error("{what}: {source}")]
    System {
        /// What was asked of it.
        what: &'static str,
        /// What it says.
        source: io::Error,
    },
    /// The directory of the images cannot be used.
    #[error("{}: {source}", path.display())]
    State {
        /// The directory.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Another process uses the directory of the images.
    #[error("{}: another process keeps its state here", .0.display())]
    StateInUse(PathBuf),
    /// A recording cannot be made.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// A tape cannot be made.
    #[error(transparent)]
    Tape(#[from] TapeError),
    /// A flash image cannot be loaded or saved.
    #[error(transparent)]
    Image(#[from] ImageError),
}

impl Error {
    fn system(what: &'static str) -> impl Fn(io::Error) -> Self {
        move |source| Self::System { what, source }
    }
}

/// How long axes that are held may take to be told to stop when the server ends.
const LAST_STOPS: Duration = Duration::from_secs(2);

/// A running server. Dropping it without [`stop`](Self::stop) leaves its threads running.
pub struct Server {
    ready: Vec<(String, String)>,
    url: Option<String>,
    stop: Stop,
    threads: Vec<JoinHandle<()>>,
    images: Images,
    units: Vec<Arc<Unit>>,
    desk: Arc<Desk>,
    tapes: Vec<Tape>,
    runtime: Runtime,
}

impl Server {
    /// Switches the devices on and opens everything. When it returns, everything listens.
    ///
    /// # Errors
    /// [`Error`]; then nothing is left open.
    pub fn start(settings: Settings) -> Result<Self, Error> {
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(1)
            .thread_name("http")
            .enable_all()
            .build()
            .map_err(Error::system("HTTP thread"))?;

        raise_file_limit();
        // Everything that can fail comes before the first thread.
        let mut group = Group::open(&settings.devices, settings.workers)?;
        let http = settings.http.map(Http::bind).transpose()?;
        let images = Images::open(settings.state)?;
        let flashes = settings.devices.iter().map(|config| images.load(config));
        let flashes = flashes.collect::<Result<Vec<_>, _>>()?;
        let seed = random_seed();
        let heads: Vec<_> =
            settings.devices.iter().zip(&flashes).map(|(config, flash)| (config, seed, flash)).collect();
        let (tapes, files): (Vec<_>, Vec<_>) = settings.record.iter().partition(|path| tape::is_tape(path));
        let tapes =
            tapes.into_iter().map(|path| Tape::create(path, &heads)).collect::<Result<Vec<_>, _>>()?;
        let mut units = Vec::new();
        for (number, (config, flash)) in settings.devices.iter().zip(&flashes).enumerate() {
            let mut device = VirtualDevice::with_flash(config, flash.clone(), seed);
            tapes.iter().for_each(|tape| device.add_tape(tape.track(number)));
            for file in &files {
                let file = record::file_of(file, &config.name, settings.devices.len() == 1);
                device.add_recorder(record::create(&file, &device.record_info())?);
            }
            for planned in settings.scenario.of(number) {
                device
                    .plan(planned)
                    .map_err(|source| Error::Fault { device: config.name.clone(), source })?;
            }
            units.push(group.add(device, settings.speed));
        }

        let (mut ready, mut seats) = (Vec::new(), Vec::new());
        for (number, (unit, config)) in units.iter().zip(&settings.devices).enumerate() {
            let (endpoints, ports) = (group.endpoints(number), group.ports(number));
            ready.extend(endpoints.iter().map(|endpoint| (unit.name.clone(), endpoint.clone())));
            seats.push(Seat::of_unit(config.model, Arc::clone(unit), endpoints, &ports, None));
        }
        let url = http.as_ref().map(Http::url);
        let desk = Arc::new(Desk::new(seats, settings.speed, images.clone()));

        let stop = Stop::new()?;
        let threads = group.serve(&stop)?;
        let mut server = Self { ready, url, stop, threads, images, units, desk, tapes, runtime };
        if let Some(keeper) = server.images.keeper(server.stop.watch()) {
            server.threads.push(group::spawn("images", keeper)?);
        }
        if let Some(http) = http {
            let desk = Arc::clone(&server.desk);
            server.runtime.spawn(async move {
                let Err(error) = http.serve(desk).await;
                eprintln!("warning: HTTP ends: {error}");
            });
        }
        Ok(server)
    }

    /// Device names with the endpoints at which they can be reached, real port numbers included.
    pub fn ready(&self) -> &[(String, String)] {
        &self.ready
    }

    /// Address of the HTTP interface, with the token.
    pub fn url(&self) -> Option<&str> {
        self.url.as_deref()
    }

    /// Catches the signals that ask the process to end, from now on.
    ///
    /// # Errors
    /// The system refuses.
    pub fn signals(&self) -> Result<Signals<'_>, Error> {
        Signals::catch(&self.runtime)
    }

    /// Closes everything, ends the recordings and saves the images.
    ///
    /// # Errors
    /// A recording or an image cannot be saved; the others are.
    pub fn stop(self) -> Result<(), Error> {
        // What cannot be stopped in this time is not.
        let stopped = async { tokio::time::timeout(LAST_STOPS, self.desk.stop_held()).await };
        let _ = self.runtime.block_on(stopped);
        drop(self.stop);
        self.desk.close();
        // What is still asked over HTTP is answered or not; the state no longer counts.
        self.runtime.shutdown_background();
        for thread in self.threads {
            // A thread that panicked has said so.
            let _ = thread.join();
        }
        let mut result = self.images.save();
        self.images.release();
        for unit in self.units {
            result = result.and(unit.finish_recordings().map_err(Into::into));
        }
        for tape in self.tapes {
            result = result.and(tape.finish().map_err(Into::into));
        }
        result
    }
}

/// Every endpoint and every client is an open file, and what a shell allows is often little.
fn raise_file_limit() {
    let limit = getrlimit(Resource::Nofile);
    // What does not work shows when a file cannot be opened.
    let _ = setrlimit(Resource::Nofile, Rlimit { current: limit.maximum, ..limit });
}

pub(crate) fn random_seed() -> u64 {
    // Without random numbers every run has the same ones, which harms nobody.
    getrandom::u64().unwrap_or(0)
}
