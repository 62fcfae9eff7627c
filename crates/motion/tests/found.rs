//! Moves that once went wrong, as the random moves found them.

use motion::train::MAX_DURATION;
use motion::{Axis, Direction, Goal, Limits, Shape, Train, tmc429};

fn limits(divs: [u32; 2], [top, start, stop, acceleration]: [u32; 4], shape: Shape) -> Limits {
    let [pulse_div, ramp_div] = divs;
    let growth = tmc429::growth(acceleration, pulse_div, ramp_div);
    Limits {
        scale: tmc429::scale(pulse_div),
        top: tmc429::speed(top),
        start: tmc429::speed(start),
        stop: tmc429::speed(stop),
        growth,
        fall: growth,
        shape,
    }
}

/// The trains until the axis rests, no more than `most`.
fn to_rest(axis: &mut Axis, most: usize) -> Vec<Train> {
    let mut trains = Vec::new();
    while let Some(wake) = axis.wake() {
        assert!(trains.len() < most, "does not come to rest");
        axis.advance(wake, |train| trains.push(*train));
    }
    trains
}

/// Beginning faster than a stop allows, the axis swung about its target for ever.
#[test]
fn a_start_speed_above_the_stop_speed_comes_to_rest() {
    for shape in [Shape::Trapezoid, Shape::Soft] {
        for way in 1..20 {
            let mut axis = Axis::new(limits([2, 1], [6, 15, 1, 1], shape));
            axis.set_goal(Goal::Position(way));
            to_rest(&mut axis, 40);
            assert_eq!((axis.position(), axis.steps()), (way, way as u64));
        }
    }
}

/// A block of the slowest pulses lasted longer than its offsets have bits.
#[test]
fn slow_blocks_fit_a_train() {
    for shape in [Shape::Trapezoid, Shape::Soft] {
        let mut axis = Axis::new(limits([13, 13], [87, 1, 1, 1], shape));
        axis.set_goal(Goal::Position(-1200));
        for train in to_rest(&mut axis, 1300) {
            assert!(train.end() - train.start.ticks < MAX_DURATION, "{train:?}");
        }
        assert_eq!(axis.position(), -1200);
    }
}

/// The line of a soft approach, drawn on above the top speed, was steeper than the acceleration.
#[test]
fn a_soft_approach_from_above_the_top_speed_keeps_the_acceleration() {
    let soft = limits([3, 0], [1, 1, 1, 1], Shape::Soft);
    let mut axis = Axis::new(soft);
    axis.set_goal(Goal::Speed(Direction::Negative, tmc429::speed(30)));
    axis.advance(147_587, |_| {});
    axis.set_goal(Goal::Position(axis.position() - 2));
    let mut fell = axis.speed();
    let mut steps = axis.steps();
    while axis.is_moving() && axis.direction() == Direction::Negative {
        let Some(wake) = axis.wake() else { break };
        axis.advance(wake, |_| {});
        let squares = [fell, axis.speed()].map(|speed| u64::from(speed).pow(2));
        // Down from the stop speed at once, and otherwise by 2a a pulse.
        let fall = soft.fall * (axis.steps() - steps);
        let least = squares[0].saturating_sub(fall + u64::from(soft.stop).pow(2) + (1 << 32));
        assert!(squares[1] >= least, "{squares:?}");
        (fell, steps) = (axis.speed(), axis.steps());
    }
}

/// Rounding of a block's cubic made a step in its spacings of some units of acceleration.
#[test]
fn long_blocks_join_without_a_step() {
    let mut axis = Axis::new(limits([0, 13], [2047, 2000, 2000, 3], Shape::Trapezoid));
    axis.set_goal(Goal::Position(100_000));
    let trains = to_rest(&mut axis, 10_000);
    for pair in trains.windows(2).filter(|pair| pair[0].count > 1) {
        let Some(last) = pair[0].moment(pair[0].count).since(pair[0].moment(pair[0].count - 1)) else {
            panic!("not in order: {pair:?}")
        };
        let step = pair[1].interval.abs_diff(last);
        assert!(step < 1 << 12, "a step of {step} / 2^32 clocks");
    }
}
