//! Those who look at a controller, and what they see. While somebody does, it is asked for its status over and over,
//! as often as its wire allows and no more than [`RATE_HZ`] times a second; all see the same answers.

use super::seat::Seat;
use crate::samples::{AxisSamples, Samples};
use host::Status;
use std::{
    sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError},
    time::Duration,
};
use tokio::{
    sync::{Notify, broadcast, watch},
    task::AbortHandle,
    time::{Instant, MissedTickBehavior, interval, sleep, sleep_until, timeout},
};

/// Statuses a second.
const RATE_HZ: u32 = 15;

/// Batches of samples a second.
const BATCH_RATE_HZ: u32 = 30;

/// How often a real controller is asked whether it is there while nobody looks.
const IDLE_LOOK: Duration = Duration::from_secs(5);

/// How long to wait after a first failure; twice as long after each further one.
const FIRST_PAUSE: Duration = Duration::from_millis(250);
const LONGEST_PAUSE: Duration = Duration::from_secs(10);

/// Batches of samples that may wait for somebody who is slow.
const BATCHES: usize = 64;

/// Those who look at a controller.
#[derive(Default)]
pub(crate) struct Hub {
    watched: Mutex<Watched>,
    came: Notify,
    /// There once somebody has looked: there may be thousands of controllers.
    seen: OnceLock<Seen>,
}

/// What they see.
struct Seen {
    status: watch::Sender<Option<Arc<Status>>>,
    samples: broadcast::Sender<Arc<Samples>>,
}

#[derive(Default)]
struct Watched {
    watchers: usize,
    /// The task that looks for all of them.
    task: Option<AbortHandle>,
    closed: bool,
}

impl Default for Seen {
    fn default() -> Self {
        Self { status: watch::Sender::new(None), samples: broadcast::Sender::new(BATCHES) }
    }
}

/// Somebody looks, as long as this is there.
pub(super) struct Watching(Arc<Seat>);

impl Watching {
    /// Begins to look.
    pub fn begin(seat: &Arc<Seat>) -> Self {
        let mut watched = seat.hub.watched();
        watched.watchers += 1;
        if watched.task.is_none() && !watched.closed {
            watched.task = Some(tokio::spawn(attend(Arc::clone(seat), false)).abort_handle());
        }
        drop(watched);
        seat.hub.came.notify_one();
        Self(Arc::clone(seat))
    }

    /// The newest status, and each new one.
    pub fn status(&self) -> watch::Receiver<Option<Arc<Status>>> {
        self.0.hub.seen().status.subscribe()
    }

    /// The samples from now on.
    pub fn samples(&self) -> broadcast::Receiver<Arc<Samples>> {
        self.0.hub.seen().samples.subscribe()
    }
}

impl Drop for Watching {
    fn drop(&mut self) {
        self.0.hub.watched().watchers -= 1;
    }
}

impl Hub {
    /// Looks after a real controller even if nobody watches, so that it is connected again by itself.
    pub fn attend_always(seat: &Arc<Seat>) {
        seat.hub.watched().task = Some(tokio::spawn(attend(Arc::clone(seat), true)).abort_handle());
    }

    /// Nobody looks any more, or can.
    pub fn close(&self) {
        let mut watched = self.watched();
        watched.closed = true;
        if let Some(task) = watched.task.take() {
            task.abort();
        }
    }

    /// Whether there is nothing more to see.
    pub fn is_closed(&self) -> bool {
        self.watched().closed
    }

    fn seen(&self) -> &Seen {
        self.seen.get_or_init(Seen::default)
    }

    fn is_watched(&self) -> bool {
        self.watched().watchers > 0
    }

    /// Whether the task may end, because nobody looks; the next one who does begins another.
    fn may_end(&self) -> bool {
        let mut watched = self.watched();
        let ends = watched.watchers == 0;
        if ends {
            watched.task = None;
        }
        ends
    }

    fn watched(&self) -> MutexGuard<'_, Watched> {
        self.watched.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Looks at a controller until nobody watches, or always.
async fn attend(seat: Arc<Seat>, always: bool) {
    loop {
        tokio::select! {
            () = look(&seat, always) => {}
            () = sample(&seat) => {}
        }
        if let Some(unit) = seat.device() {
            unit.sample(false);
        }
        if seat.hub.may_end() {
            return;
        }
    }
}

/// Asks for the status over and over.
async fn look(seat: &Seat, always: bool) {
    let (hub, Some(link)) = (&seat.hub, seat.link()) else {
        return std::future::pending().await;
    };
    let mut pause = FIRST_PAUSE;
    while always || hub.is_watched() {
        let started = Instant::now();
        let answer = host::polling(async {
            if hub.is_watched() {
                link.ask(async |it| it.status().await.map(Some)).await
            } else {
                link.ask(async |it| it.identify().await.map(|_| None)).await
            }
        });
        let answer = answer.await;
        match answer {
            Ok(Some(status)) => {
                if seat.device().is_none() {
                    // Nobody knows what lies between two of them; whoever is not there misses them.
                    let _ = hub.seen().samples.send(Arc::new(sample_of(seat, &status)));
                }
                hub.seen().status.send_replace(Some(Arc::new(status)));
                pause = FIRST_PAUSE;
                sleep_until(started + Duration::from_secs(1) / RATE_HZ).await;
            }
            Ok(None) => {
                pause = FIRST_PAUSE;
                let _ = timeout(IDLE_LOOK, hub.came.notified()).await;
            }
            Err(_) => {
                sleep(pause).await;
                pause = LONGEST_PAUSE.min(pause * 2);
            }
        }
    }
}

/// Takes exact samples of a virtual device, and ends when nobody watches it.
async fn sample(seat: &Seat) {
    let Some(unit) = seat.device() else { return std::future::pending().await };
    unit.sample(true);
    let mut ticks = interval(Duration::from_secs(1) / BATCH_RATE_HZ);
    ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
    while seat.hub.is_watched() {
        ticks.tick().await;
        let samples = unit.samples();
        if !samples.seconds.is_empty() {
            let _ = seat.hub.seen().samples.send(Arc::new(samples));
        }
    }
}

/// A status as a sample.
fn sample_of(seat: &Seat, status: &Status) -> Samples {
    let one = |number: i32| vec![f64::from(number)];
    let axis = |name: &&'static str| {
        let axis = status.axes.get(*name)?;
        let samples = AxisSamples {
            position: one(axis.position),
            encoder: one(axis.encoder.unwrap_or(axis.position)),
            speed: one(axis.speed),
            load: axis.load.map(one),
            delta: axis.delta.map(one),
        };
        Some((*name, samples))
    };
    Samples { seconds: vec![status.seconds], axes: seat.model.guide.axes.iter().filter_map(axis).collect() }
}
