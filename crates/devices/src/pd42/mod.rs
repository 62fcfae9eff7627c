//! Trinamic PD42-1140 with TMCL firmware V1.47: one axis on a TMC429 and a TMC262.
//!
//! - [`axis_parameters`], [`global_parameters`], `pins`: what there is, as tables.
//! - `memory`: what is remembered, in RAM and flash.
//! - `motion`: the axis: moves, switches, reference search, ramps.
//! - `power`: currents, load, supply, temperature.
//! - `encoders`: both encoders and the deviation stops.
//! - `commands`, `control`: what each command does; `parameters`: reading and writing parameters.
//! - `wire`: bytes in, replies out; `program`: the standalone program and its interrupts.
//! - `trial`: what the assembler asks.
//!
//! This file is the clock: it takes the module from one thing that happens to the next.

pub mod axis_parameters;
mod commands;
mod control;
mod driver;
mod encoders;
pub mod global_parameters;
#[cfg(feature = "std")]
pub mod guide;
#[cfg(feature = "std")]
mod inspect;
mod memory;
mod motion;
mod parameters;
mod pins;
mod power;
mod program;
#[cfg(feature = "std")]
pub mod trial;
mod wire;

use crate::board::{Board, Port};
use crate::controller::{AxisState, Controller, Notice, Pin, PinKind, ProgramRun, ProgramState};
use crate::flash::Flash;
use ::motion::{Axis, Ticks, tmc429};
use axis_parameters as ap;
use encoders::Encoders;
use global_parameters::module as gp;
use memory::Memory;
use motion::Motion;
use pins::number as pin;
use power::Power;
use rand_pcg::Pcg32;
use tmcl::vm::{Mode, Vm};
use wire::Wire;

/// Clocks of a millisecond.
const MILLISECOND: Ticks = tmc429::CLOCK_HZ as Ticks / 1000;

/// Clocks of the unit in which programs wait and delays are set: 10 ms.
const TEN_MILLISECONDS: Ticks = 10 * MILLISECOND;

/// How long a program command takes, unless set otherwise: 50 µs.
pub const COMMAND_CLOCKS: Ticks = tmc429::CLOCK_HZ as Ticks / 20_000;

/// Bytes of flash that the module needs: the program of 2,048 commands and all settings, three times.
pub const FLASH_BYTES: u32 = 48 * crate::flash::PAGE_BYTES;

/// The firmware's name: the answer to command 136.
pub const VERSION: &[u8; 8] = b"1140V147";

/// Inputs that are on or off: stop left, stop right, home and the digital reading of the analog one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Inputs {
    left: bool,
    right: bool,
    home: bool,
    analog: bool,
}

impl Inputs {
    const OFF: Self = Self { left: false, right: false, home: false, analog: false };
}

/// The module.
pub struct Pd42<F: Flash> {
    now: Ticks,
    /// The clock at which the tick timer (global parameter 132) was 0; it may lie before power-up.
    timer_zero: i128,
    command_clocks: Ticks,
    memory: Memory<F>,
    axis: Axis,
    motion: Motion,
    power: Power,
    encoders: Encoders,
    vm: Vm,
    program: program::Program,
    wire: Wire,
    /// Random numbers; none while the module is switched off.
    random: Option<Pcg32>,
    inputs: Inputs,
    outputs: [bool; 2],
    pull_ups: bool,
    /// The next tick of the millisecond clock, while something needs it.
    tick_at: Option<Ticks>,
    /// Flash lost its supply: the module is off.
    dead: bool,
}

impl<F: Flash> Pd42<F> {
    /// A module that has just been switched on, at clock 0. Random numbers start from `seed`.
    pub fn new(flash: F, seed: u64) -> Self {
        let mut module = Self::off(flash);
        module.power_on(seed);
        module
    }

    /// A module that is switched off: it can be a static, and is then [switched on](Self::power_on) where it is.
    pub const fn off(flash: F) -> Self {
        Self {
            now: 0,
            timer_zero: 0,
            command_clocks: COMMAND_CLOCKS,
            memory: Memory::new(flash),
            axis: Axis::new(motion::RESTING),
            motion: Motion::new(),
            power: Power::new(),
            encoders: Encoders::new(),
            vm: Vm::new(),
            program: program::Program::new(),
            wire: Wire::new(),
            random: None,
            inputs: Inputs::OFF,
            outputs: [false; 2],
            pull_ups: true,
            tick_at: None,
            dead: false,
        }
    }

    /// Switches the module on, once and before anything else, at clock 0. Random numbers start from `seed`.
    pub fn power_on(&mut self, seed: u64) {
        self.random = Some(Pcg32::new(seed, RANDOM_STREAM));
        self.memory.open(&mut self.vm);
        self.axis.set_limits(motion::limits(&self.memory));
        self.start();
    }

    /// Sets how many clocks a program command takes.
    ///
    /// # Panics
    /// If it is 0: a program would never let time pass.
    pub fn set_command_clocks(&mut self, clocks: Ticks) {
        assert!(clocks > 0, "a command takes time");
        self.command_clocks = clocks;
    }

    /// What power-up does once everything is in place.
    fn start(&mut self) {
        self.wire.start(self.memory.module.get(gp::ASCII_MODE), self.now);
        self.encoders.configure(&self.memory);
        if self.memory.module.get(gp::AUTO_START) != 0 {
            self.start_program(Some(0));
        }
    }

    /// Command 255: as switching off and on. The axis stops at once; the shaft stays where it is.
    fn reset(&mut self, board: &mut dyn Board) {
        if !self.memory.is_open() {
            self.dead = true;
            return;
        }
        // The store is read anew, as at power-up.
        self.vm.power_on();
        self.memory.open(&mut self.vm);
        self.axis.halt();
        self.axis.set_position(0);
        self.axis.set_goal(::motion::Goal::Position(0));
        self.motion = Motion::new();
        self.power.restart(self.now);
        self.encoders = Encoders::new();
        self.program = program::Program::new();
        self.wire = Wire::new();
        for output in [pin::OUT0, pin::OUT1] {
            board.output(output, false);
        }
        board.output(pin::PULLUPS, true);
        self.outputs = [false; 2];
        self.pull_ups = true;
        self.timer_zero = self.now.into();
        self.apply_limits();
        self.apply_blocks();
        self.watch_shorts();
        self.start();
    }

    /// Lets the axis run to a clock and sees to what has changed there.
    fn step_to(&mut self, clock: Ticks, board: &mut dyn Board) {
        board.clock(clock);
        self.axis.advance(clock, |train| board.pulses(0, train));
        self.now = clock;
        if self.tick_at.is_some_and(|due| due <= clock) {
            self.tick_at = Some(clock + MILLISECOND);
            self.tick(board);
        }
        self.react(board);
    }

    /// The millisecond clock, for what is watched and not told.
    fn tick(&mut self, board: &mut dyn Board) {
        self.measure_load(board);
        self.watch_deviation(board);
    }

    /// Whatever follows from the present state: called after everything that happens.
    fn react(&mut self, board: &mut dyn Board) {
        if self.dead {
            return;
        }
        self.encoders.begin(board);
        self.run_search();
        self.watch_axis(board);
        self.watch_heartbeats();
        self.run_timers();
        self.end_wait();
        self.apply_power(board);
        let ticking = self.encoders.watched(&self.memory) || self.axis.is_moving() && self.load_matters();
        match (ticking, self.tick_at) {
            (true, None) => self.tick_at = Some(self.now + MILLISECOND),
            (false, Some(_)) => self.tick_at = None,
            _ => {}
        }
    }

    /// The next clock at which something is due, the axis' and the program's business included or not.
    fn due(&self) -> Ticks {
        let axis = if self.speed_matters() { self.axis.wake() } else { self.axis.due() };
        let deadlines = [
            axis,
            self.tick_at,
            self.power.due(),
            self.heartbeat_due(),
            self.program.timers_due(),
            self.wait_due(),
        ];
        deadlines.into_iter().flatten().min().unwrap_or(Ticks::MAX).max(self.now)
    }

    /// A store failed because the supply is gone: nothing happens any more.
    fn die(&mut self) {
        self.dead = true;
        self.axis.halt();
        self.vm.stop();
        self.tick_at = None;
    }

    /// Milliseconds since power-up or since the timer was set.
    fn timer_ms(&self) -> i32 {
        ((i128::from(self.now) - self.timer_zero) / i128::from(MILLISECOND)) as i32 & i32::MAX
    }
}

/// The stream of the random numbers; any odd number will do.
const RANDOM_STREAM: u64 = 0x5851_F42D_4C95_7F2D;

impl<F: Flash> Controller for Pd42<F> {
    fn clock_hz(&self) -> u32 {
        tmc429::CLOCK_HZ
    }

    fn axes(&self) -> &'static [&'static str] {
        &["0"]
    }

    fn pins(&self) -> &'static [Pin] {
        pins::PINS
    }

    fn number(&self) -> u8 {
        self.memory.module.get(gp::SERIAL_ADDRESS) as u8
    }

    fn watches(&self, pin: usize) -> bool {
        match pins::PINS.get(pin).map(|pin| pin.kind) {
            Some(PinKind::Index(_)) => self.encoders.watches_null(),
            Some(PinKind::Input | PinKind::Analog) => true,
            _ => false,
        }
    }

    fn advance(&mut self, now: Ticks, board: &mut dyn Board) -> Ticks {
        assert!(now >= self.now, "time moves forward");
        if self.dead {
            self.axis.advance(now, |_| ());
            self.now = now;
            return now;
        }
        let outside = |module: &Self| (module.power.drive, module.encoders.watches_null());
        let before = outside(self);
        self.program.forget_rounds();
        self.program.gate.look();
        let active = self.program_active();
        loop {
            let due = self.due();
            let horizon = due.min(now);
            let was = self.axis.odometer();
            let next = self.program_at().filter(|&clock| clock <= horizon);
            if next.is_none_or(|clock| clock >= due) {
                self.program.forget_rounds();
            }
            self.step_to(next.unwrap_or(horizon), board);
            let stops = |it: &Self| {
                let ended = active && !it.program_active();
                ended || it.axis.odometer() != was && it.axis.at_window() || outside(it) != before
            };
            let mut stale = false;
            if next.is_some() {
                if self.is_held() {
                    let stops = stops(self);
                    self.program.gate.hold(stops);
                    return self.now;
                }
                stale = self.program.gate.pass();
                // What is due in a clock comes before a command in it.
                self.run_program(if due > now { now } else { due.saturating_sub(1).max(self.now) }, board);
            }
            if self.dead {
                return self.advance(now, board);
            }
            if stale || stops(self) {
                return self.now;
            }
            if self.now == now && self.program_at().is_none_or(|clock| clock > now) && self.due() > now {
                return now;
            }
        }
    }

    fn wake(&self) -> Ticks {
        if self.dead {
            return Ticks::MAX;
        }
        // A program has something to do all the time: once a millisecond is often enough to look.
        let program = self.program_at().map_or(Ticks::MAX, |at| at.max(self.now + MILLISECOND));
        self.due().min(program)
    }

    fn is_moving(&self) -> bool {
        self.axis.is_moving()
    }

    fn receive(&mut self, port: Port, bytes: &[u8], board: &mut dyn Board) {
        for &byte in if port == Port::Can { &[] } else { bytes } {
            self.serial_byte(port, byte, board);
        }
        if port == Port::Can {
            self.can_frame(bytes, board);
        }
        self.react(board);
    }

    fn input(&mut self, number: usize, on: bool, board: &mut dyn Board) {
        if self.dead {
            return;
        }
        match number {
            pin::STOP_L => self.inputs.left = on,
            pin::STOP_R => self.inputs.right = on,
            pin::HOME => self.inputs.home = on,
            pin::ENC_N => self.null_channel(on, board),
            pin::SHORT_A..=pin::OPEN_B => self.coil_changed(number, on),
            _ => return,
        }
        self.input_changed(number, on);
        self.react(board);
    }

    fn analog_changed(&mut self, number: usize, board: &mut dyn Board) {
        if self.dead {
            return;
        }
        match number {
            pin::AIN0 => {
                let on = board.analog(pin::AIN0) >= ANALOG_HIGH;
                if on != self.inputs.analog {
                    self.inputs.analog = on;
                    self.input_changed(pin::AIN0, on);
                }
            }
            pin::SUPPLY => self.supply_changed(board.analog(pin::SUPPLY)),
            pin::TEMPERATURE => self.temperature_changed(board.analog(pin::TEMPERATURE)),
            _ => return,
        }
        self.react(board);
    }

    fn set_window(&mut self, _axis: usize, low: i64, high: i64) {
        self.axis.set_window(low, high);
    }

    fn odometer(&self, _axis: usize) -> i64 {
        self.axis.odometer()
    }

    fn axis(&self, _axis: usize, board: &mut dyn Board) -> AxisState {
        let bits = self.axis.limits().scale;
        let speed = bits.millipulses_per_second(self.axis.speed(), tmc429::CLOCK_HZ) as i64;
        let status = self.axis_status();
        let mut encoders = self.encoders.clone();
        encoders.update(board);
        AxisState {
            position: self.axis.position(),
            encoder: encoders.internal.position(),
            speed_mpps: speed * self.axis.direction().sign(),
            target: self.memory.axis.get(ap::TARGET_POSITION),
            status,
            steps: self.axis.steps(),
        }
    }

    fn program(&self, index: usize) -> Option<ProgramState> {
        let run = match self.vm.mode() {
            Mode::Stop | Mode::Reset => ProgramRun::Idle,
            Mode::Run => ProgramRun::Running,
            Mode::Step => ProgramRun::Paused,
        };
        let run = if self.program.failed { ProgramRun::Error } else { run };
        (index == 0).then(|| ProgramState {
            run,
            counter: self.vm.counter().into(),
            instructions: self.vm.instructions(),
        })
    }

    fn take_notice(&mut self) -> Option<Notice> {
        self.program.take_notice()
    }

    #[cfg(feature = "std")]
    fn inspect(&mut self) -> Option<&mut dyn crate::Inspect> {
        Some(self)
    }
}

/// The analog input counts as on from here: half of its 12 bits.
const ANALOG_HIGH: i32 = 2048;
