//! Arcus PMX-2ED-SA with firmware V128BL: two axes with built-in drivers, and programs in A-SCRIPT.
//!
//! - [`table`]: the commands; `commands`: what each does.
//! - `memory`: what is remembered, in RAM and flash.
//! - `motion`: moves, jogs, homing, stops and limits; `feedback`: encoders and StepNLoop; `joystick`.
//! - `io`, `pins`, [`polarity`]: inputs, outputs, motor power, and the bits that invert them.
//! - `wire`: bytes in, replies out; `program`: the standalone programs.
//!
//! This file is the clock: it takes the controller from one thing that happens to the next.

mod commands;
mod feedback;
#[cfg(feature = "std")]
pub mod guide;
#[cfg(feature = "std")]
mod inspect;
mod io;
mod joystick;
mod memory;
mod motion;
mod pins;
pub mod polarity;
mod program;
mod refusal;
pub mod table;
mod wire;

use crate::ascii::clock::{Clocked, Programmed as _};
use crate::ascii::encoder::Encoder;
use crate::ascii::speeds::Family;
use crate::ascii::station::{Station, Task};
use crate::ascii::threads::{LineTime, Threads};
use crate::board::{Board, Drive, Port};
use crate::controller::{AxisState, Controller, Pin, PinKind, ProgramState};
use crate::flash::Flash;
use ::motion::path::Path;
use ::motion::{Axis, Direction, Goal, Ticks, pps};
use memory::Memory;
use pins::number as pin;
use program::THREADS;
use table::AXIS_COUNT;
pub use table::MAX_SPEED_PPS;
use wire::Wire;

/// Clocks of a millisecond.
const MILLISECOND: Ticks = pps::CLOCK_HZ as Ticks / 1000;

/// How long a compiled line takes, unless set otherwise.
const LINE_MICROS: u32 = 100;

/// Clock and speeds.
const FAMILY: Family = Family { clock_hz: pps::CLOCK_HZ, windows: &pps::PERFORMAX };

/// Device names are this with the two digits of the number (manual, 6.3).
pub const NAME: &str = "2ED";

/// Bytes of flash that the controller needs: the program of 1,275 lines and all settings, three times.
pub const FLASH_BYTES: u32 = 48 * crate::flash::PAGE_BYTES;

/// The controller.
pub struct Pmx2ed<F: Flash> {
    now: Ticks,
    memory: Memory<F>,
    axes: [Axis; AXIS_COUNT],
    stations: [Station; AXIS_COUNT],
    /// The interpolated move, if one is on.
    line: Path<AXIS_COUNT>,
    /// Targets count from the position.
    incremental: bool,
    io: io::Io,
    wire: Wire,
    programs: Threads<THREADS>,
    /// The next tick of the millisecond clock, while something needs it.
    tick_at: Option<Ticks>,
    /// Outputs and programs have been set going.
    started: bool,
    /// Flash lost its supply: the controller is off.
    dead: bool,
}

impl<F: Flash> Pmx2ed<F> {
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
            line: Path::idle(),
            incremental: false,
            io: io::Io::new(),
            wire: Wire::new(),
            programs: Threads::new(LineTime::of_micros(LINE_MICROS, pps::CLOCK_HZ)),
            tick_at: None,
            started: false,
            dead: false,
        }
    }

    /// Switches the controller on, once and before anything else, at clock 0.
    pub fn power_on(&mut self) {
        self.memory.open();
        self.wire.power_on(self.memory.number);
        for axis in 0..AXIS_COUNT {
            self.stations[axis].encoder.set_decoding(polarity::decoding_shift(self.polarity(axis)), 0);
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
        self.line.clear();
        self.tick_at = None;
    }
}

impl<F: Flash> Clocked for Pmx2ed<F> {
    type Outside = ([Option<Drive>; AXIS_COUNT], [bool; 2 * AXIS_COUNT]);

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
        let inputs = core::array::from_fn(|number| {
            let input = if number % 2 == 0 { pin::HOME } else { pin::INDEX };
            self.watches_homing(number / 2 * pin::AXIS + input)
        });
        (self.io.drives(), inputs)
    }

    fn due(&self) -> Ticks {
        let line = self.line.due(&self.axes);
        let deadlines = [line, self.tick_at, self.time_out_due(), self.programs.delay_due()];
        let axes = self.axes.iter().map(Axis::due);
        deadlines.into_iter().chain(axes).flatten().min().unwrap_or(Ticks::MAX).max(self.now)
    }

    fn step_to(&mut self, clock: Ticks, board: &mut dyn Board) {
        board.clock(clock);
        for (number, axis) in self.axes.iter_mut().enumerate() {
            axis.advance(clock, |train| board.pulses(number, train));
        }
        self.line.advance(clock, &mut self.axes, |axis, train| board.pulses(axis, train));
        self.now = clock;
        self.react(board);
        if self.tick_at.is_some_and(|due| due <= clock) {
            self.tick_at = Some(clock + MILLISECOND);
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
        // A line that ends where a limit comes on has not run into it.
        self.settle();
        self.watch_limits();
        self.watch_hosts();
        self.end_waits();
        let ticking =
            (0..AXIS_COUNT).any(|axis| self.stations[axis].closed.is_on() || self.joystick_on(axis));
        match (ticking, self.tick_at) {
            (true, None) => self.tick_at = Some(self.now + MILLISECOND),
            (false, Some(_)) => self.tick_at = None,
            _ => {}
        }
    }
}

impl<F: Flash> Controller for Pmx2ed<F> {
    fn clock_hz(&self) -> u32 {
        pps::CLOCK_HZ
    }

    fn axes(&self) -> &'static [&'static str] {
        &["X", "Y"]
    }

    fn pins(&self) -> &'static [Pin] {
        pins::PINS
    }

    fn number(&self) -> u8 {
        self.wire.address()
    }

    fn watches(&self, number: usize) -> bool {
        match pins::PINS.get(number).map(|pin| pin.kind) {
            Some(PinKind::Input) if number < pin::DI1 && number % pin::AXIS == pin::HOME => {
                self.watches_homing(number)
            }
            Some(PinKind::Index(_)) => self.watches_homing(number),
            Some(PinKind::Input) => true,
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
            (false, true) => self.next_look(MILLISECOND),
        }
    }

    fn is_moving(&self) -> bool {
        self.line.is_moving() || self.axes.iter().any(Axis::is_moving)
    }

    fn receive(&mut self, port: Port, bytes: &[u8], board: &mut dyn Board) {
        self.start(board);
        for &byte in if port == Port::Can { &[] } else { bytes } {
            self.take_byte(port, byte, board);
        }
        self.react(board);
    }

    fn hang_up(&mut self, port: Port) {
        self.wire.hang_up(port);
    }

    fn input(&mut self, number: usize, on: bool, board: &mut dyn Board) {
        if self.dead {
            return;
        }
        self.start(board);
        self.take_level(number, on);
        if number < pin::DI1 {
            self.run_homing(number / pin::AXIS, board);
        }
        self.react(board);
    }

    fn analog_changed(&mut self, _: usize, _: &mut dyn Board) {}

    fn set_window(&mut self, axis: usize, low: i64, high: i64) {
        self.axes[axis].set_window(low, high);
    }

    fn odometer(&self, axis: usize) -> i64 {
        self.axes[axis].odometer()
    }

    fn axis(&self, axis: usize, board: &mut dyn Board) -> AxisState {
        let unit = &self.axes[axis];
        let (speed, limits, direction) = match self.line_of(axis) {
            Some(line) => (line.speed(axis), line.limits(), line.direction(axis)),
            None => (unit.speed(), unit.limits(), Some(unit.direction())),
        };
        let speed = limits.scale.millipulses_per_second(speed, pps::CLOCK_HZ) as i64;
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
