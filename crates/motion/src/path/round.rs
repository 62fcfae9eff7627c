//! Motion around a circle: what both axes do in the slots of the path.
//!
//! The angle grows evenly with the slots, or with every 2ᵏ of them where a helix needs finer ones. These
//! ticks are a little less than a pulse of arc long, so a point of the chain is never left out.

use super::angle::{self, QUARTER, TURN};
use super::circle::{Circle, PLACE_BITS, Point};
use super::eighth::Eighth;
use super::places::{Places, STRIDE, Spot};
use super::steps::Steps;
use super::window::{WINDOW, bits};
use crate::train::Direction;
use crate::wide::quotient;

/// An arc in progress. Inside, arcs go counter-clockwise: others are mirrored.
#[derive(Clone, Copy, Debug)]
pub struct Round {
    circle: Circle,
    places: Places,
    /// Clockwise: the second coordinate is that of the mirror.
    mirrored: bool,
    /// Slots a tick, as a power of two.
    slot_bits: u32,
    /// The window that was looked at last: which axis steps, and which steps are negative.
    window: i64,
    bits: [u64; 4],
    /// What the window after that begins with.
    next: i64,
    spot: Spot,
    point: Point,
}

impl Round {
    /// The arc from a point, seen from the centre, in at least so many slots.
    pub fn new(start: Point, mirrored: bool, travel: u128, slots: u32) -> Self {
        let start = mirror(start, mirrored);
        let circle = Circle::through(start);
        let length = angle::arc_length(circle.squared() as u64, travel);
        // Shorter than a pulse by more than what places may be off.
        let shortest = ((length + (length >> 17)) >> 32) + 1;
        let slot_bits = (u64::from(slots) / shortest).checked_ilog2().unwrap_or(0);
        let ticks = u64::from(slots).div_ceil(1 << slot_bits).max(shortest);
        let places = Places::new(start, travel, ticks);
        let spot = places.of(0);
        Self {
            circle,
            places,
            mirrored,
            slot_bits,
            window: i64::MIN,
            bits: [0; 4],
            next: 0,
            spot,
            point: start,
        }
    }

    /// How many slots it takes, and how long it is, in 2⁻³² pulses.
    pub fn slots(&self) -> [u64; 2] {
        let length = angle::arc_length(self.circle.squared() as u64, self.places.travel);
        [self.places.ticks << self.slot_bits, length]
    }

    /// From start to end.
    pub fn way(&self) -> [i64; 2] {
        let ([x, y], end) = (self.places.start, self.point_of(self.places.ticks as i64));
        mirror([end[0] - x, end[1] - y], self.mirrored)
    }

    /// The point of a tick.
    fn point_of(&self, tick: i64) -> Point {
        self.circle.point(self.places.of(tick).at)
    }

    /// Which way both axes go after a slot, forward on the path or backward.
    pub fn directions(&self, slot: i64, ahead: bool) -> [Direction; 2] {
        let tick = slot >> self.slot_bits;
        let other = if ahead && tick < self.places.ticks as i64 { tick + 1 } else { tick - 1 };
        // In the middle of the tick, so that an axis does not step against its direction.
        let [[x, y], [u, v]] = [tick, other].map(|tick| self.places.of(tick).at);
        let way = mirror([-y - v, x + u], self.mirrored);
        way.map(|way| if ahead { Direction::of(way) } else { Direction::of(way).reversed() })
    }

    /// The first slot after `slot` from which one of the axes goes the other way; beyond the end if neither does.
    pub fn turn_after(&self, slot: i64) -> i64 {
        let tick = slot >> self.slot_bits;
        let turn = self.turning_point(0, tick).min(self.turning_point(1, tick));
        turn << self.slot_bits
    }

    /// The share of both axes in the speed on the circle after a slot, in 2⁻³².
    pub fn shares(&self, slot: i64) -> [u64; 2] {
        let radius = ((self.circle.squared() as u128) << (2 * PLACE_BITS)).isqrt();
        let [x, y] = self.places.of(slot >> self.slot_bits).at;
        [y, x].map(|at| quotient(u128::from(at.unsigned_abs()) << 32, radius) as u64)
    }

    /// Slots from `slot` to the first in which one of the axes (0 or 1) is so far below or above where it is
    /// now, or earlier; `None` if it does not get there in `count` slots.
    #[inline]
    pub fn slots_to(&self, axis: usize, rooms: [i64; 2], slot: i64, count: u32, ahead: bool) -> Option<u64> {
        // At or beyond an edge there is nothing more to wait for. Mostly there is more room than that.
        let rooms = rooms.map(|room| if room > 0 { room } else { i64::MAX });
        if rooms[0].min(rooms[1]) > count.into() {
            return None;
        }
        self.slots_within(axis, rooms, slot, count, ahead)
    }

    /// The same with a look at the circle.
    #[cold]
    fn slots_within(
        &self,
        axis: usize,
        [mut below, mut above]: [i64; 2],
        slot: i64,
        count: u32,
        ahead: bool,
    ) -> Option<u64> {
        if self.mirrored && axis == 1 {
            (below, above) = (above, below);
        }
        let end = if ahead { slot + i64::from(count) } else { slot - i64::from(count) };
        let [now, end] = [slot, end].map(|slot| slot >> self.slot_bits);
        let (point, reach) = (self.point_of(now), self.circle.reach());
        let (low, high) = (point[axis].saturating_sub(below), point[axis].saturating_add(above));
        if low < -reach && high > reach {
            return None;
        }
        let there = |point: Point| point[axis] <= low || point[axis] >= high;
        if !ahead {
            // Only a change of limits on the way takes a path back.
            let soon = (now - STRIDE).max(end);
            let tick = (soon..now).rev().find(|&tick| there(self.point_of(tick)));
            let last = ((tick.unwrap_or(soon) + 1) << self.slot_bits) - 1;
            return (tick.is_some() || soon > end).then(|| (slot - last).max(1) as u64);
        }
        let mut from = now;
        while from < end {
            let to = self.turning_point(axis, from).min(end);
            if there(self.point_of(to)) {
                let tick = self.first(from, to, there);
                return Some(((tick << self.slot_bits) - slot) as u64);
            }
            from = to;
        }
        None
    }

    /// The tick that is nearest to where an axis turns back, after this one: there it does not step.
    fn turning_point(&self, axis: usize, tick: i64) -> i64 {
        let start = angle::of_point(self.places.start);
        let from = start.wrapping_add(self.places.angle_of(tick)).wrapping_sub(axis as u64 * QUARTER);
        let mut left = u128::from(2 * QUARTER - from % (2 * QUARTER));
        loop {
            let ticks =
                quotient(left * u128::from(self.places.ticks) + self.places.travel / 2, self.places.travel);
            if ticks > 0 {
                return tick + ticks as i64;
            }
            left += TURN / 2;
        }
    }

    /// The first tick after `from` that is there, where all that follow up to `to` are.
    fn first(&self, mut from: i64, mut to: i64, there: impl Fn(Point) -> bool) -> i64 {
        while to - from > 2 * STRIDE {
            let middle = (from + (to - from) / 2) & -STRIDE;
            if there(self.circle.point(self.places.of_stride(middle).at)) {
                to = middle
            } else {
                from = middle
            }
        }
        let mut spot = self.places.of(from);
        for tick in from..to {
            spot = self.places.after(tick, spot);
            if there(self.circle.point(spot.at)) {
                return tick + 1;
            }
        }
        to
    }

    /// What both axes do in some slots after `slot`, 64 at the most.
    #[inline]
    pub fn steps(&mut self, slot: i64, count: u32, ahead: bool) -> [Steps; 2] {
        let [x, y, x_negative, y_negative] = bits(slot, count, ahead, |window| {
            if window != self.window {
                self.look_at(window);
            }
            self.bits
        });
        let [first, second] = [(x, x_negative), (y, y_negative)].map(|(some, negative)| {
            let steps = Steps { some, negative };
            if ahead { steps } else { steps.reversed() }
        });
        [first, if self.mirrored { second.reversed() } else { second }]
    }

    /// Finds the bits of a window.
    fn look_at(&mut self, window: i64) {
        let first = (window * i64::from(WINDOW)) >> self.slot_bits;
        if window != self.next {
            self.spot = self.places.of(first);
            self.point = self.circle.point(self.spot.at);
        }
        let mut steps = [Steps::default(); 2];
        if self.slot_bits == 0 {
            self.go_through_stride(first, &mut steps);
        } else {
            let last = ((window + 1) * i64::from(WINDOW)) >> self.slot_bits;
            for tick in first..last {
                let slot = (tick + 1) << self.slot_bits;
                self.go_on(tick, (slot - window * i64::from(WINDOW) - 1) as u32, &mut steps);
            }
        }
        let [x, y] = steps;
        self.bits = [x.some, y.some, x.negative, y.negative];
        (self.window, self.next) = (window, window + 1);
    }

    /// From a tick to the next one.
    fn go_on(&mut self, tick: i64, bit: u32, steps: &mut [Steps; 2]) {
        self.spot = self.places.after(tick, self.spot);
        let point = self.circle.point(self.spot.at);
        for ((steps, from), to) in steps.iter_mut().zip(self.point).zip(point) {
            steps.step(bit, to - from);
        }
        self.point = point;
    }

    /// The ticks of a stride, each of which is a slot.
    fn go_through_stride(&mut self, first: i64, steps: &mut [Steps; 2]) {
        let mut done = 0;
        while done < WINDOW {
            // As far as possible on an eighth of the circle, and a tick wherever it leads.
            let mut eighth = Eighth::of(&self.circle, &self.spot, self.point);
            let run = eighth.run(&self.circle, &self.places, &mut self.spot, WINDOW - 1 - done);
            let point = eighth.point();
            for (axis, steps) in steps.iter_mut().enumerate() {
                let bits = run.bits[axis] << done;
                steps.some |= bits;
                steps.negative |= if point[axis] < self.point[axis] { bits } else { 0 };
            }
            self.point = point;
            done += run.ticks;
            self.go_on(first + i64::from(done), done, steps);
            done += 1;
        }
    }
}

/// Seen in the mirror, or not.
fn mirror([x, y]: [i64; 2], mirrored: bool) -> [i64; 2] {
    [x, if mirrored { -y } else { y }]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::path::MAX_RADIUS;
    use crate::train::{EVERY_SLOT, MAX_SLOTS, Moment, Train};

    fn path(count: u32) -> Train {
        let start = Moment::at(0);
        let direction = Direction::Negative;
        Train { start, interval: 10 << 32, add: 0, jerk: 0, count, direction, mask: EVERY_SLOT }
    }

    /// Goes on for some slots; the steps by slot.
    fn go(round: &mut Round, slot: i64, count: u32, ahead: bool) -> Vec<[i64; 2]> {
        let mut steps = vec![[0; 2]; count as usize];
        let mut done = 0;
        while done < count {
            let part = (count - done).min(MAX_SLOTS);
            let from = if ahead { slot + i64::from(done) } else { slot - i64::from(done) };
            for (axis, bits) in round.steps(from, part, ahead).into_iter().enumerate() {
                bits.emit(&path(part), |train| {
                    for k in 1..=train.count {
                        let slot = &mut steps[done as usize + (train.edge(k) / 10 - 1) as usize][axis];
                        assert_eq!(*slot, 0);
                        *slot = train.direction.sign();
                    }
                });
            }
            done += part;
        }
        steps
    }

    /// A circle from each point in each direction: it returns, is the same in pieces and backward, and an axis
    /// is at the edges of a window when it should be.
    fn check(start: Point, mirrored: bool, slots: u32) {
        let mut round = Round::new(start, mirrored, TURN, slots);
        let begin = round;
        let [count, _] = round.slots();
        let steps = go(&mut round, 0, count as u32, true);
        let mut at = [0; 2];
        let mut halfway = begin;
        for (slot, step) in steps.iter().enumerate() {
            let rooms = [3, 2];
            for (axis, &now) in step.iter().enumerate() {
                let expected = (slot..)
                    .zip(&steps[slot..])
                    .scan(0, |way, (at, step)| {
                        *way += step[axis];
                        Some((at, *way))
                    })
                    .find(|(_, way)| *way == -rooms[0] || *way == rooms[1])
                    .map(|(at, _)| (at - slot + 1) as u64);
                let left = (count as usize - slot) as u32;
                let found = begin.slots_to(axis, rooms, slot as i64, left, true);
                assert_eq!(found, expected, "{start:?} {mirrored} {slots} slot {slot} axis {axis}");
                if now != 0 {
                    assert_eq!(begin.directions(slot as i64, true)[axis].sign(), now, "{start:?} {slot}");
                }
            }
            assert_eq!(go(&mut halfway, slot as i64, 1, true), [*step], "{start:?} {mirrored} {slot}");
            at = [0, 1].map(|axis| at[axis] + step[axis]);
        }
        assert_eq!((at, begin.way()), ([0; 2], [0; 2]));
        let mut back = go(&mut round, count as i64, count as u32, false);
        back.reverse();
        assert!(back.iter().zip(&steps).all(|(back, step)| *back == step.map(|step| -step)));
    }

    #[test]
    fn small_circles_return_from_everywhere() {
        for x in -12..=12 {
            for y in (-12..=12).filter(|y| [x, *y] != [0, 0]) {
                for mirrored in [false, true] {
                    check([x, y], mirrored, 0);
                }
            }
        }
    }

    #[test]
    fn helices_have_finer_slots() {
        for slots in [10, 63, 64, 100, 257, 1000, 5000] {
            check([5, 0], false, slots);
            check([-3, 8], true, slots);
        }
    }

    /// Pieces of circles too large to go round.
    #[test]
    fn large_circles_are_followed_everywhere() {
        let most = i64::from(MAX_RADIUS);
        for (number, radius) in (0..).zip([5000, 1 << 20, (1 << 24) - 1, most - 1, most].repeat(40)) {
            let x = (number * 7_777_777) % (2 * radius) - radius;
            let start = [x, (radius * radius - x * x).isqrt()];
            let begin = Round::new(start, number % 2 == 1, TURN, 0);
            assert_eq!(begin.way(), [0, 0]);
            // Every piece begins at another angle; some at quarters and eighths of the turn.
            let eighths = begin.places.ticks as i64 / 8;
            let tick =
                (number % 8) * eighths + (number * number * 1_234_567) % (eighths / (number % 3 + 1)) - 100;
            let mut at = mirror(begin.point_of(tick), begin.mirrored);
            for step in go(&mut begin.clone(), tick, 300, true) {
                at = [0, 1].map(|axis| at[axis] + step[axis]);
                assert!(begin.circle.is_near(at), "{start:?} {at:?}");
            }
            assert_eq!(mirror(at, begin.mirrored), begin.point_of(tick + 300));
        }
    }
}
