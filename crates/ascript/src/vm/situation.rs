//! Where a thread stands, to see whether it comes there again.

use super::{Memory, Thread};

/// What a thread does next depends on this, and on what the device does and reads for it.
#[derive(Clone, Debug)]
pub struct Situation {
    thread: Thread,
    variables: Vec<i32>,
}

impl Situation {
    /// The present situation.
    pub fn of<const LINES: usize, const VARIABLES: usize>(
        thread: &Thread,
        memory: &Memory<LINES, VARIABLES>,
    ) -> Self {
        Self { thread: thread.clone(), variables: memory.variables.to_vec() }
    }

    /// Whether a thread is in this situation. How many lines it has executed does not matter.
    pub fn is<const LINES: usize, const VARIABLES: usize>(
        &self,
        thread: &Thread,
        memory: &Memory<LINES, VARIABLES>,
    ) -> bool {
        let Thread { state, counter, start, stack, temporaries, handler, pending, fetched, instructions: _ } =
            &self.thread;
        *counter == thread.counter
            && *pending == thread.pending
            && *fetched == thread.fetched
            && *temporaries == thread.temporaries
            && *stack == thread.stack
            && (*state, *start, *handler) == (thread.state, thread.start, thread.handler)
            && self.variables == memory.variables
    }
}
