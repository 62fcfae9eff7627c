//! Digital inputs and outputs, motor power, analog inputs, and what the polarity words do to them
//! (manual, sections 7.5, 7.13, 7.14 and 7.16).

use super::pins::{MAX_MV, PORT_BITS, number as pin};
use super::table::{AXIS_COUNT, Id};
use super::{Pmx2ed, polarity};
use crate::ascii::outputs::Outputs;
use crate::board::{Board, Drive};
use crate::flash::Flash;

/// A pulse is the driver's finest microstep, an eighth of a full step, as with open jumpers (manual, 5.3).
const STEP: i16 = 1;

/// Full current in the units of [`Drive`].
const CURRENT: u8 = 32;

/// Levels of the pins.
#[derive(Clone, Copy, Debug)]
pub struct Io {
    /// Levels of the digital inputs, DI1 in bit 0.
    inputs: u8,
    /// Which digital outputs are on.
    outputs: u8,
    /// Which motors have power.
    enables: u8,
    /// Levels of the limit inputs of each axis: plus, minus.
    limits: [[bool; 2]; AXIS_COUNT],
    drives: [Option<Drive>; AXIS_COUNT],
    pins: Outputs,
}

impl Io {
    pub const fn new() -> Self {
        Self {
            inputs: 0,
            outputs: 0,
            enables: 0,
            limits: [[false; 2]; AXIS_COUNT],
            drives: [None; AXIS_COUNT],
            pins: Outputs::new(),
        }
    }

    /// The driver stages, once they were told what to do.
    pub const fn drives(&self) -> [Option<Drive>; AXIS_COUNT] {
        self.drives
    }
}

impl<F: Flash> Pmx2ed<F> {
    /// The polarity word of an axis.
    pub fn polarity(&self, axis: usize) -> i32 {
        self.memory.cells.at(Id::Polarity, axis)
    }

    /// Sets a polarity word: pins that it inverts change at once, the encoder goes on from where it is.
    pub fn set_polarity(&mut self, axis: usize, word: i32, board: &mut dyn Board) {
        for other in 0..AXIS_COUNT {
            let shared = self.polarity(other) & !polarity::SHARED | word & polarity::SHARED;
            let word = if other == axis { word } else { shared };
            self.stations[other].encoder.set_decoding(polarity::decoding_shift(word), board.encoder(other));
            self.memory.cells.set_at(Id::Polarity, other, word);
        }
        self.put_out(board);
    }

    /// Whether a polarity bit of an axis inverts a level.
    fn reads(&self, axis: usize, bit: i32, level: bool) -> bool {
        level != (self.polarity(axis) & bit != 0)
    }

    /// Drives every output as state and polarity say.
    pub fn put_out(&mut self, board: &mut dyn Board) {
        for bit in 0..PORT_BITS {
            let on = self.io.outputs >> bit & 1 != 0;
            let level = self.reads(0, polarity::OUTPUTS, on);
            self.io.pins.set(pin::DO1 + bit, level, board);
        }
        for axis in 0..AXIS_COUNT {
            let on = self.io.enables >> axis & 1 != 0;
            let enable = self.reads(axis, polarity::ENABLE, on);
            self.io.pins.set(pin::EO1 + axis, enable, board);
            let step = if self.polarity(axis) & polarity::DIRECTION != 0 { -STEP } else { STEP };
            let drive = Drive { step, parts: 1, current: if on { CURRENT } else { 0 } };
            if self.io.drives[axis].replace(drive) != Some(drive) {
                board.drive(axis, drive);
            }
        }
    }

    /// A digital input or limit changes its level; others are read when they are asked for.
    pub fn take_level(&mut self, number: usize, level: bool) {
        match number {
            pin::DI1..pin::DO1 => {
                let bit = 1 << (number - pin::DI1);
                self.io.inputs = if level { self.io.inputs | bit } else { self.io.inputs & !bit };
            }
            0..pin::DI1 if number % pin::AXIS <= pin::MINUS_LIMIT => {
                self.io.limits[number / pin::AXIS][number % pin::AXIS] = level;
            }
            _ => {}
        }
    }

    /// Whether the limits of an axis are on: plus, minus.
    pub fn limits_on(&self, axis: usize) -> [bool; 2] {
        self.io.limits[axis].map(|level| self.reads(axis, polarity::LIMITS, level))
    }

    /// Whether the home input of an axis is on.
    pub fn home_on(&self, axis: usize, board: &mut dyn Board) -> bool {
        self.reads(axis, polarity::HOME, board.digital(axis * pin::AXIS + pin::HOME))
    }

    /// Whether the Z index of an axis is on.
    pub fn index_on(&self, axis: usize, board: &mut dyn Board) -> bool {
        self.reads(axis, polarity::INDEX, board.digital(axis * pin::AXIS + pin::INDEX))
    }

    /// The digital inputs that are on, or one of them.
    pub fn inputs(&self, bit: Option<usize>) -> i32 {
        let inverted = if self.polarity(0) & polarity::INPUTS != 0 { u8::MAX } else { 0 };
        part(self.io.inputs ^ inverted, bit)
    }

    /// The digital outputs that are on, or one of them.
    pub fn outputs(&self, bit: Option<usize>) -> i32 {
        part(self.io.outputs, bit)
    }

    /// Sets the digital outputs, or one of them.
    pub fn set_outputs(&mut self, bit: Option<usize>, value: i32, board: &mut dyn Board) {
        self.io.outputs = with_part(self.io.outputs, bit, value);
        self.put_out(board);
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

    /// The voltage of an analog input, in mV.
    pub fn analog(&self, channel: usize, board: &mut dyn Board) -> i32 {
        board.analog(pin::AI1 + channel).clamp(0, MAX_MV)
    }

    /// What was put out last: digital outputs, configurable ones, motor power.
    pub fn latches(&self) -> [u32; 3] {
        [self.io.outputs.into(), 0, self.io.enables.into()]
    }

    /// Where outputs and motor power are at power-up.
    pub fn boot_outputs(&mut self, board: &mut dyn Board) {
        self.io.outputs = self.memory.cells.get(Id::OutputsBoot) as u8;
        self.io.enables = self.memory.cells.get(Id::EnablesBoot) as u8;
        self.put_out(board);
    }
}

fn part(bits: u8, bit: Option<usize>) -> i32 {
    bit.map_or(bits, |bit| bits >> bit & 1).into()
}

fn with_part(bits: u8, bit: Option<usize>, value: i32) -> u8 {
    match bit {
        None => value as u8,
        Some(bit) if value != 0 => bits | 1 << bit,
        Some(bit) => bits & !(1 << bit),
    }
}
