//! The error clear output: a pulse that tells a servo driver to forget its deflection (manual, 2.1.6.1).

use super::pins::number as pin;
use super::table::{AXIS_COUNT, Id};
use super::{Cmd4cr, HZ, polarity};
use crate::board::Board;
use crate::flash::Flash;
use ::motion::Ticks;

/// `ERCD`: how long the pulse waits, in microseconds (manual, table 2-14).
const DELAYS_US: [u32; 4] = [0, 12, 1600, 104_000];

/// `ERCP`: how long it is (manual, table 2-15).
const WIDTHS_US: [u32; 7] = [12, 102, 409, 1600, 13_000, 52_000, 104_000];

/// When the pulse is given; the bit of `ERC` that asks for it (manual, table 2-13).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Occasion {
    /// An error has stopped the axis.
    ErrorStop = 1,
    /// Homing is over.
    Home = 2,
}

/// The output of an axis.
#[derive(Clone, Copy, Debug)]
pub struct ErrorClear {
    /// When the pulse begins and when it ends.
    pulse: Option<(Ticks, Ticks)>,
    on: bool,
}

impl ErrorClear {
    pub const fn new() -> Self {
        Self { pulse: None, on: false }
    }

    /// Whether the output is on.
    pub const fn is_on(&self) -> bool {
        self.on
    }

    /// When it changes next.
    pub fn due(&self) -> Option<Ticks> {
        self.pulse.map(|(from, to)| if self.on { to } else { from })
    }
}

/// Clocks of some microseconds, up to a whole one.
const fn micros(us: u32) -> Ticks {
    (us as Ticks * HZ as Ticks).div_ceil(1_000_000)
}

impl<F: Flash> Cmd4cr<F> {
    /// Gives the pulse if the axis is to give it on this occasion.
    pub fn clear_deflection(&mut self, axis: usize, occasion: Occasion) {
        let get = |id| self.memory.cells.at(id, axis) as usize;
        if get(Id::ErrorClear) & occasion as usize != 0 {
            let from = self.now + micros(DELAYS_US[get(Id::ErrorClearDelay)]);
            let to = from + micros(WIDTHS_US[get(Id::ErrorClearWidth)]);
            self.clears[axis].pulse = Some((from, to));
        }
    }

    /// Switches the outputs whose time has come.
    pub fn give_clears(&mut self, board: &mut dyn Board) {
        for axis in 0..AXIS_COUNT {
            let Some((from, to)) = self.clears[axis].pulse else { continue };
            let on = (from..to).contains(&self.now);
            if self.now >= to {
                self.clears[axis].pulse = None;
            }
            if core::mem::replace(&mut self.clears[axis].on, on) != on {
                let inverted = self.polarity(axis) & polarity::ERROR_CLEAR != 0;
                self.io.pins.set(axis * pin::AXIS + pin::ERROR_CLEAR, on != inverted, board);
            }
        }
    }
}
