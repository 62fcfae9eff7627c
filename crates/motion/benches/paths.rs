//! What interpolation costs: paths made and expanded to the edges of all axes.
//!
//! `cargo bench -p motion --bench paths -- circle` runs some.

mod compare;

use compare::{EDGES, compare};
use motion::path::{Arc, End, Turn};
use motion::pps::{self, CLOCK_HZ, Profile};
use motion::{Axis, Goal, Limits, Move, Path, Ticks, Train, merge};
use std::hint::black_box;

const AXES: usize = 4;

/// 100,000 pulses a second, with ramps of 300 ms from 1,000.
fn limits(ramps: bool) -> Limits {
    let high_pps = 100_000;
    let low_pps = if ramps { 1000 } else { high_pps };
    let profile = Profile { low_pps, high_pps, acceleration_ms: 300, deceleration_ms: 300, s_curve: false };
    profile.limits(pps::scale(high_pps, CLOCK_HZ), CLOCK_HZ)
}

/// A circle of two axes, about a centre seen from the start, and perhaps the way of a third.
fn circle(centre: [i32; 2], along: Option<(usize, i32)>) -> Move<AXES> {
    Move::Arc(Arc::new([0, 1], centre, Turn::Clockwise, End::Circle, along).expect("a circle"))
}

/// The edges of all axes of moves, until there are enough.
fn make_edges<const N: usize>(
    now: &mut Ticks,
    axes: &mut [Axis; N],
    limits: Limits,
    moves: &Move<N>,
    edges: &mut [Ticks],
) -> usize {
    let [mut done, mut at] = [0; 2];
    while done + at < EDGES / 2 {
        let mut path = Path::new(limits, moves, *now, axes);
        while let Some(wake) = path.wake(axes) {
            *now = wake;
            path.advance(wake, axes, |_, train| {
                // Over those that were there before, where the room ends.
                if edges.len() - at < train.count as usize {
                    (done, at) = (done + at, 0);
                }
                at += train.expand(&mut edges[at..]);
            });
        }
    }
    black_box(edges);
    done + at
}

/// What moves of a kind cost.
fn cost<const N: usize>(name: &str, limits: Limits, moves: Move<N>, goal: Option<f64>, edges: &mut [Ticks]) {
    let (mut axes, mut now) = ([(); N].map(|()| Axis::new(limits)), 0);
    compare(name, goal, &mut || make_edges(&mut now, &mut axes, limits, &moves, edges));
}

/// Clock of the CMD-4CR, and its fastest speed.
const FAST_CLOCK_HZ: u32 = 19_660_800;
const FAST_PPS: u32 = 6_553_500;
const PULSES_A_SECOND: f64 = FAST_PPS as f64 * AXES as f64;

/// A long way, and clocks between two looks at all axes.
const FAR: i32 = 1 << 30;
const SLICE: Ticks = 10_000;

fn fastest() -> Limits {
    let (low_pps, high_pps) = (100_000, FAST_PPS);
    let profile = Profile { low_pps, high_pps, acceleration_ms: 10, deceleration_ms: 10, s_curve: false };
    profile.limits(pps::scale(FAST_PPS, FAST_CLOCK_HZ), FAST_CLOCK_HZ)
}

/// Merges the trains of axes and shows every pulse to an observer that keeps a sum of all that it sees. Gives
/// their number.
fn observe(trains: &mut [Vec<Train>; AXES], sum: &mut u64) -> usize {
    merge::merge(trains.each_ref().map(|trains| trains.as_slice()), |pulses| {
        let axes = u64::from(pulses.axes()) << 8 | u64::from(pulses.negative());
        *sum = sum.rotate_left(1) ^ pulses.clock ^ axes;
    });
    let pulses = trains.iter().flatten().map(|train| train.count as usize).sum();
    trains.iter_mut().for_each(Vec::clear);
    pulses
}

/// There and back on a line, as far as a position goes.
fn far(axes: &[Axis; AXES]) -> Move<AXES> {
    Move::Line(axes.each_ref().map(|axis| if axis.position() > 0 { -FAR } else { FAR }))
}

/// Four axes at full speed on a line, without an observer: how many pulses go by.
fn pass_unobserved(name: &str) {
    let limits = fastest();
    let (mut axes, mut now) = ([(); AXES].map(|()| Axis::new(limits)), 0);
    let goal = 100_000.0 * PULSES_A_SECOND / 1e6;
    compare(name, Some(goal), &mut || {
        let mut path = Path::new(limits, &far(&axes), now, &mut axes);
        let mut pulses = 0;
        while let Some(wake) = path.wake(&axes) {
            now = wake;
            path.advance(now, &mut axes, |_, train| pulses += black_box(train).count as usize);
        }
        pulses
    });
}

/// The same with every pulse of all axes merged, for some time.
fn observe_line(name: &str) {
    let limits = fastest();
    let (mut axes, mut now) = ([(); AXES].map(|()| Axis::new(limits)), 0);
    let (mut trains, mut sum) = ([(); AXES].map(|()| Vec::new()), 0);
    let mut path = Path::new(limits, &far(&axes), now, &mut axes);
    compare(name, Some(10.0 * PULSES_A_SECOND / 1e6), &mut || {
        let mut pulses = 0;
        while pulses < EDGES {
            match path.wake(&axes) {
                Some(wake) => now = wake.min(now + SLICE),
                None => path = Path::new(limits, &far(&axes), now, &mut axes),
            }
            path.advance(now, &mut axes, |axis, train| trains[axis].push(*train));
            pulses += observe(&mut trains, &mut sum);
        }
        pulses
    });
    black_box(sum);
}

/// And with each axis on its own.
fn observe_axes(name: &str) {
    let limits = fastest();
    let (mut axes, mut now) = ([(); AXES].map(|()| Axis::new(limits)), 0);
    let (mut trains, mut sum) = ([(); AXES].map(|()| Vec::new()), 0);
    compare(name, Some(10.0 * PULSES_A_SECOND / 1e6), &mut || {
        let mut pulses = 0;
        while pulses < EDGES {
            now += SLICE;
            for (number, (axis, trains)) in (0..).zip(axes.iter_mut().zip(&mut trains)) {
                // They do not set out together.
                if !axis.is_moving() && now > 77_777 * number {
                    axis.set_goal(Goal::Position(if axis.position() > 0 { -FAR } else { FAR }));
                }
                axis.advance(now, |train| trains.push(*train));
            }
            pulses += observe(&mut trains, &mut sum);
        }
        pulses
    });
    black_box(sum);
}

fn main() {
    pass_unobserved("four axes at 6.55 M pps on a line, pulses");
    observe_line("the same, each pulse observed in order");
    observe_axes("four axes at 6.55 M pps each, observed");
    let mut edges = vec![0; 2 * EDGES];
    let line = Move::Line([41_150, -24_403, 100_000, -70_370]);
    let [small, large] = [circle([80, -60], None), circle([-12_000, 9000], None)];
    let helix = |centre, way| circle(centre, Some((2, way)));
    for (name, ramps, moves, goal) in [
        ("lines of four axes with ramps, edges of all", true, line, Some(200.0)),
        ("lines of four axes at a steady speed", false, line, Some(200.0)),
        ("circles of radius 5,000, ramps only, edges", true, circle([-4000, 3000], None), None),
        ("circles of radius 15,000 with ramps, edges", true, large, Some(100.0)),
        ("circles of radius 15,000 at a steady speed", false, large, Some(100.0)),
        ("circles of radius 100 at a steady speed", false, small, Some(100.0)),
        ("helices with ramps, edges of all", true, helix([-12_000, 9000], 17_321), Some(100.0)),
        ("steep helices with ramps, edges of all", true, helix([1200, 900], 100_000), Some(100.0)),
    ] {
        cost(name, limits(ramps), moves, goal, &mut edges);
    }
    for (name, way) in [
        ("lines of two axes, ramps only, edges", [30_000, -18_541]),
        ("lines nearly along one axis, ramps only, edges", [30_000, 200]),
    ] {
        cost(name, limits(true), Move::Line(way), Some(200.0), &mut edges);
    }
}
