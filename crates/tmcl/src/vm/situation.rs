//! Where a program stands, to see whether it comes there again.

use super::{Interrupts, Pending, Registers, STACK_DEPTH, Variables, Vm};

/// What a program does next depends on this, and on what the device does and reads for it.
#[derive(Clone, Debug)]
pub struct Situation {
    counter: u16,
    pending: Pending,
    registers: Registers,
    interrupts: Interrupts,
    stack: heapless::Vec<u16, STACK_DEPTH>,
    variables: Box<Variables>,
}

impl Vm {
    /// The present situation.
    pub fn situation(&self) -> Situation {
        Situation {
            counter: self.counter,
            pending: self.pending,
            registers: self.registers,
            interrupts: self.interrupts.clone(),
            stack: self.stack.clone(),
            variables: Box::new(self.variables),
        }
    }

    /// Whether the program is in this situation. How many commands it has executed does not matter.
    pub fn is_in(&self, situation: &Situation) -> bool {
        let Situation { counter, pending, registers, interrupts, stack, variables } = situation;
        *counter == self.counter
            && *pending == self.pending
            && *registers == self.registers
            && *interrupts == self.interrupts
            && *stack == self.stack
            && **variables == self.variables
    }

    /// Commands were executed that nobody has seen: rounds that change nothing.
    pub const fn count(&mut self, instructions: u64) {
        self.instructions += instructions;
    }
}
