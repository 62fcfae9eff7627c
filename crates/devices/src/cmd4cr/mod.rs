//! Nippon Pulse CMD-4CR (Commander core) with firmware V126BL: four axes, and programs in A-SCRIPT.
//!
//! - [`table`]: the commands; [`refusal`]: why one is not done; `commands`: what each does.
//! - [`memory`]: what is remembered, in RAM and flash.
//! - `motion`: moves, jogs and stops; `homing`; `path`: interpolated moves; `buffer`: those that follow each
//!   other; `start`: motions that wait for the external start.
//! - `safety`: what stops axes or holds them back; `erc`: the error clear output; `feedback`: encoders and
//!   StepNLoop; `joystick`, `pulser`: axes that follow something.
//! - `capture`: latches and synchronisation outputs.
//! - `io`, `pins`, [`polarity`]: inputs and outputs, and the bits that invert them.
//! - `wire`: bytes in, replies out; `program`: the standalone programs.
//!
//! This file is the clock: it takes the controller from one thing that happens to the next.

mod buffer;
mod capture;
mod commands;
mod erc;
mod feedback;
#[cfg(feature = "std")]
pub mod guide;
mod homing;
#[cfg(feature = "std")]
mod inspect;
mod io;
mod joystick;
pub mod memory;
mod motion;
mod path;
mod pins;
pub mod polarity;
mod program;
mod pulser;
pub mod refusal;
mod safety;
mod start;
pub mod table;
mod wire;

use crate::ascii::clock::{Clocked, Programmed as _};
use crate::ascii::encoder::Encoder;
use crate::ascii::ports::Ports;
use crate::ascii::speeds::Family;
use crate::ascii::station::{Station, Task};
use crate::ascii::threads::{LineTime, Threads};
use crate::board::{Board, Drive, Port};
use crate::controller::{AxisState, Controller, Pin, PinKind, ProgramState};
use crate::flash::Flash;
use ::motion::{Axis, Direction, Goal, Ticks, pps};
use buffer::Buffer;
use capture::Capture;
use erc::ErrorClear;
use memory::Memory;
use path::Rides;
use pins::number as pin;
use program::THREADS;
use pulser::Pulser;
use safety::Guard;
use start::Waiting;
use table::AXIS_COUNT;
pub use table::MAX_SPEED_PPS;

/// What its names on USB begin with; the digits of its identification number follow (manual, 3.3).
pub const NAME: &str = "CMD-4CR-";

/// The reference clock of the PCL6045BL.
const HZ: u32 = 19_660_800;

/// How long a compiled line takes, unless set otherwise.
const LINE_MICROS: u32 = 100;

/// Clock and speeds.
const FAMILY: Family = Family { clock_hz: HZ, windows: &pps::COMMANDER };

/// Bytes of flash that the controller needs: the program of 1,800 lines and all settings, three times.
pub const FLASH_BYTES: u32 = 64 * crate::flash::PAGE_BYTES;

/// Clocks of some milliseconds, up to a whole one.
const fn milliseconds(ms: Ticks) -> Ticks {
    (ms * HZ as Ticks).div_ceil(1000)
}

/// The controller.
pub struct Cmd4cr<F: Flash> {
    now: Ticks,
    memory: Memory<F>,
    axes: [Axis; AXIS_COUNT],
    stations: [Station; AXIS_COUNT],
    guards: [Guard; AXIS_COUNT],
    clears: [ErrorClear; AXIS_COUNT],
    captures: [Capture; AXIS_COUNT],
    pulsers: [Pulser; AXIS_COUNT],
    rides: Rides,
    buffer: Buffer,
    waiting: Waiting,
    /// Targets count from the position.
    incremental: bool,
    io: io::Io,
    ports: Ports,
    programs: Threads<THREADS>,
    /// The next tick of the millisecond clock, while something needs it.
    tick_at: Option<Ticks>,
    /// Outputs and programs have been set going.
    started: bool,
    /// Flash lost its supply: the controller is off.
    dead: bool,
}

impl<F: Flash> Cmd4cr<F> {
    /// A controller that has just been switched on, at clock 0.
    pub fn new(flash: F) -> Self {
        let mut controller = Self::off(flash);
        controller.power_on();
        controller
    }

    /// A controller that is switched off: it can be a static, and is then [switched on](Self::power_on) where it
    /// is.
    pub const fn off(flash: F) -> Self {
        Self {
            now: 0,
            memory: Memory::new(flash, &memory::LAYOUT),
            axes: [const { Axis::new(motion::resting()) }; AXIS_COUNT],
            stations: [const { Station::new(Encoder::new(0, 0)) }; AXIS_COUNT],
            guards: [Guard::new(); AXIS_COUNT],
            clears: [ErrorClear::new(); AXIS_COUNT],
            captures: [const { Capture::new() }; AXIS_COUNT],
            pulsers: [const { Pulser::new() }; AXIS_COUNT],
            rides: Rides::new(),
            buffer: Buffer::new(),
            waiting: Waiting::new(),
            incremental: false,
            io: io::Io::new(),
            ports: Ports::new(),
            programs: Threads::new(LineTime::of_micros(LINE_MICROS, HZ)),
            tick_at: None,
            started: false,
            dead: false,
        }
    }

    /// Switches the controller on, once and before anything else, at clock 0.
    pub fn power_on(&mut self) {
        self.memory.open();
        self.ports.power_on(self.memory.number);
        for axis in 0..AXIS_COUNT {
            let (shift, reversed) = polarity::encoder(self.polarity(axis));
            self.stations[axis].encoder.set_counting(shift, reversed, 0);
        }
    }

    /// Sets how many clocks a compiled line takes.
    ///
    /// # Panics
    /// If it is 0: a program would never let time pass.
    pub fn set_line_clocks(&mut self, clocks: Ticks) {
        self.programs.set_line_clocks(clocks);
    }

    /// What power-up does once there is a board.
    fn start(&mut self, board: &mut dyn Board) {
        if !core::mem::replace(&mut self.started, true) {
            self.boot_outputs(board);
            // Decoders count from anywhere.
            for axis in 0..AXIS_COUNT {
                self.stations[axis].encoder.set_position(0, board.encoder(axis));
            }
            self.boot_loops(board);
            self.boot_programs();
        }
    }

    /// The millisecond clock, for what is watched and not told.
    fn tick(&mut self, board: &mut dyn Board) {
        for axis in 0..AXIS_COUNT {
            self.poll_loop(axis, board);
            self.follow_joystick(axis, board);
        }
    }

    /// A store failed because the supply is gone: nothing happens any more.
    fn die(&mut self) {
        self.dead = true;
        self.axes.iter_mut().for_each(Axis::halt);
        self.rides.clear();
        self.tick_at = None;
    }
}

/// What the window of an axis depends on.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Outside {
    drive: Option<Drive>,
    inputs: [bool; 3],
    pulser: bool,
    encoder: Option<(i32, i32)>,
}

/// The next clock of the millisecond clock after this one.
const fn next_tick(now: Ticks) -> Ticks {
    milliseconds(now * 1000 / HZ as Ticks + 1)
}

impl<F: Flash> Clocked for Cmd4cr<F> {
    type Outside = [Outside; AXIS_COUNT];

    fn now(&self) -> Ticks {
        self.now
    }

    fn is_dead(&self) -> bool {
        self.dead
    }

    fn axes(&self) -> &[Axis] {
        &self.axes
    }

    fn outside(&self) -> Self::Outside {
        let drives = self.io.drives();
        core::array::from_fn(|axis| Outside {
            drive: drives[axis],
            inputs: [pin::HOME, pin::INDEX, pin::SLOWDOWN]
                .map(|input| self.watches_axis_pin(axis * pin::AXIS + input)),
            pulser: self.pulser_on(axis),
            encoder: self.captured_window(axis),
        })
    }

    fn due(&self) -> Ticks {
        let rides = self.rides.iter().map(|ride| self.ride_due(ride));
        let clears = self.clears.iter().map(ErrorClear::due);
        let captures = self.captures.iter().map(Capture::due);
        let axes = self.axes.iter().map(Axis::due);
        let deadlines = [self.tick_at, self.programs.delay_due()].into_iter();
        let all = deadlines.chain(rides).chain(clears).chain(captures).chain(axes);
        all.flatten().min().unwrap_or(Ticks::MAX).max(self.now)
    }

    fn step_to(&mut self, clock: Ticks, board: &mut dyn Board) {
        board.clock(clock);
        for (number, axis) in self.axes.iter_mut().enumerate() {
            axis.advance(clock, |train| board.pulses(number, train));
        }
        for ride in &mut self.rides {
            ride.path.advance(clock, &mut self.axes, |axis, train| board.pulses(axis, train));
        }
        self.now = clock;
        self.react(board);
        if self.tick_at.is_some_and(|due| due <= clock) {
            self.tick_at = Some(next_tick(clock));
            self.tick(board);
            self.react(board);
        }
    }

    fn react(&mut self, board: &mut dyn Board) {
        if self.dead {
            return;
        }
        for axis in 0..AXIS_COUNT {
            if !self.axes[axis].is_moving() {
                self.stations[axis].polled = false;
                self.run_homing(axis, board);
            }
        }
        // What ends where a limit comes on has not run into it.
        self.settle();
        self.watch_emergency();
        self.watch_alarms();
        self.watch_limits();
        self.settle();
        self.watch_positions();
        self.give_clears(board);
        self.compare(board);
        if self.run_buffer(board).is_err()
            && let Some(number) = self.programs.responsible(self.buffer.program())
        {
            self.fail(number);
        }
        self.end_waits();
        let ticking =
            (0..AXIS_COUNT).any(|axis| self.stations[axis].closed.is_on() || self.joystick_on(axis));
        match (ticking, self.tick_at) {
            (true, None) => self.tick_at = Some(next_tick(self.now)),
            (false, Some(_)) => self.tick_at = None,
            _ => {}
        }
    }
}

impl<F: Flash> Controller for Cmd4cr<F> {
    fn clock_hz(&self) -> u32 {
        HZ
    }

    fn axes(&self) -> &'static [&'static str] {
        &["X", "Y", "Z", "U"]
    }

    fn pins(&self) -> &'static [Pin] {
        pins::PINS
    }

    fn number(&self) -> u8 {
        self.ports.address()
    }

    fn watches(&self, number: usize) -> bool {
        match pins::PINS.get(number).map(|pin| pin.kind) {
            Some(PinKind::Input | PinKind::Index(_)) if number < AXIS_COUNT * pin::AXIS => {
                self.watches_axis_pin(number)
            }
            Some(PinKind::Input | PinKind::Port) => true,
            // Analog inputs are read when they are asked for.
            _ => false,
        }
    }

    fn advance(&mut self, now: Ticks, board: &mut dyn Board) -> Ticks {
        assert!(now >= self.now, "time moves forward");
        if !self.dead {
            self.start(board);
            let reached = self.pass(now, board);
            if !self.dead {
                return reached;
            }
        }
        self.now = now;
        now
    }

    fn wake(&self) -> Ticks {
        match (self.dead, self.started) {
            (true, _) => Ticks::MAX,
            (false, false) => self.now,
            (false, true) => self.next_look(milliseconds(1)),
        }
    }

    fn is_moving(&self) -> bool {
        !self.rides.is_empty() || self.axes.iter().any(Axis::is_moving)
    }

    fn receive(&mut self, port: Port, bytes: &[u8], board: &mut dyn Board) {
        self.start(board);
        for &byte in if port == Port::Can { &[] } else { bytes } {
            self.take_byte(port, byte, board);
        }
        self.react(board);
    }

    fn hang_up(&mut self, port: Port) {
        self.ports.hang_up(port);
    }

    fn input(&mut self, number: usize, on: bool, board: &mut dyn Board) {
        if self.dead {
            return;
        }
        self.start(board);
        let before = (self.inputs(None), self.io.start());
        self.io.take_level(number, on);
        if number < AXIS_COUNT * pin::AXIS {
            let axis = number / pin::AXIS;
            if number % pin::AXIS == pin::SLOWDOWN {
                self.watch_slowdown(axis, board);
            }
            self.run_homing(axis, board);
        }
        let come_on = self.inputs(None) & !before.0;
        (0..AXIS_COUNT).filter(|axis| come_on >> axis & 1 != 0).for_each(|axis| self.latch(axis, board));
        if self.io.start() && !before.1 {
            self.external_start(board);
        }
        self.react(board);
    }

    fn analog_changed(&mut self, _: usize, _: &mut dyn Board) {}

    fn has_pulser(&self, _: usize) -> bool {
        true
    }

    fn watches_pulser(&self, axis: usize) -> bool {
        self.pulser_on(axis)
    }

    fn pulser(&mut self, axis: usize, counts: i32, board: &mut dyn Board) {
        if self.dead {
            return;
        }
        self.start(board);
        self.take_pulses(axis, counts);
        self.react(board);
    }

    fn encoder_window(&self, channel: usize) -> Option<(i32, i32)> {
        // Whoever has no supply compares nothing.
        self.captured_window(channel).filter(|_| !self.dead)
    }

    fn encoder_moved(&mut self, _: usize, board: &mut dyn Board) {
        if !self.dead {
            self.react(board);
        }
    }

    fn set_window(&mut self, axis: usize, low: i64, high: i64) {
        self.axes[axis].set_window(low, high);
    }

    fn odometer(&self, axis: usize) -> i64 {
        self.axes[axis].odometer()
    }

    fn axis(&self, axis: usize, board: &mut dyn Board) -> AxisState {
        let unit = &self.axes[axis];
        let (speed, limits, direction) = match self.ride_of(axis) {
            Some(ride) => (ride.path.speed(axis), ride.path.limits(), ride.path.direction(axis)),
            None => (unit.speed(), unit.limits(), Some(unit.direction())),
        };
        let speed = limits.scale.millipulses_per_second(speed, HZ) as i64;
        let target = match (&self.stations[axis].task, unit.goal()) {
            (&Task::Path { target }, _) | (_, Goal::Position(target)) => target,
            _ => unit.position(),
        };
        AxisState {
            position: self.position(axis),
            encoder: self.encoder(axis, board),
            speed_mpps: speed * direction.map_or(0, Direction::sign),
            target,
            status: self.status(axis, board) as u32,
            steps: unit.steps(),
        }
    }

    fn program(&self, index: usize) -> Option<ProgramState> {
        self.programs.view(index)
    }

    #[cfg(feature = "std")]
    fn inspect(&mut self) -> Option<&mut dyn crate::Inspect> {
        Some(self)
    }
}
