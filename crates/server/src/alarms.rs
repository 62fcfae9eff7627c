//! When devices want to be looked after: a heap of times, and a task that waits for the first of them.

use crate::unit::Unit;
use std::{
    cmp::Reverse,
    collections::BinaryHeap,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::Instant,
};
use tokio::sync::Notify;

/// So many devices are looked after before clients have their turn.
const BATCH: usize = 16;

/// The alarms of the devices of one worker. An alarm that was set too early does no harm; one that is no longer
/// wanted stays until its time.
#[derive(Default)]
pub(crate) struct Alarms {
    heap: Mutex<BinaryHeap<Reverse<(Instant, usize)>>>,
    earlier: Notify,
}

impl Alarms {
    /// The device with this number is to be looked after at this time.
    pub fn set(&self, at: Instant, device: usize) {
        let mut heap = self.heap();
        let is_first = heap.peek().is_none_or(|Reverse((first, _))| at < *first);
        heap.push(Reverse((at, device)));
        drop(heap);
        if is_first {
            self.earlier.notify_one();
        }
    }

    /// Takes an alarm whose time has come.
    fn take(&self, now: Instant) -> Option<(Instant, usize)> {
        let mut heap = self.heap();
        let Reverse((at, device)) = *heap.peek()?;
        (at <= now).then(|| {
            heap.pop();
            (at, device)
        })
    }

    /// Waits for the next alarm, or until there is an earlier one.
    async fn wait(&self) {
        let next = self.heap().peek().map(|Reverse((at, _))| *at);
        let earlier = self.earlier.notified();
        match next {
            Some(at) => tokio::select! {
                () = tokio::time::sleep_until(at.into()) => {}
                () = earlier => {}
            },
            None => earlier.await,
        }
    }

    /// Looks after devices for ever. The number of an alarm is the place in `units`.
    pub async fn attend(&self, units: &[Arc<Unit>]) {
        loop {
            let mut attended = 0;
            while let Some((at, device)) = self.take(Instant::now()) {
                units[device].tend(at);
                attended += 1;
                if attended % BATCH == 0 {
                    tokio::task::yield_now().await;
                }
            }
            self.wait().await;
        }
    }

    fn heap(&self) -> MutexGuard<'_, BinaryHeap<Reverse<(Instant, usize)>>> {
        self.heap.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    fn runtime() -> tokio::runtime::Runtime {
        tokio::runtime::Builder::new_current_thread().enable_time().build().unwrap()
    }

    #[test]
    fn alarms_come_in_the_order_of_their_times() {
        let (alarms, start) = (Alarms::default(), Instant::now());
        let at = |ms| start + Duration::from_millis(ms);
        for (ms, device) in [(30, 0), (10, 1), (20, 2), (10, 3)] {
            alarms.set(at(ms), device);
        }
        assert_eq!(alarms.take(at(9)), None);
        let taken: Vec<_> = std::iter::from_fn(|| alarms.take(at(20))).map(|(_, device)| device).collect();
        assert_eq!(taken, [1, 3, 2]);
        assert_eq!(alarms.take(at(30)), Some((at(30), 0)));
    }

    #[test]
    fn whoever_waits_hears_of_an_earlier_alarm() {
        let alarms = Arc::new(Alarms::default());
        let start = Instant::now();
        alarms.set(start + Duration::from_secs(60), 0);
        let setter = Arc::clone(&alarms);
        runtime().block_on(async move {
            // What was set before somebody waits counts too.
            alarms.wait().await;
            std::thread::spawn(move || {
                std::thread::sleep(Duration::from_millis(20));
                setter.set(start + Duration::from_millis(25), 1);
            });
            while alarms.take(Instant::now()).is_none() {
                alarms.wait().await;
            }
        });
        assert!(start.elapsed() >= Duration::from_millis(25));
        assert!(start.elapsed() < Duration::from_secs(30));
    }
}
