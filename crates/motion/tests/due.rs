//! An axis or a path that is advanced only when something is due makes the same pulses, and never passes what it
//! was to stop for.

use motion::path::{Arc, End, Move, Path, Turn};
use motion::pps::{Profile, scale};
use motion::{Axis, Direction, Goal, Limits, Ticks};
use proptest::prelude::*;

const HZ: u32 = 19_660_800;

prop_compose! {
    fn limits()(low_pps in 1u32..5000, more in 0u32..2_000_000, acceleration_ms in 1u32..2000,
        deceleration_ms in 1u32..2000, s_curve: bool) -> Limits {
        let high_pps = low_pps + more;
        let profile = Profile { low_pps, high_pps, acceleration_ms, deceleration_ms, s_curve };
        profile.limits(scale(2_005_000, HZ), HZ)
    }
}

/// What is told an axis, in the clock after so many looks.
#[derive(Clone, Copy, Debug)]
enum Told {
    Goal(i32),
    Speed(bool, u8),
    Limits(Limits),
}

fn told() -> impl Strategy<Value = (u8, Told)> {
    let goal = (-2_000_000i32..2_000_000).prop_map(Told::Goal);
    let speed = (any::<bool>(), any::<u8>()).prop_map(|(way, part)| Told::Speed(way, part));
    (0u8..12, prop_oneof![goal, speed, limits().prop_map(Told::Limits)])
}

fn tell(axis: &mut Axis, told: Told) {
    match told {
        Told::Goal(position) => axis.set_goal(Goal::Position(position)),
        Told::Speed(positive, part) => {
            let way = if positive { Direction::Positive } else { Direction::Negative };
            let speed = axis.limits().top / 255 * u32::from(part);
            axis.set_goal(Goal::Speed(way, speed));
        }
        Told::Limits(limits) => axis.set_limits(limits),
    }
}

/// Most looks at an axis.
const MAX_LOOKS: usize = 3000;

proptest! {
    #[test]
    fn axes_stop_where_they_are_to((from, plan) in (limits(), prop::collection::vec(told(), 1..5)),
        window in 1i64..500_000, marks in 1i64..100_000) {
        let mut axis = Axis::new(from);
        let mut last: Ticks = 0;
        let mut plan = plan.into_iter();
        let mut next = plan.next();
        let mut looks = 0;
        axis.set_window(-window, window);
        for _ in 0..MAX_LOOKS {
            if let Some((after, told)) = next && looks >= after {
                tell(&mut axis, told);
                (looks, next) = (0, plan.next());
            }
            looks = looks.saturating_add(1);
            let odometer = axis.odometer();
            axis.set_marks(odometer.saturating_sub(marks), odometer.saturating_add(marks));
            let Some(due) = axis.due() else {
                if next.is_none() { break }
                continue;
            };
            prop_assert!(due >= axis.wake().unwrap_or(0));
            axis.advance(due, |train| last = train.end());
            // Never past an edge, and at rest or at an edge only with the very last pulse.
            prop_assert!((axis.odometer() - odometer).abs() <= marks);
            let arrived = !axis.is_moving() || (axis.odometer() - odometer).abs() == marks;
            prop_assert!(!arrived || last == due, "{} {}", last, due);
            if axis.at_window() {
                prop_assert!(axis.odometer().abs() == window && last == due);
                break;
            }
        }
    }

    #[test]
    fn paths_stop_where_they_are_to(limits in limits(), way in prop::array::uniform2(-300_000i32..300_000),
        is_arc: bool, angle in 0i32..360_000, marks in 1i64..50_000) {
        let course = match Arc::new([0, 1], way, Turn::Clockwise, End::Angle(angle), None) {
            Ok(arc) if is_arc => Move::Arc(arc),
            _ => Move::Line(way),
        };
        let mut axes: [Axis; 2] = core::array::from_fn(|_| Axis::new(limits));
        let mut path = Path::new(limits, &course, 0, &mut axes);
        let mut last = 0;
        for _ in 0..MAX_LOOKS {
            let before = axes.each_ref().map(Axis::odometer);
            for axis in &mut axes {
                let odometer = axis.odometer();
                axis.set_marks(odometer - marks, odometer + marks);
            }
            let Some(due) = path.due(&axes) else { break };
            path.advance(due, &mut axes, |_, train| last = last.max(train.end()));
            for (axis, before) in axes.iter().zip(before) {
                let gone = (axis.odometer() - before).abs();
                prop_assert!(gone <= marks);
                prop_assert!(gone < marks || last == due);
            }
            prop_assert!(path.is_moving() || last <= due);
        }
        if !path.is_moving() {
            let ends = axes.each_ref().map(Axis::position);
            prop_assert_eq!(ends, course.way());
        }
    }
}
