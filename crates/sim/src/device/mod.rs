//! A controller in its machine, and the loop that lets their time pass.

mod faults;
mod held;
mod lines;
mod pins;
mod power;
mod schedule;
mod settle;
mod state;
mod switches;
#[cfg(test)]
mod tests;
mod traps;
mod wheel;
mod world;

pub use pins::{ParsePinValueError, PinError, PinValue};
pub(crate) use pins::{find as find_pin, to_drive as level_for};
pub use schedule::{Input, TimedInput, TimedInputError};
pub use state::{AxisView, DeviceState, ProgramView};
pub use switches::{SwitchError, Switches};
pub use wheel::MAX_COUNTS;
pub use world::{MAX_CONTACTS, MAX_SENT, Sent};

use crate::{
    config::{DeviceConfig, MAX_PULSES},
    fault::{Parts, Way},
    flash::SharedFlash,
    record::{Mark, Note, RecordError, RecordInfo, Recorder},
    tape::{self, Act, Track},
};
use devices::{AxisState, Controller, Drive, Notice, Pin, Port, ProgramRun, ProgramState, Wiring};
use faults::Faults;
use motion::Ticks;
use protocol::{hid::Name, tmcl::Status};
use schedule::Schedule;
use std::collections::VecDeque;
use wheel::Wheel;
use world::{Stirred, World};

/// How often something may happen at one and the same clock before it is a fault of the controller.
const MAX_STANDSTILL: u32 = 100_000;

/// Most notices that wait to be taken while they are recorded; those after them are in the recording only.
const MAX_NOTICES: usize = 16;

/// Most programs of a device.
const MAX_PROGRAMS: usize = 16;

/// Why an axis cannot be loaded, pushed or turned by hand.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum AxisError {
    /// The device has no such axis.
    #[error("there is no axis `{name}`, the device has: {known}")]
    Unknown {
        /// The name that was asked for.
        name: String,
        /// All names.
        known: String,
    },
    /// It has no input for a manual pulse generator.
    #[error("axis `{0}` has no MPG input")]
    NoPulser(String),
    /// A load is a number from 0 to 1000; a push goes, and pulses are lost, [`MAX_PULSES`] at most; no more
    /// than [`MAX_COUNTS`] of a hand wheel may be waiting.
    #[error("the value is out of range")]
    Range,
}

/// A controller with its flash, and the machine behind its pins, in virtual time.
///
/// Times are clocks of the device, counted from its making; they go on when the power is cycled. Every
/// call happens at [`now`](Self::now), and only [`advance`](Self::advance) moves that.
pub struct VirtualDevice {
    config: DeviceConfig,
    seed: u64,
    flash: SharedFlash,
    controller: Box<dyn Controller + Send>,
    clock_hz: u32,
    world: World,
    schedule: Schedule,
    /// The hand wheel at each axis.
    wheels: Vec<Wheel>,
    /// The level of each input as the controller knows it.
    told: Vec<i32>,
    movements: Vec<Movement>,
    /// Those that recordings were told of.
    notices: VecDeque<Notice>,
    tapes: Vec<Track>,
    faults: Faults,
    /// The load of each axis without faults.
    loads: Vec<f64>,
    is_powered: bool,
    /// Instructions of all programs before the supply came last.
    executed: u64,
    /// Whether a debugger lets its programs' lines through one by one.
    gated: bool,
}

impl VirtualDevice {
    /// A device fresh from the factory, switched on. `seed` counts where the configuration has none.
    pub fn new(config: &DeviceConfig, seed: u64) -> Self {
        Self::with_flash(config, SharedFlash::erased(config.model.flash_bytes), seed)
    }

    /// A device with this flash, switched on.
    ///
    /// # Panics
    /// If the flash has another size than the model needs.
    pub fn with_flash(config: &DeviceConfig, flash: SharedFlash, seed: u64) -> Self {
        assert_eq!(flash.len(), config.model.flash_bytes, "the flash must be the model's");
        let seed = config.seed.unwrap_or(seed);
        flash.set_seed(seed);
        flash.restore_power();
        let controller = (config.model.build)(Box::new(flash.clone()), seed);
        let (axes, pins, clock_hz) = (controller.axes(), controller.pins(), controller.clock_hz());
        let world = World::new(config, axes, pins, flash.clone(), clock_hz, seed);
        let wheels = axes.iter().map(|axis| Wheel::new(config.axis(axis).mpg_hz, clock_hz)).collect();
        let loads = axes.iter().map(|axis| config.axis(axis).load).collect();
        let mut device = Self {
            config: config.clone(),
            seed,
            flash,
            clock_hz,
            world,
            schedule: Schedule::default(),
            wheels,
            told: Vec::new(),
            movements: Vec::new(),
            notices: VecDeque::new(),
            tapes: Vec::new(),
            faults: Faults::none(&Parts::of_controller(config.model, &*controller)),
            loads,
            is_powered: true,
            executed: 0,
            gated: false,
            controller,
        };
        device.start();
        device
    }

    /// What it was made from.
    pub fn config(&self) -> &DeviceConfig {
        &self.config
    }

    /// The memory that outlives the power.
    pub fn flash(&self) -> &SharedFlash {
        &self.flash
    }

    /// Clocks a second.
    pub fn clock_hz(&self) -> u32 {
        self.clock_hz
    }

    /// What it is called on USB if it is a device of reports there; `None` if it is a serial port.
    pub fn hid_name(&self) -> Option<Name> {
        Some(Name::new(self.config.model.hid_product?, self.controller.number()))
    }

    /// The address on RS-485 that it listens to.
    pub fn bus_address(&self) -> u8 {
        self.controller.number()
    }

    /// The device time at which it was switched on last.
    pub fn switched_on_at(&self) -> Ticks {
        self.world.origin
    }

    /// Device time in clocks.
    pub fn now(&self) -> Ticks {
        self.world.now()
    }

    /// Device time in seconds.
    pub fn seconds(&self) -> f64 {
        self.now() as f64 / f64::from(self.clock_hz)
    }

    /// A span in clocks, rounded to the nearest; as long as there is if it is too long.
    pub fn ticks(&self, seconds: f64) -> Ticks {
        (seconds * f64::from(self.clock_hz)).round() as Ticks
    }

    /// When something will happen by itself; [`Ticks::MAX`] if nothing will.
    pub fn wake(&self) -> Ticks {
        let own = if self.is_powered { self.controller.wake() } else { Ticks::MAX };
        let own = if own == Ticks::MAX { own } else { own.saturating_add(self.world.origin) };
        own.min(self.outside()).min(self.world.next_sample()).min(self.world.wire.next(Way::Out))
    }

    /// The device time at which something has to be done here. Recordings look at the axes wherever
    /// something happens.
    fn stop(&self) -> Ticks {
        if self.world.is_recording() { self.wake() } else { self.outside() }
    }

    /// The device time at which something outside happens by itself.
    fn outside(&self) -> Ticks {
        let machine = self.next_turn().min(self.world.machine.due());
        let wire = self.world.wire.next(Way::In).min(self.world.wire.next_babble());
        self.schedule.next().min(machine).min(wire).min(self.faults.next())
    }

    /// Lets time pass until the end of clock `until`. An earlier time than now is now.
    pub fn advance(&mut self, until: Ticks) {
        let mut standstill = 0;
        loop {
            let before = self.now();
            self.step(self.stop().min(until).max(before));
            let now = self.now();
            if now >= until && self.stop() > now {
                return;
            }
            standstill = if now == before { standstill + 1 } else { 0 };
            assert!(standstill < MAX_STANDSTILL, "{} makes no progress at clock {now}", self.config.name);
        }
    }

    /// Lets time pass until something may have changed that callers look for, a program's end above all, and no
    /// longer than until the end of clock `until`. Time need not pass at all: call it until it has come there.
    pub fn advance_some(&mut self, until: Ticks) {
        self.step(self.stop().min(until).max(self.now()));
    }

    /// Bytes arrive at a port.
    pub fn receive(&mut self, port: Port, bytes: &[u8]) {
        self.tell_tape(|| Act::Receive(port.into(), tape::hex(bytes)));
        self.carry(port, bytes);
    }

    /// Whoever was sending at a port has gone, maybe in the middle of something.
    pub fn hang_up(&mut self, port: Port) {
        self.tell_tape(|| Act::HangUp(port.into()));
        self.faults.hang_up(port);
        if self.is_powered {
            self.controller.hang_up(port);
        }
    }

    /// Takes what was sent since the last time, oldest first.
    pub fn drain_sent(&mut self) -> impl Iterator<Item = Sent> + '_ {
        self.world.take_in();
        self.world.sent.drain(..)
    }

    /// The pins.
    pub fn pins(&self) -> &'static [Pin] {
        self.world.pins
    }

    /// The names of the axes.
    pub fn axes(&self) -> &'static [&'static str] {
        self.controller.axes()
    }

    /// What is on a pin.
    ///
    /// # Errors
    /// [`PinError::Unknown`].
    pub fn read_pin(&self, name: &str) -> Result<PinValue, PinError> {
        let pin = pins::find(self.pins(), name)?;
        Ok(pins::from_level(&self.pins()[pin], self.world.level(pin)))
    }

    /// Drives an input by hand, whatever the machine does, until it is released. A port that becomes an
    /// output meanwhile is the controller's, and the hand's again afterwards. A pin that measures the motor supply
    /// is that supply: the motors have the same volts.
    ///
    /// # Errors
    /// [`PinError`].
    pub fn drive_pin(&mut self, name: &str, value: PinValue) -> Result<(), PinError> {
        let pin = pins::find(self.pins(), name)?;
        let level = pins::to_drive(&self.pins()[pin], value)?;
        if self.world.is_output(pin) {
            return Err(PinError::Driven(name.into()));
        }
        self.tell_tape(|| Act::Pin(name.into(), Some(value)));
        self.put(pin, Some(level));
        self.tend_faults();
        Ok(())
    }

    /// Gives an input back to the machine.
    ///
    /// # Errors
    /// [`PinError::Unknown`] and [`PinError::Output`].
    pub fn release_pin(&mut self, name: &str) -> Result<(), PinError> {
        let pin = self.input_pin(name)?;
        self.tell_tape(|| Act::Pin(name.into(), None));
        self.put(pin, None);
        self.tend_faults();
        Ok(())
    }

    /// Plans a change of an input for device time `at`; an earlier time than now is now. For a digital
    /// pin the numbers 0 and 1 are levels too. A port that is an output then takes the level when it becomes
    /// an input.
    ///
    /// # Errors
    /// [`PinError`].
    pub fn schedule(&mut self, at: Ticks, input: &Input) -> Result<(), PinError> {
        let pin = self.input_pin(&input.pin)?;
        let level = match input.value {
            None => None,
            Some(value) => {
                let digital = !self.pins()[pin].kind.is_analog();
                let value = match value {
                    PinValue::Number(number) if digital && (number == 0.0 || number == 1.0) => {
                        PinValue::Level(number == 1.0)
                    }
                    value => value,
                };
                Some(pins::to_drive(&self.pins()[pin], value)?)
            }
        };
        self.tell_tape(|| Act::Plan(at, input.pin.clone(), input.value));
        self.schedule.add(at.max(self.now()), pin, level);
        Ok(())
    }

    /// Sets the load of an axis in parts of the motor's pull-out torque at full current.
    ///
    /// # Errors
    /// [`AxisError`].
    pub fn set_load(&mut self, axis: &str, load: f64) -> Result<(), AxisError> {
        let name = axis;
        let axis = self.axis_index(axis)?;
        if !(0.0..=1000.0).contains(&load) {
            return Err(AxisError::Range);
        }
        self.tell_tape(|| Act::Load(name.into(), load));
        self.loads[axis] = load;
        self.world.machine.set_load(axis, load + self.faults.load(axis));
        self.world.windows[axis] = None;
        self.settle();
        Ok(())
    }

    /// The load of an axis, without what faults add.
    ///
    /// # Errors
    /// [`AxisError::Unknown`].
    pub fn load(&self, axis: &str) -> Result<f64, AxisError> {
        Ok(self.loads[self.axis_index(axis)?])
    }

    /// Turns the motor of an axis from outside, in the unit of [`AxisConfig`](crate::AxisConfig).
    ///
    /// # Errors
    /// [`AxisError`].
    pub fn push(&mut self, axis: &str, distance: i64) -> Result<(), AxisError> {
        let name = axis;
        let axis = self.axis_index(axis)?;
        if !(-MAX_PULSES..=MAX_PULSES).contains(&distance) {
            return Err(AxisError::Range);
        }
        self.tell_tape(|| Act::Push(name.into(), distance));
        self.world.machine.push(axis, distance);
        self.world.windows[axis] = None;
        self.world.stir(Stirred::Contacts);
        self.settle();
        self.tend_faults();
        Ok(())
    }

    /// Lets the motor of an axis lose so many of the pulses to come, in whatever direction.
    ///
    /// # Errors
    /// [`AxisError`].
    pub fn lose(&mut self, axis: &str, pulses: u64) -> Result<(), AxisError> {
        let name = axis;
        let axis = self.axis_index(axis)?;
        if pulses > MAX_PULSES.unsigned_abs() {
            return Err(AxisError::Range);
        }
        self.tell_tape(|| Act::Lose(name.into(), pulses));
        self.world.machine.lose(axis, pulses);
        self.world.windows[axis] = None;
        self.settle();
        Ok(())
    }

    /// Turns the hand wheel at the MPG input of an axis so many counts: edges of both its phases. They
    /// arrive one by one, [`AxisConfig::mpg_hz`](crate::AxisConfig) of them a second, after those that are
    /// still to come.
    ///
    /// # Errors
    /// [`AxisError`].
    pub fn pulser(&mut self, axis: &str, counts: i64) -> Result<(), AxisError> {
        let name = axis;
        let axis = self.axis_index(name)?;
        if !self.controller.has_pulser(axis) {
            return Err(AxisError::NoPulser(name.into()));
        }
        self.wheels[axis].turn(counts, self.world.now()).map_err(|_| AxisError::Range)?;
        self.tell_tape(|| Act::Mpg(name.into(), counts));
        Ok(())
    }

    /// What the driver stage of an axis does.
    ///
    /// # Errors
    /// [`AxisError::Unknown`].
    pub fn drive(&self, axis: &str) -> Result<Drive, AxisError> {
        Ok(self.world.machine.drive(self.axis_index(axis)?))
    }

    /// Where the driven side of an axis really is, from where it first stood, in the unit of
    /// [`AxisConfig`](crate::AxisConfig).
    ///
    /// # Errors
    /// [`AxisError::Unknown`].
    pub fn shaft(&self, axis: &str) -> Result<i64, AxisError> {
        Ok(self.world.machine.position(self.axis_index(axis)?))
    }

    /// The counters and status of an axis by its number.
    ///
    /// # Panics
    /// If there is no axis of this number.
    pub fn axis(&mut self, axis: usize) -> AxisState {
        if !self.is_powered {
            return AxisState::default();
        }
        self.controller.axis(axis, &mut self.world)
    }

    /// The state of a program by its number; `None` past the last.
    pub fn program(&self, index: usize) -> Option<ProgramState> {
        let program = self.controller.program(index)?;
        let off = ProgramState { run: ProgramRun::Idle, counter: 0, instructions: 0 };
        Some(if self.is_powered { program } else { off })
    }

    /// Instructions that all programs have executed since the device was made.
    pub fn instructions(&self) -> u64 {
        self.executed + self.programs().map(|program| program.instructions).sum::<u64>()
    }

    /// The next command that a program passed over; only the first few are kept.
    pub fn take_notice(&mut self) -> Option<Notice> {
        self.notices.pop_front().or_else(|| self.controller.take_notice())
    }

    /// The states of all programs.
    pub fn programs(&self) -> impl Iterator<Item = ProgramState> + '_ {
        (0..MAX_PROGRAMS).map_while(|index| self.program(index))
    }

    /// What the device is doing, for people and their tools.
    pub fn state(&mut self) -> DeviceState {
        let axes = self.axes();
        DeviceState {
            axes: axes.iter().enumerate().map(|(index, name)| (*name, self.axis(index).into())).collect(),
            programs: self.programs().map(Into::into).collect(),
            device_seconds: self.seconds(),
        }
    }

    /// What a recorder has to know.
    pub fn record_info(&self) -> RecordInfo {
        let (device, clock_hz) = (self.config.name.clone(), self.clock_hz);
        RecordInfo { device, clock_hz, axes: self.axes(), pins: self.pins() }
    }

    /// Tells this recorder of everything from now on.
    pub fn add_recorder(&mut self, recorder: Box<dyn Recorder + Send>) {
        self.movements = self.movement();
        self.world.add_recorder(recorder);
    }

    /// Takes down on this tape, too, what the device is told. It has to be the tape of a device that was just
    /// made.
    pub fn add_tape(&mut self, track: Track) {
        self.tapes.push(track);
    }

    /// Ends the tapes at the present clock.
    pub fn end_tape(&mut self) {
        self.tell_tape(|| Act::End);
        self.tapes.clear();
    }

    fn tell_tape(&self, act: impl Fn() -> Act) {
        self.tapes.iter().for_each(|track| track.put(self.now(), act()));
    }

    /// Ends all recordings, with a sample of the end where they have samples.
    ///
    /// # Errors
    /// The first [`RecordError`]; the other recordings are finished all the same.
    pub fn finish_recordings(&mut self) -> Result<(), RecordError> {
        let states = self.axis_states();
        self.world.finish_recordings(&states)
    }

    fn axis_index(&self, name: &str) -> Result<usize, AxisError> {
        let axes = self.axes();
        let found = axes.iter().position(|axis| *axis == name);
        found.ok_or_else(|| AxisError::Unknown { name: name.into(), known: axes.join(", ") })
    }

    fn input_pin(&self, name: &str) -> Result<usize, PinError> {
        let pin = pins::find(self.pins(), name)?;
        if self.pins()[pin].kind.is_output() {
            return Err(PinError::Output(name.into()));
        }
        Ok(pin)
    }

    /// Puts a level on an input, or releases it.
    fn put(&mut self, pin: usize, level: Option<i32>) {
        let before = self.world.level(pin);
        self.world.drive_input(pin, level);
        if self.pins()[pin].wiring == Wiring::Supply {
            self.supply();
        }
        self.analog_was(pin, before);
        self.settle();
    }

    /// Tells of an analog pin if it no longer has this level.
    fn analog_was(&mut self, pin: usize, before: i32) {
        let level = self.world.level(pin);
        if self.pins()[pin].kind.is_analog() && level != before {
            self.world.record_pin(pin, level);
            if self.is_powered {
                self.controller.analog_changed(pin, &mut self.world);
            }
        }
    }

    /// Bytes enter the wire to a port. A fault that waits for a message begins before it.
    fn carry(&mut self, port: Port, bytes: &[u8]) {
        let mut from = 0;
        if self.faults.listens() {
            for (at, byte) in bytes.iter().enumerate() {
                if self.faults.hear(port, at == 0, *byte, self.now(), self.clock_hz) {
                    if from < at {
                        self.pass_in(port, &bytes[from..at]);
                    }
                    from = at;
                    self.tend_faults();
                }
            }
        }
        self.pass_in(port, &bytes[from..]);
        self.tend_faults();
    }

    fn pass_in(&mut self, port: Port, bytes: &[u8]) {
        if self.world.wire.is_sound() {
            return self.hear(port, bytes);
        }
        let mut arrived = Vec::new();
        self.world
            .wire
            .pass(Way::In, self.world.now(), (port, 0, bytes), |bytes| arrived.push(bytes.to_vec()));
        arrived.iter().for_each(|bytes| self.hear(port, bytes));
    }

    /// Goes to device time `now`, to the first change of an input before it, or to a line that is held.
    fn step_to_line(&mut self, now: Ticks) {
        if self.is_powered {
            // Less than was asked for where a shaft has come to the edge of its window.
            let clock = self.controller.advance(now - self.world.origin, &mut self.world);
            self.world.set_clock(clock);
            if (self.gated || self.faults.wait_for_lines()) && self.is_held() {
                return;
            }
            self.world.settle_contacts();
            self.settle();
            self.turn_wheels();
        } else {
            self.pass_in_the_dark(now);
        }
        while let Some(due) = self.schedule.take(self.now()) {
            self.put(due.pin, due.level);
        }
        self.tend_faults();
        if self.world.is_recording() {
            self.record();
        }
    }

    fn movement(&mut self) -> Vec<Movement> {
        (0..self.axes().len()).map(|axis| Movement::of(&self.axis(axis))).collect()
    }

    fn axis_states(&mut self) -> Vec<AxisState> {
        (0..self.axes().len()).map(|axis| self.axis(axis)).collect()
    }

    fn record(&mut self) {
        while let Some(notice) = self.controller.take_notice() {
            self.world.record_note(Note::Notice, &notice_text(&notice));
            if self.notices.len() < MAX_NOTICES {
                self.notices.push_back(notice);
            }
        }
        let states = self.axis_states();
        for (axis, state) in states.iter().enumerate() {
            let before = std::mem::replace(&mut self.movements[axis], Movement::of(state));
            for mark in before.marks(state) {
                self.world.record_mark(axis, mark);
            }
        }
        self.world.sample(&states);
    }
}

/// A command that a program passed over, in words.
pub fn notice_text(notice: &Notice) -> String {
    let command = tmcl::isa::instruction(notice.opcode).and_then(|entry| entry.mnemonic).unwrap_or("?");
    format!("{command} at address {} was passed over: {}", notice.counter, Status(notice.status))
}

/// How an axis was moving when it was last looked at.
#[derive(Clone, Copy, Debug)]
struct Movement {
    moving: bool,
    target: i32,
}

impl Movement {
    fn of(state: &AxisState) -> Self {
        Self { moving: state.speed_mpps != 0, target: state.target }
    }

    /// What has happened until now. A program may give the next target in the moment of arrival.
    fn marks(self, now: &AxisState) -> impl Iterator<Item = Mark> + use<> {
        let moving = now.speed_mpps != 0;
        let next = moving && now.target != self.target;
        let arrived = self.moving && now.position == self.target && (next || !moving);
        let came_to_rest = match (arrived, self.moving && !moving) {
            (true, _) => Some(Mark::TargetReached),
            (false, true) => Some(Mark::Stopped),
            (false, false) => None,
        };
        let started = (moving && (!self.moving || arrived)).then_some(Mark::Started);
        came_to_rest.into_iter().chain(started)
    }
}
