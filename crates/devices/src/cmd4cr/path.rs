//! Interpolated moves: lines, circles, arcs and helices (manual, 2.3 and appendix C).

use super::motion::{axes_in, resting};
use super::refusal::Refusal;
use super::safety::slowed;
use super::table::{AXIS_COUNT, MAX_SPEED_PPS};
use super::{Cmd4cr, FAMILY, HZ};
use crate::ascii::station::{Halt, Task};
use crate::board::Board;
use crate::flash::Flash;
use ::motion::path::{Arc, End, Move, Path, Turn};
use ::motion::speed::Speed;
use ::motion::{Limits, Ticks, closed_loop};

/// The axis that goes along a line while X and Y turn.
const RISER: usize = 2;

/// The axis that is used up meanwhile (manual, C.5).
const HELPER: usize = 3;

/// A circle or an arc as a command has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Curve {
    /// The axes of its plane.
    pub axes: [usize; 2],
    /// Which way it goes.
    pub turn: Turn,
    /// The position of its centre.
    pub centre: [i32; 2],
    /// Where it ends.
    pub end: End,
    /// Where Z ends, if it goes along.
    pub rise: Option<i32>,
}

impl Curve {
    /// The axes that it needs, as bits.
    pub fn axes(&self) -> u8 {
        let plane = self.axes.map(|axis| 1 << axis);
        plane[0] | plane[1] | if self.rise.is_some() { 1 << RISER | 1 << HELPER } else { 0 }
    }

    /// The same as a path from these pulses.
    pub fn path(&self, from: [i32; AXIS_COUNT]) -> Result<Arc, Refusal> {
        let [first, second] = self.axes;
        let centre = [(first, self.centre[0]), (second, self.centre[1])];
        let centre = centre.map(|(axis, centre)| centre.wrapping_sub(from[axis]));
        let along = self.rise.map(|target| (RISER, target.wrapping_sub(from[RISER])));
        Arc::new(self.axes, centre, self.turn, self.end, along).map_err(|_| Refusal::Index)
    }

    /// In which directions an axis sets out: plus, minus.
    pub fn ways(&self, axis: usize, from: [i32; AXIS_COUNT]) -> [bool; 2] {
        let [right, up] = [0, 1].map(|side| i64::from(from[self.axes[side]]) - i64::from(self.centre[side]));
        let clockwise = [up, -right];
        let way = match (self.axes.iter().position(|&member| member == axis), self.turn) {
            (Some(side), Turn::Clockwise) => clockwise[side],
            (Some(side), Turn::CounterClockwise) => -clockwise[side],
            (None, _) if axis == RISER => {
                self.rise.map_or(0, |target| i64::from(target) - i64::from(from[RISER]))
            }
            (None, _) => 0,
        };
        [way > 0, way < 0]
    }
}

/// Limits along a curve at which the axis that goes along on a helix is no faster than an axis can be: its way
/// may be many times as long.
pub fn held(limits: Limits, arc: &Arc) -> Limits {
    let rise = u128::from(arc.along().map_or(0, |(_, way)| way.unsigned_abs()));
    let length = u128::from(arc.length().max(1));
    // One that goes nowhere in its plane is a line of the other axis.
    if rise <= length || arc.ends() == [0; 2] && arc.length() == 0 {
        return limits;
    }
    let highest = (MAX_SPEED_PPS as u128) << limits.scale.bits();
    let highest = (highest * length / (u128::from(HZ) * rise)).clamp(1, Speed::MAX.into()) as Speed;
    Limits {
        top: limits.top.min(highest),
        start: limits.start.min(highest),
        stop: limits.stop.min(highest),
        ..limits
    }
}

/// The interpolated moves that are on: an axis is in one at the most. A chip sets aside room for all; a host takes it
/// when it is needed.
#[cfg(feature = "std")]
pub type Rides = alloc::vec::Vec<Ride>;
#[cfg(not(feature = "std"))]
pub type Rides = heapless::Vec<Ride, AXIS_COUNT>;

/// An interpolated move.
#[derive(Debug)]
pub struct Ride {
    pub path: Path<AXIS_COUNT>,
    /// The axes that it needs, as bits.
    members: u8,
    /// Its limits where no slowdown input is on.
    limits: Limits,
    /// It came from the buffer.
    pub buffered: bool,
}

impl Ride {
    /// One that is about to set out.
    const fn new() -> Self {
        Self { path: Path::idle(), members: 0, limits: resting(), buffered: false }
    }
}

impl<F: Flash> Cmd4cr<F> {
    /// The interpolated move of an axis.
    pub fn ride_of(&self, axis: usize) -> Option<&Ride> {
        self.rides.iter().find(|ride| ride.members >> axis & 1 != 0)
    }

    /// When something is due on a ride: where a limit is on, also where an axis may turn into it.
    pub fn ride_due(&self, ride: &Ride) -> Option<Ticks> {
        let due = ride.path.due(&self.axes)?;
        let limited = axes_in(ride.members).any(|axis| self.limits_on(axis).contains(&true));
        if !limited {
            return Some(due);
        }
        Some(ride.path.turn().map_or(due, |turn| due.min(turn)))
    }

    fn pulses(&self) -> [i32; AXIS_COUNT] {
        core::array::from_fn(|axis| self.axes[axis].position())
    }

    /// Sets axes going along a line; where they are to be then, in their own units, and how many pulses away.
    pub fn ride_line(
        &mut self,
        targets: [Option<i32>; AXIS_COUNT],
        ways: [i32; AXIS_COUNT],
        program: Option<usize>,
        board: &mut dyn Board,
    ) {
        // The manual's main axis (C.1): the first of those with the longest way.
        let longest = (0..AXIS_COUNT).rev().max_by_key(|&axis| ways[axis].unsigned_abs()).unwrap_or(0);
        let limits = self.speeds(None, longest).limits_over(ways[longest].unsigned_abs(), &FAMILY);
        for (axis, target) in targets.into_iter().enumerate() {
            let Some(target) = target else { continue };
            self.stations[axis].program = program;
            self.stations[axis].closed.begin(&self.axes[axis], closed_loop::Motion::To(target));
        }
        self.start_ride(&Move::Line(ways), limits, ways, false, false, board);
    }

    /// Sets axes going along a circle or an arc.
    pub fn ride_curve(
        &mut self,
        curve: &Curve,
        program: Option<usize>,
        board: &mut dyn Board,
    ) -> Result<(), Refusal> {
        // Positions may be encoder counts; paths are of pulses.
        let [first, second] = curve.axes;
        let centre = [self.goal(first, curve.centre[0])?, self.goal(second, curve.centre[1])?];
        let rise = curve.rise.map(|target| self.goal(RISER, target)).transpose()?;
        let curve = Curve { centre, rise, ..*curve };
        let from = self.pulses();
        let arc = curve.path(from)?;
        for axis in axes_in(curve.axes()) {
            self.may_move(axis, curve.ways(axis, from))?;
        }
        let course = Move::Arc(arc);
        let ways = course.way();
        let limits = held(self.speeds(None, first).limits_over(arc.length(), &FAMILY), &arc);
        for axis in axes_in(curve.axes()) {
            let counts = self.ratio(axis).counts(ways[axis].into()) as i32;
            let target = self.position(axis).wrapping_add(counts);
            self.stations[axis].program = program;
            self.stations[axis].closed.begin(&self.axes[axis], closed_loop::Motion::To(target));
        }
        self.start_ride(&course, limits, ways, curve.rise.is_some(), false, board);
        Ok(())
    }

    /// Sets a path going: for the axes that it moves, and for the helper of a helix.
    pub fn start_ride(
        &mut self,
        course: &Move<AXIS_COUNT>,
        limits: Limits,
        ways: [i32; AXIS_COUNT],
        helped: bool,
        buffered: bool,
        board: &mut dyn Board,
    ) {
        assert!(self.rides.len() < AXIS_COUNT, "an axis is in one interpolated move at the most");
        self.rides.extend([Ride::new()]);
        let ride = self.rides.last_mut().expect("there is one at least");
        ride.path.set_out(limits, course, self.now, &mut self.axes);
        let moved = |axis: &usize| ride.path.involves(*axis) || helped && *axis == HELPER;
        let members = (0..AXIS_COUNT).filter(moved).map(|axis| 1 << axis).sum();
        (ride.members, ride.limits, ride.buffered) = (members, limits, buffered);
        for axis in axes_in(members) {
            let target = self.axes[axis].position().wrapping_add(ways[axis]);
            self.stations[axis].task = Task::Path { target };
            self.forget_slowdown(axis, board);
        }
        if let Some(first) = axes_in(members).next() {
            self.slow_ride(first);
        }
    }

    /// Brings the speed of a ride in line with the slowdown inputs of its axes (manual, C.6).
    pub fn slow_ride(&mut self, axis: usize) {
        let Some(ride) = self.rides.iter_mut().find(|ride| ride.members >> axis & 1 != 0) else { return };
        let slow = axes_in(ride.members).any(|member| self.guards[member].slow);
        ride.path.set_limits(if slow { slowed(ride.limits) } else { ride.limits }, &mut self.axes);
    }

    /// Stops the ride of an axis, if there is one, and with it all that take part.
    pub fn stop_ride(&mut self, axis: usize, halt: Halt) -> bool {
        let Some(ride) = self.rides.iter_mut().find(|ride| ride.members >> axis & 1 != 0) else {
            return false;
        };
        match halt {
            Halt::AtOnce => ride.path.halt(),
            Halt::Ramp => ride.path.stop(&mut self.axes),
        }
        for member in axes_in(ride.members) {
            self.stations[member].closed.begin(&self.axes[member], halt.motion());
        }
        if ride.buffered {
            self.drop_buffer();
        }
        true
    }

    /// Takes out the rides that have ended; the axes that they had, as bits.
    pub fn take_ended_rides(&mut self) -> u8 {
        let mut ended = 0;
        self.rides.retain(|ride| {
            let goes_on = ride.path.is_moving();
            ended |= if goes_on { 0 } else { ride.members };
            goes_on
        });
        ended
    }
}
