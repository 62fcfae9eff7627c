//! The log of edges: when each pulse was due and how late it was.

use crate::registers::PAGE;
use crate::timer::extended;
use motion::Direction;
use runtime::hardware::TimerTicks;
use tock_registers::interfaces::{Readable, Writeable};

use super::page::{LOG_EDGES, set_long};

/// Which way a pulse went, in [`Edge::axis`](super::page::Edge).
const UP: u32 = 1 << 8;

/// Logs a pulse, while the host wants more.
#[inline]
pub fn edge(axis: usize, direction: Direction, due: TimerTicks, late: u32) {
    let wanted = PAGE.log_wanted.get();
    if wanted != 0 {
        write(wanted, axis, direction, due, late);
    }
}

#[cold]
#[inline(never)]
fn write(wanted: u32, axis: usize, direction: Direction, due: TimerTicks, late: u32) {
    let page = &*PAGE;
    let at = page.logged.get();
    if at >= wanted.min(LOG_EDGES as u32) {
        return;
    }
    let edge = &page.log[at as usize];
    set_long(&edge.due, extended(due));
    edge.axis.set(axis as u32 | if direction == Direction::Positive { UP } else { 0 });
    edge.late.set(late);
    page.logged.set(at + 1);
}
