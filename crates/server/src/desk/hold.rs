//! Jogs that are held: they go on only while somebody says so. When the page, its computer or the network between is
//! gone, the axis stops.

use super::seat::Seat;
use host::Action;
use std::{
    collections::BTreeMap,
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
    time::Duration,
};
use tokio::{
    sync::watch,
    time::{Instant, timeout, timeout_at},
};

/// How long a jog goes on of which nobody says that it does. The page says it three times in that time.
pub(super) const HOLD_SILENCE: Duration = Duration::from_millis(600);

/// How often a controller is told to stop that does not answer, and how long to wait in between.
const STOP_TRIES: u32 = 120;
const STOP_PAUSE: Duration = Duration::from_millis(250);

/// The jogs of a controller that somebody holds, by axis.
#[derive(Default)]
pub(crate) struct Holds(Mutex<BTreeMap<String, Arc<Hold>>>);

/// A jog that somebody holds.
struct Hold(watch::Sender<Phase>);

/// How it is with a jog that somebody holds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase {
    /// The controller is being told.
    Starting,
    /// It goes on until then; whoever said that it does.
    Held { until: Instant, by: Option<u64> },
    /// The controller is being told to stop.
    Stopping,
    /// That is done, or no longer wanted.
    Over,
}

impl Hold {
    fn change(&self, change: impl FnOnce(Phase) -> Option<Phase>) {
        self.0.send_if_modified(|phase| match change(*phase) {
            Some(next) => {
                *phase = next;
                true
            }
            None => false,
        });
    }
}

impl Holds {
    /// What was done instead, so that nobody has to stop the axes of held jogs any more.
    pub fn superseded(&self, action: &Action) {
        match action {
            Action::Stop { axis: None } | Action::Abort { axis: None } => self.end(|_| true),
            Action::Jog { axis, .. }
            | Action::Stop { axis: Some(axis) }
            | Action::Abort { axis: Some(axis) }
            | Action::Home { axis, .. }
            | Action::ChangeTarget { axis, .. } => self.end(|other| other == axis),
            Action::Move { targets, .. } => self.end(|axis| targets.contains_key(axis)),
            Action::Power { .. }
            | Action::SetPosition { .. }
            | Action::SetEncoder { .. }
            | Action::ClearError { .. }
            | Action::ChangeSpeed { .. }
            | Action::SetMode { .. }
            | Action::Output { .. } => {}
        }
    }

    fn end(&self, ends: impl Fn(&str) -> bool) {
        self.all().retain(|axis, hold| {
            let ends = ends(axis);
            if ends {
                hold.change(|_| Some(Phase::Over));
            }
            !ends
        });
    }

    /// A client says that these axes go on, and thereby that others do not that it held before.
    fn hold(&self, client: u64, axes: &[String]) {
        let now = Instant::now();
        for (axis, hold) in &*self.all() {
            hold.change(|phase| match phase {
                Phase::Held { .. } if axes.contains(axis) => {
                    Some(Phase::Held { until: now + HOLD_SILENCE, by: Some(client) })
                }
                Phase::Held { by, .. } if by == Some(client) => Some(Phase::Held { until: now, by }),
                _ => None,
            });
        }
    }

    /// The axes of held jogs.
    pub fn axes(&self) -> Vec<String> {
        self.all().keys().cloned().collect()
    }

    fn all(&self) -> MutexGuard<'_, BTreeMap<String, Arc<Hold>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Somebody who may hold jogs: those that he does stop when he leaves.
pub(super) struct Holder {
    seat: Arc<Seat>,
    number: u64,
}

impl Holder {
    pub fn new(seat: &Arc<Seat>) -> Self {
        static NUMBER: AtomicU64 = AtomicU64::new(0);
        Self { seat: Arc::clone(seat), number: NUMBER.fetch_add(1, Ordering::Relaxed) }
    }

    /// Says that these axes go on, and no others that he held.
    pub fn hold(&self, axes: &[String]) {
        self.seat.holds.hold(self.number, axes);
    }
}

impl Drop for Holder {
    fn drop(&mut self) {
        self.hold(&[]);
    }
}

/// A held jog of which a controller is being told. Its time begins when this is dropped, whatever came of it: if nobody
/// waits for the answer any more, the controller may have got it nevertheless.
pub(super) struct Begun {
    axis: String,
    hold: Arc<Hold>,
    /// Whether nobody held this axis before.
    is_first: bool,
}

impl Begun {
    /// The controller does not do it.
    pub fn refused(self, holds: &Holds) {
        // One that is refused because an earlier one goes on is held as that one was.
        if self.is_first {
            holds.end(|axis| axis == self.axis);
        }
    }
}

impl Drop for Begun {
    fn drop(&mut self) {
        let held = Phase::Held { until: Instant::now() + HOLD_SILENCE, by: None };
        self.hold.change(|phase| (phase == Phase::Starting).then_some(held));
    }
}

/// Takes notice of a held jog before the controller is told of it. Anything else is none.
pub(super) fn begin(seat: &Arc<Seat>, action: &Action) -> Option<Begun> {
    let Action::Jog { axis, held: true, .. } = action else { return None };
    let mut all = seat.holds.all();
    if let Some(hold) = all.get(axis) {
        hold.change(|phase| (phase != Phase::Over).then_some(Phase::Starting));
        return Some(Begun { axis: axis.clone(), hold: Arc::clone(hold), is_first: false });
    }
    let hold = Arc::new(Hold(watch::Sender::new(Phase::Starting)));
    all.insert(axis.clone(), Arc::clone(&hold));
    drop(all);
    tokio::spawn(attend(Arc::clone(seat), axis.clone(), Arc::clone(&hold)));
    Some(Begun { axis: axis.clone(), hold, is_first: true })
}

/// Stops an axis when its jog is no longer held.
async fn attend(seat: Arc<Seat>, axis: String, hold: Arc<Hold>) {
    let mut phases = hold.0.subscribe();
    let stop = Action::Stop { axis: Some(axis) };
    let mut tries = 0;
    loop {
        let phase = *phases.borrow_and_update();
        match phase {
            Phase::Starting => drop(phases.changed().await),
            Phase::Held { until, .. } => {
                if timeout_at(until, phases.changed()).await.is_err() {
                    hold.change(|now| (now == phase).then_some(Phase::Stopping));
                    tries = 0;
                }
            }
            Phase::Stopping => {
                tries += 1;
                let done = seat.ask(async |it| it.act(&stop).await).await;
                if done.is_ok() || tries == STOP_TRIES {
                    seat.holds.stopped(&hold);
                } else {
                    let _ = timeout(STOP_PAUSE, phases.changed()).await;
                }
            }
            Phase::Over => return,
        }
    }
}

impl Holds {
    /// The axis of a hold was told to stop, unless it was told to jog again meanwhile.
    fn stopped(&self, hold: &Arc<Hold>) {
        self.all().retain(|_, other| {
            let mut is_over = false;
            if Arc::ptr_eq(other, hold) {
                hold.change(|phase| {
                    is_over = phase == Phase::Stopping;
                    is_over.then_some(Phase::Over)
                });
            }
            !is_over
        });
    }
}
