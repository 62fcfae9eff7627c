//! What stops axes or holds them back: limits, alarms, the emergency stop, slowdown inputs, and servo drivers
//! that are not in position (manual, 2.1.2.2 and 2.1.3.1).

use super::Cmd4cr;
use super::erc::Occasion;
use super::motion::resting;
use super::pins::number as pin;
use super::table::{AXIS_COUNT, Id};
use crate::ascii::station::{Halt, SIDES, Task, side};
use crate::board::Board;
use crate::flash::Flash;
use ::motion::{Direction, Goal, Limits};

/// `SDE`: the slowdown input counts.
const SLOWDOWN_ON: i32 = 1;
/// `SDE`: it is latched.
const SLOWDOWN_LATCHED: i32 = 2;

/// What watches over an axis.
#[derive(Clone, Copy, Debug)]
pub struct Guard {
    /// The limits of the motion that is on, where the slowdown input is off.
    pub limits: Limits,
    /// The alarm error.
    pub alarm: bool,
    /// The emergency stop error.
    pub emergency: bool,
    /// The slowdown input has stopped a motion.
    pub slowdown_stop: bool,
    /// The slowdown input acts: it is on, or was since the motion began and is latched.
    pub slow: bool,
    /// The pulses are out, but the driver is not in position yet.
    pub arriving: bool,
}

impl Guard {
    pub const fn new() -> Self {
        Self {
            limits: resting(),
            alarm: false,
            emergency: false,
            slowdown_stop: false,
            slow: false,
            arriving: false,
        }
    }
}

/// Limits that the slowdown input leaves: low speed.
pub fn slowed(limits: Limits) -> Limits {
    Limits { top: limits.start.min(limits.top), ..limits }
}

impl<F: Flash> Cmd4cr<F> {
    /// `IERR`: limits, alarms and emergency stops latch no errors.
    pub fn ignores_errors(&self) -> bool {
        self.memory.cells.get(Id::IgnoreErrors) != 0
    }

    /// Whether an axis is in an error that `CLR` has to clear before it moves again.
    pub fn is_barred(&self, axis: usize) -> bool {
        let guard = &self.guards[axis];
        self.stations[axis].errors.contains(&true) || guard.alarm || guard.emergency
    }

    /// `CLR`, `ECLEAR`: the errors of an axis are forgotten, those of StepNLoop too.
    pub fn clear(&mut self, axis: usize, board: &mut dyn Board) {
        self.stations[axis].errors = [false; 2];
        let guard = &mut self.guards[axis];
        (guard.alarm, guard.emergency, guard.slowdown_stop) = (false, false, false);
        self.clear_loop(axis, board);
    }

    /// Stops motion into limits that are on.
    pub fn watch_limits(&mut self) {
        for axis in 0..AXIS_COUNT {
            let on = self.limits_on(axis);
            for way in SIDES.into_iter().filter(|&way| on[side(way)]) {
                let into = match (&self.stations[axis].task, self.ride_of(axis)) {
                    // Homing looks after its limits itself.
                    (Task::Home(_), _) => false,
                    (_, Some(ride)) => ride.path.is_moving() && ride.path.direction(axis) == Some(way),
                    _ => self.axes[axis].is_moving() && self.axes[axis].direction() == way,
                };
                if into {
                    self.limit_hit(axis, way);
                }
            }
        }
    }

    /// The axis has run into its limit: it stops at once, and so does what it is interpolated with.
    pub fn limit_hit(&mut self, axis: usize, way: Direction) {
        let ratio = self.ratio(axis);
        self.error_stop(axis);
        if !self.ignores_errors() {
            let (station, unit) = (&mut self.stations[axis], &mut self.axes[axis]);
            station.errors[side(way)] = true;
            station.closed.limit(unit, ratio);
            self.program_error(axis);
        }
    }

    /// Stops an axis at once because of an error; its driver may have to hear of it.
    fn error_stop(&mut self, axis: usize) {
        if matches!(self.stations[axis].task, Task::Home(_)) {
            self.stations[axis].task = Task::Stop;
        }
        self.stop_axis(axis, Halt::AtOnce);
        self.clear_deflection(axis, Occasion::ErrorStop);
    }

    /// Stops axes whose alarm input is on.
    pub fn watch_alarms(&mut self) {
        for axis in 0..AXIS_COUNT {
            if self.alarm_on(axis) && self.is_moving(axis) {
                self.error_stop(axis);
                if !self.ignores_errors() {
                    self.guards[axis].alarm = true;
                    self.program_error(axis);
                }
            }
        }
    }

    /// `ESTOP` and the emergency stop input: all axes stop at once, for those that moved it is an error, and
    /// nothing waits any more.
    pub fn emergency_stop(&mut self) {
        self.drop_all_waiting();
        self.drop_buffer();
        // Stopping one may stop others.
        let moved: [bool; AXIS_COUNT] = core::array::from_fn(|axis| self.is_moving(axis));
        for axis in (0..AXIS_COUNT).filter(|&axis| moved[axis]) {
            self.error_stop(axis);
            if !self.ignores_errors() {
                self.guards[axis].emergency = true;
                self.program_error(axis);
            }
        }
        self.settle();
    }

    /// Looks at the emergency stop input: while it is on, nothing moves.
    pub fn watch_emergency(&mut self) {
        if self.io.emergency() && (0..AXIS_COUNT).any(|axis| self.is_moving(axis)) {
            self.emergency_stop();
        }
    }

    /// The limits of the motion of an axis; the slowdown input may lower them.
    pub fn set_limits(&mut self, axis: usize, limits: Limits) {
        self.guards[axis].limits = limits;
        self.apply_limits(axis);
    }

    fn apply_limits(&mut self, axis: usize) {
        let Guard { limits, slow, .. } = self.guards[axis];
        let limits = if slow { slowed(limits) } else { limits };
        let unit = &mut self.axes[axis];
        unit.set_limits(limits);
        if let (Task::Jog, Goal::Speed(way, _)) = (&self.stations[axis].task, unit.goal()) {
            unit.set_goal(Goal::Speed(way, limits.top));
        }
    }

    /// Whether changes of an axis' slowdown input matter.
    pub fn watches_slowdown(&self, axis: usize) -> bool {
        self.memory.cells.at(Id::Slowdown, axis) & SLOWDOWN_ON != 0
    }

    /// The level of the slowdown input as it acts, without its latch.
    fn slowdown_acts(&self, axis: usize, board: &mut dyn Board) -> bool {
        self.watches_slowdown(axis) && self.slowdown_on(axis, board)
    }

    /// A motion begins: what was latched before does not count. It may begin on the switch and leave it,
    /// slowly.
    pub fn forget_slowdown(&mut self, axis: usize, board: &mut dyn Board) {
        self.guards[axis].slow = self.slowdown_acts(axis, board);
    }

    /// The slowdown input of an axis may have changed.
    pub fn watch_slowdown(&mut self, axis: usize, board: &mut dyn Board) {
        let on = self.slowdown_acts(axis, board);
        let latches = self.memory.cells.at(Id::Slowdown, axis) & SLOWDOWN_LATCHED != 0;
        let moving = self.is_moving(axis);
        let guard = &mut self.guards[axis];
        let slow = on || latches && guard.slow;
        if core::mem::replace(&mut guard.slow, slow) == slow {
            return;
        }
        if slow && moving && self.memory.cells.at(Id::SlowdownStops, axis) != 0 {
            self.guards[axis].slowdown_stop = true;
            if matches!(self.stations[axis].task, Task::Home(_)) {
                self.stations[axis].task = Task::Stop;
            }
            self.stop_axis(axis, Halt::Ramp);
            self.settle();
        } else if self.ride_of(axis).is_some() {
            self.slow_ride(axis);
        } else if matches!(self.stations[axis].task, Task::Move { .. } | Task::Jog) {
            self.apply_limits(axis);
        }
    }

    /// Axes whose driver is in position have arrived.
    pub fn watch_positions(&mut self) {
        for axis in 0..AXIS_COUNT {
            let waits = self.guards[axis].arriving && self.memory.cells.at(Id::InPosition, axis) != 0;
            self.guards[axis].arriving = waits && !self.in_position(axis);
        }
    }

    /// The status word (manual, table 2-28).
    pub fn status(&self, axis: usize, board: &mut dyn Board) -> i32 {
        let (station, guard) = (&self.stations[axis], &self.guards[axis]);
        let phase = match self.ride_of(axis) {
            Some(ride) => ride.path.acceleration(),
            None => self.axes[axis].acceleration(),
        };
        let moving = self.is_moving(axis);
        let [plus, minus] = self.limits_on(axis);
        let bits = [
            moving && phase > 0,
            moving && phase < 0,
            moving && phase == 0,
            self.alarm_on(axis),
            plus,
            minus,
            self.home_on(axis, board),
            self.slowdown_on(axis, board),
            station.errors[0],
            station.errors[1],
            guard.alarm,
            self.in_position(axis),
            self.clears[axis].is_on(),
            self.index_on(axis, board),
            self.io.start(),
            self.io.emergency(),
            guard.emergency,
            guard.slowdown_stop,
            guard.arriving,
            self.is_waiting(axis),
        ];
        (0..).zip(bits).map(|(bit, on)| i32::from(on) << bit).sum()
    }

    /// Whether edges of an axis' inputs matter now, which others look at when they are asked.
    pub fn watches_axis_pin(&self, number: usize) -> bool {
        let (axis, input) = (number / pin::AXIS, number % pin::AXIS);
        match (&self.stations[axis].task, input) {
            (_, pin::SLOWDOWN) => self.watches_slowdown(axis),
            (Task::Home(_), pin::HOME) => true,
            (Task::Home(homing), pin::INDEX) => homing.watches_index(),
            (_, pin::HOME | pin::INDEX) => self.stations[axis].polled,
            _ => true,
        }
    }
}
