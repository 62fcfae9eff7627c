//! Inputs and outputs, motor power, and what the polarity settings do to them (manual, 2.1.2, 2.1.3, 2.1.5 and
//! 2.2.1).

use super::pins::{BITS, MAX_MV, PORTS, number as pin};
use super::table::{AXIS_COUNT, Id};
use super::{Cmd4cr, polarity};
use crate::ascii::outputs::Outputs;
use crate::board::{Board, Drive};
use crate::flash::Flash;

/// A pulse is a full step of the machine's driver.
const STEP: i16 = 1;

/// Full current in the units of [`Drive`].
const CURRENT: u8 = 32;

/// Bits of `IOP` (manual, table 2-18).
const PORTS_IN: i32 = 1;
const PORTS_OUT: i32 = 1 << 1;

/// Levels and states of the pins.
#[derive(Clone, Copy, Debug)]
pub struct Io {
    /// Levels of the high-speed inputs, DI1 in bit 0.
    inputs: u32,
    /// Which high-speed outputs are on by hand.
    outputs: u32,
    /// Which of them follow the synchronisation, and which it has on.
    synchronised: u32,
    sync_outputs: u32,
    /// Levels of the configurable inputs, IO1 in bit 0.
    port_inputs: u32,
    /// Which configurable outputs are on, or will be once they are outputs.
    port_outputs: u32,
    /// Which motors have power.
    enables: u32,
    /// Levels of the limit inputs of each axis: plus, minus.
    limits: [[bool; 2]; AXIS_COUNT],
    alarms: [bool; AXIS_COUNT],
    in_positions: [bool; AXIS_COUNT],
    emergency: bool,
    start: bool,
    drives: [Option<Drive>; AXIS_COUNT],
    pub pins: Outputs,
}

impl Io {
    pub const fn new() -> Self {
        Self {
            inputs: 0,
            outputs: 0,
            synchronised: 0,
            sync_outputs: 0,
            port_inputs: 0,
            port_outputs: 0,
            enables: 0,
            limits: [[false; 2]; AXIS_COUNT],
            alarms: [false; AXIS_COUNT],
            in_positions: [false; AXIS_COUNT],
            emergency: false,
            start: false,
            drives: [None; AXIS_COUNT],
            pins: Outputs::new(),
        }
    }

    /// The driver stages, once they were told what to do.
    pub const fn drives(&self) -> [Option<Drive>; AXIS_COUNT] {
        self.drives
    }

    /// Whether the emergency stop input is on.
    pub const fn emergency(&self) -> bool {
        self.emergency
    }

    /// Whether the external start input is on.
    pub const fn start(&self) -> bool {
        self.start
    }

    /// An input changes its level. Home, index and slowdown inputs are read when they are asked for.
    pub fn take_level(&mut self, number: usize, level: bool) {
        let set = |bits: &mut u32, bit: usize| *bits = *bits & !(1 << bit) | u32::from(level) << bit;
        match number {
            0..pin::CEMG => {
                let axis = number / pin::AXIS;
                match number % pin::AXIS {
                    side @ (pin::PLUS_LIMIT | pin::MINUS_LIMIT) => self.limits[axis][side] = level,
                    pin::ALARM => self.alarms[axis] = level,
                    pin::IN_POSITION => self.in_positions[axis] = level,
                    _ => {}
                }
            }
            pin::CEMG => self.emergency = level,
            pin::CSTA => self.start = level,
            pin::DI1..pin::DO1 => set(&mut self.inputs, number - pin::DI1),
            pin::IO1..pin::AI1 => set(&mut self.port_inputs, number - pin::IO1),
            _ => {}
        }
    }

    /// The high-speed outputs as they are, by hand or synchronisation.
    const fn high_speed_outputs(&self) -> u32 {
        self.outputs & !self.synchronised | self.sync_outputs & self.synchronised
    }
}

impl<F: Flash> Cmd4cr<F> {
    /// The polarity word of an axis.
    pub fn polarity(&self, axis: usize) -> i32 {
        self.memory.cells.at(Id::Polarity, axis)
    }

    /// Sets a polarity word: outputs that it inverts change at once, the encoder goes on from where it is.
    pub fn set_polarity(&mut self, axis: usize, word: i32, board: &mut dyn Board) {
        let (shift, reversed) = polarity::encoder(word);
        self.stations[axis].encoder.set_counting(shift, reversed, board.encoder(axis));
        self.memory.cells.set_at(Id::Polarity, axis, word);
        self.put_out(board);
    }

    /// Whether a level of an axis' pin means on, or the other way round.
    fn reads(&self, axis: usize, bit: i32, level: bool) -> bool {
        level != (self.polarity(axis) & bit != 0)
    }

    /// All bits if a setting inverts, else none.
    fn inverts(&self, id: Id, bit: i32) -> u32 {
        if self.memory.cells.get(id) & bit != 0 { u32::MAX } else { 0 }
    }

    /// Drives every output as state and polarity say.
    pub fn put_out(&mut self, board: &mut dyn Board) {
        let outputs = self.io.high_speed_outputs() ^ self.inverts(Id::OutputsPolarity, 1);
        for bit in 0..BITS {
            self.io.pins.set(pin::DO1 + bit, outputs >> bit & 1 != 0, board);
        }
        let driven = self.ports_out();
        let ports = self.io.port_outputs ^ self.inverts(Id::PortsPolarity, PORTS_OUT);
        for bit in (0..PORTS).filter(|bit| driven >> bit & 1 != 0) {
            self.io.pins.set(pin::IO1 + bit, ports >> bit & 1 != 0, board);
        }
        for axis in 0..AXIS_COUNT {
            let on = self.io.enables >> axis & 1 != 0;
            let enable = self.reads(axis, polarity::ENABLE, on);
            self.io.pins.set(axis * pin::AXIS + pin::ENABLE, enable, board);
            let clear = self.clears[axis].is_on();
            let clear = self.reads(axis, polarity::ERROR_CLEAR, clear);
            self.io.pins.set(axis * pin::AXIS + pin::ERROR_CLEAR, clear, board);
            let step = if polarity::reverses(self.polarity(axis)) { -STEP } else { STEP };
            let drive = Drive { step, parts: 1, current: if on { CURRENT } else { 0 } };
            if self.io.drives[axis].replace(drive) != Some(drive) {
                board.drive(axis, drive);
            }
        }
    }

    /// Whether the limits of an axis are on: plus, minus.
    pub fn limits_on(&self, axis: usize) -> [bool; 2] {
        self.io.limits[axis].map(|level| self.reads(axis, polarity::LIMITS, level))
    }

    /// Whether the alarm input of an axis is on.
    pub fn alarm_on(&self, axis: usize) -> bool {
        self.reads(axis, polarity::ALARM, self.io.alarms[axis])
    }

    /// Whether the driver of an axis says that it is in position.
    pub fn in_position(&self, axis: usize) -> bool {
        self.reads(axis, polarity::IN_POSITION, self.io.in_positions[axis])
    }

    /// Whether the home input of an axis is on.
    pub fn home_on(&self, axis: usize, board: &mut dyn Board) -> bool {
        self.reads(axis, polarity::HOME, board.digital(axis * pin::AXIS + pin::HOME))
    }

    /// Whether the Z index of an axis is on.
    pub fn index_on(&self, axis: usize, board: &mut dyn Board) -> bool {
        self.reads(axis, polarity::INDEX, board.digital(axis * pin::AXIS + pin::INDEX))
    }

    /// Whether the slowdown input of an axis is on.
    pub fn slowdown_on(&self, axis: usize, board: &mut dyn Board) -> bool {
        self.reads(axis, polarity::SLOWDOWN, board.digital(axis * pin::AXIS + pin::SLOWDOWN))
    }

    /// The high-speed inputs that are on, or one of them.
    pub fn inputs(&self, bit: Option<usize>) -> i32 {
        part((self.io.inputs ^ self.inverts(Id::InputsPolarity, 1)) & mask(BITS), bit)
    }

    /// The high-speed outputs that are on, or one of them.
    pub fn outputs(&self, bit: Option<usize>) -> i32 {
        part(self.io.high_speed_outputs(), bit)
    }

    /// Sets the high-speed outputs, or one of them. Those that follow the synchronisation stay as they are
    /// (manual, 2.1.3.2.2).
    pub fn set_outputs(&mut self, bit: Option<usize>, value: i32, board: &mut dyn Board) {
        let asked = with_part(self.io.outputs, bit, value);
        self.io.outputs = self.io.outputs & self.io.synchronised | asked & !self.io.synchronised;
        self.put_out(board);
    }

    /// An output follows the synchronisation, which has it on or off; or, with `None`, no longer: then it is
    /// as it was last set by hand.
    pub fn synchronise_output(&mut self, axis: usize, on: Option<bool>, board: &mut dyn Board) {
        let before = self.io.high_speed_outputs();
        self.io.synchronised = with_part(self.io.synchronised, Some(axis), on.is_some().into());
        self.io.sync_outputs = with_part(self.io.sync_outputs, Some(axis), (on == Some(true)).into());
        let now = self.io.high_speed_outputs();
        if now != before {
            let level = (now ^ self.inverts(Id::OutputsPolarity, 1)) >> axis & 1 != 0;
            self.io.pins.set(pin::DO1 + axis, level, board);
        }
    }

    /// Whether the output of an axis follows the synchronisation.
    pub const fn is_synchronised(&self, axis: usize) -> bool {
        self.io.synchronised >> axis & 1 != 0
    }

    /// The motors that have power, or one of them.
    pub fn enables(&self, bit: Option<usize>) -> i32 {
        part(self.io.enables, bit)
    }

    /// Switches motor power.
    pub fn set_enables(&mut self, bit: Option<usize>, value: i32, board: &mut dyn Board) {
        self.io.enables = with_part(self.io.enables, bit, value);
        self.put_out(board);
    }

    /// Which configurable inputs and outputs are outputs.
    fn ports_out(&self) -> u32 {
        self.memory.cells.get(Id::PortsOut) as u32
    }

    /// `IOCFG`: those that become inputs are let go, those that become outputs are driven as they were set.
    pub fn configure_ports(&mut self, outputs: i32, board: &mut dyn Board) {
        let released = self.ports_out() & !outputs as u32;
        self.memory.cells.set(Id::PortsOut, outputs);
        for bit in (0..PORTS).filter(|bit| released >> bit & 1 != 0) {
            self.io.pins.release(pin::IO1 + bit, board);
        }
        self.put_out(board);
    }

    /// The configurable inputs and outputs that are on, or one of them.
    pub fn ports(&self, bit: Option<usize>) -> i32 {
        let inputs = self.io.port_inputs ^ self.inverts(Id::PortsPolarity, PORTS_IN);
        let driven = self.ports_out();
        part(inputs & !driven | self.io.port_outputs & driven, bit)
    }

    /// Sets the configurable outputs, or one of them. What is an input remembers it until it is an output.
    pub fn set_ports(&mut self, bit: Option<usize>, value: i32, board: &mut dyn Board) {
        self.io.port_outputs = with_part(self.io.port_outputs, bit, value);
        self.put_out(board);
    }

    /// The voltage of an analog input, in mV.
    pub fn analog(&self, channel: usize, board: &mut dyn Board) -> i32 {
        board.analog(pin::AI1 + channel).clamp(0, MAX_MV)
    }

    /// Gives out a PWM signal: the setting of the first is how long it is low, of the second how long it is
    /// high (manual, 2.1.3.3.3).
    pub fn put_duty(&self, channel: usize, board: &mut dyn Board) {
        let percent = self.memory.cells.at(Id::Duty, channel);
        board.output_analog(pin::PWM1 + channel, if channel == 0 { 100 - percent } else { percent });
    }

    /// What was put out last: digital outputs, configurable ones, motor power.
    pub fn latches(&self) -> [u32; 3] {
        [self.io.outputs, self.io.port_outputs, self.io.enables]
    }

    /// Where outputs and motor power are at power-up.
    pub fn boot_outputs(&mut self, board: &mut dyn Board) {
        self.io.outputs = self.memory.cells.get(Id::OutputsBoot) as u32;
        self.io.enables = self.memory.cells.get(Id::EnablesBoot) as u32;
        self.io.port_outputs = self.memory.cells.get(Id::PortsBoot) as u32 & self.ports_out();
        self.put_out(board);
        for channel in 0..2 {
            self.put_duty(channel, board);
        }
    }
}

/// So many bits.
const fn mask(bits: usize) -> u32 {
    (1 << bits) - 1
}

fn part(bits: u32, bit: Option<usize>) -> i32 {
    bit.map_or(bits, |bit| bits >> bit & 1) as i32
}

fn with_part(bits: u32, bit: Option<usize>, value: i32) -> u32 {
    match bit {
        None => value as u32,
        Some(bit) if value != 0 => bits | 1 << bit,
        Some(bit) => bits & !(1 << bit),
    }
}
