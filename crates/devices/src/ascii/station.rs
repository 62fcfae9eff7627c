//! An axis as the command languages see it: what it was told to do, its encoder and its closed loop.

use super::encoder::Encoder;
use super::speeds;
use motion::closed_loop::{self, Ratio, Settings, StepNLoop};
use motion::homing::Homing;
use motion::joystick::{self, Joystick};
use motion::{Axis, Direction, Goal, Ticks, pps};

/// How a motion is ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Halt {
    /// Within the clock.
    AtOnce,
    /// With the deceleration ramp.
    Ramp,
}

impl Halt {
    /// What StepNLoop calls it.
    pub const fn motion(self) -> closed_loop::Motion {
        match self {
            Self::AtOnce => closed_loop::Motion::Abort,
            Self::Ramp => closed_loop::Motion::Stop,
        }
    }
}

/// What an axis was told to do.
#[derive(Clone, Debug)]
pub enum Task {
    /// Nothing.
    Rest,
    /// To go to a target; INC targets of `T` count from here.
    Move {
        /// Position at the start.
        from: i32,
    },
    /// To go on and on.
    Jog,
    /// To find its zero point.
    Home(Homing),
    /// To follow a path with other axes.
    Path {
        /// To this pulse.
        target: i32,
    },
    /// To follow a joystick or a manual pulse generator.
    Follow,
    /// To come to rest.
    Stop,
}

/// What belongs to an axis beside its pulses.
#[derive(Debug)]
pub struct Station {
    /// What it was told to do.
    pub task: Task,
    /// Latched limit errors: plus, minus, as [`side`] says.
    pub errors: [bool; 2],
    /// The encoder counter.
    pub encoder: Encoder,
    /// StepNLoop.
    pub closed: StepNLoop,
    /// What the joystick has come to.
    pub joystick: Joystick,
    /// The program that set it in motion, for its errors.
    pub program: Option<usize>,
    /// A program looks at its status while it moves.
    pub polled: bool,
}

/// Places of a limit: plus comes first in pins, status bits and errors.
pub const fn side(way: Direction) -> usize {
    match way {
        Direction::Positive => 0,
        Direction::Negative => 1,
    }
}

/// The directions of the [`side`]s.
pub const SIDES: [Direction; 2] = [Direction::Positive, Direction::Negative];

impl Station {
    /// An axis at power-up.
    pub const fn new(encoder: Encoder) -> Self {
        Self {
            task: Task::Rest,
            errors: [false; 2],
            encoder,
            closed: StepNLoop::new(),
            joystick: Joystick::new(),
            program: None,
            polled: false,
        }
    }

    /// A program looks at its status: until when that stays as it is if nothing happens, where that is known.
    pub fn poll(&mut self, axis: &Axis) -> Option<Ticks> {
        self.polled = true;
        // Within a train the axis goes on as it does.
        if matches!(self.task, Task::Path { .. }) { None } else { axis.wake() }
    }

    /// Whether StepNLoop is still bringing the axis into position.
    pub fn is_settling(&self) -> bool {
        let status = self.closed.status();
        !matches!(status, closed_loop::Status::Idle | closed_loop::Status::Off) && !status.is_error()
    }

    /// StepNLoop on, from where the encoder is, or off.
    pub fn switch_loop(&mut self, on: bool, axis: &Axis, decoder: i32) {
        if on {
            self.closed.enable(axis, self.encoder.position(decoder));
        } else {
            self.closed.disable();
        }
    }

    /// Sets the encoder counter; the target of StepNLoop goes along.
    pub fn set_encoder(&mut self, position: i32, decoder: i32) {
        self.closed.shift(position.wrapping_sub(self.encoder.position(decoder)));
        self.encoder.set_position(position, decoder);
    }

    /// Lets StepNLoop watch an axis that moves by itself, or is `carried` along a path. Whether it has found an
    /// error: the axis stands then, but not yet the path.
    pub fn poll_loop(&mut self, axis: &mut Axis, decoder: i32, settings: &Settings, carried: bool) -> bool {
        let encoder = self.encoder.position(decoder);
        let failed = if carried {
            self.closed.watch(axis, encoder, settings)
        } else {
            self.closed.poll(axis, encoder, settings).is_some_and(closed_loop::Status::is_error)
        };
        if failed && !matches!(self.task, Task::Rest | Task::Path { .. }) {
            self.task = Task::Stop;
        }
        failed
    }

    /// Once a millisecond: the speed that the joystick asks for, in the directions (plus, minus) in which the
    /// axis may move.
    pub fn follow_joystick(
        &mut self,
        axis: &mut Axis,
        settings: &joystick::Settings,
        analog_mv: i32,
        allowed: [bool; 2],
        clock_hz: u32,
    ) {
        let mut speed = self.joystick.tick(settings, analog_mv, axis.position());
        if speed != 0 && !allowed[side(Direction::of(speed.into()))] {
            self.joystick = Joystick::new();
            speed = 0;
        }
        let limits = speeds::at_once(settings.speed_pps, clock_hz);
        let top = pps::speed(speed.unsigned_abs(), limits.scale, clock_hz);
        // The joystick's own steps are the ramp: the axis takes each at once.
        axis.set_limits(limits);
        let way = if speed == 0 { axis.direction() } else { Direction::of(speed.into()) };
        axis.set_goal(Goal::Speed(way, top));
    }

    /// Here is zero.
    pub fn zero(&mut self, axis: &Axis, decoder: i32) {
        self.closed.zero(axis);
        self.encoder.set_position(0, decoder);
    }

    /// The pulse that a target means; `None` if it is out of reach.
    pub fn goal(&self, axis: &Axis, target: i32, ratio: Ratio) -> Option<i32> {
        if self.closed.is_on() { self.closed.goal(axis, target, ratio) } else { Some(target) }
    }

    /// An axis that stands has nothing to do any more, nor has one whose path has ended.
    pub fn settle(&mut self, is_moving: bool, path_ended: bool) {
        let over = match self.task {
            Task::Move { .. } | Task::Jog | Task::Stop => !is_moving,
            Task::Path { .. } => path_ended,
            Task::Rest | Task::Home(_) | Task::Follow => false,
        };
        if over {
            self.task = Task::Rest;
        }
    }
}
