//! How much of the stack was never used: cortex-m-rt paints it before anything runs.

use cortex_m_rt::STACK_PAINT_VALUE;

#[allow(unsafe_code)]
// SAFETY: the linker script has these symbols; only their addresses are of use.
unsafe extern "C" {
    static _stack_start: u32;
    static _stack_end: u32;
}

/// First and one past the last address.
fn bounds() -> (*const u32, *const u32) {
    (&raw const _stack_end, &raw const _stack_start)
}

/// Bytes that it has.
pub fn size() -> u32 {
    let (end, start) = bounds();
    start.addr().wrapping_sub(end.addr()) as u32
}

/// Words that are looked at in one go.
const STRIDE: usize = 64;

/// Looks for the end of the paint, a part of the stack at a time: it is asked often.
pub struct Gauge {
    /// Words that still had paint when the whole was looked at.
    painted: usize,
    /// How far it has come.
    at: usize,
}

impl Gauge {
    /// Before it has looked.
    pub const fn new() -> Self {
        Self { painted: usize::MAX, at: 0 }
    }

    /// Bytes that were never used, as far as is known.
    pub fn unused(&mut self) -> u32 {
        let (bottom, _) = bounds();
        self.painted = self.painted.min(size() as usize / 4);
        let end = self.painted.min(self.at + STRIDE);
        let used = (self.at..end).find(|&word| {
            // SAFETY: inside the stack, which is memory for as long as there is a program, aligned, and volatile,
            // since this function has its own words there.
            #[allow(unsafe_code)]
            let word = unsafe { bottom.add(word).read_volatile() };
            word != STACK_PAINT_VALUE
        });
        if let Some(word) = used {
            self.painted = word;
        }
        self.at = if end < self.painted { end } else { 0 };
        4 * self.painted as u32
    }
}
