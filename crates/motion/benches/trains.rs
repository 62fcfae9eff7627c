//! What pulse trains cost: making them, and expanding them to edges.
//!
//! `cargo bench -p motion --bench trains -- expand` runs some.

mod compare;

use compare::{EDGES, compare};
use motion::pps::{self, CLOCK_HZ, Profile};
use motion::{Axis, Goal, Limits, Shape, Ticks, Train, tmc429};
use std::hint::black_box;

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
}
