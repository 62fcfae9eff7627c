//! Moves, jogs and stops of the axes, alone (manual, 2.2 and 2.4).

use super::path::Curve;
use super::refusal::Refusal;
use super::table::{AXIS_COUNT, Id};
use super::{Cmd4cr, FAMILY, HZ, MAX_SPEED_PPS};
use crate::ascii::clock::Clocked as _;
use crate::ascii::speeds::{self, Speeds};
use crate::ascii::station::{Halt, Task};
use crate::board::Board;
use crate::flash::Flash;
use ::motion::closed_loop::{self, Ratio};
use ::motion::pps::{self, COMMANDER, Profile};
use ::motion::{Direction, Goal, Limits, Shape};

/// Targets by axis.
pub type Targets = [Option<i32>; AXIS_COUNT];

/// A motion that a host or a program asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// `X`, `Y`, `Z`, `U`: to targets, which count from the positions if they are incremental.
    To { targets: Targets, incremental: bool },
    /// `J`.
    Jog { axis: usize, way: Direction },
    /// `H` with its mode, or `ZMOVE` without.
    Home { axis: usize, way: Direction, mode: Option<usize> },
    /// `CIR`, `ARC`, `CIRT`, `ARCT`.
    Curve(Curve),
}

impl Motion {
    /// The axes that take part, as bits.
    pub fn axes(&self) -> u8 {
        match self {
            Self::To { targets, .. } => {
                (0..AXIS_COUNT).filter(|&axis| targets[axis].is_some()).map(|axis| 1 << axis).sum()
            }
            Self::Jog { axis, .. } | Self::Home { axis, .. } => 1 << axis,
            Self::Curve(curve) => curve.axes(),
        }
    }
}

/// The axes of a set of bits.
pub fn axes_in(bits: u8) -> impl Iterator<Item = usize> + Clone {
    (0..AXIS_COUNT).filter(move |axis| bits >> axis & 1 != 0)
}

/// The limits of an axis before its first motion, which brings its own.
pub const fn resting() -> Limits {
    let profile = Profile { low_pps: 1, high_pps: 1, acceleration_ms: 1, deceleration_ms: 1, s_curve: false };
    profile.limits(pps::scale(1, HZ), HZ)
}

impl<F: Flash> Cmd4cr<F> {
    /// Whether pulses are on their way on an axis.
    pub fn is_moving(&self, axis: usize) -> bool {
        self.axes[axis].is_moving() || self.ride_of(axis).is_some_and(|ride| ride.path.is_moving())
    }

    /// Whether an axis has come to the end of its motion: in position, corrections included.
    pub fn is_idle(&self, axis: usize) -> bool {
        let station = &self.stations[axis];
        matches!(station.task, Task::Rest | Task::Follow)
            && !self.is_moving(axis)
            && !station.is_settling()
            && !self.guards[axis].arriving
    }

    /// Whether an axis has nothing to do any more, now or later.
    pub fn is_done(&self, axis: usize) -> bool {
        self.is_idle(axis) && !self.is_waiting(axis) && !self.is_buffered(axis)
    }

    /// Speed of an axis: pulses a second, or counts a second with StepNLoop, but for interpolated moves
    /// (manual, table 2-29).
    pub fn speed(&self, axis: usize) -> i32 {
        if let Some(ride) = self.ride_of(axis) {
            return pps::pps(ride.path.speed(axis), ride.path.limits().scale, HZ) as i32;
        }
        let pulses = pps::pps(self.axes[axis].speed(), self.axes[axis].limits().scale, HZ);
        if self.stations[axis].closed.is_on() {
            self.ratio(axis).counts(pulses.into()) as i32
        } else {
            pulses as i32
        }
    }

    /// Whether an axis may set out, in these directions: plus, minus (manual, table 4-41). With the emergency
    /// input on it may not, and that is an error of the axis (manual, 2.1.3.1.2).
    pub fn may_move(&mut self, axis: usize, ways: [bool; 2]) -> Result<(), Refusal> {
        if !self.is_idle(axis) || matches!(self.stations[axis].task, Task::Follow) {
            return Err(Refusal::Moving);
        }
        self.may_set_out(axis, ways)
    }

    /// The same where it may still have something else to do first.
    pub fn may_set_out(&mut self, axis: usize, ways: [bool; 2]) -> Result<(), Refusal> {
        if self.io.emergency() {
            self.guards[axis].emergency |= !self.ignores_errors();
            return Err(Refusal::EmergencyStop);
        }
        if self.alarm_on(axis) {
            return Err(Refusal::Alarm);
        }
        match self.limits_on(axis) {
            [true, _] if ways[0] => return Err(Refusal::PlusLimit),
            [_, true] if ways[1] => return Err(Refusal::MinusLimit),
            _ => {}
        }
        // A limit stops StepNLoop too, but then it is the limit's error that has to be cleared.
        match (self.is_barred(axis), self.stations[axis].closed.status().is_error()) {
            (true, _) => Err(Refusal::Moving),
            (_, true) => Err(Refusal::ClosedLoop),
            _ => Ok(()),
        }
    }

    /// Speeds and times in force for an axis, or with `None` for interpolated moves, in pulses. S-curves are
    /// those of axis `curve_of`.
    pub fn speeds(&self, axis: Option<usize>, curve_of: usize) -> Speeds {
        let get = |id| match axis {
            Some(axis) => self.memory.cells.of_axis(id, axis),
            None => self.memory.cells.get(id),
        };
        let pulses = |value: i32| match axis.filter(|&axis| self.stations[axis].closed.is_on()) {
            Some(axis) => self.ratio(axis).pulses(value.into()).clamp(1, MAX_SPEED_PPS.into()) as u32,
            None => value as u32,
        };
        Speeds {
            high_pps: pulses(get(Id::HighSpeed)),
            low_pps: pulses(get(Id::LowSpeed)),
            acceleration_ms: get(Id::Acceleration) as u32,
            deceleration_ms: get(Id::Deceleration) as u32,
            window: axis.map(|axis| self.memory.cells.at(Id::SpeedMode, axis) as u8),
            s_curve: self.memory.cells.at(Id::SCurve, curve_of) != 0,
        }
    }

    /// The limits of a motion without a target.
    pub fn limits(&self, axis: usize) -> Limits {
        self.speeds(Some(axis), axis).limits(&FAMILY)
    }

    /// What a motion command does: it moves, goes to the buffer, or waits for the external start.
    pub fn command(
        &mut self,
        motion: Motion,
        program: Option<usize>,
        board: &mut dyn Board,
    ) -> Result<(), Refusal> {
        if self.buffer.is_on()
            && let Some(entry) = self.buffered(&motion)?
        {
            return self.add_to_buffer(entry);
        }
        if self.memory.cells.get(Id::ExternalStart) != 0 {
            return self.wait_for_start(motion, program);
        }
        self.begin(&motion, program, board)
    }

    /// Sets a motion going.
    pub fn begin(
        &mut self,
        motion: &Motion,
        program: Option<usize>,
        board: &mut dyn Board,
    ) -> Result<(), Refusal> {
        match *motion {
            Motion::To { targets, incremental } => self.move_to(targets, incremental, program, board)?,
            Motion::Jog { axis, way } => self.jog(axis, way, program, board)?,
            Motion::Home { axis, way, mode } => self.home(axis, way, mode, program, board)?,
            Motion::Curve(curve) => self.ride_curve(&curve, program, board)?,
        }
        self.react(board);
        Ok(())
    }

    /// An axis sets out by itself.
    fn set_out(&mut self, axis: usize, task: Task, limits: Limits, motion: closed_loop::Motion) {
        let station = &mut self.stations[axis];
        station.task = task;
        station.closed.begin(&self.axes[axis], motion);
        self.set_limits(axis, limits);
    }

    fn move_to(
        &mut self,
        targets: Targets,
        incremental: bool,
        program: Option<usize>,
        board: &mut dyn Board,
    ) -> Result<(), Refusal> {
        // Everything is reckoned before anything is changed.
        let mut goals = [None; AXIS_COUNT];
        for (axis, target) in (0..).zip(targets) {
            let Some(target) = target else { continue };
            let from = self.position(axis);
            let target = if incremental { from.wrapping_add(target) } else { target };
            let pulses = self.goal(axis, target)?;
            goals[axis] = Some((from, target, pulses, pulses.wrapping_sub(self.axes[axis].position())));
        }
        for (axis, goal) in (0..).zip(goals) {
            if let Some((.., way)) = goal {
                self.may_move(axis, [way > 0, way < 0])?;
            }
        }
        if goals.iter().flatten().count() > 1 && self.memory.cells.get(Id::Interpolation) != 0 {
            let targets = goals.map(|goal| goal.map(|(_, target, ..)| target));
            let ways = goals.map(|goal| goal.map_or(0, |(.., way)| way));
            self.ride_line(targets, ways, program, board);
            return Ok(());
        }
        for (axis, goal) in (0..).zip(goals) {
            let Some((from, target, pulses, way)) = goal else { continue };
            self.stations[axis].program = program;
            self.forget_slowdown(axis, board);
            let limits = self.speeds(Some(axis), axis).limits_over(way.unsigned_abs(), &FAMILY);
            self.set_out(axis, Task::Move { from }, limits, closed_loop::Motion::To(target));
            self.axes[axis].set_goal(Goal::Position(pulses));
        }
        Ok(())
    }

    fn jog(
        &mut self,
        axis: usize,
        way: Direction,
        program: Option<usize>,
        board: &mut dyn Board,
    ) -> Result<(), Refusal> {
        self.may_move(axis, [way == Direction::Positive, way == Direction::Negative])?;
        self.stations[axis].program = program;
        self.forget_slowdown(axis, board);
        self.set_out(axis, Task::Jog, self.limits(axis), closed_loop::Motion::Jog);
        let top = self.axes[axis].limits().top;
        self.axes[axis].set_goal(Goal::Speed(way, top));
        Ok(())
    }

    /// `STOP`, `ABORT`: one axis with those that are interpolated with it, or all; also what waits for them. One
    /// that has a joystick goes on, which is an error (manual, 2.5.1.3).
    pub fn stop(&mut self, axis: Option<usize>, halt: Halt) -> Result<(), Refusal> {
        let mut stopped = Ok(());
        for axis in (0..AXIS_COUNT).filter(|&other| axis.is_none_or(|axis| axis == other)) {
            if self.joystick_on(axis) {
                stopped = Err(Refusal::Moving);
            } else {
                self.drop_waiting(axis);
                self.stop_axis(axis, halt);
            }
        }
        self.settle();
        stopped
    }

    /// Stops an axis and what it is interpolated with. One that follows something goes on following it.
    pub fn stop_axis(&mut self, axis: usize, halt: Halt) {
        if self.stop_ride(axis, halt) {
            return;
        }
        let (station, unit) = (&mut self.stations[axis], &mut self.axes[axis]);
        if matches!(station.task, Task::Rest) && !station.is_settling() {
            return;
        }
        station.closed.begin(unit, halt.motion());
        match halt {
            Halt::AtOnce => unit.halt(),
            Halt::Ramp => unit.set_goal(Goal::Speed(unit.direction(), 0)),
        }
        if !matches!(station.task, Task::Follow) {
            station.task = Task::Stop;
        }
    }

    /// Whether a motion of an axis may be changed on its way: it is not slowing down (manual, 2.4).
    fn may_change(&self, axis: usize) -> Result<(), Refusal> {
        let unit = &self.axes[axis];
        if unit.is_moving() && unit.acceleration() >= 0 { Ok(()) } else { Err(Refusal::Override) }
    }

    /// `SSPD`: another speed for a motion that is on (manual, 2.4.1).
    pub fn change_speed(&mut self, axis: usize, speed: i32) -> Result<(), Refusal> {
        if self.buffer.is_on() {
            return Err(Refusal::BufferEnabled);
        }
        // Window 0 is the first one too (manual, table B-46).
        let mode = self.memory.cells.at(Id::SpeedMode, axis).max(1);
        let window = &COMMANDER[mode as usize - 1];
        let s_curve = self.memory.cells.at(Id::SCurve, axis) != 0;
        let asked = match &self.stations[axis].closed {
            closed if closed.is_on() => self.ratio(axis).pulses(speed.into()),
            _ => speed.into(),
        };
        let allowed = window.least_low_pps..=window.to_pps;
        let asked = u32::try_from(asked).ok().filter(|asked| allowed.contains(asked) && !s_curve);
        let asked = window.stepped(asked.ok_or(Refusal::Speed)?);
        if !matches!(self.stations[axis].task, Task::Move { .. } | Task::Jog) {
            return Err(Refusal::Override);
        }
        self.may_change(axis)?;
        let limits = self.guards[axis].limits;
        if limits.shape != Shape::Trapezoid {
            return Err(Refusal::Speed);
        }
        let scaled = rescaled(limits, pps::scale(asked, HZ));
        self.set_limits(axis, speeds::changed(scaled, asked, HZ));
        Ok(())
    }

    /// `T`: another target for a move of one axis (manual, 2.4.2).
    pub fn change_target(&mut self, axis: usize, target: i32) -> Result<(), Refusal> {
        let Task::Move { from } = self.stations[axis].task else { return Err(Refusal::Override) };
        self.may_change(axis)?;
        let target = if self.incremental { from.wrapping_add(target) } else { target };
        let pulses = self.goal(axis, target)?;
        self.stations[axis].closed.begin(&self.axes[axis], closed_loop::Motion::To(target));
        self.axes[axis].set_goal(Goal::Position(pulses));
        Ok(())
    }

    /// What has come to its end lets its axes go; an axis that stands waits for its driver, if it is to.
    pub fn settle(&mut self) {
        let ended = self.take_ended_rides();
        for axis in 0..AXIS_COUNT {
            let station = &mut self.stations[axis];
            let was = !matches!(station.task, Task::Rest | Task::Follow);
            station.settle(self.axes[axis].is_moving(), ended >> axis & 1 != 0);
            let arrived = was && matches!(station.task, Task::Rest) && !self.is_buffered(axis);
            if arrived && self.memory.cells.at(Id::InPosition, axis) != 0 {
                self.guards[axis].arriving = true;
            }
        }
    }

    /// The StepNLoop ratio of an axis.
    pub fn ratio(&self, axis: usize) -> Ratio {
        let thousandths = self.memory.cells.at(Id::LoopRatio, axis) as u32;
        Ratio::new(thousandths).expect("only ratios in range can be set")
    }
}

/// The same limits in a coarser scale, where there is room for a faster speed.
fn rescaled(limits: Limits, scale: ::motion::Scale) -> Limits {
    let Some(bits) = limits.scale.bits().checked_sub(scale.bits()).filter(|bits| *bits > 0) else {
        return limits;
    };
    Limits {
        scale,
        top: limits.top >> bits,
        start: limits.start >> bits,
        stop: limits.stop >> bits,
        // Growth is of the square of the speed.
        growth: (limits.growth >> (2 * bits)).max(1),
        fall: (limits.fall >> (2 * bits)).max(1),
        ..limits
    }
}
