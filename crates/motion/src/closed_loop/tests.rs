//! A motor that loses pulses, with an encoder on its shaft.

use super::*;
use crate::pps::{self, Profile};
use crate::{Direction, Scale, Ticks};

const CLOCK_HZ: u32 = 1_000_000;
const MILLISECOND: Ticks = CLOCK_HZ as Ticks / 1000;
const SCALE: Scale = pps::scale(1_000_000, CLOCK_HZ);
const TOP_PPS: u32 = 10_000;

const SETTINGS: Settings = Settings { ratio: Ratio::ONE, tolerance: 3, range: 100, attempts: 3 };

struct Bench {
    axis: Axis,
    settings: Settings,
    /// Pulses a count, in thousandths, as the mechanics have it.
    gear: i64,
    /// Where the shaft stands, in pulses.
    shaft: i64,
    blocked: bool,
    zero: i32,
    now: Ticks,
    snl: StepNLoop,
    /// Every change of status.
    log: Vec<Status>,
}

impl Bench {
    fn new(settings: Settings) -> Self {
        let profile = Profile {
            low_pps: 500,
            high_pps: TOP_PPS,
            acceleration_ms: 20,
            deceleration_ms: 20,
            s_curve: false,
        };
        let axis = Axis::new(profile.limits(SCALE, CLOCK_HZ));
        let mut snl = StepNLoop::new();
        snl.enable(&axis, 0);
        let gear = i64::from(settings.ratio.thousandths());
        let log = Vec::new();
        Self { axis, settings, gear, shaft: 0, blocked: false, zero: 0, now: 0, snl, log }
    }

    fn encoder(&self) -> i32 {
        ((self.shaft * 1000).div_euclid(self.gear) as i32).wrapping_add(self.zero)
    }

    fn position(&self) -> i32 {
        self.snl.position(&self.axis, self.settings.ratio)
    }

    fn delta(&self) -> i32 {
        self.snl.delta(&self.axis, self.encoder(), self.settings.ratio)
    }

    fn go(&mut self, target: i32) {
        let goal = self.snl.goal(&self.axis, target, self.settings.ratio).expect("within reach");
        self.axis.set_goal(Goal::Position(goal));
        self.snl.begin(&self.axis, Motion::To(target));
    }

    fn jog(&mut self, direction: Direction) {
        self.axis.set_goal(Goal::Speed(direction, pps::speed(TOP_PPS, SCALE, CLOCK_HZ)));
        self.snl.begin(&self.axis, Motion::Jog);
    }

    fn stop(&mut self) {
        self.axis.set_goal(Goal::Speed(self.axis.direction(), 0));
        self.snl.begin(&self.axis, Motion::Stop);
    }

    fn poll(&mut self) {
        let encoder = self.encoder();
        self.log.extend(self.snl.poll(&mut self.axis, encoder, &self.settings));
    }

    fn run(&mut self, ms: u64) {
        for _ in 0..ms {
            let tick = self.now + MILLISECOND;
            while let Some(wake) = self.axis.wake().filter(|&wake| wake < tick) {
                self.advance(wake);
            }
            self.advance(tick);
            self.poll();
        }
    }

    fn advance(&mut self, now: Ticks) {
        self.now = now;
        let before = self.axis.odometer();
        self.axis.advance(now, |_| ());
        if !self.blocked {
            self.shaft += self.axis.odometer() - before;
        }
    }

    #[track_caller]
    fn check(&self, status: Status, position: i32, encoder: i32) {
        assert_eq!((self.snl.status(), self.position(), self.encoder()), (status, position, encoder));
    }
}

#[test]
fn the_numbers_of_the_states() {
    use Status::*;
    let states = [
        Idle,
        Moving,
        Correcting,
        Stopping,
        Aborting,
        Jogging,
        Homing,
        IndexHoming,
        RangeError,
        AttemptError,
        StallError,
        LimitError,
        Off,
        LimitHoming,
    ];
    for (number, status) in states.into_iter().enumerate() {
        assert_eq!(status as usize, number);
        assert_eq!(status.is_error(), (8..=11).contains(&number));
    }
}

#[test]
fn a_move_is_in_counts() {
    let mut bench = Bench::new(Settings { ratio: Ratio::new(2500).unwrap(), ..SETTINGS });
    bench.go(1000);
    bench.run(50);
    assert_eq!(bench.snl.status(), Status::Moving);
    assert!(bench.delta().abs() <= 1);
    bench.run(500);
    bench.check(Status::Idle, 1000, 1000);
    assert_eq!(bench.axis.position(), 2500);
    bench.go(-1000);
    bench.run(1000);
    bench.check(Status::Idle, -1000, -1000);
    assert_eq!(bench.log, [Status::Idle, Status::Idle]);
}

/// Pulses lost on the way are made up for at the end of the move.
#[track_caller]
fn check_slip(pulses: i64, log: &[Status], encoder: i32) {
    let mut bench = Bench::new(SETTINGS);
    bench.go(1000);
    bench.run(50);
    bench.shaft -= pulses;
    bench.run(500);
    assert_eq!(bench.log, log, "{pulses}");
    bench.check(Status::Idle, 1000, encoder);
    // The next move starts from where the shaft is.
    bench.go(0);
    bench.run(500);
    assert_eq!((bench.position(), bench.encoder()), (0, encoder - 1000));
}

#[test]
fn lost_pulses_are_made_up_for() {
    use Status::{Correcting, Idle};
    check_slip(3, &[Idle], 997);
    check_slip(4, &[Correcting, Idle], 1000);
    check_slip(100, &[Correcting, Idle], 1000);
    check_slip(-100, &[Correcting, Idle], 1000);
    check_slip(-3, &[Idle], 1003);
}

#[test]
fn the_target_stays_while_a_correction_adds_pulses() {
    let mut bench = Bench::new(SETTINGS);
    bench.shaft = 80;
    bench.run(u64::from(SETTLING_POLLS));
    bench.check(Status::Correcting, 0, 80);
    bench.run(10);
    bench.check(Status::Correcting, 0, bench.encoder());
    assert!((1..80).contains(&bench.encoder()));
    bench.run(20);
    bench.check(Status::Idle, 0, 0);
    assert_eq!(bench.axis.position(), -80);
}

#[test]
fn a_push_at_rest() {
    let mut bench = Bench::new(SETTINGS);
    for (to, status, encoder) in
        [(3, Status::Idle, 3), (4, Status::Idle, 0), (-100, Status::Idle, 0), (101, Status::RangeError, 101)]
    {
        bench.shaft = to;
        bench.run(100);
        bench.check(status, 0, encoder);
    }
    // In the error nothing moves.
    let steps = bench.axis.steps();
    bench.shaft = 50;
    bench.run(100);
    assert_eq!((bench.snl.status(), bench.axis.steps()), (Status::RangeError, steps));
}

#[test]
fn a_short_swing_is_no_reason_to_correct() {
    let mut bench = Bench::new(SETTINGS);
    for _ in 0..10 {
        bench.shaft = 20;
        bench.run(u64::from(SETTLING_POLLS) - 1);
        bench.shaft = 0;
        bench.run(1);
    }
    assert_eq!((bench.axis.steps(), bench.snl.status()), (0, Status::Idle));
}

#[test]
fn a_blocked_shaft_is_a_stall() {
    let mut bench = Bench::new(SETTINGS);
    bench.go(1000);
    bench.run(50);
    bench.blocked = true;
    bench.run(100);
    assert_eq!(bench.snl.status(), Status::StallError);
    assert!(!bench.axis.is_moving());
    let delta = bench.delta();
    assert!((101..=111).contains(&delta), "{delta}: at once, which is within a millisecond");
    // Nothing begins in the error.
    bench.snl.begin(&bench.axis, Motion::Jog);
    assert_eq!(bench.snl.status(), Status::StallError);
    bench.blocked = false;
    let (steps, encoder) = (bench.axis.steps(), bench.encoder());
    bench.snl.clear(&bench.axis, encoder);
    bench.run(100);
    bench.check(Status::Idle, encoder, encoder);
    assert_eq!(bench.axis.steps(), steps);
    bench.go(1000);
    bench.run(500);
    bench.check(Status::Idle, 1000, 1000);
}

/// The shaft moves half as far as the ratio says: every correction halves what is left.
#[track_caller]
fn check_wrong_ratio(attempts: u32, log: &[Status], encoder: i32) {
    let mut bench = Bench::new(Settings { attempts, range: 1000, ..SETTINGS });
    bench.gear = 2000;
    bench.go(64);
    bench.run(1000);
    assert_eq!(bench.log, log);
    assert_eq!((bench.position(), bench.encoder()), (64, encoder));
}

#[test]
fn corrections_that_do_not_help() {
    use Status::{AttemptError, Correcting, Idle};
    check_wrong_ratio(0, &[AttemptError], 32);
    check_wrong_ratio(1, &[Correcting, AttemptError], 48);
    check_wrong_ratio(3, &[Correcting, AttemptError], 60);
    check_wrong_ratio(4, &[Correcting, Idle], 62);
    // A narrow error range sees it on the way.
    let mut bench = Bench::new(Settings { range: 20, ..SETTINGS });
    bench.gear = 2000;
    bench.go(64);
    bench.run(100);
    assert_eq!(bench.log, [Status::StallError]);
}

#[test]
fn attempts_count_anew_after_success() {
    let mut bench = Bench::new(Settings { attempts: 1, ..SETTINGS });
    for push in [50, -50, 50] {
        bench.shaft += push;
        bench.run(100);
        bench.check(Status::Idle, 0, 0);
    }
}

#[test]
fn the_smallest_and_the_largest_ratio() {
    // A pulse is 1000 counts: nearer than half of them nobody can come.
    let fine = Settings { ratio: Ratio::new(1).unwrap(), tolerance: 0, range: 5000, ..SETTINGS };
    let mut bench = Bench::new(fine);
    bench.go(123_456);
    bench.run(1000);
    bench.check(Status::Idle, 123_456, 123_000);
    bench.shaft -= 2;
    bench.run(100);
    bench.check(Status::Idle, 123_456, 123_000);
    bench.go(-2_000_000_000);
    assert_eq!(bench.axis.goal(), Goal::Position(2 - 2_000_000));
    // And the other end.
    let mut bench = Bench::new(Settings { ratio: Ratio::new(MAX_THOUSANDTHS).unwrap(), ..SETTINGS });
    bench.go(7);
    bench.run(1500);
    assert_eq!(bench.axis.position(), 7000);
    bench.check(Status::Idle, 7, 7);
    let ratio = bench.settings.ratio;
    assert_eq!(bench.snl.goal(&bench.axis, 2_147_492, ratio), Some(2_147_489_853_u32 as i32));
    assert_eq!(bench.snl.goal(&bench.axis, 2_147_493, ratio), None);
    assert_eq!(bench.snl.goal(&bench.axis, i32::MIN, ratio), None);
}

#[test]
fn rounding_does_not_add_up() {
    let mut bench = Bench::new(Settings { ratio: Ratio::new(1333).unwrap(), ..SETTINGS });
    for target in 1..=1000 {
        bench.go(target);
        bench.run(5);
    }
    assert_eq!(bench.axis.position(), 1333);
    assert_eq!(bench.log, [Status::Idle; 1000]);
}

#[test]
fn a_disturbed_jog() {
    let mut bench = Bench::new(SETTINGS);
    bench.jog(Direction::Negative);
    bench.run(100);
    bench.shaft += 100;
    bench.run(100);
    assert_eq!((bench.snl.status(), bench.delta()), (Status::Jogging, -100));
    bench.stop();
    bench.run(10);
    assert_eq!(bench.snl.status(), Status::Stopping);
    bench.run(100);
    // After a stop nothing moves by itself.
    assert_eq!(bench.log, [Status::Idle]);
    bench.check(Status::Idle, bench.encoder(), bench.axis.position() + 100);
    bench.jog(Direction::Positive);
    bench.run(100);
    bench.shaft -= 101;
    bench.run(1);
    assert_eq!((bench.snl.status(), bench.axis.is_moving()), (Status::StallError, false));
}

#[test]
fn a_line_carries_the_axis() {
    let mut bench = Bench::new(SETTINGS);
    bench.snl.begin(&bench.axis, Motion::To(500));
    bench.axis.carry(Direction::Positive, 200);
    assert!(!bench.snl.watch(&bench.axis, 100, &SETTINGS));
    assert_eq!((bench.snl.status(), bench.position()), (Status::Moving, 200));
    assert!(bench.snl.watch(&bench.axis, 99, &SETTINGS));
    assert_eq!((bench.snl.status(), bench.position()), (Status::StallError, 200));
    assert!(!bench.snl.watch(&bench.axis, 99, &SETTINGS), "once");
}

#[test]
fn stopped_in_a_correction() {
    let mut bench = Bench::new(SETTINGS);
    bench.shaft = 80;
    bench.run(u64::from(SETTLING_POLLS) + 8);
    assert_eq!(bench.snl.status(), Status::Correcting);
    bench.axis.halt();
    bench.snl.begin(&bench.axis, Motion::Abort);
    bench.check(Status::Aborting, 0, bench.encoder());
    let encoder = bench.encoder();
    bench.run(100);
    bench.check(Status::Idle, encoder, encoder);
}

#[test]
fn homing_keeps_what_the_pulses_say() {
    for (motion, number) in [(Motion::Home, 6), (Motion::IndexHome, 7), (Motion::LimitHome, 13)] {
        let mut bench = Bench::new(SETTINGS);
        bench.axis.set_goal(Goal::Speed(Direction::Positive, pps::speed(TOP_PPS, SCALE, CLOCK_HZ)));
        bench.snl.begin(&bench.axis, motion);
        assert_eq!(bench.snl.status() as u8, number);
        bench.run(100);
        // The trigger.
        bench.axis.set_position(0);
        bench.zero = bench.zero.wrapping_sub(bench.encoder());
        bench.snl.zero(&bench.axis);
        bench.axis.set_goal(Goal::Speed(Direction::Positive, 0));
        bench.shaft -= 10;
        bench.run(100);
        assert_eq!(bench.log, [Status::Idle, Status::Correcting, Status::Idle]);
        let position = bench.position();
        assert!(position > 50);
        bench.check(Status::Idle, position, position);
    }
}

#[test]
fn homing_goes_on_when_it_turns_around() {
    let mut bench = Bench::new(SETTINGS);
    bench.snl.begin(&bench.axis, Motion::Home);
    for way in [Direction::Negative, Direction::Positive] {
        bench.poll();
        bench.axis.set_goal(Goal::Speed(way, pps::speed(TOP_PPS, SCALE, CLOCK_HZ)));
        bench.run(100);
        bench.axis.halt();
        assert_eq!(bench.snl.status(), Status::Homing);
    }
    bench.run(2);
    bench.check(Status::Idle, bench.encoder(), bench.encoder());
}

#[test]
fn setting_the_encoder_keeps_delta() {
    let mut bench = Bench::new(SETTINGS);
    bench.go(500);
    bench.run(10);
    bench.shaft -= 2;
    bench.zero -= 1000;
    bench.snl.shift(-1000);
    assert_eq!(bench.delta(), 2);
    bench.run(500);
    bench.check(Status::Idle, -500, -502);
    bench.go(0);
    bench.run(500);
    bench.check(Status::Idle, 0, -2);
}

#[test]
fn counters_wrap() {
    let mut bench = Bench::new(SETTINGS);
    bench.snl.disable();
    bench.zero = i32::MAX - 100;
    bench.snl.enable(&bench.axis, bench.encoder());
    bench.go(i32::MIN + 100);
    bench.run(100);
    bench.check(Status::Idle, i32::MIN + 100, i32::MIN + 100);
    assert_eq!(bench.axis.position(), 201);
}

#[test]
fn a_limit_and_switching_off() {
    let mut bench = Bench::new(SETTINGS);
    bench.jog(Direction::Positive);
    bench.run(100);
    bench.axis.halt();
    bench.snl.limit(&bench.axis, Ratio::ONE);
    let position = bench.position();
    bench.shaft += 5;
    bench.run(100);
    assert_eq!((bench.snl.status() as u8, bench.position(), bench.delta()), (11, position, -5));
    bench.snl.disable();
    bench.snl.clear(&bench.axis, bench.encoder());
    assert_eq!((bench.snl.status() as u8, bench.delta()), (12, 0));
    bench.axis.set_position(-7);
    assert_eq!(bench.position(), -7);
    bench.shaft += 5000;
    bench.run(100);
    assert_eq!(bench.log, []);
    // On again, in the middle of a motion.
    bench.jog(Direction::Negative);
    bench.run(10);
    bench.snl.enable(&bench.axis, bench.encoder());
    assert_eq!((bench.snl.status(), bench.delta()), (Status::Jogging, 0));
    bench.run(100);
    assert_eq!((bench.snl.status(), bench.delta()), (Status::Jogging, 0));
}

/// Moves, stops, pushes and ratios at random: in the end the axis is in position or the loop says why not,
/// and then it can be cleared.
#[test]
fn whatever_happens_it_settles_or_says_so() {
    let mut seed = 1u64;
    let mut random = move |below: u64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) % below
    };
    let mut seen = [0; 14];
    for _ in 0..60 {
        let ratio = Ratio::new([100, 500, 1000, 1700, 9_999][random(5) as usize]).unwrap();
        let mut bench = Bench::new(Settings { ratio, tolerance: random(4) as u32, ..SETTINGS });
        for _ in 0..20 {
            let target = random(2000) as i32 - 1000;
            match random(8) {
                0 => bench.blocked = true,
                1..=2 => bench.shaft += random(200) as i64 - 100,
                _ if bench.snl.status().is_error() => {}
                3 => bench.jog(Direction::of(target.into())),
                4 => bench.stop(),
                _ => bench.go(target),
            }
            bench.run(random(60));
            bench.blocked = false;
            seen[bench.snl.status() as usize] += 1;
        }
        if bench.snl.status() == Status::Jogging {
            bench.stop();
        }
        bench.run(3000);
        if bench.snl.status().is_error() {
            let steps = bench.axis.steps();
            bench.snl.clear(&bench.axis, bench.encoder());
            bench.run(10);
            assert_eq!(bench.axis.steps(), steps);
        }
        assert_eq!(bench.snl.status(), Status::Idle);
        let delta = bench.delta().unsigned_abs();
        assert!(delta <= bench.settings.tolerance || ratio.pulses(delta.into()) == 0);
    }
    for status in [Status::Idle, Status::Moving, Status::Correcting, Status::Stopping, Status::Jogging] {
        assert_ne!(seen[status as usize], 0, "{status:?}");
    }
    assert_ne!(seen[Status::StallError as usize], 0);
}
