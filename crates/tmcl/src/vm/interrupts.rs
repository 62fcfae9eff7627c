//! Which interrupts are enabled, pending and where their handlers are.

use super::Context;
use crate::isa::{GLOBAL_INTERRUPT, INTERRUPTS, interrupt_index};

/// A vector that has not been set.
const NONE: u16 = u16::MAX;

/// A bit for each entry of [`INTERRUPTS`].
type Mask = u16;
const _: () = assert!(INTERRUPTS.len() <= Mask::BITS as usize);

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Interrupts {
    vectors: [u16; INTERRUPTS.len()],
    enabled: Mask,
    pending: Mask,
    global: bool,
    /// What the handler that is running interrupted.
    saved: Option<Context>,
    /// Those that would be taken now; kept up to date so that the run loop looks at one number.
    due: Mask,
}

impl Interrupts {
    pub(super) const fn new() -> Self {
        Self { vectors: [NONE; INTERRUPTS.len()], enabled: 0, pending: 0, global: false, saved: None, due: 0 }
    }

    fn update(&mut self) {
        self.due = if self.global && self.saved.is_none() { self.pending & self.enabled } else { 0 };
    }

    /// Whether one is to be taken before the next command.
    #[inline(always)]
    pub(super) const fn is_due(&self) -> bool {
        self.due != 0
    }

    /// Whether a handler is running.
    pub(super) const fn in_handler(&self) -> bool {
        self.saved.is_some()
    }

    /// What that handler interrupted.
    pub(super) const fn saved(&self) -> Option<Context> {
        self.saved
    }

    /// The address of the handler that is entered next.
    pub(super) const fn vector(&self) -> u16 {
        self.vectors[self.due.trailing_zeros() as usize]
    }

    /// `EI` and `DI`; false if there is no such interrupt. One that is disabled is also forgotten.
    pub(super) fn enable(&mut self, number: u8, on: bool) -> bool {
        if number == GLOBAL_INTERRUPT {
            self.global = on;
        } else if let Some(index) = interrupt_index(number) {
            let bit = 1 << index;
            if on {
                self.enabled |= bit;
            } else {
                self.enabled &= !bit;
                self.pending &= !bit;
            }
        } else {
            return false;
        }
        self.update();
        true
    }

    /// `VECT`; false if there is no such interrupt.
    pub(super) fn set_vector(&mut self, number: u8, address: u16) -> bool {
        let Some(index) = interrupt_index(number) else { return false };
        self.vectors[index] = address;
        true
    }

    /// An interrupt happens. It is remembered if it is enabled and has a handler.
    pub(super) fn raise(&mut self, number: u8) {
        let Some(index) = interrupt_index(number) else { return };
        if self.enabled & 1 << index != 0 && self.vectors[index] != NONE {
            self.pending |= 1 << index;
            self.update();
        }
    }

    /// Enters the handler of the first due interrupt and gives its address.
    pub(super) fn enter(&mut self, context: Context) -> u16 {
        let index = self.due.trailing_zeros() as usize;
        self.pending &= !(1 << index);
        self.saved = Some(context);
        self.update();
        self.vectors[index]
    }

    /// Leaves the handler; `None` if none is running.
    pub(super) fn leave(&mut self) -> Option<Context> {
        let context = self.saved.take();
        self.update();
        context
    }

    /// Forgets what is pending and the handler that was running. Vectors and enables stay.
    pub(super) fn reset(&mut self) {
        self.pending = 0;
        self.saved = None;
        self.update();
    }
}
