//! A synchronisation output: a counter compared with a set position, or a pulse at every multiple of a
//! distance.
//!
//! The output belongs to no axis and no clock. Whoever holds it stops the counter after [`Sync::room`] pulses
//! or counts, in whatever way it can, and tells the new count: the output then changes in the very clock.
//! CMD-4CR manual, 2.1.3.2.2.

use crate::compare::{self, Condition};
use crate::train::Ticks;

/// When the output is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Never.
    Never,
    /// As long as the counter meets a condition.
    While(Condition),
    /// For a pulse at every multiple of so many counts from where it was switched on; 0 has none.
    Every(u32),
}

/// What has become of the rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Switched off.
    Off = 0,
    /// Waiting for the condition, or the first multiple.
    Waiting = 1,
    /// It was met at some time since.
    Met = 2,
}

/// The output while it is switched on.
#[derive(Clone, Copy, Debug)]
struct Running {
    rule: Rule,
    /// The counter as it was told last.
    counter: i32,
    /// The way from where it was switched on; unlike the counter it does not wrap.
    way: i64,
    met: bool,
    /// Until when a pulse lasts.
    pulse_to: Option<Ticks>,
}

/// A synchronisation output.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sync {
    running: Option<Running>,
    /// Pulses come from the first to the second count only, both included.
    window: Option<[i32; 2]>,
}

impl Sync {
    /// An output that is switched off.
    pub const fn new() -> Self {
        Self { running: None, window: None }
    }

    /// Begins anew with a rule.
    pub fn switch_on(&mut self, rule: Rule, counter: i32) {
        let met = matches!(rule, Rule::While(condition) if condition.holds(counter));
        self.running = Some(Running { rule, counter, way: 0, met, pulse_to: None });
    }

    /// Switches off, the window too.
    pub fn switch_off(&mut self) {
        *self = Self::new();
    }

    /// Pulses of [`Rule::Every`] come only while the counter is from the first to the second count; the
    /// multiples go on outside. `None` lets them come everywhere.
    pub fn set_window(&mut self, window: Option<[i32; 2]>) {
        self.window = window;
    }

    /// Whether it has a window.
    pub const fn has_window(&self) -> bool {
        self.window.is_some()
    }

    /// What has become of the rule. Once met it stays so.
    pub const fn status(&self) -> Status {
        match &self.running {
            None => Status::Off,
            Some(Running { met: false, .. }) => Status::Waiting,
            Some(Running { met: true, .. }) => Status::Met,
        }
    }

    /// Whether it drives its pin.
    pub const fn is_on(&self) -> bool {
        self.running.is_some()
    }

    /// The level of the output.
    pub fn level(&self) -> bool {
        self.running.as_ref().is_some_and(|running| match running.rule {
            Rule::Never => false,
            Rule::While(condition) => condition.holds(running.counter),
            Rule::Every(_) => running.pulse_to.is_some(),
        })
    }

    /// How many counts down and how many up [`Self::reach`] has something to do, from the counter that it was
    /// told last; `None` if there is nothing either way.
    pub fn room(&self) -> Option<[u32; 2]> {
        let running = self.running.as_ref()?;
        match running.rule {
            Rule::Never => None,
            Rule::While(condition) => condition.room(running.counter),
            // It has to be seen leaving a multiple to be seen coming back.
            Rule::Every(period @ 1..) if running.way % i64::from(period) == 0 => Some([1, 1]),
            Rule::Every(period) => compare::room(period, running.way),
        }
    }

    /// The counter has come here; pulses that begin now last until `pulse_to`. A pulse that begins before the
    /// last one is over prolongs it.
    pub fn reach(&mut self, counter: i32, pulse_to: Ticks) {
        let window = self.window;
        let Some(running) = &mut self.running else { return };
        let moved = counter.wrapping_sub(running.counter);
        let room = match running.rule {
            _ if moved == 0 => return,
            Rule::Never => None,
            Rule::While(condition) => condition.room(running.counter),
            Rule::Every(period) => compare::room(period, running.way),
        };
        // A counter that jumps may have passed it.
        let passed = room.is_some_and(|[down, up]| moved.unsigned_abs() >= if moved < 0 { down } else { up });
        running.counter = counter;
        running.way += i64::from(moved);
        running.met |= passed;
        let inside = window.is_none_or(|[low, high]| low <= counter && counter <= high);
        if passed && inside && matches!(running.rule, Rule::Every(_)) {
            running.pulse_to = Some(pulse_to);
        }
    }

    /// The counter was given another number. Multiples stay where they are.
    pub fn renumber(&mut self, counter: i32) {
        if let Some(running) = &mut self.running {
            running.counter = counter;
            running.met |= matches!(running.rule, Rule::While(condition) if condition.holds(counter));
        }
    }

    /// When the pulse ends, if there is one.
    pub const fn due(&self) -> Option<Ticks> {
        match &self.running {
            Some(running) => running.pulse_to,
            None => None,
        }
    }

    /// Ends a pulse whose time is over.
    pub fn expire(&mut self, now: Ticks) {
        if let Some(running) = &mut self.running {
            running.pulse_to.take_if(|end| *end <= now);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Condition::{Above, Below, Equal};

    /// Pulses take this long in the tests, and a count one clock.
    const PULSE: Ticks = 3;

    /// Takes a counter along a way count by count, and gives the counts after which the level changed, with
    /// the new one. The output is told only where it asks for it, and has to say the same then.
    fn levels(mut sync: Sync, way: &[i32]) -> Vec<(i32, bool)> {
        let mut asked = sync;
        let (mut counter, mut told, mut now, mut on) = (way[0], way[0], 0, sync.level());
        let mut changes = Vec::new();
        for &target in &way[1..] {
            while counter != target {
                let step = if target.wrapping_sub(counter) < 0 { -1 } else { 1 };
                counter = counter.wrapping_add(step);
                now += 1;
                sync.expire(now);
                sync.reach(counter, now + PULSE);
                asked.expire(now);
                let gone = counter.wrapping_sub(told);
                let due = asked
                    .room()
                    .is_some_and(|[down, up]| gone.unsigned_abs() == if gone < 0 { down } else { up });
                if due {
                    asked.reach(counter, now + PULSE);
                    told = counter;
                }
                assert_eq!((asked.level(), asked.status()), (sync.level(), sync.status()), "at {counter}");
                if sync.level() != on {
                    on = sync.level();
                    changes.push((counter, on));
                }
            }
        }
        changes
    }

    #[track_caller]
    fn check(rule: Rule, window: Option<[i32; 2]>, way: &[i32], expected: &[(i32, bool)]) {
        let mut sync = Sync::new();
        sync.set_window(window);
        sync.switch_on(rule, way[0]);
        assert_eq!(levels(sync, way), expected, "{rule:?} {window:?} along {way:?}");
    }

    #[test]
    fn the_output_follows_the_condition() {
        let way = [0, 10, -10];
        check(Rule::Never, None, &way, &[]);
        check(Rule::While(Equal(5)), None, &way, &[(5, true), (6, false), (5, true), (4, false)]);
        check(Rule::While(Below(5)), None, &way, &[(5, false), (4, true)]);
        check(Rule::While(Above(5)), None, &way, &[(6, true), (5, false)]);
        check(Rule::While(Above(5)), None, &[i32::MAX - 2, i32::MIN + 2], &[(i32::MIN, false)]);
    }

    #[test]
    fn pulses_come_at_every_multiple() {
        // Counted from 2; a pulse is on for three counts.
        let up = [(12, true), (15, false), (22, true), (25, false)];
        check(Rule::Every(10), None, &[2, 28], &up);
        // Back over one that was reached, too.
        let back = [12, 2, -8].into_iter().flat_map(|at| [(at, true), (at - 3, false)]);
        let back: Vec<_> = [(12, true), (13, false)].into_iter().chain(back).collect();
        check(Rule::Every(10), None, &[2, 14, -15], &back);
        // The place itself again.
        check(Rule::Every(10), None, &[2, 5, -3], &[(2, true), (-1, false)]);
        // Pulses without a gap between.
        check(Rule::Every(2), None, &[0, 6, 7, 20, 26], &[(2, true)]);
        check(Rule::Every(0), None, &[2, 50], &[]);
        // Multiples go on through the counter's wrap.
        let edge = i32::MAX - 4;
        let wrapped = [(i32::MIN + 1, true), (i32::MIN + 4, false)];
        check(Rule::Every(6), None, &[edge, i32::MIN + 6], &wrapped);
    }

    #[test]
    fn a_window_hides_pulses_and_loses_none() {
        let shown = [(20, true), (23, false), (30, true), (33, false)];
        check(Rule::Every(10), Some([20, 30]), &[0, 45], &shown);
        check(Rule::Every(10), Some([30, 20]), &[0, 45], &[]);
        // It is for pulses only.
        check(Rule::While(Above(5)), Some([0, 0]), &[0, 9], &[(6, true)]);
    }

    #[test]
    fn what_was_met_stays_so() {
        let mut sync = Sync::new();
        assert_eq!(sync.status(), Status::Off);
        sync.switch_on(Rule::While(Above(5)), 0);
        assert_eq!((sync.status(), sync.level()), (Status::Waiting, false));
        sync.reach(6, 0);
        assert_eq!((sync.status(), sync.level()), (Status::Met, true));
        sync.reach(0, 0);
        assert_eq!((sync.status(), sync.level()), (Status::Met, false));
        sync.switch_off();
        assert_eq!((sync.status(), sync.level(), sync.room()), (Status::Off, false, None));
        sync.switch_on(Rule::While(Below(5)), 0);
        assert_eq!((sync.status(), sync.level()), (Status::Met, true));
    }

    #[test]
    fn counters_jump() {
        // An encoder with many counts a pulse passes the comparator within one.
        let mut sync = Sync::new();
        sync.switch_on(Rule::While(Equal(5)), 0);
        sync.reach(8, 0);
        assert_eq!((sync.status(), sync.level()), (Status::Met, false));
        sync.switch_on(Rule::Every(5), 0);
        sync.reach(18, 100);
        assert_eq!((sync.level(), sync.due(), sync.room()), (true, Some(100), Some([3, 2])));
        // Another number is not a way.
        sync.expire(100);
        sync.renumber(1000);
        assert_eq!((sync.level(), sync.room()), (false, Some([3, 2])));
        sync.switch_on(Rule::While(Above(5)), 0);
        sync.renumber(6);
        assert_eq!((sync.status(), sync.level()), (Status::Met, true));
    }
}
