//! Timing tables of whole ramps, a line for every few pulses and every change.
//! `INSTA_UPDATE=always cargo test -p motion --test timing` writes them anew.

use motion::{Axis, Direction, Goal, Limits, Shape, Stop, tmc429};
use std::fmt::Write;

/// Speed 1678, acceleration 100, divisors 3 and 7: about 51,208 pulses a second with 46,566 a second².
fn limits() -> Limits {
    Limits {
        scale: tmc429::scale(3),
        top: tmc429::speed(1678),
        start: tmc429::speed(1),
        stop: tmc429::speed(1),
        growth: tmc429::growth(100, 3, 7),
        fall: tmc429::growth(100, 3, 7),
        shape: Shape::Trapezoid,
    }
}

struct Table {
    axis: Axis,
    now: u64,
    text: String,
}

impl Table {
    fn new(limits: Limits) -> Self {
        Self { axis: Axis::new(limits), now: 0, text: "       clock  position  speed\n".into() }
    }

    fn change(mut self, what: &str, change: impl FnOnce(&mut Axis)) -> Self {
        let _ = writeln!(self.text, "{what}");
        change(&mut self.axis);
        self
    }

    /// So many pulses, or to rest, with a line every `every` pulses.
    fn pulses(mut self, pulses: i64, every: i64) -> Self {
        let from = self.axis.odometer();
        let mut done = 0;
        while done < pulses {
            done += every.min(pulses - done);
            self.axis.set_window(from - done, from + done);
            while (self.axis.odometer() - from).abs() < done {
                let Some(wake) = self.axis.wake() else {
                    self.line();
                    self.text += "at rest\n";
                    return self;
                };
                self.now = wake;
                self.axis.advance(wake, |_| {});
            }
            self.line();
        }
        self
    }

    fn line(&mut self) {
        let speed = tmc429::internal(self.axis.speed()) * self.axis.direction().sign() as i32;
        let _ = writeln!(self.text, "{:>12} {:>9} {speed:>6}", self.now, self.axis.position());
    }
}

#[test]
fn trapezoid() {
    let table = Table::new(limits()).change("to 70000", |axis| axis.set_goal(Goal::Position(70_000)));
    insta::assert_snapshot!(table.pulses(i64::MAX, 4000).text);
}

#[test]
fn triangle() {
    let table = Table::new(limits()).change("to -40", |axis| axis.set_goal(Goal::Position(-40)));
    insta::assert_snapshot!(table.pulses(i64::MAX, 1).text);
}

#[test]
fn soft() {
    let table = Table::new(Limits { shape: Shape::Soft, ..limits() })
        .change("softly to 100000", |axis| axis.set_goal(Goal::Position(100_000)));
    insta::assert_snapshot!(table.pulses(i64::MAX, 4000).text);
}

#[test]
fn reversal() {
    let table = Table::new(limits())
        .change("to 10000", |axis| axis.set_goal(Goal::Position(10_000)))
        .pulses(3000, 500)
        .change("to -2000", |axis| axis.set_goal(Goal::Position(-2000)));
    insta::assert_snapshot!(table.pulses(i64::MAX, 1000).text);
}

#[test]
fn speed_change() {
    let speed = |speed| Goal::Speed(Direction::Positive, tmc429::speed(speed));
    let table = Table::new(limits())
        .change("at 500", |axis| axis.set_goal(speed(500)))
        .pulses(4000, 500)
        .change("at 200", |axis| axis.set_goal(speed(200)))
        .pulses(4000, 500)
        .change("stop", |axis| axis.set_goal(speed(0)));
    insta::assert_snapshot!(table.pulses(i64::MAX, 100).text);
}

#[test]
fn blocks() {
    let block = |stop| move |axis: &mut Axis| axis.set_blocked(Direction::Positive, stop);
    let table = Table::new(limits())
        .change("to 5000", |axis| axis.set_goal(Goal::Position(5000)))
        .pulses(1000, 250)
        .change("soft block", block(Some(Stop::Soft)))
        .pulses(i64::MAX, 250)
        .change("free", block(None))
        .pulses(500, 100)
        .change("hard block", block(Some(Stop::Hard)))
        .pulses(i64::MAX, 250)
        .change("free", block(None));
    insta::assert_snapshot!(table.pulses(i64::MAX, 500).text);
}
