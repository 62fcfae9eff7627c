//! What may happen to an axis of a Performax while it moves (PMX-2ED-SA manual, sections 7.2 to 7.10).

use motion::pps::{self, CLOCK_HZ, PERFORMAX, Profile};
use motion::{Axis, Direction, Goal, Limits, Scale, Ticks};

const PROFILE: Profile =
    Profile { low_pps: 1000, high_pps: 10_000, acceleration_ms: 100, deceleration_ms: 40, s_curve: false };

/// Clocks in a millisecond.
const MS: Ticks = CLOCK_HZ as Ticks / 1000;

fn scale() -> Scale {
    pps::scale(pps::window(&PERFORMAX, PROFILE.high_pps).to_pps, CLOCK_HZ)
}

fn limits(s_curve: bool) -> Limits {
    Profile { s_curve, ..PROFILE }.limits(scale(), CLOCK_HZ)
}

/// An axis with its clock and the clocks of its pulses, their directions in the sign.
#[derive(Clone)]
struct Bench {
    axis: Axis,
    now: Ticks,
    pulses: Vec<i64>,
}

impl Bench {
    fn new(s_curve: bool, goal: Goal) -> Self {
        let mut axis = Axis::new(limits(s_curve));
        axis.set_goal(goal);
        Self { axis, now: 0, pulses: Vec::new() }
    }

    fn until(&mut self, then: Ticks) {
        while self.now < then {
            let wake = self.axis.wake().unwrap_or(Ticks::MAX).min(then);
            let pulses = &mut self.pulses;
            self.axis.advance(wake, |train| {
                pulses.extend(train.edges().map(|clock| clock as i64 * train.direction.sign()));
            });
            self.now = wake;
        }
    }

    fn finish(&mut self) {
        while let Some(wake) = self.axis.wake() {
            self.until(wake);
        }
    }

    fn pps(&self) -> u32 {
        pps::pps(self.axis.speed(), scale(), CLOCK_HZ)
    }

    #[track_caller]
    fn check(&self, pps: u32, acceleration: i32) {
        let found = (self.pps(), self.axis.acceleration());
        assert!(found.0.abs_diff(pps) <= pps / 50, "{found:?}");
        assert_eq!(found.1, acceleration);
    }
}

fn jog(pps: u32) -> Goal {
    Goal::Speed(Direction::Positive, pps::speed(pps, scale(), CLOCK_HZ))
}

#[test]
fn a_move_tells_how_its_speed_changes() {
    for s_curve in [false, true] {
        let mut bench = Bench::new(s_curve, Goal::Position(3000));
        bench.until(50 * MS);
        bench.check(5500, 1);
        bench.until(150 * MS);
        bench.check(10_000, 0);
        // 3000 pulses: 550 in 100 ms, 220 in 40 ms, the others in 223 ms.
        bench.until(343 * MS);
        bench.check(5500, -1);
        bench.finish();
        bench.check(0, 0);
        assert!(bench.now.abs_diff(363 * MS) < MS, "{}", bench.now);
        assert_eq!(bench.axis.position(), 3000);
    }
}

#[test]
fn the_speed_changes_on_the_way() {
    let mut bench = Bench::new(false, jog(10_000));
    bench.until(200 * MS);
    // 90,000 pps² up, 225,000 down.
    bench.axis.set_goal(jog(5500));
    bench.until(210 * MS);
    bench.check(7750, -1);
    bench.until(300 * MS);
    bench.check(5500, 0);
    bench.axis.set_goal(jog(14_500));
    bench.until(350 * MS);
    bench.check(10_000, 1);
    bench.until(500 * MS);
    bench.check(14_500, 0);

    let mut bench = Bench::new(false, Goal::Position(9000));
    bench.until(200 * MS);
    bench.axis.set_limits(Limits { top: pps::speed(2000, scale(), CLOCK_HZ), ..bench.axis.limits() });
    bench.until(250 * MS);
    bench.check(2000, 0);
    bench.finish();
    assert_eq!((bench.axis.position(), bench.pulses.len()), (9000, 9000));
}

#[test]
fn an_acceleration_changes_on_the_way() {
    let mut bench = Bench::new(false, jog(10_000));
    bench.until(50 * MS);
    let steep = Profile { acceleration_ms: 50, ..PROFILE }.limits(scale(), CLOCK_HZ);
    bench.axis.set_limits(steep);
    bench.check(5500, 1);
    bench.until(65 * MS);
    bench.check(8200, 1);
}

#[test]
fn a_target_changes_on_the_way() {
    for s_curve in [false, true] {
        for target in [5000, 1500, 1000, 0, -700] {
            let mut bench = Bench::new(s_curve, Goal::Position(3000));
            bench.until(150 * MS);
            let passed = bench.axis.position();
            bench.axis.set_goal(Goal::Position(target));
            bench.finish();
            assert_eq!(bench.axis.position(), target);
            let back = bench.pulses.iter().filter(|clock| **clock < 0).count();
            assert_eq!(back > 0, target < passed + 220, "to {target} after {passed}");
        }
    }
}

#[test]
fn a_stop_slows_down_and_an_abort_does_not() {
    for s_curve in [false, true] {
        for goal in [Goal::Position(3000), jog(10_000)] {
            let mut bench = Bench::new(s_curve, goal);
            bench.until(200 * MS);
            let (made, mut aborted) = (bench.pulses.len(), bench.clone());
            bench.axis.set_goal(Goal::Speed(Direction::Positive, 0));
            bench.until(220 * MS);
            bench.check(5500, -1);
            bench.finish();
            assert!((219..=222).contains(&(bench.pulses.len() - made)));
            assert!(bench.now.abs_diff(240 * MS) < MS);

            aborted.axis.halt();
            assert!(!aborted.axis.is_moving() && aborted.axis.wake().is_none());
            aborted.until(300 * MS);
            assert_eq!(aborted.pulses.len(), made);
        }
    }
}

#[test]
fn an_abort_takes_effect_at_the_end_of_its_clock() {
    let mut whole = Bench::new(false, jog(10_000));
    whole.until(2 * MS);
    let second = whole.pulses[1] as Ticks;
    for (clock, made) in [(second - 1, 1), (second, 2)] {
        let mut bench = Bench::new(false, jog(10_000));
        bench.until(clock);
        bench.axis.halt();
        bench.until(10 * MS);
        assert_eq!(bench.pulses.len(), made);
    }
}

#[test]
fn a_counter_set_on_the_way_disturbs_nothing() {
    let stop = Goal::Speed(Direction::Positive, 0);
    for s_curve in [false, true] {
        for (goal, then) in [(jog(10_000), stop), (jog(10_000), jog(3000)), (Goal::Position(3000), stop)] {
            for step in 1..40 {
                let mut bench = Bench::new(s_curve, goal);
                bench.until(100 * MS);
                bench.axis.set_goal(then);
                let mut undisturbed = bench.clone();
                bench.until(100 * MS + step * MS);
                let made = bench.pulses.len();
                bench.axis.set_position(0);
                bench.until(300 * MS);
                undisturbed.until(300 * MS);
                assert_eq!(bench.pulses, undisturbed.pulses);
                assert_eq!(bench.axis.position() as usize, bench.pulses.len() - made);
            }
        }
    }
}

#[test]
fn a_target_goes_with_a_renumbered_place() {
    for s_curve in [false, true] {
        let mut undisturbed = Bench::new(s_curve, Goal::Position(-3000));
        undisturbed.finish();
        for step in 1..70 {
            let mut bench = Bench::new(s_curve, Goal::Position(-3000));
            bench.until(step * 5 * MS);
            let made = bench.pulses.len() as i32;
            bench.axis.renumber(i32::MIN + 5);
            bench.finish();
            assert_eq!(bench.pulses, undisturbed.pulses);
            assert_eq!(bench.axis.position(), i32::MIN.wrapping_add(5 - 3000 + made));
            assert_eq!(bench.axis.goal(), Goal::Position(bench.axis.position()));
        }
    }
}

/// Places at which the axis wakes on its way, with windows and marks that are not moved any more.
#[test]
fn windows_and_marks_wake_the_axis_at_their_pulse() {
    let stops = |window: [i64; 2], marks: [i64; 2], places: &[i64]| {
        let mut bench = Bench::new(false, Goal::Position(3000));
        bench.axis.set_window(window[0], window[1]);
        bench.axis.set_marks(marks[0], marks[1]);
        let mut seen = Vec::new();
        while let Some(wake) = bench.axis.wake() {
            bench.until(wake);
            seen.push(bench.axis.odometer());
        }
        assert!(places.iter().all(|place| seen.contains(place)), "{places:?} in {seen:?}");
        assert_eq!(bench.axis.position(), 3000);
    };
    stops([-1, 1001], [-1, 1777], &[1001, 1777]);
    stops([-1, 1777], [-1, 1001], &[1001, 1777]);
    // What lies behind does not hide what is to come.
    stops([-1, 1], [-1, 1777], &[1, 1777]);
    stops([i64::MIN, i64::MAX], [i64::MIN, 1777], &[1777]);
}
