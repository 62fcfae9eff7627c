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

/// Goes on from where the paint was last found to end, so that it costs next to nothing to ask often.
pub struct Gauge {
    /// Bytes that still had paint.
    unused: u32,
}

impl Gauge {
    /// Before it has looked.
    pub const fn new() -> Self {
        Self { unused: u32::MAX }
    }

    /// Bytes that were never used.
    pub fn unused(&mut self) -> u32 {
        let (bottom, _) = bounds();
        let mut words = 0;
        let most = self.unused.min(size()) / 4;
        while words < most {
            // SAFETY: inside the stack, which is memory for as long as there is a program, aligned, and volatile,
            // since this function has its own words there.
            #[allow(unsafe_code)]
            let word = unsafe { bottom.add(words as usize).read_volatile() };
            if word != STACK_PAINT_VALUE {
                break;
            }
            words += 1;
        }
        self.unused = words * 4;
        self.unused
    }
}
