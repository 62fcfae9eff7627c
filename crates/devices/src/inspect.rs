//! What a debugger sees of a controller, without changing it.

extern crate alloc;

use crate::{Board, gate::Gate};
use alloc::{string::String, vec::Vec};
use motion::Ticks;

/// What a quantity belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Scope {
    /// The registers of the program itself: accumulator, flags.
    Program,
    /// Variables.
    Variables,
    /// Parameters and registers of the axes.
    Axes,
    /// All other parameters and registers of the device.
    Device,
}

/// Something that has a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// Its name, for [`Inspect::value`].
    pub name: String,
    /// What it belongs to.
    pub scope: Scope,
    /// What it is, in a sentence; may be empty.
    pub text: &'static str,
}

/// The programs of a controller, and its numbers, for somebody who looks on.
pub trait Inspect {
    /// The gate before its programs' lines.
    fn gate(&mut self) -> &mut Gate;

    /// The program whose line is due first, and when; `None` while all stand or wait. One number more than there
    /// are programs is that of a subroutine that a host has started.
    fn next_program(&self) -> Option<(Ticks, usize)>;

    /// The address of a program's next line; `None` if there is no such program.
    fn address(&self, program: usize) -> Option<u16>;

    /// Where a program is: the address of its next line, and the one from which each routine that it is in
    /// was called or interrupted, innermost first.
    fn frames(&self, program: usize) -> Vec<u16>;

    /// The value of a quantity; `None` if there is none of this name.
    fn value(&self, name: &str, board: &mut dyn Board) -> Option<f64>;

    /// Sets a register of a program that no host can set; false if there is none of this name.
    fn set_register(&mut self, _name: &str, _value: i32) -> bool {
        false
    }

    /// Everything that has a value.
    fn quantities(&self) -> Vec<Quantity>;
}
