//! Moves, jogs and stops of both axes, and what limits do to them (manual, sections 7.1 to 7.11).

use super::pins::number as pin;
use super::refusal::Refusal;
use super::table::{AXIS_COUNT, Id};
use super::{FAMILY, MAX_SPEED_PPS, Pmx2ed};
use crate::ascii::clock::Clocked as _;
use crate::ascii::speeds::{self, Speeds};
use crate::ascii::station::{Halt, SIDES, Task, side};
use crate::board::Board;
use crate::flash::Flash;
use ::motion::closed_loop::{self, Ratio};
use ::motion::homing::routine::{Inputs, Outcome, Settings};
use ::motion::homing::{Homing, performax::Routine};
use ::motion::path::{Move, Path};
use ::motion::pps::{self, CLOCK_HZ, PERFORMAX, Profile};
use ::motion::{Direction, Goal, Limits, Shape};

/// The limits of an axis before its first motion, which brings its own.
pub const fn resting() -> Limits {
    let profile = Profile { low_pps: 1, high_pps: 1, acceleration_ms: 1, deceleration_ms: 1, s_curve: false };
    profile.limits(pps::scale(1, CLOCK_HZ), CLOCK_HZ)
}

impl<F: Flash> Pmx2ed<F> {
    /// Whether pulses are on their way on an axis.
    pub fn is_moving(&self, axis: usize) -> bool {
        self.axes[axis].is_moving() || self.line_of(axis).is_some_and(Path::is_moving)
    }

    /// Whether an axis has come to the end of what it was told, corrections included.
    pub fn is_done(&self, axis: usize) -> bool {
        let station = &self.stations[axis];
        matches!(station.task, Task::Rest | Task::Follow)
            && !self.is_moving(axis)
            && !self.stations[axis].is_settling()
    }

    /// The line that an axis follows.
    pub fn line_of(&self, axis: usize) -> Option<&Path<AXIS_COUNT>> {
        Some(&self.line).filter(|line| line.involves(axis))
    }

    /// Speed of an axis: pulses a second, or counts a second with StepNLoop, but for lines.
    pub fn speed(&self, axis: usize) -> i32 {
        let station = &self.stations[axis];
        if let Some(line) = self.line_of(axis) {
            return pps::pps(line.speed(axis), line.limits().scale, CLOCK_HZ) as i32;
        }
        let pulses = pps::pps(self.axes[axis].speed(), self.axes[axis].limits().scale, CLOCK_HZ);
        if station.closed.is_on() { self.ratio(axis).counts(pulses.into()) as i32 } else { pulses as i32 }
    }

    /// The status word (manual, table 7.2).
    pub fn status(&self, axis: usize, board: &mut dyn Board) -> i32 {
        let station = &self.stations[axis];
        let phase = match self.line_of(axis) {
            Some(line) => line.acceleration(),
            None => self.axes[axis].acceleration(),
        };
        let moving = self.is_moving(axis);
        let [plus, minus] = self.limits_on(axis);
        let bits = [
            moving && phase > 0,
            moving && phase < 0,
            moving && phase == 0,
            false,
            plus,
            minus,
            self.home_on(axis, board),
            station.errors[0],
            station.errors[1],
            self.index_on(axis, board),
            self.joystick_on(axis),
            self.wire.timed_out,
        ];
        (0..).zip(bits).map(|(bit, on)| i32::from(on) << bit).sum()
    }

    /// Whether an axis may set out.
    pub fn may_move(&self, axis: usize) -> Result<(), Refusal> {
        let station = &self.stations[axis];
        match station.closed.status() {
            _ if self.joystick_on(axis) => Err(Refusal::State),
            _ if !self.is_done(axis) => Err(Refusal::Moving),
            // A limit stops StepNLoop too, but then it is the limit's error that has to be cleared.
            _ if station.errors.contains(&true) => Err(Refusal::State),
            status if status.is_error() => Err(Refusal::ClosedLoop),
            _ => Ok(()),
        }
    }

    /// Speeds and times in force for an axis, or with `None` for lines, in pulses. S-curves are those of axis
    /// `curve_of`.
    fn speeds(&self, axis: Option<usize>, curve_of: usize) -> Speeds {
        let get = |id| match axis {
            Some(axis) => self.memory.cells.of_axis(id, axis),
            None => self.memory.cells.get(id),
        };
        let pulses = |value: i32| match axis.filter(|&axis| self.stations[axis].closed.is_on()) {
            Some(axis) => self.ratio(axis).pulses(value.into()).clamp(1, MAX_SPEED_PPS.into()) as u32,
            None => value as u32,
        };
        let own = self.memory.cells.get(Id::OwnDeceleration) != 0;
        Speeds {
            high_pps: pulses(get(Id::HighSpeed)),
            low_pps: pulses(get(Id::LowSpeed)),
            acceleration_ms: get(Id::Acceleration) as u32,
            deceleration_ms: get(if own { Id::Deceleration } else { Id::Acceleration }) as u32,
            window: axis.map(|axis| self.memory.cells.at(Id::SpeedMode, axis) as u8),
            s_curve: self.memory.cells.at(Id::SCurve, curve_of) != 0,
        }
    }

    /// The limits of a motion without a target.
    pub fn limits(&self, axis: usize) -> Limits {
        self.speeds(Some(axis), axis).limits(&FAMILY)
    }

    /// The limits of a move over so many pulses.
    fn limits_over(&self, axis: Option<usize>, pulses: u32, curve_of: usize) -> Limits {
        self.speeds(axis, curve_of).limits_over(pulses, &FAMILY)
    }

    /// `X`, `Y`, `I`: to a target, or along a line to targets. `program` is who says so, if not a host.
    pub fn move_to(
        &mut self,
        targets: [Option<i32>; AXIS_COUNT],
        program: Option<usize>,
        board: &mut dyn Board,
    ) -> Result<(), Refusal> {
        let named = targets.iter().flatten().count();
        for axis in (0..AXIS_COUNT).filter(|&axis| targets[axis].is_some()) {
            self.may_move(axis)?;
        }
        // Everything is reckoned before anything is changed.
        let mut goals = [None; AXIS_COUNT];
        for (axis, target) in (0..).zip(targets) {
            let Some(target) = target else { continue };
            let from = self.position(axis);
            let target = if self.incremental { from.wrapping_add(target) } else { target };
            let pulses = self.goal(axis, target)?;
            goals[axis] = Some((from, target, pulses, pulses.wrapping_sub(self.axes[axis].position())));
        }
        for (axis, goal) in (0..).zip(goals) {
            let Some((from, target, pulses, way)) = goal else { continue };
            let station = &mut self.stations[axis];
            station.program = program;
            station.closed.begin(&self.axes[axis], closed_loop::Motion::To(target));
            if named == 1 {
                station.task = Task::Move { from };
                let limits = self.limits_over(Some(axis), way.unsigned_abs(), axis);
                self.axes[axis].set_limits(limits);
                self.axes[axis].set_goal(Goal::Position(pulses));
            } else if way != 0 {
                station.task = Task::Path { target: pulses };
            }
        }
        if named > 1 {
            let ways = goals.map(|goal| goal.map_or(0, |(.., way)| way));
            let longest = if ways[1].unsigned_abs() > ways[0].unsigned_abs() { 1 } else { 0 };
            let limits = self.limits_over(None, ways[longest].unsigned_abs(), longest);
            self.line.set_out(limits, &Move::Line(ways), self.now, &mut self.axes);
        }
        self.react(board);
        Ok(())
    }

    /// `J`: one axis or both at the same clock.
    pub fn jog(
        &mut self,
        axis: Option<usize>,
        way: Direction,
        program: Option<usize>,
    ) -> Result<(), Refusal> {
        let jogging = (0..AXIS_COUNT).filter(|&other| axis.is_none_or(|axis| axis == other));
        for axis in jogging.clone() {
            self.may_move(axis)?;
        }
        for axis in jogging {
            let limits = self.limits(axis);
            let station = &mut self.stations[axis];
            station.task = Task::Jog;
            station.program = program;
            station.closed.begin(&self.axes[axis], closed_loop::Motion::Jog);
            self.axes[axis].set_limits(limits);
            self.axes[axis].set_goal(Goal::Speed(way, limits.top));
        }
        self.watch_limits();
        Ok(())
    }

    /// `STOP`, `ABORT`: one axis with those that are interpolated with it, or all.
    pub fn stop(&mut self, axis: Option<usize>, halt: Halt) {
        for axis in (0..AXIS_COUNT).filter(|&other| axis.is_none_or(|axis| axis == other)) {
            if self.stop_line(axis, halt) || self.is_done(axis) {
                continue;
            }
            let (station, unit) = (&mut self.stations[axis], &mut self.axes[axis]);
            station.closed.begin(unit, halt.motion());
            match halt {
                Halt::AtOnce => unit.halt(),
                Halt::Ramp => unit.set_goal(Goal::Speed(unit.direction(), 0)),
            }
            if !matches!(station.task, Task::Follow) {
                station.task = Task::Stop;
            }
        }
        self.settle();
    }

    /// Stops the line that an axis follows, if there is one, and with it all that follow it.
    pub fn stop_line(&mut self, axis: usize, halt: Halt) -> bool {
        let line = &mut self.line;
        if !line.involves(axis) {
            return false;
        }
        match halt {
            Halt::AtOnce => line.halt(),
            Halt::Ramp => line.stop(&mut self.axes),
        }
        for member in (0..AXIS_COUNT).filter(|&member| line.involves(member)) {
            self.stations[member].closed.begin(&self.axes[member], halt.motion());
        }
        true
    }

    /// `SSPD`: another speed for a motion that is on.
    pub fn change_speed(&mut self, axis: usize, speed: i32) -> Result<(), Refusal> {
        let mode = self.memory.cells.at(Id::SpeedMode, axis);
        let station = &self.stations[axis];
        if matches!(station.task, Task::Path { .. }) {
            return Err(Refusal::Interpolating);
        }
        if self.memory.cells.at(Id::SCurve, axis) != 0 {
            return Err(Refusal::SCurve);
        }
        let window =
            mode.checked_sub(1).and_then(|row| PERFORMAX.get(row as usize)).ok_or(Refusal::NoWindow)?;
        if !matches!(station.task, Task::Move { .. } | Task::Jog) || !self.axes[axis].is_moving() {
            return Err(Refusal::State);
        }
        let asked = if station.closed.is_on() { self.ratio(axis).pulses(speed.into()) } else { speed.into() };
        let limits = self.axes[axis].limits();
        let present = pps::pps(limits.top, limits.scale, CLOCK_HZ);
        let allowed = window.least_low_pps..=window.to_pps;
        let asked =
            u32::try_from(asked).ok().filter(|asked| allowed.contains(asked)).ok_or(Refusal::Speed)?;
        if !allowed.contains(&present) || limits.shape != Shape::Trapezoid {
            return Err(Refusal::Speed);
        }
        let limits = speeds::changed(limits, asked, CLOCK_HZ);
        self.axes[axis].set_limits(limits);
        if let Goal::Speed(way, _) = self.axes[axis].goal() {
            self.axes[axis].set_goal(Goal::Speed(way, limits.top));
        }
        Ok(())
    }

    /// `T`: another target for a move of one axis.
    pub fn change_target(&mut self, axis: usize, target: i32) -> Result<(), Refusal> {
        let Task::Move { from } = self.stations[axis].task else { return Err(Refusal::NoTarget) };
        let target = if self.incremental { from.wrapping_add(target) } else { target };
        let pulses = self.goal(axis, target)?;
        self.stations[axis].closed.begin(&self.axes[axis], closed_loop::Motion::To(target));
        self.axes[axis].set_goal(Goal::Position(pulses));
        self.watch_limits();
        Ok(())
    }

    /// `H`, `L`, `ZH`, `Z`, `HL`.
    pub fn home(
        &mut self,
        id: Id,
        axis: usize,
        way: Direction,
        program: Option<usize>,
        board: &mut dyn Board,
    ) -> Result<(), Refusal> {
        self.may_move(axis)?;
        let (routine, motion) = match id {
            Id::Home => (Routine::Home, closed_loop::Motion::Home),
            Id::HomeLow => (Routine::HomeLow, closed_loop::Motion::Home),
            Id::LimitHome => (Routine::Limit, closed_loop::Motion::LimitHome),
            Id::HomeIndex => (Routine::HomeIndex, closed_loop::Motion::IndexHome),
            _ => (Routine::Index, closed_loop::Motion::IndexHome),
        };
        let amount = if id == Id::LimitHome { Id::LimitCorrection } else { Id::HomeCorrection };
        let limits = self.limits(axis);
        let settings = Settings {
            limits,
            slow: limits.start,
            correction: self.memory.cells.of_axis(amount, axis),
            index_marks: 1,
            return_to_zero: self.memory.cells.get(Id::ReturnToZero) != 0,
        };
        let station = &mut self.stations[axis];
        station.program = program;
        station.closed.begin(&self.axes[axis], motion);
        station.task = Task::Home(Homing::new(routine.steps(), way, settings));
        self.run_homing(axis, board);
        self.react(board);
        Ok(())
    }

    /// Lets a homing routine take notice of inputs and axis.
    pub fn run_homing(&mut self, axis: usize, board: &mut dyn Board) {
        if !matches!(self.stations[axis].task, Task::Home(_)) {
            return;
        }
        let [plus, minus] = self.limits_on(axis);
        let inputs = Inputs {
            home: self.home_on(axis, board),
            limits: [minus, plus],
            index: self.index_on(axis, board),
            // The device has no such input.
            slowdown: false,
        };
        let station = &mut self.stations[axis];
        let Task::Home(homing) = &mut station.task else { return };
        let outcome = homing.poll(&mut self.axes[axis], inputs);
        if homing.take_zeroed() {
            station.zero(&self.axes[axis], board.encoder(axis));
        }
        match outcome {
            None => {}
            Some(Outcome::Found) => station.task = Task::Stop,
            Some(Outcome::Limit(way)) => {
                station.task = Task::Stop;
                self.limit_hit(axis, way);
            }
        }
        self.settle();
    }

    /// A limit stops motion into it.
    pub fn watch_limits(&mut self) {
        for axis in 0..AXIS_COUNT {
            let on = self.limits_on(axis);
            for way in SIDES.into_iter().filter(|&way| on[side(way)]) {
                let station = &self.stations[axis];
                let into = match (&station.task, self.line_of(axis)) {
                    // Homing looks after its limits itself.
                    (Task::Home(_), _) => false,
                    (_, Some(line)) => line.direction(axis) == Some(way),
                    _ => self.axes[axis].is_moving() && self.axes[axis].direction() == way,
                };
                if into {
                    self.limit_hit(axis, way);
                }
            }
        }
        self.settle();
    }

    /// The axis has run into its limit: it stops at once, and so does a line that it is part of.
    fn limit_hit(&mut self, axis: usize, way: Direction) {
        let ignored = self.memory.cells.get(Id::IgnoreErrors) != 0;
        let ratio = self.ratio(axis);
        let on_line = self.stop_line(axis, Halt::AtOnce);
        let (station, unit) = (&mut self.stations[axis], &mut self.axes[axis]);
        unit.halt();
        if !on_line && !matches!(station.task, Task::Follow) {
            station.task = Task::Stop;
        }
        if ignored {
            station.closed.begin(unit, Halt::AtOnce.motion());
        } else {
            station.errors[side(way)] = true;
            station.closed.limit(unit, ratio);
            self.program_error(axis);
        }
    }

    /// `CLR`: the errors of an axis are forgotten.
    pub fn clear(&mut self, axis: usize, board: &mut dyn Board) {
        self.stations[axis].errors = [false; 2];
        self.clear_loop(axis, board);
    }

    /// A line that has ended lets its axes go, and axes that stand have nothing to do any more.
    pub fn settle(&mut self) {
        let mut ended = false;
        for (number, (station, axis)) in self.stations.iter_mut().zip(&self.axes).enumerate() {
            let path_ended = !self.line.is_moving() && self.line.involves(number);
            station.settle(axis.is_moving(), path_ended);
            ended |= path_ended;
        }
        if ended {
            self.line.clear();
        }
    }

    /// Whether edges of an axis' home input or index matter now.
    pub fn watches_homing(&self, number: usize) -> bool {
        let (axis, input) = (number / pin::AXIS, number % pin::AXIS);
        match &self.stations[axis].task {
            Task::Home(homing) => input == pin::HOME || homing.watches_index(),
            _ => self.stations[axis].polled,
        }
    }

    /// The StepNLoop ratio of an axis.
    pub fn ratio(&self, axis: usize) -> Ratio {
        let thousandths = self.memory.cells.at(Id::LoopRatio, axis) as u32;
        Ratio::new(thousandths).expect("only ratios in range can be set")
    }
}
