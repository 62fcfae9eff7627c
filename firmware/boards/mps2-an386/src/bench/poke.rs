//! Faults that the host asks for, to see what becomes of them.

use crate::registers::{NOWHERE, PAGE};
use core::hint::black_box;
use tock_registers::interfaces::{Readable, Writeable};

/// Fails an assertion.
const ASSERTION: u32 = 1;
/// Never comes back.
const HANG: u32 = 2;
/// Runs over the end of the stack.
const STACK: u32 = 3;
/// Accesses memory that there is not.
const BUS: u32 = 4;

/// Does what the host asked for. From the main loop.
pub fn take() {
    let poke = PAGE.poke.get();
    if poke == 0 {
        return;
    }
    PAGE.poke.set(0);
    match poke {
        ASSERTION => assert!(poke != ASSERTION),
        HANG => loop {
            cortex_m::asm::nop();
        },
        STACK => {
            black_box(dig(poke));
        }
        BUS => {
            NOWHERE.get();
        }
        _ => {}
    }
}

/// Calls itself without end. No compiler makes a loop of it: what comes after the call needs what it gave.
#[inline(never)]
fn dig(depth: u32) -> u32 {
    let room = black_box([depth; 16]);
    if black_box(depth) == 0 { room[0] } else { black_box(room)[1].rotate_left(black_box(dig(depth + 1))) }
}
