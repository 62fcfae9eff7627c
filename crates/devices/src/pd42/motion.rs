//! The axis of the module: moves, ramps, stop switches, and the reference search
//! (manual, sections 3.7.1 to 3.7.4, 3.7.13 and 7.1).

use super::memory::Memory;
use super::{Pd42, ap, gp};
use crate::board::Board;
use crate::flash::Flash;
use ::motion::homing::{Search, Switches, reference};
use ::motion::{Direction, Goal, Limits, Shape, Stop, tmc429};
use protocol::tmcl::Status;
use tmcl::isa::Condition;

/// Ramp modes (axis parameter 138).
pub mod ramp_mode {
    /// Position mode.
    pub const POSITION: i32 = 0;
    /// Position mode with the exponential approach.
    pub const SOFT: i32 = 1;
    /// Velocity mode.
    pub const VELOCITY: i32 = 2;
}

/// Interrupts of the axis (manual, table 12).
const POSITION_REACHED: u8 = 3;
const STALL: u8 = 15;

/// Bits of the extended error flags (axis parameter 207).
pub const STALL_ERROR: i32 = 1;
/// See [`STALL_ERROR`].
pub const DEVIATION_ERROR: i32 = 2;

/// State of the axis beyond the kernel's.
pub struct Motion {
    /// A move to a position has begun and not been reported as ended.
    pub awaited: bool,
    /// Whether pulses were on their way when last looked.
    moving: bool,
    pub search: Option<Search>,
    /// The last stop was by an end switch (for axis parameter 150).
    pub stopped_by_switch: bool,
}

impl Motion {
    pub const fn new() -> Self {
        Self { awaited: false, moving: false, search: None, stopped_by_switch: false }
    }
}

/// Limits of an axis before it has those of the parameters.
pub const RESTING: Limits = Limits {
    scale: tmc429::scale(0),
    top: tmc429::speed(1),
    start: tmc429::speed(1),
    stop: tmc429::speed(1),
    growth: 1,
    fall: 1,
    shape: Shape::Trapezoid,
};

/// The kernel's limits from the parameters.
pub fn limits<F: Flash>(memory: &Memory<F>) -> Limits {
    let get = |number| memory.axis.get(number) as u32;
    let (pulse_div, ramp_div) = (get(ap::PULSE_DIVISOR), get(ap::RAMP_DIVISOR));
    let growth = tmc429::growth(get(ap::MAX_ACCELERATION), pulse_div, ramp_div);
    Limits {
        scale: tmc429::scale(pulse_div),
        top: tmc429::speed(get(ap::MAX_SPEED)),
        start: tmc429::speed(1),
        stop: tmc429::speed(get(ap::MIN_SPEED)),
        growth,
        fall: growth,
        shape: if memory.axis.get(ap::RAMP_MODE) == ramp_mode::SOFT { Shape::Soft } else { Shape::Trapezoid },
    }
}

impl<F: Flash> Pd42<F> {
    /// Whether the motor may be moved now.
    ///
    /// # Errors
    /// [`Status::NOT_AVAILABLE`] with too little supply or a driver that has shut down.
    fn may_move(&self) -> Result<(), Status> {
        if self.power.allows_motion() { Ok(()) } else { Err(Status::NOT_AVAILABLE) }
    }

    /// A motion command begins: it ends a search and clears the extended error flags.
    fn begin_motion(&mut self) {
        self.end_search();
        self.memory.axis.set(ap::EXTENDED_ERRORS, 0);
        self.motion.awaited = false;
        self.motion.stopped_by_switch = false;
    }

    /// Goes to a position.
    ///
    /// # Errors
    /// [`Status::NOT_AVAILABLE`] if the motor may not be moved.
    pub fn move_to(&mut self, target: i32) -> Result<(), Status> {
        self.may_move()?;
        self.begin_motion();
        if self.memory.axis.get(ap::RAMP_MODE) == ramp_mode::VELOCITY {
            self.memory.axis.set(ap::RAMP_MODE, ramp_mode::POSITION);
        }
        self.memory.axis.set(ap::TARGET_POSITION, target);
        self.motion.awaited = true;
        self.apply_limits();
        self.axis.set_goal(Goal::Position(target));
        Ok(())
    }

    /// Turns at a speed in internal units.
    ///
    /// # Errors
    /// [`Status::INVALID_VALUE`] for a speed out of range, [`Status::NOT_AVAILABLE`] if the motor may not
    /// be moved; stopping is always possible.
    pub fn rotate(&mut self, speed: i32) -> Result<(), Status> {
        if !(-tmc429::MAX_INTERNAL..=tmc429::MAX_INTERNAL).contains(&speed) {
            return Err(Status::INVALID_VALUE);
        }
        if speed != 0 {
            self.may_move()?;
        }
        self.begin_motion();
        self.memory.axis.set(ap::RAMP_MODE, ramp_mode::VELOCITY);
        self.memory.axis.set(ap::TARGET_SPEED, speed);
        self.apply_limits();
        self.axis.set_goal(Goal::Speed(Direction::of(speed.into()), tmc429::speed(speed.unsigned_abs())));
        Ok(())
    }

    /// Sets the actual position. At standstill the target follows.
    pub fn set_position(&mut self, position: i32) {
        if self.axis.is_moving() {
            self.axis.set_position(position);
            return;
        }
        self.axis.halt();
        self.axis.set_position(position);
        self.memory.axis.set(ap::TARGET_POSITION, position);
        self.resume_mode();
    }

    /// Takes up the ramp mode's goal, after it or a target was set.
    pub fn resume_mode(&mut self) {
        self.apply_limits();
        let goal = if self.memory.axis.get(ap::RAMP_MODE) == ramp_mode::VELOCITY {
            let speed = self.memory.axis.get(ap::TARGET_SPEED);
            Goal::Speed(Direction::of(speed.into()), tmc429::speed(speed.unsigned_abs()))
        } else {
            Goal::Position(self.memory.axis.get(ap::TARGET_POSITION))
        };
        self.axis.set_goal(goal);
    }

    /// Stops at once: by an error, not by a command.
    pub fn stop_hard(&mut self) {
        self.end_search();
        self.axis.halt();
        self.memory.axis.set(ap::RAMP_MODE, ramp_mode::VELOCITY);
        self.memory.axis.set(ap::TARGET_SPEED, 0);
        if core::mem::take(&mut self.motion.awaited) {
            self.vm.set_error(Condition::PositionError);
        }
    }

    /// Hands the parameters to the kernel.
    pub fn apply_limits(&mut self) {
        if self.motion.search.is_none() {
            self.axis.set_limits(limits(&self.memory));
        }
    }

    /// Logical state of the stop switches: left, right.
    pub fn stop_switches(&self) -> [bool; 2] {
        let inverted = self.memory.module.get(gp::SWITCH_POLARITY) != 0;
        [self.inputs.left != inverted, self.inputs.right != inverted]
    }

    /// Blocks the directions whose stop switch is pressed, unless it is disabled or a search is on.
    pub fn apply_blocks(&mut self) {
        let searching = self.motion.search.is_some();
        let stop = if self.memory.axis.get(ap::SOFT_STOP) == 0 { Stop::Hard } else { Stop::Soft };
        let [left, right] = self.stop_switches();
        let sides = [
            (Direction::Negative, left, ap::LEFT_SWITCH_OFF),
            (Direction::Positive, right, ap::RIGHT_SWITCH_OFF),
        ];
        for (direction, pressed, disable) in sides {
            let blocked = pressed && !searching && self.memory.axis.get(disable) == 0;
            if blocked && self.axis.is_moving() && self.axis.direction() == direction {
                self.motion.stopped_by_switch = true;
            }
            self.axis.set_blocked(direction, blocked.then_some(stop));
        }
    }

    /// `RFS START`: searches in the mode of axis parameter 193.
    ///
    /// # Errors
    /// [`Status::NOT_AVAILABLE`] if the motor may not be moved.
    pub fn start_search(&mut self) -> Result<(), Status> {
        self.may_move()?;
        self.begin_motion();
        let mode = self.memory.axis.get(ap::SEARCH_MODE);
        let steps = reference::steps((mode & 0x3F) as u8);
        let steps = steps.expect("only modes that exist can be set");
        let speed = |number| tmc429::speed(self.memory.axis.get(number) as u32);
        let speeds = [speed(ap::SEARCH_SPEED), speed(ap::SWITCH_SPEED)];
        let limits = Limits { shape: Shape::Trapezoid, ..limits(&self.memory) };
        self.axis.halt();
        self.axis.set_limits(limits);
        self.motion.search = Some(Search::new(steps, mode & 64 != 0, mode & 128 != 0, speeds, limits));
        self.memory.axis.set(ap::RAMP_MODE, ramp_mode::VELOCITY);
        self.apply_blocks();
        Ok(())
    }

    /// `RFS STOP`, and what other motion commands do to a search: the motor stops at once.
    pub fn end_search(&mut self) {
        if self.motion.search.take().is_some() {
            self.axis.halt();
            self.memory.axis.set(ap::TARGET_SPEED, 0);
            self.apply_limits();
            self.apply_blocks();
        }
    }

    /// `RFS STATUS`: 0 when no search is on, else its step.
    pub fn search_status(&self) -> i32 {
        self.motion.search.as_ref().map_or(0, |search| search.step() as i32)
    }

    /// Lets a search take notice.
    pub fn run_search(&mut self) {
        let [negative, positive] = self.stop_switches();
        let switches = Switches { negative, positive, home: self.inputs.home };
        let Some(search) = &mut self.motion.search else { return };
        let Some(found) = search.poll(&mut self.axis, switches) else { return };
        self.motion.search = None;
        self.memory.axis.set(ap::LAST_REFERENCE, found.zero);
        if let Some(distance) = found.distance {
            self.memory.axis.set(ap::END_SWITCH_DISTANCE, distance.wrapping_abs());
        }
        self.axis.halt();
        self.axis.set_position(0);
        self.memory.axis.set(ap::TARGET_POSITION, 0);
        self.memory.axis.set(ap::RAMP_MODE, ramp_mode::POSITION);
        self.resume_mode();
        self.apply_blocks();
    }

    /// Notices that the axis has started, stopped or arrived.
    pub fn watch_axis(&mut self, board: &mut dyn Board) {
        let moving = self.axis.is_moving();
        if moving == self.motion.moving && !self.motion.awaited {
            return;
        }
        let stopped = self.motion.moving && !moving;
        self.motion.moving = moving;
        if moving {
            self.power.motor_started();
            return;
        }
        if stopped {
            self.power.motor_stopped(self.now);
        }
        if !self.motion.awaited {
            return;
        }
        if self.reached() {
            self.motion.awaited = false;
            self.raise(POSITION_REACHED);
            if let Some(port) = self.wire.event_port() {
                self.send_position_reached(port, board);
            }
        } else if stopped {
            self.vm.set_error(Condition::PositionError);
        }
    }

    /// Whether the axis stands at its target.
    pub fn reached(&self) -> bool {
        self.axis.position() == self.memory.axis.get(ap::TARGET_POSITION)
    }

    /// A load value of 0 above the speed of axis parameter 181 stops the motor.
    pub fn watch_stall(&mut self) {
        let above = self.memory.axis.get(ap::STOP_ON_STALL);
        let speed = tmc429::internal(self.axis.speed());
        if above > 0 && speed > above && self.power.driver.reading() == 0 {
            self.stop_hard();
            let errors = self.memory.axis.get(ap::EXTENDED_ERRORS) | STALL_ERROR;
            self.memory.axis.set(ap::EXTENDED_ERRORS, errors);
            self.raise(STALL);
        }
    }
}
