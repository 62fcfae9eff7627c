//! Motion around a circle: which point belongs to which slot of the path.
//!
//! The angle grows evenly with the slots, or with every 2ᵏ of them where a helix needs finer ones. These
//! ticks are a little less than a pulse of arc long, so a point of the chain is never left out. Where on the
//! circle a tick lies is a function of its number alone: every 64 ticks it is found from the angle, in
//! between by turning the last place. So it can be asked for ahead, and backward.

use super::angle::{self, Angle, QUARTER, TURN, UNIT_BITS};
use super::circle::{Circle, PLACE_BITS, Place, Point};
use crate::train::{Direction, Train};

/// Ticks from one place that is found from the angle to the next.
const STRIDE: i64 = 64;

/// An arc in progress. Inside, arcs go counter-clockwise: others are mirrored.
#[derive(Clone, Copy, Debug)]
pub struct Round {
    circle: Circle,
    start: Point,
    /// Clockwise: the second coordinate is that of the mirror.
    mirrored: bool,
    /// From start to end in 2⁻⁶⁴ of a turn, a whole turn at the most, and how many ticks that is.
    travel: u128,
    ticks: u64,
    /// Slots a tick, as a power of two.
    slot_bits: u32,
    /// Cosine and sine of the angle of a tick.
    turn: [i64; 2],
    /// The tick that was reached last, with its place and its point.
    tick: i64,
    place: Place,
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
        let turn = angle::cosine_and_sine((travel / u128::from(ticks)) as Angle);
        let place = start.map(|at| at << PLACE_BITS);
        Self { circle, start, mirrored, travel, ticks, slot_bits, turn, tick: 0, place, point: start }
    }

    /// How many slots it takes, and how long it is, in 2⁻³² pulses.
    pub fn slots(&self) -> [u64; 2] {
        [self.ticks << self.slot_bits, angle::arc_length(self.circle.squared() as u64, self.travel)]
    }

    /// From start to end.
    pub fn way(&self) -> [i64; 2] {
        let end = self.circle.point(self.place_of(self.ticks as i64));
        mirror([end[0] - self.start[0], end[1] - self.start[1]], self.mirrored)
    }

    /// Where a tick lies.
    fn place_of(&self, tick: i64) -> Place {
        let first = tick & -STRIDE;
        (first..tick).fold(self.place_of_stride(first), |place, _| self.turned(place))
    }

    /// Where a tick lies that begins a stride.
    fn place_of_stride(&self, tick: i64) -> Place {
        let [cosine, sine] = angle::cosine_and_sine(self.angle_of(tick)).map(i128::from);
        let [x, y] = self.start.map(i128::from);
        [x * cosine - y * sine, x * sine + y * cosine].map(|at| (at >> (UNIT_BITS - PLACE_BITS)) as i64)
    }

    /// From the start to a tick.
    fn angle_of(&self, tick: i64) -> Angle {
        (self.travel as i128 * i128::from(tick)).div_euclid(self.ticks.into()) as Angle
    }

    /// A place one tick on.
    #[inline]
    fn turned(&self, [x, y]: Place) -> Place {
        let [cosine, sine] = self.turn.map(i128::from);
        let [x, y] = [i128::from(x), i128::from(y)];
        [x * cosine - y * sine, x * sine + y * cosine].map(|at| (at >> UNIT_BITS) as i64)
    }

    /// The place of the tick after the one that has this place.
    #[inline]
    fn place_after(&self, tick: i64, place: Place) -> Place {
        if (tick + 1) % STRIDE == 0 { self.place_of_stride(tick + 1) } else { self.turned(place) }
    }

    /// Which way both axes go, next, forward on the path or backward.
    pub fn directions(&self, ahead: bool) -> [Direction; 2] {
        let other = if ahead && self.tick < self.ticks as i64 {
            self.place_after(self.tick, self.place)
        } else {
            self.place_of(self.tick - 1)
        };
        // In the middle of the tick, so that an axis does not step against its direction.
        let [x, y] = [self.place[0] + other[0], self.place[1] + other[1]];
        let way = mirror([-y, x], self.mirrored);
        way.map(|way| if ahead { Direction::of(way) } else { Direction::of(way).reversed() })
    }

    /// The share of both axes in the speed on the circle, in 2⁻³².
    pub fn shares(&self) -> [u64; 2] {
        let radius = ((self.circle.squared() as u128) << (2 * PLACE_BITS)).isqrt();
        let [x, y] = self.place;
        [y, x].map(|at| ((u128::from(at.unsigned_abs()) << 32) / radius) as u64)
    }

    /// Slots from `slot` to the first in which one of the axes (0 or 1) is so far below or above where it is
    /// now, or earlier; `None` if it does not get there in `count` slots.
    pub fn slots_to(&self, axis: usize, rooms: [i64; 2], slot: i64, count: u32, ahead: bool) -> Option<u64> {
        let [mut below, mut above] = rooms;
        if self.mirrored && axis == 1 {
            (below, above) = (above, below);
        }
        // At or beyond an edge there is nothing more to wait for.
        let [below, above] = [below, above].map(|room| if room > 0 { room } else { i64::MAX });
        let (low, high) = (self.point[axis].saturating_sub(below), self.point[axis].saturating_add(above));
        let reach = self.circle.reach();
        let end = if ahead { slot + i64::from(count) } else { slot - i64::from(count) };
        let end = end >> self.slot_bits;
        if (low < -reach && high > reach) || below.min(above) > (end - self.tick).abs() {
            return None;
        }
        let there = |point: Point| point[axis] <= low || point[axis] >= high;
        if !ahead {
            // Only a change of limits on the way takes a path back.
            let soon = (self.tick - STRIDE).max(end);
            let tick = (soon..self.tick).rev().find(|&tick| there(self.circle.point(self.place_of(tick))));
            let last = ((tick.unwrap_or(soon) + 1) << self.slot_bits) - 1;
            return (tick.is_some() || soon > end).then(|| (slot - last).max(1) as u64);
        }
        let mut from = self.tick;
        while from < end {
            let to = self.turning_point(axis, from).min(end);
            if there(self.circle.point(self.place_of(to))) {
                let tick = self.first(from, to, there);
                return Some(((tick << self.slot_bits) - slot) as u64);
            }
            from = to;
        }
        None
    }

    /// The tick that is nearest to where an axis turns back, after this one: there it does not step.
    fn turning_point(&self, axis: usize, tick: i64) -> i64 {
        let start = angle::of_point(self.start);
        let from = start.wrapping_add(self.angle_of(tick)).wrapping_sub(axis as u64 * QUARTER);
        let mut left = u128::from(2 * QUARTER - from % (2 * QUARTER));
        loop {
            let ticks = (left * u128::from(self.ticks) + self.travel / 2) / self.travel;
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
            if there(self.circle.point(self.place_of_stride(middle))) { to = middle } else { from = middle }
        }
        let mut place = self.place_of(from);
        for tick in from..to {
            place = self.place_after(tick, place);
            if there(self.circle.point(place)) {
                return tick + 1;
            }
        }
        to
    }

    /// The trains of both axes (0 and 1) in a train of the path that begins after `slot`.
    pub fn follow(&mut self, path: &Train, slot: i64, ahead: bool, mut emit: impl FnMut(usize, &Train)) {
        let (mut slot, mut rest) = (slot, Some(*path));
        while let Some(train) = rest {
            let slots;
            (slots, rest) = train.first_slots();
            let [first, second] =
                if ahead { self.go_ahead(slot, slots.count) } else { self.go_back(slot, slots.count) };
            slot += if ahead { i64::from(slots.count) } else { -i64::from(slots.count) };
            first.emit(slots, |train| emit(0, train));
            let second = if self.mirrored { second.reversed() } else { second };
            second.emit(slots, |train| emit(1, train));
        }
    }

    /// The steps in some slots after `slot`.
    fn go_ahead(&mut self, slot: i64, count: u32) -> [Steps; 2] {
        let mut steps = [Steps::default(); 2];
        let last = (slot + i64::from(count)) >> self.slot_bits;
        while self.tick < last {
            self.place = self.place_after(self.tick, self.place);
            self.tick += 1;
            let bit = ((self.tick << self.slot_bits) - slot - 1) as u32;
            let point = self.circle.point(self.place);
            for ((steps, from), to) in steps.iter_mut().zip(self.point).zip(point) {
                steps.step(bit, to - from);
            }
            self.point = point;
        }
        steps
    }

    /// The same backward.
    fn go_back(&mut self, slot: i64, count: u32) -> [Steps; 2] {
        let mut steps = [Steps::default(); 2];
        let last = (slot - i64::from(count)) >> self.slot_bits;
        while self.tick > last {
            // A tick ends with the slot that leads to the one before.
            let bit = (slot - (self.tick << self.slot_bits)) as u32;
            self.tick -= 1;
            self.place = self.place_of(self.tick);
            let point = self.circle.point(self.place);
            for ((steps, from), to) in steps.iter_mut().zip(self.point).zip(point) {
                steps.step(bit, to - from);
            }
            self.point = point;
        }
        steps
    }
}

/// Seen in the mirror, or not.
fn mirror([x, y]: [i64; 2], mirrored: bool) -> [i64; 2] {
    [x, if mirrored { -y } else { y }]
}

/// What an axis does in up to 64 slots: a bit for each.
#[derive(Clone, Copy, Debug, Default)]
struct Steps {
    some: u64,
    negative: u64,
}

impl Steps {
    /// Adds a step of −1, 0 or 1.
    #[inline]
    fn step(&mut self, bit: u32, way: i64) {
        debug_assert!((-1..=1).contains(&way), "a step is a pulse or none");
        self.some |= (way as u64 & 1) << bit;
        self.negative |= (way as u64 >> 63) << bit;
    }

    fn reversed(self) -> Self {
        Self { negative: self.some & !self.negative, ..self }
    }

    /// The trains of these slots: more than one where the axis turns back.
    fn emit(self, slots: Train, mut emit: impl FnMut(&Train)) {
        let (mut slots, Self { mut some, mut negative }) = (slots, self);
        while some != 0 {
            let back = negative >> some.trailing_zeros() & 1 == 1;
            let direction = if back { Direction::Negative } else { Direction::Positive };
            let turn = (if back { some & !negative } else { some & negative }).trailing_zeros();
            let part = Train { direction, ..slots };
            if turn == u64::BITS {
                return part.masked(some).iter().for_each(emit);
            }
            let (before, after) = part.split(turn);
            before.masked(some & ((1 << turn) - 1)).iter().for_each(&mut emit);
            (slots, some, negative) = (after, some >> turn, negative >> turn);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::path::MAX_RADIUS;
    use crate::train::{EVERY_SLOT, Moment};

    fn path(count: u32) -> Train {
        let start = Moment::at(0);
        let direction = Direction::Negative;
        Train { start, interval: 10 << 32, add: 0, jerk: 0, count, direction, mask: EVERY_SLOT }
    }

    /// Goes on for some slots; the steps by slot.
    fn go(round: &mut Round, slot: i64, count: u32, ahead: bool) -> Vec<[i64; 2]> {
        let mut steps = vec![[0; 2]; count as usize];
        round.follow(&path(count), slot, ahead, |axis, train| {
            for k in 1..=train.count {
                let slot = &mut steps[(train.edge(k) / 10 - 1) as usize][axis];
                assert_eq!(*slot, 0);
                *slot = train.direction.sign();
            }
        });
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
                let found = halfway.slots_to(axis, rooms, slot as i64, left, true);
                assert_eq!(found, expected, "{start:?} {mirrored} {slots} slot {slot} axis {axis}");
                if now != 0 {
                    assert_eq!(halfway.directions(true)[axis].sign(), now, "{start:?} {slot}");
                }
            }
            assert_eq!(go(&mut halfway, slot as i64, 1, true), [*step], "{start:?} {mirrored} {slot}");
            at = [0, 1].map(|axis| at[axis] + step[axis]);
        }
        assert_eq!((at, begin.way()), ([0; 2], [0; 2]));
        let mut back = go(&mut round, count as i64, count as u32, false);
        back.reverse();
        assert!(back.iter().zip(&steps).all(|(back, step)| *back == step.map(|step| -step)));
        assert_eq!((round.tick, round.point, round.place), (begin.tick, begin.point, begin.place));
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
            let mut round = begin;
            // Every piece begins at another angle; some at quarters and eighths of the turn.
            let eighths = begin.ticks as i64 / 8;
            round.tick =
                (number % 8) * eighths + (number * number * 1_234_567) % (eighths / (number % 3 + 1)) - 100;
            round.place = round.place_of(round.tick);
            round.point = round.circle.point(round.place);
            let mut at = mirror(round.point, round.mirrored);
            let slot = round.tick;
            for step in go(&mut round, slot, 300, true) {
                at = [0, 1].map(|axis| at[axis] + step[axis]);
                assert!(round.circle.is_near(at), "{start:?} {at:?}");
            }
            assert_eq!(mirror(at, round.mirrored), round.point);
        }
    }
}
