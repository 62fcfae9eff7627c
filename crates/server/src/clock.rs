//! From the wall clock to the clock of a controller.

use std::time::{Duration, Instant};

/// Clocks of a controller from power-up, as in [`sim::VirtualDevice`].
type Ticks = u64;

/// The slowest and fastest that device time may run, in seconds of it a second of wall clock.
pub const SPEEDS: std::ops::RangeInclusive<f64> = 0.001..=1000.0;

/// A device that fell further behind than this, in wall clock, does not catch up: the machine is too slow
/// for the speed asked for, or was asleep. Its time then runs late instead of ever faster.
const MAX_BEHIND: Duration = Duration::from_millis(250);

/// Nanoseconds a second times the millionths that a speed is counted in.
const SCALE: u128 = 1_000_000_000 * 1_000_000;

/// Device time as a function of the wall clock: exact, so that rounding never adds up.
#[derive(Debug)]
pub(crate) struct Clock {
    started: Instant,
    /// Clocks a second of wall clock, in millionths.
    rate_micro: u128,
    /// Clocks that the device will never make up for.
    skipped: Ticks,
}

impl Clock {
    /// A clock that starts at 0 now and runs `clock_hz · speed` a second.
    pub fn new(clock_hz: u32, speed: f64, now: Instant) -> Self {
        assert!(SPEEDS.contains(&speed), "the speed was checked where it came in");
        let speed_micro = (speed * 1e6).round() as u128;
        Self { started: now, rate_micro: u128::from(clock_hz) * speed_micro, skipped: 0 }
    }

    /// The clock to which a device must advance that has come to `done`. Until `wake` nothing happens in it, so
    /// that much it cannot be behind.
    pub fn due(&mut self, now: Instant, done: Ticks, wake: Ticks) -> Ticks {
        let due = self.ticks(now.saturating_duration_since(self.started)).saturating_sub(self.skipped);
        let behind = due.saturating_sub(done.max(wake));
        let most = self.ticks(MAX_BEHIND);
        if behind > most {
            self.skipped += behind - most;
            return due - (behind - most);
        }
        due.max(done)
    }

    /// The device stands at this clock: the time that has passed since does not count.
    pub fn stand(&mut self, now: Instant, done: Ticks) {
        self.skipped = self.ticks(now.saturating_duration_since(self.started)).saturating_sub(done);
    }

    /// How long from a moment at which `now` ticks are due until `later` are.
    pub fn until(&self, now: Ticks, later: Ticks) -> Duration {
        let nanos = u128::from(later.saturating_sub(now)) * SCALE / self.rate_micro;
        Duration::from_nanos(u64::try_from(nanos).unwrap_or(u64::MAX))
    }

    fn ticks(&self, span: Duration) -> Ticks {
        u64::try_from(span.as_nanos() * self.rate_micro / SCALE).unwrap_or(Ticks::MAX)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_follow_the_wall_clock_exactly() {
        let start = Instant::now();
        let mut clock = Clock::new(16_000_000, 2.5, start);
        let mut done = 0;
        for ms in 1..=10_000 {
            done = clock.due(start + Duration::from_millis(ms), done, 0);
            assert_eq!(done, ms * 40_000);
        }
    }

    #[test]
    fn time_never_runs_back() {
        let start = Instant::now();
        let mut clock = Clock::new(1_000_000, 1.0, start + Duration::from_secs(1));
        assert_eq!(clock.due(start, 77, 0), 77);
    }

    #[test]
    fn a_late_device_skips_what_it_missed() {
        let start = Instant::now();
        let mut clock = Clock::new(1_000_000, 1.0, start);
        let done = clock.due(start + Duration::from_secs(100), 0, 0);
        assert_eq!(done, 250_000, "no more than the limit at once");
        let next = clock.due(start + Duration::from_millis(100_010), done, 0);
        assert_eq!(next, 260_000, "and then on at the usual pace");
    }

    #[test]
    fn a_device_in_which_nothing_happens_is_never_late() {
        let start = Instant::now();
        let mut clock = Clock::new(1_000_000, 1.0, start);
        let mut at = |seconds, done, wake| clock.due(start + Duration::from_secs(seconds), done, wake);
        assert_eq!(at(100, 0, Ticks::MAX), 100_000_000);
        assert_eq!(at(200, 100_000_000, 199_900_000), 200_000_000);
        assert_eq!(at(300, 200_000_000, 299_000_000), 299_250_000, "what was due is late");
        assert_eq!(at(301, 299_250_000, Ticks::MAX), 300_250_000);
    }

    #[test]
    fn time_that_a_device_stands_does_not_count() {
        let start = Instant::now();
        let mut clock = Clock::new(1_000_000, 1.0, start);
        let at = |ms| start + Duration::from_millis(ms);
        assert_eq!(clock.due(at(100), 0, Ticks::MAX), 100_000);
        clock.stand(at(100), 60_000);
        clock.stand(at(5_000), 60_000);
        assert_eq!(clock.due(at(5_100), 60_000, Ticks::MAX), 160_000);
    }

    #[test]
    fn waiting_times_are_wall_clock() {
        let clock = Clock::new(1_000_000, 4.0, Instant::now());
        assert_eq!(clock.until(0, 4_000_000), Duration::from_secs(1));
        assert_eq!(clock.until(10, 5), Duration::ZERO);
        assert_eq!(clock.until(0, Ticks::MAX), Duration::from_nanos(u64::MAX), "as long as there is");
    }
}
