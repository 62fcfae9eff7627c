//! What every controller is, seen from outside: a state machine that is told the time.

use crate::board::{Board, Port};
use motion::Ticks;

/// The state of one axis, for views and recordings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AxisState {
    /// Position counter, in pulses.
    pub position: i32,
    /// Position as the encoder of the axis says, in the unit that its register has.
    pub encoder: i32,
    /// Speed in thousandths of a pulse a second, with its sign.
    pub speed_mpps: i64,
    /// Where the axis is going, in pulses.
    pub target: i32,
    /// The axis' status word, as the device defines it.
    pub status: u32,
    /// All pulses put out since power-up, in both directions.
    pub steps: u64,
}

/// The state of one standalone program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ProgramState {
    /// What it is doing.
    pub run: ProgramRun,
    /// Where it is: line or address.
    pub counter: u32,
    /// How many instructions it has executed since power-up.
    pub instructions: u64,
}

/// What a standalone program is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ProgramRun {
    /// It has not been started, or has ended.
    Idle,
    /// It is running.
    Running,
    /// It was paused, or executes single steps.
    Paused,
    /// It was stopped by an error.
    Error,
}

/// A program command that could not be executed and was passed over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Notice {
    /// When.
    pub at: Ticks,
    /// Its line or address.
    pub counter: u32,
    /// Its number.
    pub opcode: u8,
    /// What a host would have been told.
    pub status: u8,
}

/// What kind of pin it is, seen from the controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PinKind {
    /// On or off, driven from outside.
    Input,
    /// On or off, driven by the controller.
    Output,
    /// On or off: an input until the controller drives it, and again when it lets go.
    Port,
    /// A number, driven from outside.
    Analog,
    /// A number, driven by the controller.
    AnalogOutput,
    /// The null or index channel of the encoder with this number.
    Index(usize),
}

impl PinKind {
    /// Whether it has a number on it, and not a level.
    pub const fn is_analog(self) -> bool {
        matches!(self, Self::Analog | Self::AnalogOutput)
    }

    /// Whether the controller drives it, always.
    pub const fn is_output(self) -> bool {
        matches!(self, Self::Output | Self::AnalogOutput)
    }

    /// Whether the controller is told of its changes, where it is not an output now.
    pub const fn is_told(self) -> bool {
        matches!(self, Self::Input | Self::Port | Self::Index(_))
    }
}

/// Which part of a machine a pin usually hangs on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Wiring {
    /// Nothing in particular.
    Free,
    /// The switch at the negative end of the axis.
    NegativeLimit(usize),
    /// The switch at the positive end of the axis.
    PositiveLimit(usize),
    /// The home switch of the axis.
    Home(usize),
    /// The index mark of the axis' encoder.
    Index(usize),
    /// The slowdown switch of the axis.
    Slowdown(usize),
    /// The joystick of the axis: at rest the pin is in the middle of its range.
    Joystick(usize),
    /// The signal of the axis' servo driver that it has followed all pulses.
    InPosition(usize),
    /// The motor supply.
    Supply,
    /// The temperature of the driver.
    Temperature,
}

/// One pin of a controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pin {
    /// Its name in the manual.
    pub name: &'static str,
    /// Direction and kind.
    pub kind: PinKind,
    /// Where it goes.
    pub wiring: Wiring,
    /// What an analog pin's number means, for people: `V`, `°C`.
    pub unit: &'static str,
    /// How many of the board's integers make one unit of an analog pin; 1 for others.
    pub scale: i32,
    /// The level of the pin when nothing drives it: 0 or 1, or the analog value in the board's integers.
    pub rest: i32,
}

/// A controller.
///
/// Time only moves forward, by [`advance`](Self::advance); the other calls happen at the time of the
/// last one. After any call [`wake`](Self::wake) may have changed.
pub trait Controller {
    /// Clocks a second.
    fn clock_hz(&self) -> u32;

    /// Names of the axes.
    fn axes(&self) -> &'static [&'static str];

    /// The pins; their index is their number everywhere.
    fn pins(&self) -> &'static [Pin];

    /// The address on RS-485 that it listens to now. Where its name on USB has a
    /// [number](crate::Model::hid_product) it is the same, 0 to 99.
    fn number(&self) -> u8 {
        0
    }

    /// Whether a change of this input matters now. An index mark that nobody looks at need not
    /// interrupt a cruise.
    fn watches(&self, pin: usize) -> bool;

    /// Lets time pass until the end of clock `now`: gives out the pulses made until then, runs programs,
    /// and does what was due. Never call it with an earlier time.
    ///
    /// Gives the clock that was reached. It is earlier than `now` when an axis has arrived at the edge of
    /// its [`window`](Self::set_window), or when a driver stage or what the controller
    /// [`watches`](Self::watches) has changed, so that windows are others: the caller looks after the
    /// inputs, sets the next windows and calls again. It is earlier, too, when a program has ended, for callers
    /// that wait for that.
    fn advance(&mut self, now: Ticks, board: &mut dyn Board) -> Ticks;

    /// The clock at which something will happen by itself, for callers that sleep until then;
    /// [`Ticks::MAX`] if nothing will. A running program counts once a millisecond. Nobody has to stop
    /// there: [`advance`](Self::advance) passes over it.
    fn wake(&self) -> Ticks;

    /// Whether pulses are on their way. If not, nothing at all happens before [`wake`](Self::wake).
    fn is_moving(&self) -> bool;

    /// Bytes arrive at a port.
    fn receive(&mut self, port: Port, bytes: &[u8], board: &mut dyn Board);

    /// Whoever was sending at a port has gone: what he had begun is forgotten, where a pause does not say so
    /// anyway.
    fn hang_up(&mut self, _port: Port) {}

    /// An input pin changes, or an index mark passes (`on` when it is entered).
    fn input(&mut self, pin: usize, on: bool, board: &mut dyn Board);

    /// An analog input changed; the value is read from the board. Only for pins that the controller
    /// compares with thresholds, as the supply.
    fn analog_changed(&mut self, pin: usize, board: &mut dyn Board);

    /// Whether an axis has an input for a manual pulse generator, or an encoder to follow.
    fn has_pulser(&self, _axis: usize) -> bool {
        false
    }

    /// Whether counts at the pulser input of an axis matter now. Those of an encoder that it follows come
    /// in the clock in which the encoder counts.
    fn watches_pulser(&self, _axis: usize) -> bool {
        false
    }

    /// Counts arrive at the pulser input of an axis: edges of both phases, up or down.
    fn pulser(&mut self, _axis: usize, _counts: i32, _board: &mut dyn Board) {}

    /// The counts of an encoder's decoder that have to be told: those strictly between these two need not.
    /// Counts wrap, so two equal ones leave out all others.
    fn encoder_window(&self, _channel: usize) -> Option<(i32, i32)> {
        None
    }

    /// An encoder's decoder has arrived at an end of its [window](Self::encoder_window) or beyond. The
    /// window is around its count from then on.
    fn encoder_moved(&mut self, _channel: usize, _board: &mut dyn Board) {}

    /// Nothing outside changes while the axis' odometer (net pulses since power-up) stays strictly
    /// between `low` and `high`; [`advance`](Self::advance) stops where it arrives at one of them.
    fn set_window(&mut self, axis: usize, low: i64, high: i64);

    /// The axis' odometer: net pulses put out since power-up. Unlike the position it is never set.
    fn odometer(&self, axis: usize) -> i64;

    /// What an axis is doing.
    fn axis(&self, axis: usize, board: &mut dyn Board) -> AxisState;

    /// What a program is doing; `None` past the last.
    fn program(&self, index: usize) -> Option<ProgramState>;

    /// The next command that a program passed over, for host tools; only the first few are kept.
    fn take_notice(&mut self) -> Option<Notice> {
        None
    }

    /// Its programs and numbers for a debugger; `None` if it has nothing to show.
    #[cfg(feature = "std")]
    fn inspect(&mut self) -> Option<&mut dyn crate::Inspect> {
        None
    }
}
