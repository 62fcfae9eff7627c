//! The pulses of several axes in the order of time.
//!
//! An axis gives out whole trains, one axis after the other. Whoever wants to see what happens clock by clock
//! collects the trains of each axis, and then merges them. It is done for 64 clocks at a time: the pulses of
//! each axis are entered where they belong, and then read off in order.

use crate::train::{Direction, Edges, Ticks, Train};

/// The most axes.
pub const MAX_AXES: usize = 8;

/// Clocks that are looked at together.
const WINDOW: u64 = u64::BITS as u64;

/// The pulses of one clock, of one axis or more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pulses {
    /// When.
    pub clock: Ticks,
    /// A bit for each axis in the lower half, and whether it goes backward in the upper.
    bits: u16,
}

impl Pulses {
    /// Which axes step: axis 0 in the lowest bit.
    pub fn axes(self) -> u8 {
        self.bits as u8
    }

    /// Which of them step in the negative direction.
    pub fn negative(self) -> u8 {
        (self.bits >> MAX_AXES) as u8
    }

    /// The axes that step, in the order of their numbers, and which way.
    pub fn each(self) -> impl Iterator<Item = (usize, Direction)> {
        let mut axes = self.axes();
        core::iter::from_fn(move || {
            let axis = axes.trailing_zeros() as usize;
            axes &= axes.checked_sub(1)?;
            let back = self.negative() >> axis & 1 == 1;
            Some((axis, if back { Direction::Negative } else { Direction::Positive }))
        })
    }
}

/// Shows the pulses of all axes to `observe`, clock by clock. The trains of each axis are in the order in which
/// it gave them out.
pub fn merge<const N: usize>(trains: [&[Train]; N], mut observe: impl FnMut(Pulses)) {
    const { assert!(N <= MAX_AXES, "too many axes") };
    let mut number = 0;
    let mut cursors = trains.map(|trains| {
        number += 1;
        Cursor::new(number - 1, trains)
    });
    while let Some(first) = cursors.iter().filter_map(|cursor| cursor.next).min() {
        let first = first & !(WINDOW - 1);
        let mut window = Window { first, clocks: 0, bits: [0; WINDOW as usize] };
        cursors.iter_mut().for_each(|cursor| cursor.enter(&mut window));
        let mut clocks = window.clocks;
        while clocks != 0 {
            let at = clocks.trailing_zeros();
            observe(Pulses {
                clock: first + u64::from(at),
                bits: window.bits[at as usize % WINDOW as usize],
            });
            clocks &= clocks - 1;
        }
    }
}

/// Some clocks with their pulses.
struct Window {
    first: Ticks,
    /// In which of them there are any.
    clocks: u64,
    bits: [u16; WINDOW as usize],
}

/// How far the trains of an axis are shown.
struct Cursor<'a> {
    axis: usize,
    /// The trains after the present one.
    trains: core::slice::Iter<'a, Train>,
    /// The pulses after the next one.
    edges: Edges,
    next: Option<Ticks>,
    /// The bits of a pulse.
    bits: u16,
}

impl<'a> Cursor<'a> {
    fn new(axis: usize, trains: &'a [Train]) -> Self {
        let mut cursor = Self { axis, trains: trains.iter(), edges: Edges::none(), next: None, bits: 0 };
        cursor.go_on();
        cursor
    }

    /// To the next train. None is without pulses.
    fn go_on(&mut self) {
        self.next = None;
        if let Some(train) = self.trains.next() {
            self.edges = train.edges();
            self.next = self.edges.next();
            let back = u16::from(train.direction == Direction::Negative) << MAX_AXES;
            self.bits = (1 | back) << self.axis;
        }
    }

    /// Enters the pulses of a window.
    fn enter(&mut self, window: &mut Window) {
        let end = window.first + WINDOW;
        while let Some(next) = self.next.filter(|next| *next < end) {
            let (bits, mut clocks) = (self.bits, 0);
            self.next = self.edges.until(next, end, |clock| {
                window.bits[(clock % WINDOW) as usize] |= bits;
                clocks |= 1 << (clock % WINDOW);
            });
            window.clocks |= clocks;
            if self.next.is_none() {
                self.go_on();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pps::{self, CLOCK_HZ, Profile};
    use crate::{Axis, Goal, Move, Path};

    /// The trains of each axis in, all pulses in order out.
    fn check<const N: usize>(trains: &[Vec<Train>; N]) {
        let mut expected = Vec::new();
        for (axis, trains) in trains.iter().enumerate() {
            for train in trains {
                expected.extend(train.edges().map(|clock| (clock, axis, train.direction.sign())));
            }
        }
        expected.sort_unstable();
        let (mut merged, mut last) = (Vec::new(), None);
        merge(trains.each_ref().map(|trains| trains.as_slice()), |pulses| {
            assert!(last < Some(pulses.clock), "each clock once");
            last = Some(pulses.clock);
            assert_eq!(pulses.negative() & !pulses.axes(), 0);
            merged.extend(pulses.each().map(|(axis, way)| (pulses.clock, axis, way.sign())));
        });
        let differ = merged.iter().zip(&expected).position(|(merged, expected)| merged != expected);
        assert_eq!((differ, merged.len()), (None, expected.len()));
    }

    fn profile(high_pps: u32) -> Profile {
        Profile { low_pps: 100, high_pps, acceleration_ms: 20, deceleration_ms: 5, s_curve: false }
    }

    #[test]
    fn nothing_is_merged_to_nothing() {
        merge([], |_| panic!("there are no axes"));
        check(&[vec![], vec![]]);
    }

    #[test]
    fn axes_of_different_speeds_are_merged() {
        let mut trains = [(); 5].map(|()| Vec::new());
        for (axis, (trains, pps)) in
            trains.iter_mut().zip([50, 9_000_000, 123, 77_777, 9_000_000]).enumerate()
        {
            let limits = profile(pps).limits(pps::scale(pps, CLOCK_HZ), CLOCK_HZ);
            let mut mover = Axis::new(limits);
            mover.advance(1000 * axis as u64, |_| ());
            for target in [60, -70, 1000] {
                mover.set_goal(Goal::Position(target * (pps as i32).min(1000) / 50));
                while let Some(wake) = mover.wake() {
                    mover.advance(wake, |train| trains.push(*train));
                }
            }
        }
        check(&trains);
    }

    #[test]
    fn axes_of_a_path_step_in_the_same_clocks() {
        let limits = profile(3_000_000).limits(pps::scale(3_000_000, CLOCK_HZ), CLOCK_HZ);
        let mut axes = [(); 4].map(|()| Axis::new(limits));
        let mut path = Path::new(limits, &Move::Line([5000, -5000, 3000, 77]), 0, &mut axes);
        let mut trains = [(); 4].map(|()| Vec::new());
        while let Some(wake) = path.wake(&axes) {
            path.advance(wake, &mut axes, |axis, train| trains[axis].push(*train));
        }
        check(&trains);
        let mut clocks = 0;
        merge(trains.each_ref().map(|trains| trains.as_slice()), |pulses| {
            clocks += 1;
            assert_eq!((pulses.axes() & 0b11, pulses.negative()), (0b11, 0b10));
        });
        assert_eq!(clocks, 5000);
    }
}
