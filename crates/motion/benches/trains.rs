//! What pulse trains cost: making them, and expanding them to edges.
//!
//! Each figure is the median of many short runs, taken in turn with its baseline, a plain loop that
//! writes timestamps with `interval += add`. `cargo bench -p motion --bench trains -- expand` runs some.

use motion::pps::{self, CLOCK_HZ, Profile};
use motion::{Axis, Goal, Limits, Move, Path, Shape, Ticks, Train, tmc429};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// Runs of each piece of work.
const ROUNDS: usize = 1001;

/// Edges a run.
const EDGES: usize = 1 << 16;

fn limits(shape: Shape) -> Limits {
    Limits {
        scale: tmc429::scale(3),
        top: tmc429::speed(1678),
        start: tmc429::speed(1),
        stop: tmc429::speed(1),
        growth: tmc429::growth(100, 3, 7),
        fall: tmc429::growth(100, 3, 7),
        shape,
    }
}

/// Moves there and back, until some number of trains is made.
fn make(axis: &mut Axis, way: i32, trains: usize) -> usize {
    let mut made = 0;
    while made < trains {
        let Some(wake) = axis.wake() else {
            let target = if axis.position() == 0 { way } else { 0 };
            axis.set_goal(Goal::Position(target));
            continue;
        };
        axis.advance(wake, |train| {
            black_box(train);
            made += 1;
        });
    }
    made
}

/// The trains of a trapezoid of [`EDGES`] pulses.
fn trapezoid(shape: Shape) -> Vec<Train> {
    let mut axis = Axis::new(limits(shape));
    axis.set_goal(Goal::Position(EDGES as i32));
    let mut trains = Vec::new();
    while let Some(wake) = axis.wake() {
        axis.advance(wake, |train| trains.push(*train));
    }
    trains
}

/// The limits of a Performax that goes from 1,000 to 100,000 pulses a second in 300 ms.
fn performax(s_curve: bool) -> Limits {
    let [low_pps, high_pps] = [1000, 100_000];
    let profile = Profile { low_pps, high_pps, acceleration_ms: 300, deceleration_ms: 300, s_curve };
    profile.limits(pps::scale(high_pps, CLOCK_HZ), CLOCK_HZ)
}

/// Moves there and back with all their edges, until there are as many as the room.
fn make_edges(axis: &mut Axis, way: i32, edges: &mut [Ticks]) -> usize {
    let mut done = 0;
    while done < edges.len() {
        let Some(wake) = axis.wake() else {
            let target = if axis.position() == 0 { way } else { 0 };
            axis.set_goal(Goal::Position(target));
            continue;
        };
        axis.advance(wake, |train| done += train.expand(&mut edges[done..]));
    }
    black_box(edges);
    done
}

/// The edges of both axes of a line.
fn line_edges(now: &mut Ticks, axes: &mut [Axis; 2], way: [i32; 2], edges: &mut [Ticks]) -> usize {
    let mut done = 0;
    let mut line = Path::new(performax(false), &Move::Line(way), *now, axes);
    while let Some(wake) = line.wake(axes) {
        *now = wake;
        line.advance(wake, axes, |_, train| done += train.expand(&mut edges[done..]));
    }
    black_box(edges);
    done
}

/// The baseline: timestamps at a spacing that changes evenly.
fn plain(edges: &mut [Ticks], mut interval: u64, add: u64) {
    let mut at = 0u64;
    for edge in edges {
        at = at.wrapping_add(interval);
        interval = interval.wrapping_add(add);
        *edge = at;
    }
}

fn time(work: &mut dyn FnMut() -> usize) -> f64 {
    let begin = Instant::now();
    let done = black_box(work());
    let spent = begin.elapsed().max(Duration::from_nanos(1));
    done as f64 / spent.as_secs_f64() / 1e6
}

fn median(rates: &mut [f64]) -> f64 {
    rates.sort_by(f64::total_cmp);
    rates[rates.len() / 2]
}

/// Millions a second of the work and of the baseline, run in turn.
fn compare(name: &str, goal: Option<f64>, work: &mut dyn FnMut() -> usize) {
    if std::env::args().skip(1).any(|filter| !filter.starts_with('-') && !name.contains(&filter)) {
        return;
    }
    let mut edges = vec![0; EDGES];
    let mut baseline = || {
        plain(black_box(&mut edges), black_box(300 << 32), black_box(1 << 20));
        EDGES
    };
    let (mut rates, mut bases) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        rates.push(time(work));
        bases.push(time(&mut baseline));
    }
    let (rate, base) = (median(&mut rates), median(&mut bases));
    let goal = goal.map_or(String::new(), |goal| format!(", goal {goal}"));
    println!("{name:<44} {rate:8.1} M/s, {:6.3} of the baseline's {base:.0} M edges/s{goal}", rate / base);
}

fn main() {
    let mut edges = vec![0; EDGES];
    for (name, shape, goal) in [
        ("expand a trapezoid, edges", Shape::Trapezoid, Some(300.0)),
        ("expand a soft approach, edges", Shape::Soft, None),
    ] {
        let trains = trapezoid(shape);
        compare(name, goal, &mut || {
            let mut done = 0;
            for train in black_box(&trains) {
                done += train.expand(black_box(&mut edges[done..]));
            }
            done
        });
    }
    for (name, shape, way, goal) in [
        ("make the trains of trapezoids, trains", Shape::Trapezoid, 1 << 16, Some(10.0)),
        ("make the trains of soft approaches, trains", Shape::Soft, 1 << 16, None),
        ("make the trains of single pulses, trains", Shape::Trapezoid, 1, None),
    ] {
        let mut axis = Axis::new(limits(shape));
        compare(name, goal, &mut || make(&mut axis, way, 2000));
    }
    for (name, s_curve, way, goal) in [
        ("S-curves, made and expanded, edges", true, 30_000, Some(150.0)),
        ("trapezoids, made and expanded, edges", false, 30_000, None),
        ("moves of 80 pulses, made and expanded, edges", false, 80, Some(100.0)),
    ] {
        let mut axis = Axis::new(performax(s_curve));
        compare(name, goal, &mut || make_edges(&mut axis, way, &mut edges));
    }
    for (name, way) in [
        ("lines of two axes, edges of both", [30_000, -18_541]),
        ("lines of two axes nearly along one, edges", [30_000, 200]),
    ] {
        let (mut axes, mut now) = ([(); 2].map(|()| Axis::new(performax(false))), 0);
        compare(name, Some(200.0), &mut || line_edges(&mut now, &mut axes, way, &mut edges));
    }
}
